"""What a robot tells: its card, its state at a fixed rate, its values as they change, its events."""

from collections import Counter
from typing import TYPE_CHECKING

from crew.access import Row, came_with
from crew.adapter import Adapter, TellsProgress
from crew.bus.port import Bus, Qos
from crew.clock import Clock
from crew.contracts.site import RobotSpec
from crew.contracts.snapshot import RobotState as KnownRobot
from crew.contracts.snapshot import Snapshot, Stamped, StampedValue, ValueReading
from crew.keys import Keys
from crew.messages import Dispatch, Progress, RobotCard, RobotEvent, RobotState, RobotValue

if TYPE_CHECKING:
    from crew.actors.robot.actor import RobotActor

STATE_EVERY_S = 0.1
CARD_EVERY_S = 1.0


def _progress(adapter: Adapter) -> Progress | None:
    """How far the running skill has come; None for an adapter that does not tell."""
    told = adapter.progress() if isinstance(adapter, TellsProgress) else None
    return None if told is None else Progress(share=told.share, left_m=told.left_m)


class Reporter:
    """Publishes for one robot; knows nothing of who listens."""

    def __init__(
        self, bus: Bus, keys: Keys, spec: RobotSpec, actor: "RobotActor", adapter: Adapter, clock: Clock
    ) -> None:
        self._actor, self._adapter, self._clock = actor, adapter, clock
        self._bus, self._keys = bus, keys
        self._told: dict[str, ValueReading] = {}
        self._dropped: Counter[str] = Counter()
        self._card = RobotCard(
            robot=spec.name,
            kind=spec.kind,
            kind_digest=actor.kind.digest,
            boot_id=actor.boot_id,
            adapter=spec.adapter,
            simulated=not spec.connection,
        )
        self._states = bus.publisher(keys.robot_state(spec.name), qos=Qos.STATE)
        self._events = bus.publisher(keys.robot_event(spec.name), qos=Qos.ACTUATION)
        self._cards = bus.publisher(keys.robot_card(spec.name), qos=Qos.EVENT)

    async def run(self) -> None:
        """State every 0.1 s, the card every second, of mission time."""
        rounds = round(CARD_EVERY_S / STATE_EVERY_S)
        while True:
            self._cards.put(self._card)
            for _ in range(rounds):
                self.state()
                self.values()
                await self._clock.sleep(STATE_EVERY_S)

    def introduce(self) -> None:
        """Publish the card and the state now, for somebody who has only just come."""
        self._cards.put(self._card)
        self.state()

    def state(self) -> None:
        """Publish the state as it is now."""
        actor, readings = self._actor, self._adapter.fluents()
        self._states.put(
            RobotState(
                robot=actor.name,
                boot_id=actor.boot_id,
                at_ns=self._clock.now_ns(),
                unavailable=actor.unavailable,
                stopped=self._adapter.latched,
                still=self.still and not actor.making_safe,
                running=actor.running,
                epoch=actor.admission.epoch,
                latch=actor.latch,
                told=actor.told,
                dropped=actor.dropped,
                refused_permits=actor.admission.refused_permits,
                fluents={name: reading.value for name, reading in readings.items()},
                stamps_ns={name: reading.stamp_ns for name, reading in readings.items()},
                progress=_progress(self._adapter) if actor.running else None,
            )
        )

    @property
    def still(self) -> bool:
        """Telemetry shows the robot not moving, and not in the air."""
        readings = self._adapter.fluents()
        moving, airborne = readings.get("moving"), readings.get("airborne")
        return moving is not None and moving.value is False and (airborne is None or airborne.value is False)

    def values(self, reported: tuple[str, ...] = ()) -> None:
        """Publish the values that have changed, and those that a skill has just reported whether or not they have."""
        for name, reading in self._adapter.values().items():
            if name in reported or self._told.get(name) is not reading:
                self._told[name] = reading
                value = RobotValue(robot=self._actor.name, boot_id=self._actor.boot_id, reading=reading)
                self._bus.put(self._keys.robot_value(self._actor.name, name), value, qos=Qos.EVENT)

    def event(self, what: str, *, code: str = "", detail: str = "") -> None:
        """Something that happened to the robot itself."""
        self._put(what, "", 0, code, detail)

    def permit_refused(self, row: Row, code: str, detail: str) -> None:
        """Something that came without the orchestrator's permit, and whose certificate it was sent with."""
        certificate, known = came_with(row, self._bus.peer)
        self._put("permit_refused", "", 0, code, f"{detail}; {known}", certificate)

    def of(self, dispatch: Dispatch, what: str, code: str = "", detail: str = "") -> None:
        """Something that happened to a dispatch."""
        self._put(what, dispatch.mission, dispatch.sequence, code, detail)

    def dropped(self, why: str) -> None:
        """A command that never reached the actor: `full`, `stale` or `closed`. May be called from any thread."""
        self._dropped[why] += 1
        self._put("dropped", "", 0, why, f"{self._dropped[why]} commands so far")

    @property
    def dropped_commands(self) -> int:
        """Commands that never reached the actor."""
        return self._dropped.total()

    def snapshot(self) -> Snapshot:
        """The robot's own view of itself, for checking effects."""
        now_ns = self._clock.now_ns()
        fluents = {n: Stamped(r.value, r.stamp_ns, now_ns) for n, r in self._adapter.fluents().items()}
        values = {n: StampedValue(r, self._actor.name, now_ns) for n, r in self._adapter.values().items()}
        known = KnownRobot(name=self._actor.name, fluents=fluents)
        return Snapshot(robots={self._actor.name: known}, values=values)

    def _put(self, what: str, mission: str, sequence: int, code: str, detail: str, certificate: str = "") -> None:
        self._events.put(
            RobotEvent(
                robot=self._actor.name,
                boot_id=self._actor.boot_id,
                at_ns=self._clock.now_ns(),
                what=what,
                mission=mission,
                sequence=sequence,
                code=code,
                detail=detail[:2000],
                certificate=certificate,
            )
        )
