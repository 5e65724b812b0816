"""What must be true of everything that is sent and of every end: the properties built in, judged without the gate."""

from collections.abc import Iterator, Mapping

from crew.contracts.contract import Contract
from crew.contracts.mission_state import ACTIVE, CONSUMED, MissionState, Phase, StepPhase
from crew.contracts.plan import Call
from crew.contracts.proof.instances import predecessors
from crew.contracts.proof.never import Watch, holds
from crew.contracts.proof.subject import STATUS, Var, counts
from crew.contracts.proof.trouble import Facts, Trouble
from crew.contracts.proof.world import (
    ABSENT,
    AMBIGUOUS,
    EARLIER,
    NEVER,
    NOT_FINITE,
    OK,
    OUTSIDE,
    READABLE,
    STALE,
    Ground,
    Possible,
    skill_of,
)
from crew.contracts.skill import Entity
from crew.contracts.snapshot import FluentValue

SAID_OK = frozenset((*READABLE, NOT_FINITE, OUTSIDE))
"""Conditions in which a value's source says that it has one."""
SAID = frozenset((ABSENT, AMBIGUOUS))


class Oracle:
    """Judges one instance's dispatches by the contract's text and the kinds' declarations alone."""

    def __init__(self, contract: Contract, ground: Ground) -> None:
        self._contract, self._ground = contract, ground
        self._instance = ground.instance
        present = [item.step for item in self._instance.steps]
        self._before = predecessors(contract, present)
        self._published = {
            name: tuple(item.step for item in self._instance.steps if name in self.reports(item.call))
            for name in {report for item in self._instance.steps for report in self.reports(item.call)}
        }

    def dispatch(self, step: str, mission: MissionState, facts: Facts) -> Iterator[Trouble]:
        """What is wrong with sending this step in the state just before it is sent."""
        record = mission.steps[step]
        call = record.call
        if mission.phase is not Phase.EXECUTING:
            yield Trouble("late_dispatch", f"{call} is sent although the mission is {mission.phase}", step)
        if record.phase in CONSUMED:
            yield Trouble("sent_twice", f"{call} is sent a second time", step)
        waiting = [n for n in self._before[step] if mission.steps[n].phase is not StepPhase.SUCCEEDED]
        if waiting:
            yield Trouble("out_of_order", f"{call} is sent before {', '.join(sorted(waiting))} was done", step)
        records = (*mission.steps.values(), *mission.safe.values())
        if any(r.phase in ACTIVE and r.call.robot == call.robot for r in records):
            yield Trouble("busy_robot", f"{call} is sent while {call.robot} is still at work", step)
        yield from self._guards(step, call, mission, dict(facts))
        yield from self._values(step, call, mission, dict(facts))

    def _guards(
        self, step: str, call: Call, mission: MissionState, values: Mapping[Var, FluentValue]
    ) -> Iterator[Trouble]:
        """Every guard that the contract and the skill declare for this moment is true of what was seen."""
        declared = self._contract.step(step)
        guards = () if declared is None else declared.needs
        entry = () if any(r.sequence for r in mission.steps.values()) else self._contract.needs
        told = self._read(values)
        for guard in (*entry, *guards):
            if counts(guard, self._ground.slots) and not holds(guard, self._instance.roles, self._ground.slots, told):
                yield Trouble("guard_ignored", f"{call} is sent although it needs that {guard}", step)
        skill = skill_of(call, self._ground.rules)
        for fluent, value in (*skill.needs.items(), *skill.step_needs.items()):
            if told.get(Var(call.robot, fluent)) != value:
                yield Trouble("guard_ignored", f"{call} is sent although it needs {fluent}: {value}", step)

    def _values(
        self, step: str, call: Call, mission: MissionState, values: Mapping[Var, FluentValue]
    ) -> Iterator[Trouble]:
        for param in skill_of(call, self._ground.rules).params:
            name = call.args.get(param.name)
            if param.entity is not Entity.TARGET or not isinstance(name, str) or Var(name, STATUS) not in values:
                continue
            condition = self.truth(name, str(values[Var(name, STATUS)]))
            sources = tuple(s for s in self._published.get(name, ()) if s != step)
            if condition != OK:
                yield Trouble("unbound_value", f"{call} is sent although {name} is {condition}", step)
            elif sources and not any(mission.steps[s].phase in CONSUMED for s in sources):
                message = (
                    f"{call} is sent with a {name} of an earlier mission: {_either(sources)} publishes it only later"
                )
                yield Trouble("unbound_value", message, step, before=sources)

    def truth(self, name: str, condition: str) -> str:
        """A value's condition as a contract speaks of it: an earlier fix is no fix if the plan makes one."""
        if condition == EARLIER:
            return STALE if name in self._published else OK
        return ABSENT if condition == NEVER else condition

    def broken(self, watch: Watch, values: Mapping[Var, FluentValue]) -> bool:
        """Whether a declared property is broken by a start in this world."""
        return watch.broken(self._told(values))

    def _read(self, values: Mapping[Var, FluentValue]) -> dict[Var, FluentValue]:
        """What a guard may rely on: the source's own word while it is fresh; a place only where it is a place."""
        told: dict[Var, FluentValue] = {}
        for var, value in values.items():
            condition = values.get(Var(var.owner, STATUS), OK) if self._ground.is_value(var) else OK
            if var.name == STATUS and self._ground.is_value(var):
                told |= {var: OK} if condition in SAID_OK else {var: condition} if condition in SAID else {}
            elif condition in (READABLE if var.name == "at" else SAID_OK):
                told[var] = value
        return told

    def _told(self, values: Mapping[Var, FluentValue]) -> dict[Var, FluentValue]:
        """What was seen, as a contract speaks of it: of a value in disorder nothing else is known."""
        told: dict[Var, FluentValue] = {}
        for var, value in values.items():
            if not self._ground.is_value(var):
                told[var] = value
            elif var.name == STATUS:
                told[var] = self.truth(var.owner, str(value))
            elif self.truth(var.owner, str(values.get(Var(var.owner, STATUS), OK))) == OK:
                told[var] = value
        return told

    def incomplete(self, values: Mapping[Var, FluentValue]) -> str:
        """The first completion condition that is not true; empty if all are."""
        for condition in self._contract.complete:
            head = condition.path.partition(".")[0]
            played = self._contract.role(head) is None or head in self._instance.roles
            asks = played and counts(condition, self._ground.slots)
            if asks and not holds(condition, self._instance.roles, self._ground.slots, values):
                return str(condition)
        return ""

    def unsafe(self, role: str, mission: MissionState, possible: Mapping[Var, Possible]) -> str:
        """Why a role that is left alone in this world is not safe; empty if it is."""
        robot = self._instance.roles[role]
        declared = self._contract.role(role)
        safe = None if declared is None else declared.safe
        moved = any(r.phase in CONSUMED and r.call.robot == robot for r in mission.steps.values())
        wanted = safe.reach if safe is not None else self._left_behind(role) if moved else {}
        for fluent, value in wanted.items():
            found = possible.get(Var(robot, fluent))
            if found is not None and found != {value}:
                seen = ", ".join(sorted(str(v).lower() for v in found - {value}))
                return f"{robot}.{fluent} may be {seen}, not {str(value).lower()}"
        return ""

    def safety(self, role: str) -> frozenset[Var]:
        """What tells whether a role is safe, and what its safe call asks for."""
        robot = self._instance.roles[role]
        declared = self._contract.role(role)
        safe = None if declared is None else declared.safe
        if safe is None:
            return frozenset(Var(robot, fluent) for fluent in self._left_behind(role))
        needs = skill_of(Call(robot, safe.by), self._ground.rules).needs
        return frozenset(Var(robot, fluent) for fluent in (*safe.reach, *needs))

    def _left_behind(self, role: str) -> Mapping[str, FluentValue]:
        """For a role that stays: what a safe skill of its kind would undo of what its own steps do."""
        robot = self._instance.roles[role]
        kind = self._ground.rules.kind_of(robot)
        touched = {fluent for item in self._instance.steps if item.role == role for fluent in self._touched(item.call)}
        skills = () if kind is None else kind.skills
        return {f: v for skill in skills if skill.safe for f, v in skill.effects.items() if f in touched}

    def _touched(self, call: Call) -> set[str]:
        skill = skill_of(call, self._ground.rules)
        return {*skill.effects, *skill.during, *(fluent for left in skill.may for fluent in left)}

    def reports(self, call: Call) -> tuple[str, ...]:
        return skill_of(call, self._ground.rules).reports


def _either(names: tuple[str, ...]) -> str:
    return " or ".join(names)
