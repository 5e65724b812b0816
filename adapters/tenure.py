"""Who may move a robot: one skill's run at a time, or a safe behaviour, which ends whatever ran before."""

from typing import Generic, Protocol, TypeVar

from crew.adapter import Permit, StopLatch
from crew.clock import Clock
from crew.errors import AdapterError, Latched

POLL_S = 0.05


class HoldsPermit(Protocol):
    """A run of a skill, as far as this module knows one."""

    permit: Permit


Run = TypeVar("Run", bound=HoldsPermit)


class Tenure(Generic[Run]):
    """The latch's lock orders every change with the stop. Safe to read from any thread."""

    def __init__(self, robot: str, latch: StopLatch, clock: Clock) -> None:
        self._robot, self._latch, self._clock = robot, latch, clock
        self.run: Run | None = None
        self.safe: Permit | None = None
        """The permit of the safe behaviour that is running."""

    def begin(self, skill: str, run: Run) -> Run:
        """Give the robot to a skill. Raises Latched, or AdapterError `robot_busy`."""
        with self._latch.lock:
            if self._latch.latched:
                raise Latched(f"{self._robot}: {skill} not started: the stop is latched; reset the robot first")
            if self.run is not None or self.safe is not None:
                raise AdapterError(f"{self._robot}: {skill} not started: busy", code="robot_busy")
            self.run = run
            return run

    def end(self) -> None:
        """The skill has returned."""
        self.run = None

    def begin_safe(self) -> Permit:
        """Give the robot to a safe behaviour; its permit works while the stop is latched."""
        with self._latch.lock:
            self.revoke(AdapterError(f"{self._robot}: a safe behaviour took over", code="cancelled"))
            self.safe = Permit(safe=True)
            return self.safe

    def end_safe(self, permit: Permit) -> None:
        """The safe behaviour has returned; a later one keeps the robot."""
        with self._latch.lock:
            if self.safe is permit:
                self.safe = None

    def cancel(self, why: str) -> None:
        """End the skill that has the robot, at its next check or write; a first reason stays."""
        with self._latch.lock:
            if self.run is not None:
                self.run.permit.revoke(AdapterError(f"{self._robot}: {why}", code="cancelled"))

    def revoke(self, error: AdapterError) -> None:
        """End whatever has the robot, skill or safe behaviour."""
        with self._latch.lock:
            for permit in (self.run.permit if self.run else None, self.safe):
                if permit is not None:
                    permit.revoke(error)

    async def ended(self) -> None:
        """Wait for a run whose permit was revoked to notice it: one poll, or the answer to its last command."""
        while self.run is not None and self.run.permit.revoked:
            await self._clock.sleep(POLL_S)
