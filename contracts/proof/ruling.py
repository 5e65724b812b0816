"""What the real gate says to one call, in every world that matters and under every mishap."""

from collections.abc import Iterable, Iterator, Mapping
from typing import NamedTuple

from msgspec.structs import replace

from crew.contracts.codes import Code
from crew.contracts.contract import Condition
from crew.contracts.decision import Authorizer, Decision
from crew.contracts.gate.approval import approved, wants_approval
from crew.contracts.mission import judgement
from crew.contracts.mission_state import MissionState, Purpose
from crew.contracts.plan import Call
from crew.contracts.proof.cone import Cone, World
from crew.contracts.proof.mishap import mishaps
from crew.contracts.proof.never import Watch
from crew.contracts.proof.subject import STATUS, Var, asked
from crew.contracts.proof.trouble import Trouble
from crew.contracts.proof.world import NOW_NS, Ground, Possible, skill_of
from crew.contracts.skill import Entity
from crew.contracts.snapshot import FluentValue, Snapshot

CANNOT_BE_COMMANDED = frozenset(
    (Code.STOPPED, Code.ROBOT_UNAVAILABLE, Code.STATE_STALE, Code.ROBOT_LEASED, Code.ROBOT_BUSY)
)
"""Refusals of a safe call that say that the robot is out of reach."""


class Ruling(NamedTuple):
    """All that can come of asking the gate for one call."""

    allowed: tuple[tuple[World, Decision], ...]
    refused: tuple[tuple[World, Decision], ...]
    """One for each code, the first found: what it read does not matter any more."""
    troubles: tuple[Trouble, ...] = ()


class Desk:
    """Asks the real gate. Counts how often."""

    def __init__(self, ground: Ground, watches: Iterable[Watch], gate: Authorizer) -> None:
        self._ground, self._gate = ground, gate
        self._watches = tuple(watches)
        self._contract = ground.rules.contracts[ground.instance.contract]
        self.asked = 0

    def watches(self, call: Call) -> tuple[Watch, ...]:
        """The declared properties that speak of the start of this call."""
        return tuple(w for w in self._watches if w.concerns(call))

    def step(self, step: str, mission: MissionState, possible: Mapping[Var, Possible]) -> Ruling:
        """A step of the plan."""
        call = mission.steps[step].call
        guards = list(self._guards(step, mission))
        watched = [ask for watch in self.watches(call) for ask in watch.asks()]
        values = [*self._bound(call), *(var.owner for var, _ in watched if self._ground.is_value(var))]
        cone = Cone([*guards, *(ask for ask in watched if ask[0].name != STATUS)], values, self._ground)
        reads = frozenset(var for var, _ in guards)
        return self._ask(call, step, mission, cone, reads, possible, Purpose.EXECUTE)

    def safe(self, role: str, mission: MissionState, possible: Mapping[Var, Possible]) -> tuple[list[World], Ruling]:
        """Worlds in which the real judgement sees the safe state, and the safe call in all others."""
        call = judgement.safe_call(role, mission, self._ground.rules)
        declared = self._contract.role(role)
        assert call is not None, "a role that stays is not made safe"
        assert declared is not None
        reach = {} if declared.safe is None else declared.safe.reach
        needs = skill_of(call, self._ground.rules).needs
        asks = [(Var(call.robot, fluent), value) for fluent, value in (*reach.items(), *needs.items())]
        cone = Cone(asks, (), self._ground)
        holding = [world for world in cone.worlds(possible) if not self._missing(role, mission, world)]
        reads = frozenset(Var(call.robot, fluent) for fluent in needs)
        ruling = self._ask(call, f"safe:{role}", mission, cone, reads, possible, Purpose.SAFE)
        return holding, ruling._replace(allowed=tuple(item for item in ruling.allowed if item[0] not in holding))

    def _missing(self, role: str, mission: MissionState, world: World) -> str:
        snapshot = self._ground.snapshot(dict(world.facts))
        return judgement.missing_safety(role, mission, snapshot, self._ground.rules, NOW_NS)

    def _ask(
        self,
        call: Call,
        step: str,
        mission: MissionState,
        cone: Cone,
        reads: frozenset[Var],
        possible: Mapping[Var, Possible],
        purpose: Purpose,
    ) -> Ruling:
        allowed: list[tuple[World, Decision]] = []
        refused: dict[Code, tuple[World, Decision]] = {}
        waiting = list(cone.worlds(possible))
        while waiting:
            world = waiting.pop(0)
            decision = self._authorise(call, step, mission, world, purpose)
            if decision.refusal is not None:
                refused.setdefault(decision.refusal.code, (world, decision))
                continue
            allowed.append((world, decision))
            waiting += () if cone.is_disorder(world) else cone.disorders(world)
        troubles = []
        if allowed:
            world = allowed[0][0]
            troubles = list(self._mishaps(call, step, mission, world, reads, purpose, refused))
        return Ruling(tuple(allowed), tuple(refused.values()), tuple(troubles))

    def _mishaps(
        self,
        call: Call,
        step: str,
        mission: MissionState,
        world: World,
        reads: frozenset[Var],
        purpose: Purpose,
        refused: dict[Code, tuple[World, Decision]],
    ) -> Iterator[Trouble]:
        """Each mishap on top of a world in which the call is allowed; the refusals are added to `refused`."""
        snapshot = self._ground.snapshot(dict(world.facts))
        mission = self._consented(call, step, mission, snapshot, purpose)
        for mishap in mishaps(call, step, mission, snapshot, reads, self._ground, purpose):
            self.asked += 1
            rules = self._ground.rules
            decision = self._gate.authorize(call, mishap.mission, mishap.world, rules, NOW_NS, purpose)
            if decision.refusal is None:
                yield Trouble("reckless_dispatch", f"{call} is sent although {mishap.name}", step)
            elif decision.refusal.code is not Code.APPROVAL_MISSING:
                refused.setdefault(decision.refusal.code, (world, decision))

    def _authorise(self, call: Call, step: str, mission: MissionState, world: World, purpose: Purpose) -> Decision:
        self.asked += 1
        snapshot = self._ground.snapshot(dict(world.facts))
        mission = self._consented(call, step, mission, snapshot, purpose)
        return self._gate.authorize(call, mission, snapshot, self._ground.rules, NOW_NS, purpose)

    def _consented(
        self, call: Call, step: str, mission: MissionState, world: Snapshot, purpose: Purpose
    ) -> MissionState:
        """Whoever is asked says yes: a no ends the mission as any refusal does, and the adversary has those already."""
        rules = self._ground.rules
        if purpose is Purpose.SAFE or not wants_approval(step, mission, rules):
            return mission
        return replace(mission, approvals=approved(call, step, mission, world, rules, NOW_NS))

    def _guards(self, step: str, mission: MissionState) -> Iterator[tuple[Var, FluentValue]]:
        """What the call's own preconditions and guards ask for."""
        call, declared = mission.steps[step].call, self._contract.step(step)
        guards: tuple[Condition, ...] = () if declared is None else declared.needs
        if not mission.sent_any:
            guards = (*self._contract.needs, *guards)
        yield from asked(guards, self._ground.instance.roles, self._ground.slots)
        skill = skill_of(call, self._ground.rules)
        for fluent, value in (*skill.needs.items(), *skill.step_needs.items()):
            yield Var(call.robot, fluent), value

    def _bound(self, call: Call) -> Iterator[str]:
        """The run-time values that the call is bound to."""
        for param in skill_of(call, self._ground.rules).params:
            name = call.args.get(param.name)
            if param.entity is Entity.TARGET and isinstance(name, str) and self._ground.rules.crew.value(name):
                yield name
