"""The adapter that a robot actor owns: one robot, one skill at a time, a stop that needs no event loop."""

from collections.abc import Callable, Mapping

from crew.adapter import AdapterConfig, Permit, Place, Reading, StopLatch
from crew.adapters.aftermath import Aftermath
from crew.adapters.options import read_options
from crew.adapters.settling import Settling
from crew.adapters.stopping import StopRepeater
from crew.adapters.tenure import Tenure
from crew.adapters.unitree.manipulator import ManipulatorSkills
from crew.adapters.unitree.options import ManipulatorOptions, RobotOptions, WalkerOptions
from crew.adapters.unitree.robot import Robot
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
        self._tenure: Tenure[Run] = Tenure(config.robot, self._latch, clock)
        self._aftermath = Aftermath(
            lambda: self._skills.stop(self._run_for(Permit(safe=True))), self._still_since, clock
        )
        self._halted_ns = 0
        self._repeater = StopRepeater(
            lambda: self._skills.send_stop(), lambda: self._still_since(self._halted_ns), self._latch.lock
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
        self._aftermath.forget()

    async def close(self) -> None:
        """End a running skill, stopping the robot, and let the link go."""
        if self._tenure.run is not None:
            self._tenure.cancel("adapter closed")
            self._skills.send_stop()
        await self._disconnect()

    async def execute(self, skill: str, args: SkillArgs, places: Mapping[str, Place]) -> None:
        """Carry out a skill to its observed end; raises Latched or AdapterError, and leaves no motion behind."""
        run = self._tenure.begin(skill, self._run_for(Permit()))
        try:
            await self._aftermath.settle()
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
            self._tenure.end()

    async def cancel(self) -> None:
        """End the running skill and stop; returns when still. Raises AdapterError `still_moving`."""
        self._tenure.cancel("skill cancelled")
        await self._skills.stop(self._run_for(Permit(safe=True)))
        await self._tenure.ended()

    async def safe(self, behaviour: str) -> None:
        """`stop` (a quadruped stands still) or `hold` (an arm stays where it is). Allowed while latched."""
        known = SAFE_BEHAVIOURS[self._config.kind]
        if behaviour not in known:
            raise AdapterError(f"no safe behaviour {behaviour!r}{nearest(behaviour, known)}", code="bad_argument")
        permit = self._tenure.begin_safe()
        try:
            await self._skills.stop(self._run_for(permit))
            self._repeater.finish()
            await self._tenure.ended()
        finally:
            self._tenure.end_safe(permit)

    def halt(self) -> None:
        """Latch, then stop: from any thread, at once, without the event loop. Again: the stop is sent again."""
        with self._latch.lock:
            if self._latch.latched:
                if not self._repeater.active and not self._still_since(self._halted_ns):
                    self._skills.send_stop()
                return
            self._latch.set()
            self._halted_ns = self._clock.now_ns()
            self._tenure.revoke(Latched(f"{self._config.robot}: stopped"))
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
        return self._fault() or self._aftermath.doubt()

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
        await self._aftermath.close()
        await self._skills.robot.close()

    def _fault(self) -> str:
        """Why the robot may not be set in motion; empty if it may."""
        return self._skills.robot.fault() or self._skills.unfit()[1]

    # Runs.

    def _run_for(self, permit: Permit) -> Run:
        return Run(self._skills.robot, permit, self._skills.unfit)

    def _still_since(self, start_ns: int) -> bool:
        return self._skills.still_since(start_ns)

    def _abandon(self, run: Run, error: AdapterError) -> None:
        """Stop what was set in motion, and see to it that it stops; whoever revoked the permit does so already."""
        if run.permit.revoked:
            return
        run.permit.revoke(error)
        if run.moved:
            self._skills.send_stop()
            self._aftermath.begin()
