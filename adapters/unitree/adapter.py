"""The adapter that a robot actor owns: one robot, one skill at a time, a stop that needs no event loop."""

import asyncio
from collections.abc import Callable, Mapping

from crew.adapter import AdapterConfig, Permit, Place, Reading, StopLatch
from crew.adapters.options import read_options
from crew.adapters.settling import Settling
from crew.adapters.stopping import StopRepeater
from crew.adapters.unitree.manipulator import ManipulatorSkills
from crew.adapters.unitree.options import ManipulatorOptions, RobotOptions, WalkerOptions
from crew.adapters.unitree.robot import POLL_S, Robot
from crew.adapters.unitree.run import Run
from crew.adapters.unitree.skills import Skills
from crew.adapters.unitree.transport import Counts
from crew.adapters.unitree.walker import WalkerSkills
from crew.clock import Clock
from crew.contracts.skill import SkillArgs
from crew.contracts.snapshot import ValueReading
from crew.errors import AdapterError, Latched, nearest

OPTIONS: dict[str, type[RobotOptions]] = {"humanoid": ManipulatorOptions, "quadruped": WalkerOptions}
SAFE_BEHAVIOURS = {"humanoid": ("hold",), "quadruped": ("stop",)}


class UnitreeAdapter:
    """Implements `crew.adapter.Adapter` for the kinds humanoid and quadruped."""

    def __init__(self, config: AdapterConfig, clock: Clock) -> None:
        if config.kind not in OPTIONS:
            raise AdapterError(f"unitree: no kind {config.kind!r}{nearest(config.kind, OPTIONS)}", code="bad_option")
        self._config, self._clock = config, clock
        self._options = read_options(config.robot, dict(config.options), OPTIONS[config.kind])
        self._latch = StopLatch()
        self._counts = Counts()
        self._settling = Settling(clock)
        self._skills: Skills = self._new_skills()
        self._run: Run | None = None
        self._safe: Permit | None = None
        self._stopping: asyncio.Task[None] | None = None
        self._doubt = ""
        self._doubted_ns = 0
        self._halted_ns = 0
        self._repeater = StopRepeater(
            lambda: self._skills.send_stop(), lambda: self._skills.still_since(self._halted_ns), self._latch.lock
        )

    async def connect(self) -> None:
        """Find the robot, its telemetry, its services; raise AdapterError naming what is missing. Again: reconnect."""
        await self._disconnect()
        self._skills = self._new_skills()
        try:
            await self._skills.connect()
        except BaseException:
            await self._skills.robot.close()
            raise
        self._doubt = ""

    async def close(self) -> None:
        """End a running skill, stopping the robot, and let the link go."""
        if self._run is not None:
            self._end(self._run.permit, AdapterError(f"{self._config.robot}: adapter closed", code="cancelled"))
            self._skills.send_stop()
        await self._disconnect()

    async def execute(self, skill: str, args: SkillArgs, places: Mapping[str, Place]) -> None:
        """Carry out a skill to its observed end; raises Latched or AdapterError, and leaves no motion behind."""
        run = self._begin(skill)
        try:
            await self._settle_stop()
            if self._config.fitness and (fault := self._fault()):
                raise AdapterError(f"{self._config.robot}: {skill} not started: {fault}", code="robot_unavailable")
            await self._skills.perform(args, places, run)
        except AdapterError as error:
            self._abandon(run, error)
            raise
        except BaseException:
            self._abandon(run, AdapterError(f"{self._config.robot}: {skill} cancelled", code="cancelled"))
            raise
        finally:
            self._run = None

    async def cancel(self) -> None:
        """End the running skill and stop; returns when still. Raises AdapterError `still_moving`."""
        if self._run is not None:
            self._end(self._run.permit, AdapterError(f"{self._config.robot}: skill cancelled", code="cancelled"))
        await self._skills.stop(self._run_for(Permit(safe=True)))
        await self._ended()

    async def safe(self, behaviour: str) -> None:
        """`stop` (a quadruped stands still) or `hold` (an arm stays where it is). Allowed while latched."""
        known = SAFE_BEHAVIOURS[self._config.kind]
        if behaviour not in known:
            raise AdapterError(f"no safe behaviour {behaviour!r}{nearest(behaviour, known)}", code="bad_argument")
        permit = self._begin_safe()
        try:
            await self._skills.stop(self._run_for(permit))
            self._repeater.finish()
            await self._ended()
        finally:
            with self._latch.lock:
                if self._safe is permit:
                    self._safe = None

    def halt(self) -> None:
        """Latch, then stop: from any thread, at once, without the event loop. Again: the stop is sent again."""
        with self._latch.lock:
            if self._latch.latched:
                if not self._repeater.active and not self._skills.still_since(self._halted_ns):
                    self._skills.send_stop()
                return
            self._latch.set()
            self._halted_ns = self._clock.now_ns()
            stopped = Latched(f"{self._config.robot}: stopped")
            for permit in (self._run.permit if self._run else None, self._safe):
                self._end(permit, stopped)
            self._skills.send_stop()
            self._repeater.start()

    def release(self) -> None:
        """Open the latch."""
        with self._latch.lock:
            self._repeater.finish()
            self._latch.clear()

    @property
    def latched(self) -> bool:
        return self._latch.latched

    def fluents(self) -> Mapping[str, Reading]:
        """The kind's fluents as last observed; empty before the robot was found."""
        return self._skills.fluents() if self._skills.robot.connected else {}

    def values(self) -> Mapping[str, ValueReading]:
        """What is seen of things and people, if this kind looks at any."""
        return self._skills.values() if self._skills.robot.connected else {}

    def health(self) -> str:
        """Empty if the robot can take a skill, otherwise the reason in a few words."""
        return self._fault() or self._motion_doubt()

    def link_counts(self) -> tuple[int, int]:
        """Messages sent and received."""
        return self._counts.sent, self._counts.received

    def on_traffic(self, callback: Callable[[], None]) -> None:
        """Call back, on the loop, after received traffic was handled and the tasks that it woke had their turns."""
        self._settling.on_settled(callback)

    # Connecting.

    def _new_skills(self) -> Skills:
        kind: type[WalkerSkills] | type[ManipulatorSkills]
        kind = WalkerSkills if isinstance(self._options, WalkerOptions) else ManipulatorSkills
        robot = Robot(self._config, self._options, self._clock, self._latch, self._counts, self._settling, kind.needs)
        if isinstance(self._options, WalkerOptions):
            return WalkerSkills(robot, self._options)
        assert isinstance(self._options, ManipulatorOptions)
        return ManipulatorSkills(robot, self._options)

    async def _disconnect(self) -> None:
        self._repeater.finish()
        if self._stopping is not None:
            self._stopping.cancel()
            await asyncio.gather(self._stopping, return_exceptions=True)
            self._stopping = None
        await self._skills.robot.close()

    def _fault(self) -> str:
        """Why the robot may not be set in motion; empty if it may."""
        return self._skills.robot.fault() or self._skills.unfit()[1]

    # Runs.

    def _run_for(self, permit: Permit) -> Run:
        return Run(self._skills.robot, permit, self._skills.unfit)

    def _begin(self, skill: str) -> Run:
        with self._latch.lock:
            if self._latch.latched:
                raise Latched(f"{self._config.robot}: {skill} not started: the stop is latched; reset the robot first")
            if self._run is not None or self._safe is not None:
                raise AdapterError(f"{self._config.robot}: {skill} not started: busy", code="robot_busy")
            self._run = self._run_for(Permit())
            return self._run

    def _begin_safe(self) -> Permit:
        """A permit that ends whatever ran before."""
        with self._latch.lock:
            superseded = AdapterError(f"{self._config.robot}: a safe behaviour took over", code="cancelled")
            for permit in (self._run.permit if self._run else None, self._safe):
                self._end(permit, superseded)
            self._safe = Permit(safe=True)
            return self._safe

    def _end(self, permit: Permit | None, error: AdapterError) -> None:
        with self._latch.lock:
            if permit is not None:
                permit.revoke(error)

    async def _ended(self) -> None:
        """Wait for a run whose permit was revoked to notice it."""
        while self._run is not None and self._run.permit.revoked:
            await self._clock.sleep(POLL_S)

    # Stopping after a failure.

    def _abandon(self, run: Run, error: AdapterError) -> None:
        """Stop what was set in motion, and see to it that it stops; whoever revoked the permit does so already."""
        if run.permit.revoked:
            return
        self._end(run.permit, error)
        if run.moved:
            self._skills.send_stop()
            self._stopping = asyncio.get_running_loop().create_task(self._stop_after_failure())

    async def _stop_after_failure(self) -> None:
        try:
            await self._skills.stop(self._run_for(Permit(safe=True)))
            self._doubt = ""
        except AdapterError as error:
            self._doubt = f"did not confirm its stop: {error}"
            self._doubted_ns = self._clock.now_ns()

    async def _settle_stop(self) -> None:
        """Wait for the stop that an earlier failure left."""
        if self._stopping is not None:
            await asyncio.wait({self._stopping})
            self._stopping = None

    def _motion_doubt(self) -> str:
        """Why it may still be moving after a failure; empty once it was seen standing still since."""
        if self._doubt and self._skills.still_since(self._doubted_ns):
            self._doubt = ""
        return self._doubt
