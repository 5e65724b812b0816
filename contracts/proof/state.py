"""One state of the explored system, as small as the properties allow, and back to the real mission state."""

from typing import NamedTuple

from crew.contracts.language.mention import Reading
from crew.contracts.mission_state import ACTIVE, ENDS, MissionState, Phase, StepPhase, StepRecord
from crew.contracts.plan import Call, Instance, Plan
from crew.contracts.proof.world import DISPATCHED_NS, MISSION, STARTED_NS, Possible, skill_of
from crew.contracts.site import Rules
from crew.contracts.skill import Entity
from crew.contracts.snapshot import Point

ENDING = frozenset({Phase.HALTING, Phase.CANCELLING})
FAILURES = frozenset({StepPhase.FAILED, StepPhase.CANCELLED, StepPhase.UNKNOWN})
_ONE_OF: dict[StepPhase, StepPhase] = {StepPhase.RUNNING: StepPhase.SENT, **dict.fromkeys(FAILURES, StepPhase.FAILED)}


class State(NamedTuple):
    """A mission and what is possible in its world, between two events."""

    phase: Phase
    steps: tuple[StepPhase, ...] = ()
    safe: tuple[StepPhase | None, ...] = ()
    settled: tuple[bool, ...] = ()
    owed: tuple[bool, ...] = ()
    """Roles that the machine has asked to be made safe, and that were not decided yet."""
    judging: bool = False
    """The machine has asked whether the mission is complete."""
    fluents: tuple[Possible, ...] = ()


class Frame:
    """What all states of one instance share."""

    def __init__(self, plan: Plan, instance: Instance, reading: Reading, rules: Rules, spot: Point) -> None:
        self.plan, self.instance, self.reading = plan, instance, reading
        contract = rules.contracts[instance.contract]
        self.names = tuple(item.step for item in instance.steps)
        self.calls: dict[str, Call] = {item.step: item.call for item in instance.steps}
        self.roles = tuple(instance.roles)
        self._records: dict[tuple[str, StepPhase | None], StepRecord] = {}
        self._places = {item.step: _places(item.call, rules, spot) for item in instance.steps}
        declared = {role: contract.role(role) for role in self.roles}
        self.safe_calls = {
            name: Call(instance.roles[name], role.safe.by)
            for name, role in declared.items()
            if role is not None and role.safe is not None
        }

    def mission(self, state: State) -> MissionState:
        """The real mission state that a state stands for."""
        phases = dict(zip(self.names, state.steps, strict=False))
        safe = {role: p for role, p in zip(self.roles, state.safe, strict=False) if p is not None}
        return MissionState(
            id=MISSION,
            request="",
            reading=self.reading,
            phase=state.phase,
            started_ns=-1 if state.phase is Phase.WAITING else STARTED_NS,
            plan=self.plan,
            instance=self.instance,
            contract=self.instance.contract,
            steps={name: self._step(index, name, phases.get(name)) for index, name in enumerate(self.names)},
            safe={role: self._safe(role, phase) for role, phase in safe.items()},
            settled=tuple(role for role, done in zip(self.roles, state.settled, strict=False) if done),
            sequence=len(self.names) + len(self.roles),
        )

    def _step(self, index: int, name: str, phase: StepPhase | None) -> StepRecord:
        known = self._records.get((name, phase))
        if known is None:
            known = self._records[name, phase] = self._record(index, name, phase or StepPhase.PENDING)
        return known

    def _record(self, index: int, name: str, phase: StepPhase) -> StepRecord:
        if phase in (StepPhase.PENDING, StepPhase.REFUSED):
            return StepRecord(call=self.calls[name], phase=phase)
        return StepRecord(
            call=self.calls[name],
            phase=phase,
            sequence=index + 1,
            dispatched_ns=DISPATCHED_NS,
            places=self._places[name],
        )

    def _safe(self, role: str, phase: StepPhase) -> StepRecord:
        index = len(self.names) + self.roles.index(role) + 1
        return StepRecord(call=self.safe_calls[role], phase=phase, sequence=index, dispatched_ns=DISPATCHED_NS)

    def state(
        self,
        mission: MissionState,
        fluents: tuple[Possible, ...],
        owed: frozenset[str] = frozenset(),
        judging: bool = False,
    ) -> State:
        """The state that a real mission state is an instance of. What can't matter any more is forgotten."""
        if mission.phase in ENDS:
            return State(mission.phase)
        steps = tuple(one_of(mission.steps[name]) for name in self.names)
        if mission.phase not in ENDING:
            return State(mission.phase, steps, judging=judging, fluents=fluents)
        settled = tuple(role in mission.settled for role in self.roles)
        return State(
            mission.phase,
            tuple(self._kept(name, phase, mission) for name, phase in zip(self.names, steps, strict=True)),
            tuple(self._open_safe(mission, role) for role in self.roles),
            settled,
            tuple(role in owed for role in self.roles),
            fluents=fluents,
        )

    def _kept(self, step: str, phase: StepPhase, mission: MissionState) -> StepPhase:
        """In an early end: what runs, and what a role did that has no safe state to reach."""
        item = self.instance.step(step)
        assert item is not None
        stays = item.role not in self.safe_calls and item.role not in mission.settled
        return phase if phase in ACTIVE or stays else StepPhase.PENDING

    def _open_safe(self, mission: MissionState, role: str) -> StepPhase | None:
        record = mission.safe.get(role)
        return None if record is None or role in mission.settled else one_of(record)


def one_of(record: StepRecord) -> StepPhase:
    """The phase that stands for all that lead to the same: accepted or not yet, and every way to fail."""
    if record.phase is StepPhase.REFUSED and record.sequence:
        return StepPhase.FAILED
    return _ONE_OF.get(record.phase, record.phase)


def _places(call: Call, rules: Rules, spot: Point) -> dict[str, Point]:
    """What a dispatch of this call pins."""
    found: dict[str, Point] = {}
    for param in skill_of(call, rules).params:
        name = call.args.get(param.name)
        if param.entity is Entity.TARGET and isinstance(name, str):
            place = rules.crew.location(name)
            found[param.name] = spot if place is None else Point(place.x, place.y)
    return found
