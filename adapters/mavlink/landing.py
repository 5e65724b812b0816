"""Coming down: not on a person that was found, nor on a robot; up again if a robot comes below. World ENU, metres."""

import math
from collections.abc import Callable, Sequence

from crew.adapters.ground.occupancy import Disc, Spot
from crew.adapters.mavlink.flavours.flavour import FlightFlavour
from crew.adapters.mavlink.others import Others
from crew.adapters.mavlink.run import Run
from crew.adapters.mavlink.telemetry import Motion
from crew.adapters.mavlink.vehicle import Vehicle
from crew.errors import AdapterError

TRIES = 4
COMMITTED_M = 0.4
"""Below this height it goes on down, whoever comes."""
BEYOND_M = 0.5
"""It lands this far outside of what it moved aside from."""
FRESH_S = 1.0


class Landing:
    """One way down. `person`: a disc that nobody lands in, if somebody was found."""

    def __init__(
        self, vehicle: Vehicle, flavour: FlightFlavour, others: Others, ceiling_m: float, person: Sequence[Disc]
    ) -> None:
        self._vehicle, self._flavour, self._others = vehicle, flavour, others
        self._ceiling_m, self._person = ceiling_m, person

    def aside(self) -> tuple[float, float, float] | None:
        """Where to fly before coming down, x, y and height; None if here is well, or if nobody knows where here is."""
        motion = self._motion()
        if motion is None or motion.height_m < COMMITTED_M:
            return None
        here, taken = (motion.x_m, motion.y_m), (*self._person, *self._others.standing())
        inside = [disc for disc in taken if math.dist(here, disc[:2]) < disc[2]]
        spots = [spot for disc in inside for spot in self._around(disc, taken)]
        if not spots:
            return None
        return *max(spots, key=lambda spot: self._room_m(spot, here)), min(motion.height_m, self._ceiling_m)

    async def descend(self, run: Run, on_ground: Callable[[], bool], hurried: Callable[[], bool]) -> bool:
        """Land; whether it is down. If not, a robot has come below and it is to be brought up again."""
        await run.command(self._flavour.land, leads_to=self._flavour.land_modes)
        await run.until(lambda: on_ground() or (bool(self.intruder()) and not hurried()), self._height_m, "land")
        return on_ground()

    def intruder(self) -> str:
        """Who is below; empty if nobody, or if it is too late to care."""
        motion = self._motion()
        return "" if motion is None or motion.height_m < COMMITTED_M else self._others.below(motion.x_m, motion.y_m)

    def occupied(self) -> AdapterError:
        """Why it hovers instead of landing."""
        who, name = self.intruder(), self._vehicle.config.robot
        return AdapterError(f"{name}: not landed: {who or 'a robot'} is below, after {TRIES} tries", code="not_clear")

    def _motion(self) -> Motion | None:
        told = self._vehicle.telemetry
        return told.motion.value if told.motion is not None and told.age_s(told.motion) < FRESH_S else None

    def _height_m(self) -> float:
        motion = self._vehicle.telemetry.motion
        return math.inf if motion is None else max(0.0, motion.value.height_m)

    def _around(self, disc: Disc, taken: Sequence[Disc]) -> list[Spot]:
        """Spots a little outside a disc, inside the area and outside of all that is taken."""
        x_m, y_m, radius_m = disc
        x_min, x_max, y_min, y_max = self._vehicle.config.area
        turns, reach_m = [math.tau * i / 12 for i in range(12)], radius_m + BEYOND_M
        ring = [(x_m + reach_m * math.cos(a), y_m + reach_m * math.sin(a)) for a in turns]
        inside = [(x, y) for x, y in ring if x_min <= x <= x_max and y_min <= y <= y_max]
        return [spot for spot in inside if all(math.dist(spot, d[:2]) >= d[2] for d in taken)]

    def _room_m(self, spot: Spot, here: Spot) -> float:
        """How far a spot is from every known obstacle; of equal ones the nearest is best."""
        obstacles = self._vehicle.config.obstacles
        room_m = min((math.dist(spot, (x, y)) - r for x, y, r in obstacles), default=0.0)
        return room_m - 0.001 * math.dist(spot, here)
