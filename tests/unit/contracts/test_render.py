"""Contracts and robots in other forms, against golden files. `UPDATE_GOLDEN=1` writes them anew."""

import json
import os
from collections.abc import Callable
from pathlib import Path
from xml.etree import ElementTree

import pytest

from crew.contracts.contract import Condition, Contract
from crew.contracts.render.card import robot_card
from crew.contracts.render.mermaid import contract_graph
from crew.contracts.render.prose import contract_prose
from crew.contracts.render.schema import (
    DIALECT,
    contract_file_schema,
    crew_file_schema,
    plan_tool,
    robot_schemas,
)
from crew.contracts.render.svg import contract_svg
from crew.contracts.render.wording import clause, guard_words, listed
from crew.contracts.site import Rules
from crew.library import load_rules
from tests.unit.contracts.carry import CARRY_TEXT, KINDS, carry, crew_of, edited

GOLDEN = Path(__file__).parent / "golden"


@pytest.fixture(scope="module")
def rules() -> Rules:
    return load_rules("air_ground")


def check_golden(name: str, text: str) -> None:
    path = GOLDEN / name
    if os.environ.get("UPDATE_GOLDEN"):
        path.write_text(text, encoding="utf-8")
    assert text == path.read_text(encoding="utf-8")


def _json(schema: object) -> str:
    return json.dumps(schema, indent=2) + "\n"


SHIPPED = {
    "air_ground": ("search_and_dispatch", "search_only", "dispatch_only", "abort"),
    "humanoid_quadruped": ("handover", "carry", "navigation_only", "manipulation_only"),
}


@pytest.mark.parametrize(("crew", "name"), [(crew, name) for crew, names in SHIPPED.items() for name in names])
@pytest.mark.parametrize(
    ("render", "suffix"), [(contract_prose, "txt"), (contract_graph, "mmd"), (contract_svg, "svg")]
)
def test_shipped_contract(crew: str, name: str, render: Callable[[Contract], str], suffix: str) -> None:
    check_golden(f"{name}.{suffix}", render(load_rules(crew).contracts[name]))


@pytest.mark.parametrize(("render", "suffix"), [(contract_prose, "txt"), (contract_graph, "mmd")])
def test_a_step_with_approval(render: Callable[[Contract], str], suffix: str) -> None:
    text = edited(CARRY_TEXT, "words: [carry, bring]", "approval: true")
    check_golden(f"approval.{suffix}", render(carry(text)))


def test_a_picture_is_well_formed_and_says_everything_that_the_diagram_says() -> None:
    text = edited(CARRY_TEXT, "summary: Take", "summary: Take & <bring>")
    contract = carry(edited(text, "words: [carry, bring]", "approval: true"))
    root = ElementTree.fromstring(contract_svg(contract))
    said = " ".join(node.text or "" for node in root.iter("{http://www.w3.org/2000/svg}text"))
    for words in ("carry", "approach", "loader: pick_place", "tray of carrier is $object", "a person approves"):
        assert words in said
    title = root.find("{http://www.w3.org/2000/svg}title")
    assert title is not None
    assert (title.text or "").startswith("carry: Take & <bring> an object")


ROBOTS = [("air_ground", "iris"), ("air_ground", "tb3"), ("humanoid_quadruped", "g1"), ("humanoid_quadruped", "go2")]


@pytest.mark.parametrize(("crew", "robot"), ROBOTS)
def test_robot_card(crew: str, robot: str) -> None:
    check_golden(f"{robot}.card.txt", robot_card(robot, load_rules(crew)))


def test_cards_of_kinds_with_objects() -> None:
    rules = Rules(crew=crew_of(), kinds=KINDS, contracts={})
    check_golden("lab.card.txt", robot_card("g1", rules) + "\n" + robot_card("go2", rules))


def test_a_card_of_an_unknown_robot_names_the_known(rules: Rules) -> None:
    with pytest.raises(KeyError, match="known: iris, tb3"):
        robot_card("go2", rules)


def test_contract_file_schema() -> None:
    check_golden("contract.schema.json", _json(contract_file_schema()))


def test_crew_file_schema() -> None:
    check_golden("crew.schema.json", _json(crew_file_schema()))


def test_plan_tool() -> None:
    check_golden("submit_plan.json", _json(plan_tool()))


@pytest.mark.parametrize(("crew", "robot"), ROBOTS)
def test_skill_schemas(crew: str, robot: str) -> None:
    check_golden(f"{robot}.schema.json", _json(robot_schemas(robot, load_rules(crew))))


def test_an_unknown_robot_has_no_schemas(rules: Rules) -> None:
    assert robot_schemas("go2", rules) == {}


def test_schemas_name_their_dialect_and_refuse_unknown_keys() -> None:
    for schema in (contract_file_schema(), crew_file_schema()):
        assert schema["$schema"] == DIALECT
        closed = [part for name, part in schema["$defs"].items() if name != "GuardModel"]
        assert all(part["additionalProperties"] is False for part in closed)


@pytest.mark.parametrize(
    ("condition", "words"),
    [
        (Condition(path="drone.airborne", value=False), "drone is not airborne"),
        (Condition(path="drone.airborne", value=False, negated=True), "drone is airborne"),
        (Condition(path="drone.airborne", value=True, negated=True), "drone is not airborne"),
        (Condition(path="dog.at", value="pickup", negated=True), "dog is not at pickup"),
        (Condition(path="dog.tray", value="$object"), "tray of dog is $object"),
        (Condition(path="dog.battery", value=50.0), "battery of dog is 50"),
        (Condition(path="victim", value="ok", negated=True), "victim is not ok"),
        (Condition(path="victim.status", value="ok"), "victim is ok"),
        (
            Condition(path="requester.near", value=False, when={"origin": "given", "destination": "requester"}),
            "if origin is given and destination is requester, requester is not near",
        ),
    ],
)
def test_guards_in_words(condition: Condition, words: str) -> None:
    assert guard_words(condition) == words


def test_lists_in_words() -> None:
    assert [listed(["a"]), listed(["a", "b"]), listed("abc", word="or")] == ["a", "a and b", "a, b or c"]
    assert clause("dog.tray", "none") == "tray of dog is none"
