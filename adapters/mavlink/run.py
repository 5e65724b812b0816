"""One run of a skill: its permit, what it watches, how it waits. Ends by telemetry, never by an acknowledgement."""

import math
from collections.abc import Callable

import msgspec

from crew.adapter import Permit
from crew.adapters.mavlink.command import Command
from crew.adapters.mavlink.fence import check_breach
from crew.adapters.mavlink.flavours.flavour import Modes
from crew.adapters.mavlink.vehicle import POLL_S, Vehicle, seconds_since
from crew.adapters.mavlink.way import Way
from crew.clock import seconds_ns
from crew.errors import AdapterError

MODE_GRACE_S = 2.5
"""A commanded mode shows in the heartbeat at 1 Hz; this long may pass until it does."""
STEP_M = 0.15
"""A gap must shrink by this to count as progress: more than the noise of an estimate over one poll."""
REASON_WINDOW_S = 3.0
"""A takeover's reason is looked for this long before the heartbeat that showed it."""
OTHER_AIM_M = 1.5
"""A target further than this from the one that was sent last is somebody else's."""
AIM_GRACE_S = 1.2
"""For the target to become known, and for a mode that explains another one to show in the heartbeat."""
HANDS_OFF = frozenset({"mode_changed", "commanded_by_other", "failsafe"})
"""Codes of failures after which the vehicle is another's to command."""


class Expectation(msgspec.Struct):
    """Modes that the run's last command leads to, and whether one of them was seen since."""

    modes: Modes
    since_ns: int
    seen: bool = False


class Run:
    """What a skill holds while it runs."""

    def __init__(self, vehicle: Vehicle, permit: Permit, stall_s: float, *, fenced: bool) -> None:
        self.vehicle = vehicle
        self._fenced = fenced
        self.permit = permit
        self.way = Way()
        self.moved = False
        """Whether anything that causes motion was sent."""
        self._stall_s = stall_s
        self._expectation: Expectation | None = None
        self._aim: tuple[float, float] | None = None
        self._aimed_ns = 0
        self._other_ns: int | None = None

    async def command(self, *commands: Command, leads_to: Modes | None = None) -> None:
        """Send commands in order, each accepted before the next; then hold the vehicle to the modes they lead to."""
        for command in commands:
            self.check()
            self.moved = True
            await self.vehicle.commander.send(command, self.permit)
        if leads_to is not None:
            self._expect(leads_to)

    async def go(self, commands: tuple[Command, ...], modes: Modes, aim: tuple[float, float]) -> None:
        """Send the vehicle to a point (world ENU, metres), and hold it to that."""
        self._aim = None
        await self.command(*commands, leads_to=modes)
        self._other_ns = None
        self._aim, self._aimed_ns = aim, self.vehicle.clock.now_ns()

    def check(self) -> None:
        """Raise why the run is over: stopped or cancelled, vehicle lost, rebooted or out of the area, mode changed."""
        self.permit.check()
        if fault := self.vehicle.link_fault():
            raise AdapterError(f"{self.vehicle.config.robot}: {fault}", code=_fault_code(fault))
        motion = self.vehicle.telemetry.motion
        if self._fenced and motion is not None:
            check_breach(self.vehicle.config, motion.value.x_m, motion.value.y_m)
        self._check_mode()
        if self._fenced:
            if self.vehicle.config.fitness:
                self._check_failsafe()
            self._check_home()
            self._check_aim()

    async def until(self, done: Callable[[], bool], gap_m: Callable[[], float], what: str) -> None:
        """Wait until `done`. Raises AdapterError `no_progress` when `gap_m` stops shrinking, and what `check` does."""
        clock = self.vehicle.clock
        self.way.leg(gap_m)
        best_m, since_ns = gap_m(), clock.now_ns()
        while True:
            self.permit.check()
            if done():
                return
            self.check()
            gap = gap_m()
            if gap < best_m - STEP_M:
                best_m, since_ns = gap, clock.now_ns()
            if seconds_since(clock, since_ns) > self._stall_s:
                raise AdapterError(
                    f"{self.vehicle.config.robot}: {what}: no progress for {self._stall_s:g} s, "
                    f"still {gap:.2f} m away in mode {self.vehicle.mode()}",
                    code="no_progress",
                )
            await clock.sleep(POLL_S)

    async def hold(self, seconds: float, over: Callable[[], bool] = lambda: False) -> None:
        """Stay for a time of the mission, or until `over`, watching all the while."""
        clock = self.vehicle.clock
        start_ns = clock.now_ns()
        while seconds_since(clock, start_ns) < seconds and not over():
            self.check()
            await clock.sleep(POLL_S)

    def _expect(self, modes: Modes) -> None:
        if self._expectation is None or self._expectation.modes != modes:
            self._expectation = Expectation(modes, self.vehicle.clock.now_ns())

    def _check_mode(self) -> None:
        expected, heartbeat = self._expectation, self.vehicle.telemetry.heartbeat
        if expected is None or heartbeat is None or heartbeat.stamp_ns <= expected.since_ns:
            return
        mode = self.vehicle.mode()
        if mode in expected.modes:
            expected.seen = True
        elif expected.seen or seconds_since(self.vehicle.clock, expected.since_ns) > MODE_GRACE_S:
            wanted = " or ".join(sorted(expected.modes))
            raise AdapterError(
                f"{self.vehicle.config.robot}: mode is {mode}, expected {wanted}; a pilot or a failsafe took over",
                code="mode_changed",
                reason="; ".join(self.vehicle.telemetry.texts.since(heartbeat.stamp_ns - seconds_ns(REASON_WINDOW_S))),
            )

    def _check_failsafe(self) -> None:
        """A failsafe may act without a change of mode."""
        heartbeat = self.vehicle.telemetry.heartbeat
        if self.moved and heartbeat is not None and heartbeat.value.critical:
            since_ns = heartbeat.stamp_ns - seconds_ns(REASON_WINDOW_S)
            reason = "; ".join(self.vehicle.telemetry.texts.since(since_ns))
            raise AdapterError(
                f"{self.vehicle.config.robot}: the vehicle reports a critical state: {reason or 'no reason given'}",
                code="failsafe",
                reason=reason,
            )

    def _check_home(self) -> None:
        if jump := self.vehicle.telemetry.home_jump:
            raise AdapterError(f"{self.vehicle.config.robot}: {jump}", code="home_jumped")

    def _check_aim(self) -> None:
        """The vehicle says where it is going; a target that was not sent from here means another commands it."""
        told, aim, now_ns = self.vehicle.telemetry.aim, self._aim, self.vehicle.clock.now_ns()
        if told is None or aim is None or told.stamp_ns < self._aimed_ns + seconds_ns(AIM_GRACE_S):
            return
        awaited = self._expectation is not None and self.vehicle.mode() not in self._expectation.modes
        if awaited or math.dist(told.value, aim) <= OTHER_AIM_M:
            self._other_ns = None
            return
        self._other_ns = self._other_ns or now_ns
        if now_ns - self._other_ns > seconds_ns(AIM_GRACE_S):
            raise AdapterError(
                f"{self.vehicle.config.robot}: it is going to ({told.value[0]:.1f}, {told.value[1]:.1f}) and was sent "
                f"to ({aim[0]:.1f}, {aim[1]:.1f}); another station commands it",
                code="commanded_by_other",
            )


def _fault_code(fault: str) -> str:
    if "rebooted" in fault:
        return "rebooted"
    return "link_lost" if fault.startswith("link") else "position_lost"
