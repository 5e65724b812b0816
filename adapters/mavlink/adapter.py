"""The adapter that a robot actor owns: one vehicle, one skill at a time, a stop that needs no event loop."""

from collections.abc import AsyncIterator, Callable, Mapping
from typing import cast

from crew.adapter import AdapterConfig, Check, Course, Neighbour, Permit, Place, Reading, StopLatch
from crew.adapters.aftermath import Aftermath
from crew.adapters.mavlink.braking import brake
from crew.adapters.mavlink.checklist import walk
from crew.adapters.mavlink.flavours.flavour import FlightFlavour
from crew.adapters.mavlink.link import LinkCounts
from crew.adapters.mavlink.options import QuadcopterOptions, RoverOptions, VehicleOptions
from crew.adapters.mavlink.others import Others
from crew.adapters.mavlink.quadcopter import QuadcopterSkills
from crew.adapters.mavlink.rover import RoverSkills
from crew.adapters.mavlink.run import HANDS_OFF, Run
from crew.adapters.mavlink.skills import Skills
from crew.adapters.mavlink.vehicle import Vehicle
from crew.adapters.options import read_options
from crew.adapters.settling import Settling
from crew.adapters.stopping import StopRepeater
from crew.adapters.tenure import Tenure
from crew.clock import Clock
from crew.contracts.skill import SkillArgs
from crew.contracts.snapshot import ValueReading
from crew.errors import AdapterError, Latched, nearest

OPTIONS: dict[str, type[VehicleOptions]] = {"quadcopter": QuadcopterOptions, "rover": RoverOptions}
SAFE_BEHAVIOURS = ("hover_then_land", "land", "hover", "stop")


class MavlinkAdapter:
    """Implements `crew.adapter.Adapter` for every flavour in the registry."""

    def __init__(self, config: AdapterConfig, clock: Clock) -> None:
        if config.kind not in OPTIONS:
            raise AdapterError(f"mavlink: no kind {config.kind!r}{nearest(config.kind, OPTIONS)}", code="bad_option")
        self._config = config
        self._clock = clock
        self._options = read_options(config.robot, dict(config.options), OPTIONS[config.kind])
        self._latch = StopLatch()
        self._counts = LinkCounts()
        self._settling = Settling(clock)
        self._others = Others(config.separation_m)
        self._vehicle = self._new_vehicle()
        self._skills: Skills | None = None
        self._tenure: Tenure[Run] = Tenure(config.robot, self._latch, clock)
        self._aftermath = Aftermath(lambda: self._brake(self._run_for(Permit(safe=True))), self._still_since, clock)
        self._taken_over = ""
        self._halted_ns = 0
        self._repeater = StopRepeater(self._send_stop, lambda: self._still_since(self._halted_ns), self._latch.lock)

    async def connect(self) -> None:
        """Find the vehicle and its telemetry; raise AdapterError naming what is missing. Again: reconnect."""
        await self._disconnect()
        self._vehicle = self._new_vehicle()
        try:
            await self._vehicle.connect()
        except BaseException:
            await self._vehicle.close()
            raise
        self._skills = self._new_skills()
        self._aftermath.forget()
        self._taken_over = ""

    async def close(self) -> None:
        """End a running skill, stopping the vehicle, and let the link go."""
        if self._tenure.run is not None:
            self._tenure.cancel("adapter closed")
            self._send_stop()
        await self._disconnect()

    async def execute(self, skill: str, args: SkillArgs, places: Mapping[str, Place]) -> None:
        """Carry out a skill to its observed end; raises Latched or AdapterError, and leaves no motion behind."""
        run = self._begin(skill)
        try:
            await self._aftermath.settle()
            self._require_fit(skill, run)
            await self._ready().perform(args, places, run)
        except AdapterError as error:
            if error.code in HANDS_OFF:
                self._leave_alone(error)
            else:
                self._abandon(run, error)
            raise
        except BaseException:
            self._abandon(run, AdapterError(f"{self._config.robot}: {skill} cancelled", code="cancelled"))
            raise
        finally:
            self._tenure.end()

    async def cancel(self) -> None:
        """End the running skill and brake; returns when nearly still. Raises AdapterError `still_moving`."""
        self._tenure.cancel("skill cancelled")
        await self._brake(self._run_for(Permit(safe=True)))
        await self._tenure.ended()

    async def safe(self, behaviour: str) -> None:
        """`hover` and `stop` brake, `land` lands, `hover_then_land` brakes, waits and lands. Allowed while latched.

        A vehicle that somebody else has taken over is left to them, unless the crew's own stop is latched.
        """
        if behaviour not in SAFE_BEHAVIOURS:
            raise AdapterError(
                f"no safe behaviour {behaviour!r}{nearest(behaviour, SAFE_BEHAVIOURS)}", code="bad_argument"
            )
        if self._pilot() and not self._latch.latched:
            return
        run = self._run_for(self._tenure.begin_safe())
        try:
            if behaviour != "land":
                await self._brake(run)
            if behaviour == "hover_then_land":
                await run.hold(self._hover_s(), over=self._hover_over)
            self._repeater.finish()
            if behaviour in ("land", "hover_then_land"):
                await self._ready().come_down(run)
            await self._tenure.ended()
        finally:
            self._tenure.end_safe(run.permit)

    async def checklist(self) -> AsyncIterator[Check]:
        """What a person would check before a real vehicle may be commanded. Connect first."""
        self._ready()
        async for check in walk(self._vehicle, self._options):
            yield check

    def halt(self) -> None:
        """Latch, then stop: from any thread, at once, without the event loop.

        Again while latched: the stop is sent again to a vehicle that still moves, but never into its own landing.
        """
        with self._latch.lock:
            if self._latch.latched:
                if self._tenure.safe is None and not self._repeater.active and not self._still_since(self._halted_ns):
                    self._send_stop()
                return
            self._latch.set()
            self._halted_ns = self._clock.now_ns()
            self._tenure.revoke(Latched(f"{self._config.robot}: stopped"))
            self._send_stop()
            self._repeater.start()

    def release(self) -> None:
        """Open the latch."""
        with self._latch.lock:
            self._repeater.finish()
            self._latch.clear()
            self._taken_over = ""

    @property
    def latched(self) -> bool:
        return self._latch.latched

    def fluents(self) -> Mapping[str, Reading]:
        """The kind's fluents as last observed; empty before the vehicle was found."""
        return self._skills.fluents() if self._skills else {}

    def values(self) -> Mapping[str, ValueReading]:
        """What was published so far."""
        return self._skills.values() if self._skills else {}

    def health(self) -> str:
        """Empty if the robot can take a skill, otherwise the reason in a few words."""
        if self._skills is None:
            return "not connected"
        return self._vehicle.link_fault() or self._pilot() or self._vehicle.fault() or self._aftermath.doubt()

    def meet(self, neighbour: Neighbour) -> None:
        """Keep clear of it from now on."""
        self._others.meet(neighbour)

    def link_counts(self) -> tuple[int, int]:
        """Datagrams sent and received."""
        return self._counts.sent, self._counts.received

    def on_traffic(self, callback: Callable[[], None]) -> None:
        """Call back, on the loop, after received traffic was handled and the tasks that it woke had their turns."""
        self._settling.on_settled(callback)

    # Connecting.

    def _new_vehicle(self) -> Vehicle:
        return Vehicle(self._config, self._options, self._clock, self._latch, self._counts, self._settling)

    def _new_skills(self) -> Skills:
        flavour, options = self._vehicle.flavour, self._options
        if isinstance(options, QuadcopterOptions):
            return QuadcopterSkills(self._vehicle, cast(FlightFlavour, flavour), options, self._others)
        return RoverSkills(self._vehicle, flavour, cast(RoverOptions, options), self._others)

    async def _disconnect(self) -> None:
        self._skills = None
        self._repeater.finish()
        await self._aftermath.close()
        await self._vehicle.close()

    def _ready(self) -> Skills:
        if self._skills is None:
            raise AdapterError(f"{self._config.robot}: not connected", code="not_connected")
        return self._skills

    # Runs.

    def _run_for(self, permit: Permit, *, fenced: bool = False) -> Run:
        return Run(self._vehicle, permit, self._options.stall_s, fenced=fenced)

    def _begin(self, skill: str) -> Run:
        fenced = self._skills is not None and skill not in self._skills.unconditional
        return self._tenure.begin(skill, self._run_for(Permit(), fenced=fenced))

    def _require_fit(self, skill: str, run: Run) -> None:
        run.check()
        if pilot := self._pilot():
            raise AdapterError(f"{self._config.robot}: {skill} not started: {pilot}", code="robot_unavailable")
        if skill in self._ready().unconditional:
            return
        if self._config.fitness and (fault := self._vehicle.fault()):
            raise AdapterError(f"{self._config.robot}: {skill} not started: {fault}", code="robot_unavailable")

    def progress(self) -> Course | None:
        """How far the running skill has come on its way."""
        run = self._tenure.run
        return None if run is None else run.way.course()

    # Stopping.

    def _abandon(self, run: Run, error: AdapterError) -> None:
        """After a failure: stop what was set in motion, at once, and see to it that it stops.

        Whoever revoked the permit (a stop, a cancel, a safe behaviour) does so already.
        """
        if run.permit.revoked:
            return
        run.permit.revoke(error)
        if run.moved:
            self._send_stop()
            self._aftermath.begin()

    def _leave_alone(self, error: AdapterError) -> None:
        """A pilot, a failsafe or another station has the vehicle: send nothing until it is down."""
        self._taken_over = f"somebody else has control: {error}; reset the robot when it is yours again (crew reset)"

    def _pilot(self) -> str:
        """Why the vehicle is somebody else's; empty once it stands disarmed."""
        if self._taken_over and not self._vehicle.telemetry.armed:
            self._taken_over = ""
        return self._taken_over

    async def _brake(self, run: Run) -> None:
        if not self._ready().grounded:
            await brake(run, self._ready().still_mps)

    def _send_stop(self) -> None:
        self._vehicle.send_stop()

    def _still_since(self, start_ns: int) -> bool:
        motion = self._vehicle.telemetry.motion
        still_mps = self._skills.still_mps if self._skills else 0.0
        return motion is not None and motion.stamp_ns > start_ns and motion.value.speed_mps < still_mps

    def _hover_s(self) -> float:
        return self._options.hover_s if isinstance(self._options, QuadcopterOptions) else 0.0

    def _hover_over(self) -> bool:
        """Nothing to wait for: it is on the ground, or its battery is low."""
        battery = self._vehicle.telemetry.battery_percent
        low = battery is not None and battery.value < self._options.min_battery_percent
        return low or self._ready().grounded
