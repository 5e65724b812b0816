"""Kinds and contracts made to be wrong, or big: for what no shipped kind can show."""

from collections.abc import Sequence
from typing import Any

from crew.contracts.contract import Contract
from crew.contracts.files.contract_file import load_contract
from crew.contracts.plan import Zone
from crew.contracts.site import Crew, RobotSpec, Rules
from crew.contracts.skill import Fluent, Kind, Skill, SkillArgs


class NoArgs(SkillArgs, frozen=True):
    pass


def skill(name: str, **more: Any) -> Skill:
    declared = {"about": f"{name}.", "words": (name,), "timeout_s": 10.0, "on_stop": "stop", "on_link_loss": "stop"}
    return Skill(name=name, args=NoArgs, **{**declared, **more})


def kind(*skills: Skill, fluents: Sequence[str] = ("ready", "moving"), name: str = "worker") -> Kind:
    return Kind(
        name=name,
        about="A robot for tests.",
        aliases=(name,),
        fluents=tuple(Fluent(name=f, domain="bool", about=f) for f in fluents),
        skills=skills,
        idle_on_stop="stop",
        idle_on_link_loss="stop",
    )


STOP = skill("halt", effects={"moving": False}, safe=True)


def rules(text: str, made: Kind, robots: int = 1, *others: str) -> Rules:
    """A crew of robots of one kind, with contracts from their text."""
    crew = Crew(
        name="lab",
        area=Zone(0.0, 9.0, 0.0, 9.0),
        robots=tuple(RobotSpec(name=f"r{n}", kind=made.name, adapter="none", sim=f"r{n}") for n in range(robots)),
    )
    kinds = {made.name: made}
    contracts: dict[str, Contract] = {}
    for each in (text, *others):
        contract = load_contract(each, source="lab.yaml", crew=crew, kinds=kinds)
        contracts[contract.name] = contract
    return Rules(crew=crew, kinds=kinds, contracts=contracts)


def chain(steps: int, robots: int = 1, *, ordered: bool = True) -> str:
    """A contract of as many steps in chains, one chain a robot, or in no order at all."""
    lines = [f"contract: chains\nsummary: {steps} steps, {robots} robots.\nroles:"]
    lines += [f"  w{n}: {{safe: {{by: halt, reach: {{moving: false}}}}}}" for n in range(robots)]
    lines += ["asks: []", "steps:"]
    for index in range(steps):
        after = f", after: [s{index - robots}]" if ordered and index >= robots else ""
        lines.append(f"  s{index}: {{role: w{index % robots}, do: {{work: {{}}}}{after}}}")
    return "\n".join([*lines, "deadline_s: 60", ""])
