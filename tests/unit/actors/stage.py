"""A robot actor on a bus in memory with an adapter that does as it is told, and the orchestrator's side to drive it."""

import asyncio
import secrets
from collections.abc import AsyncIterator, Callable, Mapping
from contextlib import asynccontextmanager
from dataclasses import dataclass, field
from functools import cache
from typing import Any

from msgspec.structs import replace

from crew.actors.robot import lost
from crew.actors.robot.actor import RobotActor
from crew.adapter import Adapter, Neighbour, Place, Reading, StopLatch
from crew.bus.fabric import MemoryFabric
from crew.bus.memory import MemoryBus
from crew.bus.port import Bus, Declaration, Qos
from crew.clock import SimClock, seconds_ns
from crew.contracts.plan import ArgValue, digest
from crew.contracts.site import Rules
from crew.contracts.skill import SkillArgs
from crew.contracts.snapshot import FluentValue, Point, ValueReading
from crew.errors import AdapterError, Latched
from crew.keys import Keys
from crew.library import load_rules
from crew.mailbox import Events, KeepLatest, Letter, letters
from crew.messages import RESET, CancelSkill, Dispatch, Heartbeat, Reset, RobotEvent, RobotState, Stop
from crew.permit import permit
from crew.signing import SigningKey

WAIT_S = 5.0
NEAR = (-3.0, -3.0)
SPAWN = (-4.0, -2.5)


class FakeAdapter:
    """A rover that drives nowhere: `finish` ends a skill as if it had arrived; `broken` makes it fail."""

    def __init__(self, clock: SimClock) -> None:
        self._clock = clock
        self._latch = StopLatch()
        self.did: list[str] = []
        self.finish = asyncio.Event()
        self.broken: AdapterError | None = None
        self.deaf: AdapterError | None = None
        self.brake = asyncio.Event()
        self.brake.set()
        self.missing: list[AdapterError] = []
        self.sick = ""
        self.known: dict[str, FluentValue] = {"moving": False, "at": Point(*SPAWN), "battery": 90.0}
        self.published: dict[str, ValueReading] = {}
        self.sees: dict[str, ValueReading] = {}
        """What it publishes from the moment on at which it has its vehicle."""
        self.met: list[Neighbour] = []

    async def connect(self) -> None:
        if self.missing:
            raise self.missing.pop(0)
        self.published |= self.sees

    def meet(self, neighbour: Neighbour) -> None:
        self.met.append(neighbour)

    async def close(self) -> None:
        self.did.append("close")

    async def execute(self, skill: str, args: SkillArgs, places: Mapping[str, Place]) -> None:
        if self.latched:
            raise Latched("the stop is latched")
        self.did.append(skill)
        self.known["moving"] = True
        try:
            await self.finish.wait()
            if self.broken is not None:
                raise self.broken
        finally:
            self.known["moving"] = False

    async def cancel(self) -> None:
        self.did.append("cancel")
        await self.brake.wait()
        if self.deaf is not None:
            raise self.deaf

    async def safe(self, behaviour: str) -> None:
        self.did.append(f"safe:{behaviour}")
        if self.deaf is not None:
            raise self.deaf

    def halt(self) -> None:
        if not self.latched:
            self._latch.set()
            self.did.append("halt")

    def release(self) -> None:
        self._latch.clear()

    @property
    def latched(self) -> bool:
        return self._latch.latched

    def fluents(self) -> Mapping[str, Reading]:
        return {name: Reading(value, self._clock.now_ns()) for name, value in self.known.items()}

    def values(self) -> Mapping[str, ValueReading]:
        return self.published

    def health(self) -> str:
        return self.sick

    def link_counts(self) -> tuple[int, int]:
        return 0, 0

    def on_traffic(self, callback: Callable[[], None]) -> None:
        """Nothing travels."""

    def arrive(self, x: float = NEAR[0], y: float = NEAR[1]) -> None:
        """Telemetry shows it there; the skill ends."""
        self.known["at"] = Point(x, y)
        self.finish.set()


@dataclass
class RobotStage:
    """One rover's actor and everything around it."""

    rules: Rules
    bus: Bus
    keys: Keys
    clock: SimClock
    adapter: FakeAdapter
    actor: RobotActor
    operator: SigningKey
    orchestrator: SigningKey
    fabric: MemoryFabric
    events: list[RobotEvent] = field(default_factory=list)
    states: list[RobotState] = field(default_factory=list)
    token: Declaration | None = None
    task: "asyncio.Task[None] | None" = None
    beats: int = 0
    holds: dict[str, Any] = field(default_factory=dict)
    fence: int = 1
    pulse: "asyncio.Task[None] | None" = None
    robot_bus: MemoryBus | None = None

    def __post_init__(self) -> None:
        self._events: Events[Letter[RobotEvent]] = Events(letters(RobotEvent), capacity=4096, on_lost=lambda _: None)
        self._states: KeepLatest[Letter[RobotState]] = KeepLatest(letters(RobotState))
        self.bus.subscribe(self.keys.robot_events, self._events)
        self.bus.subscribe(self.keys.robot_states, self._states)

    async def until(self, done: Callable[[], Any], why: str = "") -> None:
        """Let mission time run until a condition holds."""
        for _ in range(round(WAIT_S / 0.002)):
            self._hear()
            if done():
                return
            self.clock.advance(self.clock.now_ns() + seconds_ns(0.02))
            await asyncio.sleep(0.002)
        raise AssertionError(f"{why}: {self.whats}; {self.adapter.did}")

    async def settle(self) -> None:
        """Let everything that is on its way arrive."""
        for _ in range(3):
            assert await asyncio.to_thread(self.fabric.settled)
            for _ in range(10):
                await asyncio.sleep(0)
        self._hear()

    def _hear(self) -> None:
        self.events += [letter.message for letter in self._events.take()]
        self.states += [letter.message for letter in self._states.take()]

    @property
    def whats(self) -> list[str]:
        return [event.what for event in self.events]

    def last(self, *whats: str) -> RobotEvent:
        found = [e for e in self.events if e.what in whats]
        assert found, f"none of {whats} among {self.whats}"
        return found[-1]

    async def heard(self, *whats: str) -> RobotEvent:
        """Wait for an event of one of these kinds."""
        await self.until(lambda: any(e.what in whats for e in self.events), f"one of {whats}")
        return self.last(*whats)

    async def end(self) -> None:
        """End the robot as its process does."""
        assert self.task is not None
        self.task.cancel()
        await asyncio.gather(self.task, return_exceptions=True)

    # The orchestrator's side.

    def dispatch(self, sequence: int = 1, **changes: Any) -> Dispatch:
        """A sound dispatch to a near point, with what the test wants to be different before it is signed."""
        args: Mapping[str, ArgValue] = changes.pop("args", {"x": NEAR[0], "y": NEAR[1]})
        now_ns = self.clock.now_ns()
        sound: dict[str, Any] = {
            "mission": "m1",
            "step": "dispatch",
            "purpose": "execute",
            "sequence": sequence,
            "robot": "tb3",
            "skill": "navigate_to",
            "args": args,
            "epoch": 1,
            "lease": "m1",
            "fence": self.fence,
            "boot_id": self.actor.boot_id,
            "issued_ns": now_ns,
            "expires_ns": now_ns + seconds_ns(2.0),
            "args_digest": digest(dict(args)),
            "plan_digest": "",
            "contract_digest": self.rules.contracts["dispatch_only"].digest,
        }
        return permit(Dispatch(**{**sound, **changes}), self.keys.crew, self.orchestrator)

    def send(self, dispatch: Dispatch, *, key_robot: str = "tb3") -> None:
        self.bus.put(self.keys.act(key_robot, dispatch.skill), dispatch, qos=Qos.ACTUATION)

    async def started(self, sequence: int = 1) -> None:
        """A dispatch is under way."""
        self.send(self.dispatch(sequence))
        await self.until(lambda: self.actor.running and "navigate_to" in self.adapter.did, "it drives")

    def cancel(self, **changes: Any) -> None:
        sound: dict[str, Any] = {"mission": "m1", "sequence": 1, "robot": "tb3", "epoch": 1}
        message = CancelSkill(**{**sound, "boot_id": self.actor.boot_id, **changes})
        self.put_cancel(permit(message, self.keys.crew, self.orchestrator))

    def put_cancel(self, message: CancelSkill) -> None:
        self.bus.put(self.keys.act_cancel("tb3"), message, qos=Qos.ACTUATION)

    def heartbeat(self, epoch: int = 1, **changes: Any) -> Heartbeat:
        """The next heartbeat; what a test changes stays so."""
        self.beats += 1
        self.holds |= changes
        unsigned = Heartbeat(**{"name": "orchestrator", "epoch": epoch, "count": self.beats, **self.holds})
        return permit(unsigned, self.keys.crew, self.orchestrator)

    def beat(self, epoch: int = 1, **changes: Any) -> None:
        self.bus.put(self.keys.heartbeat(), self.heartbeat(epoch, **changes), qos=Qos.EVENT)

    def freeze(self) -> None:
        """The orchestrator's heart stands still; its token stays."""
        assert self.pulse is not None
        self.pulse.cancel()

    def orchestrator_dies(self) -> None:
        """Its token and its heartbeat are gone at once."""
        assert self.token is not None
        self.freeze()
        self.token.close()

    async def orchestrator_lives(self, epoch: int = 1) -> None:
        """Its token is there and it has been heard."""
        self.token = self.bus.token(self.keys.alive("orchestrator"))
        self.freeze()
        self.beat(epoch)
        self.pulse = asyncio.create_task(self._beat_on(epoch))
        await self.until(lambda: self.actor.admission.epoch == epoch, "the heartbeat is heard")

    async def _beat_on(self, epoch: int) -> None:
        while True:
            await asyncio.sleep(0.2)
            self.beat(epoch)

    # The operator's side.

    def stop(self) -> None:
        self.bus.put(self.keys.stop, Stop(by="operator"), qos=Qos.STOP)

    def signed_reset(self, **changes: Any) -> Reset:
        """A reset of what the robot has heard, not sent yet."""
        sound: dict[str, Any] = {"by": "operator", "epoch": 1, "nonce": secrets.token_hex(4)}
        signature = changes.pop("signature", None)
        unsigned = Reset(**{**sound, "targets": {"tb3": self.actor.latch}, **changes}, signature=b"")
        part = unsigned.signed_part(self.keys.crew)
        return replace(unsigned, signature=self.operator.sign(RESET, part) if signature is None else signature)

    def reset(self, **changes: Any) -> Reset:
        """Publish a reset that is signed as it stands, unless the test brings a signature of its own."""
        signed = self.signed_reset(**changes)
        self.bus.put(self.keys.reset, signed, qos=Qos.STOP)
        return signed


def as_adapter(adapter: FakeAdapter) -> Adapter:
    """What the actor sees: the protocol, but for the constructor."""
    found: Any = adapter
    return found  # type: ignore[no-any-return]


@cache
def air_ground() -> Rules:
    """The shipped crew's rules, read once."""
    return load_rules("air_ground")


@asynccontextmanager
async def robot_stage(
    *missing: AdapterError, alone: bool = False, stop_first: bool = False
) -> AsyncIterator[RobotStage]:
    """A rover's actor that runs, on a fabric of its own; `missing` are the failures of its first connects.

    Unless it is `alone`, an orchestrator of epoch 0 is heard. `stop_first` yields before a vehicle was found, stopped.
    """
    lost.LOOK_EVERY_S = 0.01
    rules = air_ground()
    spec = rules.crew.robot("tb3")
    assert spec is not None
    keys, clock, operator = Keys("air_ground"), SimClock(), SigningKey(secrets.token_bytes(32))
    orchestrator = SigningKey(secrets.token_bytes(32))
    with MemoryFabric() as fabric:
        async with MemoryBus(fabric) as robot_bus, MemoryBus(fabric) as bus:
            adapter = FakeAdapter(clock)
            adapter.missing = list(missing)
            actor = RobotActor(
                robot_bus, keys, spec, rules, as_adapter(adapter), clock, operator.public, orchestrator.public
            )
            stage = RobotStage(rules, bus, keys, clock, adapter, actor, operator, orchestrator, fabric)
            stage.robot_bus = robot_bus
            stage.task = asyncio.create_task(actor.run())
            try:
                if stop_first:
                    stage.stop()
                    stage.pulse = stage.task
                    yield stage
                    return
                await stage.heard("ready")
                stage.pulse = asyncio.create_task(stage._beat_on(0))
                if alone:
                    stage.freeze()
                else:
                    stage.beat(0)
                    await stage.until(lambda: not actor.unavailable, "the orchestrator is heard")
                yield stage
            finally:
                stage.freeze()
                await stage.end()
