"""The rover's skills. World ENU, metres."""

import math
from collections.abc import Mapping

from crew.adapter import Place, Reading
from crew.adapters.mavlink.braking import brake
from crew.adapters.mavlink.fence import check_inside
from crew.adapters.mavlink.flavours.flavour import Flavour
from crew.adapters.mavlink.fluents import common_fluents
from crew.adapters.mavlink.occupancy import Ground, Spot
from crew.adapters.mavlink.options import RoverOptions
from crew.adapters.mavlink.preflight import check_failsafes
from crew.adapters.mavlink.route import plan_route
from crew.adapters.mavlink.run import Run
from crew.adapters.mavlink.vehicle import Vehicle
from crew.contracts.kinds.rover import NavigateTo, Stop
from crew.contracts.skill import SkillArgs
from crew.contracts.snapshot import ValueReading
from crew.errors import AdapterError

MOVING_MPS = 0.1
STILL_MPS = 0.05
SETTLE_S = 1.5
CLOSE_M = 0.1
APPROACHES = 5
"""How often what is left to the goal is driven, once the estimate has settled."""
PASS_M = 0.25
"""A way-point between two legs is passed, not stopped at, within this distance."""


class RoverSkills:
    """Carries out the kind's skills over one vehicle."""

    still_mps = STILL_MPS
    unconditional = frozenset({"stop"})
    grounded = False

    def __init__(self, vehicle: Vehicle, flavour: Flavour, options: RoverOptions) -> None:
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
        route = self._plan(place)
        await run.command(*self._flavour.prepare(), leads_to=self._flavour.travel_modes)
        for spot in route[:-1]:
            await self._leg(run, spot, PASS_M, math.inf)
        await self._approach(run, route[-1])
        await self.stop(run)

    async def _approach(self, run: Run, spot: Spot) -> None:
        """The last leg. Standing still its position estimate settles and shows what is left: drive that, a few times.

        Raises AdapterError `no_progress` if it still stands further than `arrive_m` from the spot.
        """
        for _ in range(APPROACHES):
            await self._leg(run, spot, 2.0 * self._options.arrive_m, STILL_MPS)
            await run.hold(SETTLE_S)
            if math.dist(self._here(), spot) < CLOSE_M and self._speed_mps() < STILL_MPS:
                return
        left_m = math.dist(self._here(), spot)
        if left_m > self._options.arrive_m:
            raise AdapterError(
                f"{self._vehicle.config.robot}: stands {left_m:.2f} m from ({spot[0]:.1f}, {spot[1]:.1f}) "
                f"after {APPROACHES} approaches, allowed {self._options.arrive_m:g} m",
                code="no_progress",
            )

    def _plan(self, place: Place) -> list[Spot]:
        options, config = self._options, self._vehicle.config
        here = self._here()
        edge_m = options.robot_radius_m if config.geofence else -1000.0
        x_min, x_max, y_min, y_max = config.area
        area = (x_min + edge_m, x_max - edge_m, y_min + edge_m, y_max - edge_m)
        target = (place.x, place.y)
        ground = Ground(
            area,
            config.obstacles,
            radius_m=options.robot_radius_m,
            clearance_m=options.clearance_m,
            start=here,
            target=target,
        )
        return plan_route(ground, here, target, place.standoff_m, options.cell_m)

    async def _leg(self, run: Run, spot: Spot, near_m: float, slow_mps: float) -> None:
        place = self._vehicle.place(*spot, 0.0)
        command = self._flavour.go_to(place, self._options.cruise_mps, None)
        await run.command(command, leads_to=self._flavour.travel_modes)

        def gap_m() -> float:
            return math.dist(self._here(), spot)

        def arrived() -> bool:
            return gap_m() < near_m and self._speed_mps() < slow_mps

        await run.until(arrived, gap_m, f"drive to ({spot[0]:.1f}, {spot[1]:.1f})")

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
