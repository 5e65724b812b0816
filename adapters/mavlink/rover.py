"""The rover's skills. World ENU, metres."""

import math
from collections.abc import Mapping, Sequence

from crew.adapter import Place, Reading
from crew.adapters.ground.occupancy import Disc, Ground, Spot
from crew.adapters.ground.route import plan_route
from crew.adapters.mavlink.braking import brake
from crew.adapters.mavlink.fence import check_inside
from crew.adapters.mavlink.flavours.flavour import Flavour
from crew.adapters.mavlink.fluents import common_fluents
from crew.adapters.mavlink.options import RoverOptions
from crew.adapters.mavlink.others import Others
from crew.adapters.mavlink.preflight import check_failsafes
from crew.adapters.mavlink.run import Run
from crew.adapters.mavlink.vehicle import Vehicle
from crew.adapters.mavlink.watch import Watch
from crew.contracts.kinds.rover import NavigateTo, Stop
from crew.contracts.skill import SkillArgs
from crew.contracts.snapshot import ValueReading
from crew.errors import AdapterError

MOVING_MPS = 0.1
STILL_MPS = 0.05
SETTLE_S = 1.5
CLOSE_M = 0.07
APPROACHES = 5
"""How often what is left to the goal is driven, once the estimate has settled."""
PASS_M = 0.25
"""A way-point between two legs is passed, not stopped at, within this distance."""
DETOURS = 6


class RoverSkills:
    """Carries out the kind's skills over one vehicle."""

    still_mps = STILL_MPS
    unconditional = frozenset({"stop"})
    grounded = False

    def __init__(self, vehicle: Vehicle, flavour: Flavour, options: RoverOptions, others: Others) -> None:
        self._others = others
        self._vehicle = vehicle
        self._flavour = flavour
        self._options = options

    def fluents(self) -> Mapping[str, Reading]:
        """As the kind declares them."""
        return common_fluents(self._vehicle.telemetry, MOVING_MPS)

    def values(self) -> Mapping[str, ValueReading]:
        return {}

    async def perform(self, args: SkillArgs, places: Mapping[str, Place], run: Run) -> None:
        """Carry out one skill to its observed end."""
        match args:
            case NavigateTo():
                await self._navigate(run, resolve(args, places))
            case Stop():
                await self.stop(run)
            case _:
                raise AdapterError(f"a rover has no skill with {type(args).__name__}", code="unknown_skill")

    async def come_down(self, run: Run) -> None:
        """A rover is always on the ground."""

    async def stop(self, run: Run) -> None:
        """Hold, and wait until it stands still."""
        await brake(run, STILL_MPS)

    async def _navigate(self, run: Run, place: Place) -> None:
        check_inside(self._vehicle.config, place.x, place.y, "navigate_to")
        await check_failsafes(self._flavour, self._vehicle.parameters)
        await self._vehicle.fresh_home()
        met = self._others.columns()
        route = self._detour(place, met) if met else self._plan(place, ())
        await run.command(*self._flavour.prepare(), leads_to=self._flavour.travel_modes)
        for _ in range(DETOURS):
            new = await self._drive(run, place, route, met)
            if not new:
                await self.stop(run)
                return
            met += new
            await self.stop(run)
            await run.command(*self._flavour.prepare(), leads_to=self._flavour.travel_modes)
            route = self._detour(place, met)
        raise self._blocked(met, f"{DETOURS} detours led nowhere")

    async def _drive(self, run: Run, place: Place, route: list[Spot], met: Sequence[Disc]) -> list[Disc]:
        """Along a route to its end; or, stopping nowhere, what unknown things have come in its way."""
        watch = Watch(self._vehicle, place, met, self._options, self._others)
        run.way.plan(self._here(), route)
        for spot in route[:-1]:
            if new := await self._leg(run, spot, PASS_M, math.inf, watch):
                return new
        return await self._approach(run, route[-1], watch)

    async def _approach(self, run: Run, spot: Spot, watch: Watch) -> list[Disc]:
        """The last leg. Standing still its position estimate settles and shows what is left: drive that, a few times.

        Raises AdapterError `no_progress` if it still stands further than `arrive_m` from the spot, unless it stands
        before what it was sent to.
        """
        for _ in range(APPROACHES):
            if new := await self._leg(run, spot, 2.0 * self._options.arrive_m, STILL_MPS, watch):
                return new
            await run.hold(SETTLE_S, over=watch.before_it)
            if watch.before_it() or (math.dist(self._here(), spot) < CLOSE_M and self._speed_mps() < STILL_MPS):
                return []
        left_m = math.dist(self._here(), spot)
        if left_m > self._options.arrive_m:
            raise AdapterError(
                f"{self._vehicle.config.robot}: stands {left_m:.2f} m from ({spot[0]:.1f}, {spot[1]:.1f}) "
                f"after {APPROACHES} approaches, allowed {self._options.arrive_m:g} m",
                code="no_progress",
            )
        return []

    def _detour(self, place: Place, met: Sequence[Disc]) -> list[Spot]:
        try:
            return self._plan(place, met)
        except AdapterError as error:
            raise self._blocked(met, str(error)) from error

    def _blocked(self, met: Sequence[Disc], why: str) -> AdapterError:
        x, y, radius_m = met[-1]
        drone = (x, y, radius_m) in self._others.columns()
        what = "a drone comes down" if drone else "something that is not on the map stands in the way"
        return AdapterError(
            f"{self._vehicle.config.robot}: {what} near ({x:.1f}, {y:.1f}): {why}",
            code="path_blocked",
        )

    def _plan(self, place: Place, met: Sequence[Disc]) -> list[Spot]:
        options, config = self._options, self._vehicle.config
        here = self._here()
        edge_m = options.robot_radius_m if config.geofence else -1000.0
        x_min, x_max, y_min, y_max = config.area
        area = (x_min + edge_m, x_max - edge_m, y_min + edge_m, y_max - edge_m)
        target = (place.x, place.y)
        ground = Ground(
            area,
            (*config.obstacles, *met),
            radius_m=options.robot_radius_m,
            clearance_m=options.clearance_m,
            start=here,
            target=target,
        )
        return plan_route(ground, here, target, place.standoff_m, options.cell_m)

    async def _leg(self, run: Run, spot: Spot, near_m: float, slow_mps: float, watch: Watch) -> list[Disc]:
        commands = self._flavour.go_to(self._vehicle.place(*spot, 0.0), self._options.cruise_mps, None)
        await run.go(commands, self._flavour.travel_modes, spot)
        new: list[Disc] = []

        def gap_m() -> float:
            return math.dist(self._here(), spot)

        def over() -> bool:
            new.extend(watch.in_the_way(spot))
            return bool(new) or watch.before_it() or (gap_m() < near_m and self._speed_mps() < slow_mps)

        await run.until(over, gap_m, f"drive to ({spot[0]:.1f}, {spot[1]:.1f})")
        return new

    def _here(self) -> Spot:
        motion = self._vehicle.telemetry.motion
        if motion is None:
            raise AdapterError("no position was received yet", code="position_lost")
        return motion.value.x_m, motion.value.y_m

    def _speed_mps(self) -> float:
        motion = self._vehicle.telemetry.motion
        return math.inf if motion is None else motion.value.ground_speed_mps


def resolve(args: NavigateTo, places: Mapping[str, Place]) -> Place:
    """Where to drive: the resolved place of `target`, or the point itself. Raises AdapterError `bad_argument`."""
    if args.target is not None:
        place = places.get("target")
        if place is None:
            raise AdapterError(f"navigate_to: target {args.target!r} came without its place", code="bad_argument")
        return place
    if args.x is None or args.y is None:
        raise AdapterError("navigate_to: needs a target, or x and y", code="bad_argument")
    return Place(args.x, args.y)
