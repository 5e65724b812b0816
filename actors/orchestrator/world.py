"""Folds what robots tell into the snapshot that the gate reads. It judges nothing."""

from collections.abc import Mapping

from crew.actors.orchestrator.hold import StopHold
from crew.actors.orchestrator.identity import Identities
from crew.clock import WALL, seconds_ns
from crew.contracts.gate.guard import FUTURE_NS
from crew.contracts.separation import with_relations
from crew.contracts.site import Rules
from crew.contracts.snapshot import RobotState, Snapshot, Stamped, StampedValue
from crew.messages import RobotCard, RobotEvent, RobotStatus, RobotValue
from crew.messages import RobotState as StateMessage

SILENT_S = 3.0
"""Wall time without a state message after which a robot counts as frozen."""


class WorldFold:
    """The latest word of every robot, stamped with mission time."""

    def __init__(self, rules: Rules, hold: StopHold | None = None) -> None:
        self._rules = rules
        self._names = frozenset(r.name for r in rules.crew.robots)
        self.hold = hold or StopHold(r.name for r in rules.crew.robots)
        self.cards: dict[str, RobotCard] = {}
        self.stopped = bool(self.hold.held)
        self.bus_lost = False
        self._states: dict[str, StateMessage] = {}
        self._received: dict[str, tuple[int, int]] = {}
        self._values: dict[str, StampedValue] = {}
        self._gone: dict[str, str] = {}
        self._ended: dict[str, str] = {}
        self._identities = Identities()

    def knows(self, robot: str) -> bool:
        """Whether the crew has a robot of this name."""
        return robot in self._names

    def take_card(self, card: RobotCard) -> bool:
        """Remember who a robot says it is; whether it has rebooted since. A conflicting card only casts doubt."""
        if not self.knows(card.robot):
            return False
        known = self.cards.get(card.robot)
        if self._identities.conflicting(known, card):
            return False
        self.cards[card.robot] = card
        rebooted = known is not None and known.boot_id != card.boot_id
        if rebooted:
            self._states.pop(card.robot, None)
            self.hold.rebooted(card.robot)
        return rebooted

    def take_state(self, state: StateMessage, now_ns: int) -> None:
        """Remember a robot's state, unless it is another boot's or older than what is known.

        A state from the future is remembered (the gate refuses it as stale) but holds up no later one.
        """
        card = self.cards.get(state.robot)
        known = self._states.get(state.robot)
        older = known is not None and state.at_ns < known.at_ns <= now_ns + FUTURE_NS
        if card is None or card.boot_id != state.boot_id or older:
            return
        self.hold.hear_state(state)
        self._states[state.robot] = state
        self._received[state.robot] = (now_ns, WALL.now_ns())

    def take_value(self, value: RobotValue, now_ns: int) -> bool:
        """Remember a run-time value; whether it was taken. Only a robot whose kind publishes it is believed."""
        card = self.cards.get(value.robot)
        name = value.reading.name
        if card is None or card.boot_id != value.boot_id or value.robot not in self._rules.publishers_of(name):
            return False
        self._values[name] = StampedValue(value.reading, value.robot, now_ns)
        return True

    def take_event(self, event: RobotEvent) -> None:
        """An ended dispatch is no longer running, whatever an older state message says."""
        card = self.cards.get(event.robot)
        if card is None or card.boot_id != event.boot_id:
            return
        if event.what in ("succeeded", "failed", "cancelled", "refused"):
            self._ended[event.robot] = f"{event.mission}/{event.sequence}"

    def take_liveliness(self, robot: str, alive: bool) -> None:
        """A robot's token came or went."""
        if alive:
            self._gone.pop(robot, None)
        else:
            self._gone[robot] = "lost: its process or its link is gone"

    def lost(self, robot: str) -> str:
        """Why a robot can't be reached or believed, or empty. Losing the bus is not losing a robot."""
        if self.bus_lost:
            return "not heard: the bus is lost (the router does not answer)"
        if conflict := self._identities.conflict(robot):
            return conflict
        if robot in self._gone:
            return self._gone[robot]
        received = self._received.get(robot)
        if received is None:
            return "never heard of"
        silent_ns = WALL.now_ns() - received[1]
        return f"frozen: no state for {silent_ns / 1e9:.1f} s" if silent_ns > seconds_ns(SILENT_S) else ""

    def stop(self, by: str, reason: str = "") -> None:
        """A stop is in force until every robot that is heard was seen latched, and is released."""
        self.stopped = True
        self.hold.stop(by, reason)

    def all_released(self) -> bool:
        """Whether every robot that is heard has latched since the stop, and none is latched now. Silence is no word."""
        heard = [name for name in self._states if not self.lost(name)]
        return bool(heard) and not any(self._states[name].stopped or name in self.hold.held for name in heard)

    def silent_on_stop(self) -> list[str]:
        """Robots that are there and have not said since the stop that they are latched."""
        return [name for name in self.hold.unconfirmed if not self.lost(name)]

    def still(self) -> list[str]:
        """Robots that are heard and say that they stand still."""
        return sorted(name for name, state in self._states.items() if state.still and not self.lost(name))

    def dropped(self) -> dict[str, int]:
        """How many messages, and commands for their permit, each robot says that it refused; none are left out."""
        dropped = {f"by_{name}": s.dropped for name, s in self._states.items() if s.dropped}
        permits = {f"permits_{name}": s.refused_permits for name, s in self._states.items() if s.refused_permits}
        return {**dropped, **permits}

    def snapshot(self, leases: Mapping[str, str]) -> Snapshot:
        """The world now, for the gate."""
        robots = {name: self._robot(name, leases.get(name, "")) for name in sorted(self._names)}
        related = with_relations(robots, self._rules)
        return Snapshot(robots=related, values=dict(self._values), stopped=self.stopped)

    def _robot(self, name: str, lease: str) -> RobotState:
        card, state, lost = self.cards.get(name), self._states.get(name), self.lost(name)
        if card is None or state is None:
            return RobotState(name=name, unavailable=lost or "never heard of", lease=lease)
        received_ns = self._received[name][0]
        stamps = state.stamps_ns
        return RobotState(
            name=name,
            kind_digest=card.kind_digest,
            boot_id=card.boot_id,
            unavailable=lost or state.unavailable,
            stopped=state.stopped,
            running=self.running(name),
            lease=lease,
            fluents={
                fluent: Stamped(value, stamps[fluent], received_ns)
                for fluent, value in state.fluents.items()
                if fluent in stamps
            },
        )

    def running(self, name: str) -> str:
        """`<mission>/<sequence>` of what a robot says that it carries out, unless its end was heard; or empty."""
        state = self._states.get(name)
        return "" if state is None or self._ended.get(name) == state.running else state.running

    def status(self, leases: Mapping[str, str]) -> tuple[RobotStatus, ...]:
        """Every robot, for people."""
        found = []
        for spec in self._rules.crew.robots:
            known, state = self._robot(spec.name, leases.get(spec.name, "")), self._states.get(spec.name)
            received = self._received.get(spec.name)
            found.append(
                RobotStatus(
                    robot=spec.name,
                    kind=spec.kind,
                    unavailable=known.unavailable,
                    stopped=known.stopped,
                    still=state is not None and state.still,
                    latch="" if state is None else state.latch,
                    age_s=None if received is None else (WALL.now_ns() - received[1]) / 1e9,
                    running=known.running,
                    lease=known.lease,
                    fluents={} if state is None else state.fluents,
                    progress=None if state is None else state.progress,
                )
            )
        return tuple(found)
