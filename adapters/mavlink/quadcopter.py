"""The quadcopter's skills on any flying flavour. Heights are above home; points are world ENU, metres."""

import math
from collections.abc import Mapping

from crew.adapter import Place, Reading
from crew.adapters.ground.occupancy import Disc
from crew.adapters.mavlink.camera import footprint_m
from crew.adapters.mavlink.fence import check_inside
from crew.adapters.mavlink.flavours.flavour import FlightFlavour
from crew.adapters.mavlink.fluents import common_fluents
from crew.adapters.mavlink.landing import TRIES, Landing
from crew.adapters.mavlink.options import QuadcopterOptions
from crew.adapters.mavlink.others import Others
from crew.adapters.mavlink.preflight import check_failsafes
from crew.adapters.mavlink.run import Run
from crew.adapters.mavlink.search import VICTIM, Search
from crew.adapters.mavlink.sweep import Sweep, Zone, plan_sweep
from crew.adapters.mavlink.telemetry import Motion
from crew.adapters.mavlink.vehicle import Vehicle
from crew.contracts.kinds.quadcopter import FlyTo, GetCoordinates, Land, SearchTarget, Takeoff
from crew.contracts.skill import SkillArgs
from crew.contracts.snapshot import ValueReading
from crew.errors import AdapterError

MOVING_MPS = 0.3
STILL_MPS = 0.25
PASS_M = 0.8
"""A corner of a sweep is passed, not stopped at, within this distance."""
ON_GROUND_M = 0.5
SINKING_MPS = 0.4
ASIDE_M = 2.0
"""It lands no nearer than this to a person that it has just found."""


class QuadcopterSkills:
    """Carries out the kind's skills over one vehicle."""

    still_mps = STILL_MPS
    unconditional = frozenset({"land"})

    def __init__(self, vehicle: Vehicle, flavour: FlightFlavour, options: QuadcopterOptions, others: Others) -> None:
        self._others = others
        self._vehicle = vehicle
        self._flavour = flavour
        self._options = options
        self._swept = False
        self._values: dict[str, ValueReading] = {}

    def fluents(self) -> Mapping[str, Reading]:
        """As the kind declares them."""
        told = self._vehicle.telemetry
        found = common_fluents(told, MOVING_MPS)
        if (airborne := told.airborne) is not None:
            found["airborne"] = Reading(airborne.value, airborne.stamp_ns)
        if told.motion is not None:
            found["altitude"] = Reading(told.motion.value.height_m, told.motion.stamp_ns)
        if airborne is not None and told.motion is not None:
            found["descending"] = Reading(self._descending(told.motion.value, airborne.value), told.motion.stamp_ns)
        found["swept"] = Reading(self._swept, self._vehicle.clock.now_ns())
        return found

    def values(self) -> Mapping[str, ValueReading]:
        return dict(self._values)

    @property
    def grounded(self) -> bool:
        """On the ground and disarmed: nothing can move it without arming."""
        airborne = self._vehicle.telemetry.airborne
        return airborne is not None and not airborne.value and not self._vehicle.telemetry.armed

    async def perform(self, args: SkillArgs, places: Mapping[str, Place], run: Run) -> None:
        """Carry out one skill to its observed end."""
        match args:
            case Takeoff():
                await self._take_off(run, args.altitude)
            case SearchTarget():
                await self._search(run, args)
            case GetCoordinates():
                self._report()
            case FlyTo():
                self._require_airborne("fly_to")
                check_inside(self._vehicle.config, args.x, args.y, "fly_to")
                await self.travel(run, args.x, args.y, args.altitude, None)
            case Land():
                await self.come_down(run)
            case _:
                raise AdapterError(f"a quadcopter has no skill with {type(args).__name__}", code="unknown_skill")

    async def come_down(self, run: Run) -> None:
        """Land where it is, or aside; done when on the ground and disarmed. Raises AdapterError `not_clear`."""
        landing = Landing(self._vehicle, self._flavour, self._others, self._options.ceiling_m, self._person())
        height_m = self._height_m()
        for _ in range(TRIES):
            if self.grounded:
                return
            if (spot := landing.aside()) is not None:
                await self.travel(run, *spot, None)
            if await landing.descend(run, lambda: self.grounded, self.battery_low):
                return
            motion = self._motion()
            await self.travel(run, motion.x_m, motion.y_m, max(height_m, motion.height_m), None)
        raise landing.occupied()

    async def travel(self, run: Run, x_m: float, y_m: float, height_m: float, heading_rad: float | None) -> None:
        """Fly to a point and hover there, nearly still."""
        await self._leg(run, x_m, y_m, height_m, heading_rad)

        def arrived() -> bool:
            return self._gap_m(x_m, y_m, height_m) < self._options.arrive_m and self._motion().speed_mps < STILL_MPS

        await run.until(arrived, lambda: self._gap_m(x_m, y_m, height_m), f"fly to ({x_m:.1f}, {y_m:.1f})")

    def _check_height(self, height_m: float) -> None:
        ceiling_m = self._options.ceiling_m
        if self._vehicle.config.geofence and not 0.0 < height_m <= ceiling_m:
            raise AdapterError(
                f"{self._vehicle.config.robot}: height {height_m:g} m is not within 0 and {ceiling_m:g} m",
                code="out_of_bounds",
            )

    async def _take_off(self, run: Run, height_m: float) -> None:
        self._check_height(height_m)
        await check_failsafes(self._flavour, self._vehicle.parameters)
        home = await self._vehicle.fresh_home()
        commands = self._flavour.takeoff(height_m, home.amsl_m)
        try:
            await run.command(*commands, leads_to=self._flavour.takeoff_modes)
        except AdapterError:
            await self._disarm(run)
            raise

        def gap_m() -> float:
            return abs(self._motion().height_m - height_m)

        def up() -> bool:
            airborne = self._vehicle.telemetry.airborne
            there = gap_m() < self._options.arrive_m and self._motion().speed_mps < STILL_MPS
            return there and airborne is not None and airborne.value

        await run.until(up, gap_m, f"take off to {height_m:g} m")

    async def _disarm(self, run: Run) -> None:
        """After a refused takeoff: leave no rotors turning, if the vehicle still stands on the ground."""
        airborne = self._vehicle.telemetry.airborne
        if run.moved and airborne is not None and not airborne.value and self._motion().height_m < ON_GROUND_M:
            run.permit.check()
            await self._vehicle.commander.send(self._flavour.disarm, run.permit)

    def _person(self) -> list[Disc]:
        """Where it does not land: on the person it has found, and where a ground robot will stop."""
        found = self._values.get(VICTIM)
        if found is None or found.status != "ok" or found.position is None:
            return []
        here = (found.position.x, found.position.y)
        return [(*here, ASIDE_M)] if all(map(math.isfinite, here)) else []

    def battery_low(self) -> bool:
        """It comes down at once, wherever it is."""
        battery = self._vehicle.telemetry.battery_percent
        return battery is not None and battery.value < self._options.min_battery_percent

    def _height_m(self) -> float:
        motion = self._vehicle.telemetry.motion
        return 0.0 if motion is None else min(motion.value.height_m, self._options.ceiling_m)

    def _descending(self, motion: Motion, airborne: bool) -> bool:
        landing = self._vehicle.found and self._vehicle.mode() in self._flavour.land_modes
        return airborne and (landing or motion.up_mps < -SINKING_MPS)

    async def _search(self, run: Run, args: SearchTarget) -> None:
        self._require_airborne("search_target")
        zone = Zone(args.x_min, args.x_max, args.y_min, args.y_max)
        sweep = self._plan(zone, args.altitude)
        for x_m, y_m in ((zone.x_min, zone.y_min), (zone.x_max, zone.y_max), *sweep.points):
            check_inside(self._vehicle.config, x_m, y_m, "search_target")
        self._swept = False
        extent_m = self._options.target_extent_m
        search = Search(self._vehicle.telemetry, self._options.target_height_m, extent_m, zone)
        await self._fly(run, sweep, args.altitude)
        await self._confirm(run, search, args.altitude, sweep.heading_rad)
        self._values[VICTIM] = search.reading(self._vehicle.clock.now_ns())
        self._swept = True

    def _plan(self, zone: Zone, height_m: float) -> Sweep:
        if not (zone.x_min < zone.x_max and zone.y_min < zone.y_max):
            raise AdapterError(
                f"search_target: the zone x [{zone.x_min:g}, {zone.x_max:g}], y [{zone.y_min:g}, {zone.y_max:g}] "
                "is a line or a point, or has a minimum above its maximum",
                code="bad_argument",
            )
        options, motion = self._options, self._motion()
        above_m = max(height_m - options.target_height_m, 0.5)
        along_m = footprint_m(above_m, options.fov_y_deg)
        across_m = footprint_m(above_m, options.fov_x_deg)
        return plan_sweep(zone, along_m, across_m, options.overlap, (motion.x_m, motion.y_m))

    async def _fly(self, run: Run, sweep: Sweep, height_m: float) -> None:
        """All way-points: the first and the last are stopped at, so that the sweep begins and ends level."""
        first, *middle = sweep.points
        run.way.plan((self._motion().x_m, self._motion().y_m), sweep.points)
        await self.travel(run, *first, height_m, sweep.heading_rad)
        for x_m, y_m in middle[:-1]:
            await self._pass(run, x_m, y_m, height_m, sweep.heading_rad)
        if middle:
            await self.travel(run, *middle[-1], height_m, sweep.heading_rad)

    async def _pass(self, run: Run, x_m: float, y_m: float, height_m: float, heading_rad: float) -> None:
        await self._leg(run, x_m, y_m, height_m, heading_rad)

        def gap_m() -> float:
            return math.hypot(self._motion().x_m - x_m, self._motion().y_m - y_m)

        await run.until(lambda: gap_m() < PASS_M, gap_m, f"sweep to ({x_m:.1f}, {y_m:.1f})")

    async def _confirm(self, run: Run, search: Search, height_m: float, heading_rad: float) -> None:
        """Hover over a single fix for looks from straight above."""
        fix = search.fix()
        if fix is None or search.damaged_ns is not None or self._options.confirm_hover_s == 0:
            return
        x_min, x_max, y_min, y_max = self._vehicle.config.area
        x_m, y_m = min(max(fix.x_m, x_min), x_max), min(max(fix.y_m, y_min), y_max)
        await self.travel(run, x_m, y_m, height_m, heading_rad)
        search.hovering(self._vehicle.clock.now_ns())
        await run.hold(self._options.confirm_hover_s)

    def _report(self) -> None:
        reading = self._values.get(VICTIM)
        if reading is None:
            raise AdapterError("get_coordinates: no search was flown yet, so nothing is known", code="no_value")
        if reading.status == "absent":
            now_ns = self._vehicle.clock.now_ns()
            self._values[VICTIM] = ValueReading(name=VICTIM, status="absent", stamp_ns=now_ns)

    async def _leg(self, run: Run, x_m: float, y_m: float, height_m: float, heading_rad: float | None) -> None:
        check_inside(self._vehicle.config, x_m, y_m, "way-point")
        self._check_height(height_m)
        place = self._vehicle.place(x_m, y_m, height_m)
        commands = self._flavour.go_to(place, self._options.cruise_mps, heading_rad)
        await run.go(commands, self._flavour.travel_modes, (x_m, y_m))

    def _require_airborne(self, skill: str) -> None:
        airborne = self._vehicle.telemetry.airborne
        if airborne is None or not airborne.value:
            raise AdapterError(f"{skill}: not in the air; take off first", code="precondition_failed")

    def _motion(self) -> Motion:
        motion = self._vehicle.telemetry.motion
        if motion is None:
            raise AdapterError("no position was received yet", code="position_lost")
        return motion.value

    def _gap_m(self, x_m: float, y_m: float, height_m: float) -> float:
        motion = self._motion()
        return math.dist((motion.x_m, motion.y_m, motion.height_m), (x_m, y_m, height_m))
