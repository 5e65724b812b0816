"""What a robot actor asks of a vendor's adapter. Adapters implement kinds; they never see the simulation's truth."""

import threading
from collections.abc import AsyncIterator, Callable, Mapping
from typing import Any, Protocol, runtime_checkable

import msgspec

from crew.clock import Clock
from crew.contracts.skill import SkillArgs
from crew.contracts.snapshot import FluentValue, ValueReading
from crew.errors import AdapterError


class Place(msgspec.Struct, frozen=True):
    """A point that a symbolic argument was resolved to when it was dispatched. World ENU, metres."""

    x: float
    y: float
    z: float = 0.0
    standoff_m: float = 0.0


class AdapterConfig(msgspec.Struct, frozen=True, kw_only=True):
    """What an adapter is built from: the robot's part of the crew file and the world that it moves in."""

    robot: str
    kind: str
    connection: str
    options: dict[str, Any] = {}
    area: tuple[float, float, float, float]
    """Operational area x_min, x_max, y_min, y_max: world ENU, metres; the adapter's own geofence."""
    origin: tuple[float, float, float]
    """Latitude and longitude in degrees, altitude AMSL in metres of the world's (0, 0, 0)."""
    obstacles: tuple[tuple[float, float, float], ...] = ()
    """Known obstacles of the site's map as discs x, y, radius: world ENU, metres."""
    locations: Mapping[str, tuple[float, float]] = {}
    """The crew's named places: world ENU, metres."""
    separation_m: float = 0.0
    """How far a drone that comes down and robots on the ground keep from each other, between the places they tell."""
    models: str = ""
    """Folder of other models of the robots than this project's own, with their descriptions; empty for its own."""
    geofence: bool = True
    fitness: bool = True
    """Whether a skill is refused while the robot reports a fault; without it the robot itself has the only word.

    Both are lifted in the study's unenforced arms alone, which are simulated.
    """


class Reading(msgspec.Struct, frozen=True):
    """One fluent as the vehicle reported it, stamped with mission time at the source."""

    value: FluentValue
    stamp_ns: int


class Adapter(Protocol):
    """One robot over one vendor's protocol.

    Every coroutine raises `AdapterError` with the vehicle's own reason; none returns before telemetry shows the
    effect. `halt` is synchronous, thread-safe, idempotent and never waits: it latches first, then writes.
    """

    def __init__(self, config: AdapterConfig, clock: Clock) -> None: ...

    async def connect(self) -> None:
        """Find the vehicle and its telemetry; raise AdapterError naming what is missing."""
        ...

    async def close(self) -> None: ...

    async def execute(self, skill: str, args: SkillArgs, places: Mapping[str, Place]) -> None:
        """Carry out a skill to its observed end. `places` holds the resolved place of each symbolic argument."""
        ...

    async def cancel(self) -> None:
        """Stop the motion of the running skill and return when telemetry shows the robot nearly still."""
        ...

    async def safe(self, behaviour: str) -> None:
        """Carry out `on_stop` or `on_link_loss` behaviour (`hover`, `land`, `stop`): allowed while latched."""
        ...

    def halt(self) -> None: ...

    def release(self) -> None:
        """Open the latch: only the robot actor calls it, for a verified reset."""
        ...

    @property
    def latched(self) -> bool: ...

    def fluents(self) -> Mapping[str, Reading]:
        """The kind's fluents as last observed. A fluent that was never observed is absent."""
        ...

    def values(self) -> Mapping[str, ValueReading]:
        """Run-time values that the vehicle has published so far (a fix, for example)."""
        ...

    def health(self) -> str:
        """Empty if the robot can take a skill, otherwise the reason in a few words."""
        ...

    def link_counts(self) -> tuple[int, int]:
        """Datagrams sent and received on the vendor's link, for lockstep."""
        ...

    def on_traffic(self, callback: Callable[[], None]) -> None:
        """Call back (on the loop) after received traffic was handled."""
        ...


class Check(msgspec.Struct, frozen=True):
    """One item of a hardware checklist: what, whether it is as it must be, observed against allowed, what to do."""

    what: str
    ok: bool
    observed: str
    allowed: str
    fix: str = ""

    def __str__(self) -> str:
        if self.ok:
            return f"{self.what}: {self.observed}"
        return f"{self.what}: {self.observed}; allowed: {self.allowed}{f'; {self.fix}' if self.fix else ''}"


@runtime_checkable
class Checklist(Protocol):
    """An adapter that can ask a real robot what a person would check before it may be commanded."""

    async def connect(self) -> None: ...

    async def close(self) -> None: ...

    def checklist(self) -> AsyncIterator[Check]:
        """Every item, as it is found out. Sets nothing and moves nothing."""


class Course(msgspec.Struct, frozen=True):
    """How far a running skill has come: its share from 0 to 1, and what is left of the way, where they are known."""

    share: float | None = None
    left_m: float | None = None


@runtime_checkable
class TellsProgress(Protocol):
    """An adapter that can say how far a running skill has come. Optional: people look at it, nothing depends on it."""

    def progress(self) -> Course | None:
        """Of the skill that runs; None if none does, or if it is not known."""
        ...


class Neighbour(msgspec.Struct, frozen=True, kw_only=True):
    """Another robot of the crew by its own last word. World ENU, metres."""

    robot: str
    x: float
    y: float
    standing: bool
    """It may be on the ground."""
    coming_down: bool
    """It may be coming down through the air."""


@runtime_checkable
class KeepsClear(Protocol):
    """An adapter that keeps clear of the crew's other robots. Optional; it may ask nobody but its own neighbours."""

    def meet(self, neighbour: Neighbour) -> None:
        """Take a neighbour's last word; it counts until the next one."""
        ...


class StopLatch:
    """A latch shared by every path into an adapter; one lock orders it with the vehicle's write path."""

    def __init__(self) -> None:
        self.lock = threading.RLock()
        self._latched = False

    @property
    def latched(self) -> bool:
        return self._latched

    def set(self) -> None:
        with self.lock:
            self._latched = True

    def clear(self) -> None:
        with self.lock:
            self._latched = False


class Permit:
    """Leave to send motion-causing messages, held by one run of a skill until it is revoked.

    A `safe` permit also works while the stop is latched: braking, and whatever else makes the robot safe.
    """

    def __init__(self, *, safe: bool = False) -> None:
        self.safe = safe
        self._revoked: AdapterError | None = None

    def revoke(self, error: AdapterError) -> None:
        """End the permit for good; the first reason stays."""
        self._revoked = self._revoked or error

    @property
    def revoked(self) -> bool:
        return self._revoked is not None

    def check(self) -> None:
        """Raise the reason if the permit was revoked."""
        if self._revoked is not None:
            raise self._revoked
