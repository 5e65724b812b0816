"""The declared properties are judged by code of their own, with no part of the gate in it."""

import ast
from pathlib import Path

import pytest

from crew.contracts import proof
from crew.contracts.contract import Condition, Contract, Never, Role
from crew.contracts.plan import Call
from crew.contracts.proof.never import Watch
from crew.contracts.proof.subject import Var

FOLDER = Path(proof.__file__).parent


def imports(module: str) -> set[str]:
    """The modules that a module of the prover imports."""
    tree = ast.parse((FOLDER / f"{module}.py").read_text())
    found = {node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom) and node.module}
    return found | {alias.name for node in ast.walk(tree) if isinstance(node, ast.Import) for alias in node.names}


@pytest.mark.parametrize("module", ["never", "subject"])
def test_the_judge_of_never_shares_no_code_with_the_gate(module: str) -> None:
    """Nothing but data: the contract's, the plan's and the world's declarations."""
    allowed = {"contract", "plan", "site", "snapshot", "skill", "proof.subject"}
    own = {name.removeprefix("crew.contracts.") for name in imports(module) if name.startswith("crew")}
    assert own <= allowed, own - allowed


def test_the_oracle_judges_without_the_gate() -> None:
    assert not any("gate" in name or "judgement" in name or "machine" in name for name in imports("oracle"))


def test_the_gate_never_reads_a_never() -> None:
    gate = FOLDER.parent / "gate"
    for path in gate.glob("*.py"):
        names = {n.attr for n in ast.walk(ast.parse(path.read_text())) if isinstance(n, ast.Attribute)}
        assert "never" not in names, path.name


def watch(*conditions: Condition, **with_args: str) -> Watch:
    never = Never(starts="carrier.navigate", with_args=with_args, when=conditions, why="so", line=3)
    contract = Contract(name="c", summary="s", roles=(Role(name="carrier"), Role(name="loader")), never=(never,))
    return Watch(contract=contract, never=never, roles={"carrier": "go2", "loader": "g1"}, slots={"object": "cube"})


def test_a_start_is_told_by_robot_skill_and_arguments() -> None:
    concerned = watch(location="room")
    assert concerned.concerns(Call("go2", "navigate", {"location": "room"}))
    assert not concerned.concerns(Call("go2", "navigate", {"location": "hall"}))
    assert not concerned.concerns(Call("g1", "navigate", {"location": "room"}))
    assert not concerned.concerns(Call("go2", "stop"))


@pytest.mark.parametrize(("tray", "broken"), [("cube", False), ("bottle", True), ("none", True)])
def test_a_slot_stands_for_its_value(tray: str, broken: bool) -> None:
    unloaded = watch(Condition(path="carrier.tray", value="$object", negated=True))
    assert unloaded.broken({Var("go2", "tray"): tray}) is broken


def test_all_clauses_must_hold() -> None:
    both = watch(Condition(path="carrier.moving", value=True), Condition(path="loader.holding", value="cube"))
    assert both.broken({Var("go2", "moving"): True, Var("g1", "holding"): "cube"})
    assert not both.broken({Var("go2", "moving"): True, Var("g1", "holding"): "none"})


def test_a_condition_that_does_not_count_forbids_nothing() -> None:
    only_if = watch(Condition(path="carrier.moving", value=True, when={"object": "bottle"}))
    assert not only_if.broken({Var("go2", "moving"): True})
