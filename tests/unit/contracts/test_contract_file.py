"""Contract files: what is read, and every mistake with its place."""

from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from crew.contracts.contract import CallPattern, Condition, Role, SafeState, SlotType
from crew.contracts.files.contract_file import load_contract
from crew.contracts.files.crew_file import load_crew
from crew.contracts.files.source import SourceErrors
from crew.contracts.kinds.quadcopter import QUADCOPTER
from crew.contracts.kinds.rover import ROVER
from crew.contracts.site import Crew
from crew.contracts.skill import Kind
from tests.unit.contracts.carry import CARRY_TEXT, carry, crew_of, edited, errors_of, mark

ROOT = Path(__file__).parents[3]
LIBRARY = sorted((ROOT / "contracts" / "library").glob("*.yaml"))


def test_carry_is_read_as_written() -> None:
    contract = carry()
    assert contract.name == "carry"
    assert contract.deadline_s == 300.0
    assert contract.asks == ("deliver",)
    assert contract.source == "carry.yaml"
    origin, destination = contract.slot("origin"), contract.slot("destination")
    assert origin is not None
    assert destination is not None
    assert (origin.said_from, origin.optional, origin.types) == (True, True, (SlotType.LOCATION,))
    assert (destination.types, destination.values) == ((SlotType.LOCATION, SlotType.VALUE), ("requester",))
    assert contract.roles == (
        Role(name="loader", safe=None, line=8),
        Role(name="carrier", safe=SafeState("stop", {"moving": False}), line=9),
    )


def test_guards_carry_their_if_their_negation_and_their_line() -> None:
    contract = carry()
    assert contract.needs == (
        Condition(path="requester.near", value=False, when={"destination": "requester"}, line=12),
        Condition(path="object.at", value="$origin", when={"origin": "given"}, line=13),
    )
    load = contract.step("load")
    assert load is not None
    assert load.needs == (
        Condition(path="carrier.at", value="pickup", line=23),
        Condition(path="carrier.moving", value=False, line=23),
    )
    assert contract.never[0].when == (Condition(path="carrier.at", value="pickup", negated=True, line=32),)


def test_never_separates_arguments_that_must_differ() -> None:
    first, second = carry().never
    assert (first.with_args, first.without_args) == ({"location": "payload_tray"}, {})
    assert (second.with_args, second.without_args) == ({}, {"location": "pickup"})


def test_several_paths_in_one_mapping_are_conditions_of_their_own() -> None:
    text = edited(
        CARRY_TEXT, "[{carrier.at: pickup}, {carrier.moving: false}]", "[{carrier.at: pickup, carrier.moving: false}]"
    )
    assert carry(text) == carry()


def test_a_step_may_do_one_of_several_calls() -> None:
    text = edited(CARRY_TEXT, "do: {navigate: {location: pickup}}", "do: [{navigate: {location: pickup}}, {stop: {}}]")
    step = carry(text).step("approach")
    assert step is not None
    assert step.do == (CallPattern("navigate", {"location": "pickup"}), CallPattern("stop", {}))


def test_a_role_without_a_safe_state_stays() -> None:
    role = carry(edited(CARRY_TEXT, "loader:  {safe: stay}", "loader:  {}")).role("loader")
    assert role is not None
    assert role.safe is None


def _air_ground() -> tuple[Crew, dict[str, Kind]]:
    path = ROOT / "crew" / "crews" / "air_ground.yaml"
    crew = load_crew(path.read_text(), source=path.name)
    return crew, {"quadcopter": QUADCOPTER, "rover": ROVER}


@pytest.mark.parametrize("path", [p for p in LIBRARY if p.stem in _air_ground()[0].contracts], ids=lambda p: p.stem)
def test_shipped_contracts_load(path: Path) -> None:
    crew, kinds = _air_ground()
    assert load_contract(path.read_text(), source=path.name, crew=crew, kinds=kinds).name == path.stem


SHAPE = [
    ("contract: carry", "contract: Carry-it", "Carry-it", "bad value of contract: found 'Carry-it', allowed: a name"),
    ("contract: carry\n", "", "summary", "missing key 'contract'"),
    ("asks: [deliver]\n", "", "contract", "missing key 'asks'"),
    ("    role: loader\n", "", "load:\n", "missing key 'role' in steps.load"),
    ("after: [approach]", "afer: [approach]", "afer", "unknown key of a step: found 'afer'"),
    ("said: from", "sayd: from", "sayd", "did you mean 'said'?"),
    ("said: from", "said: to", "to, optional", "bad value of slots.origin.said: found 'to', allowed: 'from'"),
    ("optional: true}", "optional: yes}", "yes}", "YAML 1.2 reads yes as text: write true"),
    ("optional: true\n", "optional: 1\n", "1\n    do", "found 1, allowed: true or false"),
    ("deadline_s: 300", "deadline_s: 0", "0\n", "bad value of deadline_s: found 0, allowed: more than 0"),
    ("deadline_s: 300", "deadline_s: -1.5", "-1.5", "found -1.5, allowed: more than 0"),
    ("deadline_s: 300", "deadline_s: .inf", ".inf", "found inf, allowed: a finite number"),
    ("deadline_s: 300", "deadline_s: 5 min", "5 min", "write the number alone, without a unit, in seconds"),
    ("deadline_s: 300", "deadline_s: 1_000", "1_000", "YAML 1.2 reads this as text: write digits"),
    ("deadline_s: 300", "deadline_s:", "deadline_s", "'deadline_s' of a contract has no value; write one"),
    ("after: [load]", "after: load", "load\n    words: [carry", "found 'load', allowed: a list"),
    ("safe: stay", "safe: halt", "halt", "bad value of roles.loader.safe: found 'halt', allowed: a mapping"),
    ("by: stop, ", "", "safe: {reach", "missing key 'by' in roles.carrier.safe"),
    ("do: {navigate: {location: pickup}}", "do: navigate", "navigate\n  load", "found 'navigate', allowed: a mapping"),
    (
        "do: {navigate: {location: pickup}}",
        "do: {navigate: }",
        " }\n  load",
        "found nothing, allowed: a mapping; write {}",
    ),
    (
        "do: {navigate: {location: pickup}}",
        "do: {navigate: {location: pickup}, stop: {}}",
        "{navigate: {location: pickup}",
        "found a mapping of 2, allowed: at most 1",
    ),
    ("{location: pickup}}", "{location: true}}", "true}}", "found true, allowed: a number, a name or $slot"),
    ("at: {not: pickup}}", "at: {is: pickup}}", "{is", "allowed: a value, or {not: value}"),
    ("why: it is empty", "why: ''", "''", "bad value of never.1.why: found '', allowed: some text"),
    ("roles:\n  loader", "roles:\n  Loader", "Loader", "not a name in roles: found 'Loader', allowed: a name"),
]
MEANING = [
    ("{navigate: {location: pickup}}", "{navgate: {location: pickup}}", "navgate", "no kind of crew lab has it"),
    ("{navigate: {location: pickup}}", "{navgate: {location: pickup}}", "navgate", "did you mean 'navigate'?"),
    ("object: $object,", "object: $objekt,", "$objekt", "unknown slot: found '$objekt'"),
    ("object: $object,", "object: $object.x,", "$object.x", "slot object has no such field"),
    ("object: $object,", "object: $destination,", "$destination,", "argument object can't be this slot"),
    ("object: $object,", "object: cup,", "cup,", "unknown object: found 'cup', allowed: red_cube, bottle"),
    ("object: $object,", "object: 3,", "3,", "is no name: found 3, allowed: the name of an object"),
    ("{location: pickup}}", "{location: pikup}}", "pikup", "did you mean 'pickup'?"),
    ("{location: pickup}}", "{}}", "navigate: {}", "navigate lacks location"),
    ("{location: pickup}}", "{location: pickup, speed: 2}}", "speed", "unknown argument of navigate: found 'speed'"),
    ("navigate: {location: pickup}", "patrol: {location: pickup, x: 1, y: 2}", "patrol", "patrol mixes its forms"),
    ("navigate: {location: pickup}", "patrol: {x: 1}", "patrol", "allowed: exactly one of {location} or {x, y}"),
    ("navigate: {location: pickup}", "patrol: {x: 1, y: 7}", "7}", "out of bounds: found 7, allowed: -5 to 5 m"),
    ("navigate: {location: pickup}", "patrol: {x: 1, y: 5 ft}", "5 ft", "write the number alone, without a unit"),
    ("navigate: {location: pickup}", "patrol: {x: 1, y: $object}", "$object}}\n  load", "y can't be this slot"),
    ("role: loader", "role: loder", "loder", "unknown role: found 'loder', allowed: loader, carrier"),
    ("  loader:  {safe: stay}\n", "  loader:  {safe: stay}\n  spare: {}\n", "spare", "unused role: found 'spare'"),
    ("by: stop", "by: patrol", "patrol", "not a safe skill of quadruped: found 'patrol', allowed: stop"),
    ("reach: {moving: false}", "reach: {movin: false}", "movin:", "unknown fluent of quadruped: found 'movin'"),
    ("reach: {moving: false}", "reach: {moving: no}", "no}", "write false"),
    ("reach: {moving: false}", "reach: {tray: $object}", "$object}}}", "slot in a safe state: found '$object'"),
    ("at: {not: pickup}}", "at: {not: $destination.x}}", "$destination.x", "unknown slot: found '$destination.x'"),
    ("object: $object,", "object: $zone.x,", "$zone.x", "unknown slot: found '$zone.x'"),
    ("after: [load]", "after: [lod]", "lod]", "unknown step: found 'lod', allowed: approach, load, deliver"),
    ("after: [load]", "after: [load, load]", "load]\n    words: [carry", "step listed twice: found 'load'"),
    ("asks: [deliver]", "asks: [delivr]", "delivr", "did you mean 'deliver'?"),
    ("{carrier.moving: false}]", "{carrier.movng: false}]", "carrier.movng", "did you mean 'carrier.moving'?"),
    ("{carrier.moving: false}]", "{carier.moving: false}]", "carier.moving", "a guard on nothing known"),
    ("{carrier.moving: false}]", "{carrier: false}]", "carrier: false", "unknown fluent of quadruped: found 'carrier'"),
    ("{carrier.moving: false}]", "{carrier.moving: off}]", "off}", "value outside the domain: found 'off'"),
    ("{carrier.moving: false}]", "{carrier.moving: 1}]", "1}", "found 1, allowed: true or false"),
    ("{carrier.moving: false}]", "{carrier.battery: full}]", "full", "found 'full', allowed: a number"),
    ("{carrier.moving: false}]", "{carrier.at: true}]", "true}]", "found true, allowed: the name of a place"),
    ("{carrier.moving: false}]", "{carrier.moving: $object}]", "$object}]\n    do: {p", "a guard on a bool can't be"),
    ("[{carrier.at: pickup},", "[{carrier.at: pick_up},", "pick_up", "unknown place: found 'pick_up'"),
    ("[{carrier.tray: $object}]\n    do", "[{carrier.tray: cub}]\n    do", "cub}", "unknown object: found 'cub'"),
    ("requester.near: false", "requester.far: false", "requester.far", "requester has no such attribute"),
    ("requester.near: false", "requester: seen", "seen", "unknown status: found 'seen', allowed: ok"),
    ("object.at: $origin", "object.colour: red", "object.colour", "slot object has no such attribute"),
    ("requester.near: false", "destination: ok", "destination: ok", "slot destination has no such attribute"),
    ("if: {destination: requester}", "if: {destnation: requester}", "destnation", "unknown slot: found 'destnation'"),
    ("if: {destination: requester}", "if: {destination: moon}", "moon", "slot destination is never that: found 'moon'"),
    (", requester.near: false}", "}", "{if: {destination: requester}}", "a guard without a path"),
    ("starts: loader.pick_place", "starts: pick_place", "pick_place, with", "not the start of a skill by a role"),
    ("starts: loader.pick_place", "starts: loader.navigate", "loader.navigate", "allowed: loader.pick_place"),
    ("starts: carrier.navigate, with: {location: {not: pickup}}", "starts: carrier.navigate, with: {to: {not: pickup}}",
     "to: {not", "unknown argument of navigate: found 'to'"),
    ("with: {location: {not: pickup}}", "with: {location: {not: moon}}", "moon", "unknown target: found 'moon'"),
    ("object:      {type: object}", "object:      {type: objct}", "objct", "unknown slot type: found 'objct'"),
    ("object:      {type: object}", "object: {type: object, default: cup}", "cup", "default of another"),
    ("object:      {type: object}", "object: {type: object, default: 5}", "5}", "default of another type: found 5"),
    ("object:      {type: object}", "object: {type: object, default: bottle, free: true}", "free", "has a default"),
    ("  origin:  ", "  requester: {type: zone}\n  origin:  ", "requester: {type", "slot and run-time value"),
    ("  origin:  ", "  loader: {type: zone}\n  origin:  ", "loader: {type", "slot and role of one name"),
    ("contract: carry", "examples: ['bring {thing}']\ncontract: carry", "'bring {thing}'", "unknown slot or role"),
    ("contract: carry", "examples: ['(bring|take {object}']\ncontract: carry", "'(bring", "brackets that don't match"),
]  # fmt: skip


def _check_reported(text: str, needle: str, words: str) -> list[str]:
    errors = errors_of(text)
    said = [str(error) for error in errors]
    assert [e for e in errors if (e.line, e.column) == mark(text, needle) and words in str(e)], said
    assert {e.file for e in errors} == {"carry.yaml"}
    return said


@pytest.mark.parametrize(("old", "new", "needle", "words"), SHAPE)
def test_a_mistake_of_shape_is_reported_at_its_node(old: str, new: str, needle: str, words: str) -> None:
    _check_reported(edited(CARRY_TEXT, old, new), needle, words)


@pytest.mark.parametrize(("old", "new", "needle", "words"), MEANING)
def test_a_mistake_of_meaning_is_reported_once_at_its_node(old: str, new: str, needle: str, words: str) -> None:
    assert len(_check_reported(edited(CARRY_TEXT, old, new), needle, words)) == 1


def test_a_role_that_nobody_can_play_says_who_lacks_what() -> None:
    text = edited(CARRY_TEXT, "do: {navigate: {location: pickup}}", "do: {wait: {seconds: 5}}")
    said = _check_reported(text, "carrier: {safe", "no robot of crew lab can play carrier")
    assert "found g1 lacks navigate; go2 lacks wait, allowed: a robot with navigate, wait" in said[0]


def test_a_circular_order_is_printed() -> None:
    text = edited(CARRY_TEXT, "    role: carrier\n    optional: true", "    role: carrier\n    after: [deliver]")
    (error,) = errors_of(text)
    assert (error.line, error.column) == mark(text, "after: [deliver]")
    assert "approach after deliver after load after approach" in str(error)


def test_circles_that_share_no_step_are_each_reported() -> None:
    text = """\
contract: loops
summary: Two circles.
roles: {carrier: {}}
asks: []
steps:
  a: {role: carrier, after: [a], do: {stop: {}}}
  b: {role: carrier, after: [c], do: {stop: {}}}
  c: {role: carrier, after: [b], do: {stop: {}}}
"""
    assert [(e.line, e.observed) for e in errors_of(text)] == [(6, "a after a"), (7, "b after c after b")]


def test_roles_that_only_one_robot_can_play_are_refused() -> None:
    text = """\
contract: two
summary: Two carriers, one quadruped.
roles: {left: {}, right: {}}
asks: []
steps:
  a: {role: left, do: {stop: {}}}
  b: {role: right, do: {stop: {}}}
"""
    (error,) = errors_of(text)
    assert (error.line, error.column) == (3, 19)
    assert "no robot is left for role right: found only go2 can play it, and other roles need it" in str(error)


def test_a_default_out_of_the_bounds_of_its_argument_is_refused() -> None:
    text = """\
contract: pause
summary: Wait a while.
slots: {time: {type: altitude, default: 90}}
roles: {waiter: {}}
asks: []
steps:
  wait: {role: waiter, do: {wait: {seconds: $time}}}
"""
    (error,) = errors_of(text)
    assert (error.line, error.column) == (3, 41)
    assert "argument seconds out of bounds: found 90, allowed: 1 to 60 s" in str(error)


def test_all_mistakes_of_a_file_are_reported_in_the_order_of_the_lines() -> None:
    text = edited(CARRY_TEXT, "after: [load]", "afer: [load]")
    text = edited(text, "by: stop", "by: patrol")
    text = edited(text, "{carrier.tray: $object}]\ndead", "{carrier.tray: $objct}]\ndead")
    with pytest.raises(SourceErrors) as caught:
        carry(text)
    assert str(caught.value) == (
        "carry.yaml:9:24: not a safe skill of quadruped: found 'patrol', allowed: stop\n"
        "carry.yaml:27:5: unknown key of a step: found 'afer', "
        "allowed: role, do, after, optional, needs, words, approval; did you mean 'after'?\n"
        "carry.yaml:34:55: unknown slot: found '$objct', allowed: $object, $destination, $origin; "
        "did you mean '$object'?"
    )


def test_a_crew_without_known_kinds_can_play_nothing() -> None:
    with pytest.raises(SourceErrors, match="a crew without robots"):
        load_contract(CARRY_TEXT, source="carry.yaml", crew=crew_of(), kinds={})


_WORDS = [
    "",
    " ",
    "\n",
    "\t",
    "{",
    "}",
    "[",
    "]",
    ":",
    "- ",
    "$",
    "&a ",
    "*a",
    "!t ",
    "true",
    "1e999",
    "0x",
    "no",
    "''",
    "x.y",
]


@settings(max_examples=80, deadline=None)
@given(st.data())
def test_a_mutated_contract_is_read_or_refused(data: st.DataObject) -> None:
    text = data.draw(st.sampled_from([CARRY_TEXT, *(path.read_text() for path in LIBRARY)]))
    for _ in range(data.draw(st.integers(1, 3))):
        start = data.draw(st.integers(0, len(text)))
        end = min(len(text), start + data.draw(st.integers(0, 12)))
        text = text[:start] + data.draw(st.sampled_from(_WORDS) | st.text(max_size=4)) + text[end:]
    assert all(error.line >= 1 and error.column >= 1 for error in errors_of(text))


def test_long_lists_of_valid_names_are_cut() -> None:
    many = "".join(f"  s{n}: {{role: carrier, do: {{stop: {{}}}}}}\n" for n in range(30))
    (error,) = errors_of(f"contract: long\nsummary: Long.\nroles: {{carrier: {{}}}}\nasks: [zz]\nsteps:\n{many}")
    assert error.allowed.endswith("s19, ... (30 in all)")
