"""Warnings for what is legal but odd: each with its place in the file, and none for what is shipped."""

from pathlib import Path

import pytest
from msgspec.structs import replace

from crew.contracts.files.contract_file import load_contract
from crew.contracts.odd.look import oddities
from crew.contracts.odd.oddity import Oddity
from crew.contracts.site import Rules
from crew.library import CONTRACTS, crew_names, load_rules

CREW_OF = {"carry": "humanoid_quadruped", "handover": "humanoid_quadruped", "navigation_only": "humanoid_quadruped"}


def text_of(name: str) -> str:
    return (CONTRACTS / f"{name}.yaml").read_text(encoding="utf-8")


def warnings(name: str, *edits: tuple[str, str], others: tuple[str, ...] = ()) -> tuple[tuple[Oddity, ...], str]:
    """The warnings about one shipped contract after edits, alone or beside others, and the edited text."""
    rules = load_rules(CREW_OF.get(name, "air_ground"))
    text = text_of(name)
    for old, new in edits:
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    contract = load_contract(text, source=f"{name}.yaml", crew=rules.crew, kinds=rules.kinds)
    kept = {other: rules.contracts[other] for other in others}
    changed = replace(rules, contracts={**kept, contract.name: contract})
    return oddities(changed, {**{other: text_of(other) for other in others}, contract.name: text}), text


@pytest.mark.parametrize("crew", crew_names())
def test_what_is_shipped_is_not_odd(crew: str) -> None:
    rules = load_rules(crew)
    texts = {name: Path(contract.source).read_text(encoding="utf-8") for name, contract in rules.contracts.items()}
    assert oddities(rules, texts) == ()


@pytest.mark.parametrize(
    ("name", "edit", "what", "at"),
    [
        (
            "search_only",
            ("    after: [takeoff]\n", "    after: [takeoff]\n    needs: [{searcher.airborne: true}]\n"),
            "the guard 'searcher is airborne' always holds: search_target needs it already",
            "searcher.airborne: true",
        ),
        (
            "search_and_dispatch",
            ("    after: [report]\n    words", "    after: [report]\n    needs: [{victim: ok}]\n    words"),
            "the guard 'victim is ok' always holds: the call goes there",
            "victim: ok",
        ),
        (
            "search_and_dispatch",
            ("    after: [report]\n    words", "    after: [report]\n    needs: [{if: {person: victim}, responder.at: base}]\n    words"),  # noqa: E501
            "'if person is victim' always holds: the slot person is never anything else",
            "responder.at: base",
        ),
        (
            "carry",
            ("{carrier.tray: $object}]\n    do", "{if: {object: given}, carrier.tray: $object}]\n    do"),
            "'if object is given' always holds: the slot object is never open",
            "carrier.tray: $object}]\n    do",
        ),
        (
            "carry",
            ("{carrier.tray: none}]", "{carrier.tray: none}, {carrier.tray: $object}]"),
            "'tray of carrier is none' and 'tray of carrier is $object' never hold together",
            "carrier.tray: $object}]\n    do: {pick_place",
        ),
        (
            "carry",
            ("{carrier.tray: none}]", "{carrier.tray: none}, {carrier.tray: none}]"),
            "the guard 'tray of carrier is none' stands here twice",
            "carrier.tray: none}]",
        ),
        (
            "handover",
            ("    role: giver\n", "    role: giver\n    needs: [{requester.near: true}]\n"),
            "the entry guard 'requester is near' is a guard of the only step as well",
            "requester.near: true}\n",
        ),
        (
            "navigation_only",
            ("    do: {navigate", "    needs: [{walker.at: $destination}, {walker.moving: false}]\n    do: {navigate"),
            "step go changes nothing that shows: walker.at holds already, a guard of this step says so",
            "do:",
        ),
        (
            "navigation_only",
            ("complete: [{walker.at: $destination}]", "complete: [{walker.moving: false}]"),
            "the completion holds before the mission starts: walker is not moving, as robots at rest do",
            "complete:",
        ),
        (
            "carry",
            ("  origin: {type: location", "  spare: {type: object, optional: true}\n  origin: {type: location"),
            "no step reads the slot spare",
            "spare:",
        ),
        (
            "carry",
            ("  - {if: {origin: given}, object.at: $origin}\n", ""),
            "the claim origin is read from requests and compared with nothing",
            "origin: {type",
        ),
    ],
)  # fmt: skip
def test_an_oddity_is_named_where_it_stands(name: str, edit: tuple[str, str], what: str, at: str) -> None:
    found, text = warnings(name, edit)
    assert len(found) == 1, found
    assert found[0].what.startswith(what)
    assert text.count(at) == 1, at
    before = text[: text.index(at)]
    assert (found[0].line, found[0].column) == (before.count("\n") + 1, len(before) - before.rfind("\n"))
    assert str(found[0]).startswith(f"{name}.yaml:{found[0].line}:{found[0].column}: warning: {what}")


def test_a_step_that_repeats_an_earlier_one_changes_nothing() -> None:
    again = "  again: {role: searcher, after: [takeoff, report], do: {takeoff: {altitude: 5}}}\n"
    text = text_of("search_only")
    land = text[text.index("  land:\n") : text.index("complete:")]
    required = ("    optional: true\n    words: [get up, take up]\n    do: {takeoff", "    do: {takeoff")
    found, _ = warnings("search_only", (land, again), required)
    assert [o.what for o in found] == [
        "step again changes nothing that shows: searcher.airborne holds already, step takeoff has brought it about"
    ]


def test_two_contracts_with_one_wording_are_named_unless_the_state_tells_them_apart() -> None:
    same = ("  - (hand|give) {object} to me\n", "  - (carry|bring|take|deliver) {object} to {destination}\n")
    slot = ("  object: {type: object}\n", "  object: {type: object}\n  destination: {type: [location, requester]}\n")
    guards = ("  - {requester.near: true}\n", "")
    apart, _ = warnings("handover", same, slot, others=("carry",))
    alike, _ = warnings("handover", same, slot, guards, others=("carry",))
    assert not [o for o in apart if "nothing tells them apart" in o.what]
    told = [o for o in alike if "nothing tells them apart" in o.what]
    assert [o.what for o in told] == [
        "'bring <object> to <location or requester>' is a request of carry and of handover, "
        "and nothing tells them apart"
    ]


def test_two_contracts_with_one_summary_are_named() -> None:
    said = "summary: Send a ground robot to a point, to a named location, or to a person whose fix is still fresh."
    found, _ = warnings("search_only", (text_of("search_only").splitlines()[1], said), others=("dispatch_only",))
    assert [o.what.partition(":")[0] for o in found] == ["the summary says what dispatch_only says"]


def test_rules_of_a_library_are_compared_pair_by_pair() -> None:
    rules: Rules = load_rules("air_ground")
    assert oddities(rules, {}) == ()
