"""The quadruped's skills over the sport service. World ENU, metres.

A walk is a stream of Moves, each good for a moment only; it ends when telemetry shows the robot there and still.
"""

import math
from collections import deque
from collections.abc import Mapping

from crew.adapter import AdapterConfig, Place, Reading
from crew.adapters.ground.occupancy import Disc, Ground, Spot
from crew.adapters.ground.route import plan_route
from crew.adapters.unitree.options import WalkerOptions
from crew.adapters.unitree.robot import FALLEN_RAD, POLL_S, Robot
from crew.adapters.unitree.run import Run
from crew.adapters.unitree.steering import Velocity, along, sideways, wrap_rad
from crew.adapters.unitree.telemetry import Sample, Seen, SportState, Telemetry
from crew.contracts.kinds.quadruped import Navigate, Stop
from crew.contracts.skill import NOTHING, SkillArgs
from crew.contracts.snapshot import Point, ValueReading
from crew.errors import AdapterError

SPORT = "sport"
BALANCE_STAND, STOP_MOVE, STAND_UP, MOVE = 1002, 1003, 1004, 1008
BALANCED, WALKING = 1, 3
UPRIGHT_M = 0.24
STANDS_UP_S = 6.0
ASK_AGAIN_S = 0.5
MOVING_MPS = 0.1
STILL_MPS, STILL_RPS = 0.06, 0.15
STILL_S = 0.4
STOPS_S = 4.0
LOOK_S = 2 * POLL_S
"""One look at the robot tells of no longer a time, however late it comes."""
FRESH_S = 4 * POLL_S
"""A state that is older tells nothing of the present: telemetry does not come in step with the looks."""
PASS_M = 0.25
"""A way-point between two legs is passed, not stopped at, within this distance."""
CLOSE_M, CLOSE_RAD = 0.04, 0.06
BERTHED_M = 0.25
"""So near to a berth's place the robot leaves it the way it came in."""
STEP_M = 0.1
"""A gap must shrink by this, and an angle by a tenth of a radian, to count as progress."""
BLOCKED_M = 0.6
"""What the range finder sees within this while nothing moves stands in the way."""
BLOCKED_S = 3.0
BLOCK_RADIUS_M = 0.3
DETOURS = 3
LOST_S = 0.8
"""A load that the tray's sensor has not felt for so long has fallen out."""
BODY_BEHIND_M, BODY_RADIUS_M = 0.6, 0.2
"""Where a person stands behind the hand that they hold out."""


class Rest:
    """The motion of the last moments, root mean square: a robot that stands still is shaken now and then."""

    def __init__(self) -> None:
        self._seen: deque[tuple[float, float, float]] = deque()

    def take(self, state: SportState | None, seconds: float) -> None:
        """What was seen over so many seconds; after a time in which nothing was seen it begins anew."""
        if state is None:
            self._seen.clear()
            return
        self._seen.append((seconds, state.speed_mps, state.yaw_speed))
        while self.seconds - self._seen[0][0] >= STILL_S:
            self._seen.popleft()

    @property
    def is_still(self) -> bool:
        speed, turn = self.motion
        return self.seconds >= STILL_S and speed < STILL_MPS and turn < STILL_RPS

    @property
    def motion(self) -> tuple[float, float]:
        """m/s and rad/s, root mean square over what is remembered."""
        seconds = self.seconds or math.inf
        speed, turn = (math.sqrt(sum(s[0] * s[axis] ** 2 for s in self._seen) / seconds) for axis in (1, 2))
        return speed, turn

    @property
    def seconds(self) -> float:
        """For how long the motion was seen without a gap."""
        return sum(seen[0] for seen in self._seen)


class WalkerSkills:
    """Carries out the kind's skills over one robot."""

    def __init__(self, robot: Robot, options: WalkerOptions) -> None:
        self.robot = robot
        self._options = options
        self._config: AdapterConfig = robot.config
        self._load = _Load()

    @staticmethod
    def needs(told: Telemetry) -> dict[str, Sample[object] | None]:
        return {"rt/sportmodestate": told.sport, "rt/lowstate": told.low}  # type: ignore[dict-item]

    async def connect(self) -> None:
        await self.robot.connect(SPORT, lease=self._options.lease)

    # What is known.

    def fluents(self) -> Mapping[str, Reading]:
        """As the kind declares them; what was never heard is absent."""
        told = self.robot.telemetry
        found: dict[str, Reading] = {}
        if (sample := told.sport) is not None:
            state = sample.value
            upright = state.imu_state.tilt_rad < FALLEN_RAD and state.position[2] > UPRIGHT_M
            found["standing"] = Reading(upright, sample.stamp_ns)
            found["moving"] = Reading(state.speed_mps > MOVING_MPS, sample.stamp_ns)
            found["at"] = Reading(Point(*state.spot), sample.stamp_ns)
        if (tray := told.tray) is not None:
            found["tray"] = Reading(tray.value.object or NOTHING, tray.stamp_ns)
        if (battery := told.battery) is not None:
            found["battery"] = Reading(battery.value, battery.stamp_ns)
        return found

    def values(self) -> Mapping[str, ValueReading]:
        return {}

    def unfit(self) -> tuple[str, str]:
        sample = self.robot.telemetry.sport
        if sample is None:
            return "position_lost", "no position was received yet"
        if sample.value.imu_state.tilt_rad > FALLEN_RAD:
            tilt = math.degrees(sample.value.imu_state.tilt_rad)
            x, y = sample.value.spot
            return "fallen", f"it has fallen: tilted by {tilt:.0f} degrees at ({x:.1f}, {y:.1f})"
        if sample.value.error_code and self._config.fitness:
            return "robot_unavailable", f"the robot reports error {sample.value.error_code}"
        return "", ""

    def still_since(self, start_ns: int) -> bool:
        sample = self.robot.telemetry.sport
        if sample is None or sample.stamp_ns <= start_ns:
            return False
        return sample.value.speed_mps < STILL_MPS and abs(sample.value.yaw_speed) < STILL_RPS

    # What it does.

    def send_stop(self) -> None:
        self.robot.writer.stop_by_call(SPORT, STOP_MOVE)

    async def perform(self, args: SkillArgs, places: Mapping[str, Place], run: Run) -> None:
        """Carry out one skill to its observed end."""
        match args:
            case Navigate():
                await self._navigate(run, args.location, places)
            case Stop():
                await self.stop(run)
            case _:
                raise AdapterError(f"a quadruped has no skill with {type(args).__name__}", code="unknown_skill")

    async def stop(self, run: Run) -> None:
        """Stop, again and again until it has stood still for a moment. A robot that has fallen lies still."""
        watched_s, rest = 0.0, Rest()
        while not rest.is_still:
            if watched_s > STOPS_S:
                raise AdapterError(self._moving(rest), code="still_moving")
            self.send_stop()
            before_ns = self.robot.clock.now_ns()
            await run.tick()
            looked_s = min(run.since_s(before_ns), LOOK_S)
            watched_s += looked_s
            sample = self.robot.telemetry.sport
            fresh = sample is not None and run.since_s(sample.stamp_ns) <= FRESH_S
            rest.take(sample.value if sample is not None and fresh else None, looked_s)

    def _moving(self, rest: Rest) -> str:
        """What was seen last, against what counts as still."""
        sample = self.robot.telemetry.sport
        if sample is None:
            return f"{self._config.robot}: no motion state {STOPS_S:g} s after StopMove"
        seen, age_s = sample.value, (self.robot.clock.now_ns() - sample.stamp_ns) / 1e9
        speed, turn = rest.motion
        return (
            f"{self._config.robot}: still moving {STOPS_S:g} s after StopMove: {speed:.2f} m/s and {turn:.2f} rad/s "
            f"in the last {rest.seconds:.2f} s; below {STILL_MPS:g} m/s and {STILL_RPS:g} rad/s for {STILL_S:g} s "
            f"counts as still (seen {age_s:.2f} s ago: {seen.speed_mps:.2f} m/s, {abs(seen.yaw_speed):.2f} rad/s)"
        )

    async def _navigate(self, run: Run, name: str, places: Mapping[str, Place]) -> None:
        place = places.get("location")
        if place is None:
            raise AdapterError(f"{self._config.robot}: the place of {name!r} was not resolved", code="bad_argument")
        self._check_inside(place)
        self._load = _Load(run)
        await self._get_ready(run)
        await self._leave_berth(run)
        berth = self._options.berths.get(name)
        goal = berth.enter_from if berth else (place.x, place.y)
        await self._walk(run, name, goal, 0.0 if berth else place.standoff_m)
        if berth:
            await self._creep(run, self._here(), math.radians(berth.heading_deg))
            await self._creep(run, (place.x, place.y), math.radians(berth.heading_deg))
        await self.stop(run)
        self._load.check(run)
        self._check_person(name, place)
        self._check_arrived(place)

    def _check_inside(self, place: Place) -> None:
        x_min, x_max, y_min, y_max = self._config.area
        if self._config.geofence and not (x_min <= place.x <= x_max and y_min <= place.y <= y_max):
            raise AdapterError(
                f"{self._config.robot}: ({place.x:.1f}, {place.y:.1f}) lies outside the area", code="out_of_bounds"
            )

    async def _get_ready(self, run: Run) -> None:
        """On its feet with unlocked joints: a robot that is neither answers a Move and stands still."""
        if self._state().position[2] < UPRIGHT_M:
            await run.call(SPORT, STAND_UP, {})
            await run.until(lambda: self._state().position[2] > UPRIGHT_M, STANDS_UP_S, "standing up", "not_standing")
        start_ns = self.robot.clock.now_ns()
        while self._state().mode not in (BALANCED, WALKING):
            if run.since_s(start_ns) > STANDS_UP_S:
                raise AdapterError(f"{self._config.robot}: it does not unlock its joints", code="not_standing")
            await run.call(SPORT, BALANCE_STAND, {})
            await self.robot.clock.sleep(ASK_AGAIN_S)

    async def _leave_berth(self, run: Run) -> None:
        for name, berth in self._options.berths.items():
            spot = self._config.locations.get(name)
            if spot is not None and math.dist(self._here(), spot) < BERTHED_M:
                await self._creep(run, berth.enter_from, self._state().yaw_rad)

    async def _walk(self, run: Run, name: str, goal: Spot, standoff_m: float) -> None:
        """Follow a route; what stands in the way unexpectedly is gone around, if there is another way."""
        blocks: list[Disc] = []
        pinned = self._person(name)
        while True:
            route = self._plan(goal, standoff_m, blocks)
            block = await self._follow(run, route, name, pinned)
            if block is None:
                return
            blocks.append(block)
            if len(blocks) > DETOURS:
                raise self._no_progress(route[-1], "after three detours")

    def _plan(self, goal: Spot, standoff_m: float, blocks: list[Disc]) -> list[Spot]:
        options, config = self._options, self._config
        edge_m = options.robot_radius_m
        x_min, x_max, y_min, y_max = config.area
        ground = Ground(
            (x_min + edge_m, x_max - edge_m, y_min + edge_m, y_max - edge_m),
            (*config.obstacles, *self._bodies(), *blocks),
            radius_m=options.robot_radius_m,
            clearance_m=options.clearance_m,
            start=self._here(),
            target=goal,
        )
        return plan_route(ground, self._here(), goal, standoff_m, options.cell_m)

    async def _follow(self, run: Run, route: list[Spot], name: str, pinned: Seen | None) -> Disc | None:
        """Walk a route to its end; None there, or the disc of what was found to block it."""
        gait = _Progress(run)
        for number, spot in enumerate(route):
            last = number == len(route) - 1
            near_m = self._options.arrive_m / 2 if last else PASS_M
            gait.restart()
            while math.dist(self._here(), spot) > near_m:
                left_m = math.dist(self._here(), spot) + (0.0 if last else math.inf)
                self._move(run, along(self._here(), self._state().yaw_rad, spot, self._cruise_mps(), left_m))
                await run.tick()
                self._check_moved_away(name, pinned)
                self._load.check(run)
                gait.note(math.dist(self._here(), spot) + self._turn_left(spot))
                if gait.stuck_s > BLOCKED_S and (block := self._block_ahead(spot)) is not None:
                    return block
                if gait.stuck_s > self._options.stall_s:
                    raise self._no_progress(spot, "Moves are answered, but the robot stands still")
        return None

    async def _creep(self, run: Run, goal: Spot, heading_rad: float) -> None:
        """Sidestep to a spot near by with a held heading."""
        gait = _Progress(run)
        while True:
            gap_m, turn = math.dist(self._here(), goal), abs(wrap_rad(heading_rad - self._state().yaw_rad))
            if gap_m < CLOSE_M and turn < CLOSE_RAD:
                return
            self._move(run, sideways(self._here(), self._state().yaw_rad, goal, heading_rad))
            await run.tick()
            self._load.check(run)
            gait.note(gap_m + turn)
            if gait.stuck_s > self._options.stall_s:
                if gap_m < self._options.arrive_m and turn < 3.0 * CLOSE_RAD:
                    return
                raise self._no_progress(goal, "creeping")

    def _move(self, run: Run, velocity: Velocity) -> None:
        run.send(SPORT, MOVE, dict(zip("xyz", (round(v, 4) for v in velocity), strict=True)))

    def _cruise_mps(self) -> float:
        tray = self.robot.telemetry.tray
        loaded = tray is not None and bool(tray.value.object)
        return self._options.loaded_mps if loaded else self._options.cruise_mps

    def _turn_left(self, spot: Spot) -> float:
        """The turn towards a spot that is still to be made, as metres: a tenth of a radian counts as a centimetre."""
        here, yaw = self._here(), self._state().yaw_rad
        return 0.1 * abs(wrap_rad(math.atan2(spot[1] - here[1], spot[0] - here[0]) - yaw))

    def _block_ahead(self, spot: Spot) -> Disc | None:
        """A disc where the range finder sees something, if that lies on the way."""
        state = self._state()
        range_m = state.range_obstacle[0]
        ahead = abs(wrap_rad(math.atan2(spot[1] - state.position[1], spot[0] - state.position[0]) - state.yaw_rad))
        if range_m > BLOCKED_M or ahead > 0.5:
            return None
        reach_m = 0.32 + range_m + BLOCK_RADIUS_M
        x, y = state.spot
        return x + reach_m * math.cos(state.yaw_rad), y + reach_m * math.sin(state.yaw_rad), BLOCK_RADIUS_M

    # People.

    def _person(self, name: str) -> Seen | None:
        sample = self.robot.telemetry.people.get(name)
        return None if sample is None else sample.value

    def _bodies(self) -> list[Disc]:
        """Where people stand: behind the hand that they hold out."""
        return [
            (p.x - BODY_BEHIND_M * math.cos(p.yaw), p.y - BODY_BEHIND_M * math.sin(p.yaw), BODY_RADIUS_M)
            for p in (sample.value for sample in self.robot.telemetry.people.values())
        ]

    def _check_moved_away(self, name: str, pinned: Seen | None) -> None:
        now = self._person(name)
        if pinned is not None and now is not None and math.dist(pinned.spot, now.spot) > self._options.person_m:
            raise self._gone(name, now)

    def _check_person(self, name: str, place: Place) -> None:
        now = self._person(name)
        if now is not None and math.dist((place.x, place.y), now.spot) > self._options.person_m:
            raise self._gone(name, now)

    def _gone(self, name: str, now: Seen) -> AdapterError:
        return AdapterError(
            f"{self._config.robot}: {name} has walked away to ({now.x:.1f}, {now.y:.1f}) since this walk was decided",
            code="target_moved",
        )

    # Where it is.

    def _state(self) -> SportState:
        sample = self.robot.telemetry.sport
        if sample is None:
            raise AdapterError(f"{self._config.robot}: no position was received yet", code="position_lost")
        return sample.value

    def _here(self) -> Spot:
        return self._state().spot

    def _check_arrived(self, place: Place) -> None:
        away_m = math.dist(self._here(), (place.x, place.y)) - place.standoff_m
        if away_m > 2.0 * self._options.arrive_m:
            raise self._no_progress((place.x, place.y), "after it had stopped")

    def _no_progress(self, spot: Spot, why: str) -> AdapterError:
        (x, y), away_m = self._here(), math.dist(self._here(), spot)
        return AdapterError(
            f"{self._config.robot}: stands at ({x:.2f}, {y:.2f}), still {away_m:.2f} m from "
            f"({spot[0]:.1f}, {spot[1]:.1f}): {why}",
            code="no_progress",
        )


class _Load:
    """What lies in the tray when a walk begins, and whether it stays there. A hop over a doorstep is no loss."""

    def __init__(self, run: Run | None = None) -> None:
        self._carried = "" if run is None else _in_tray(run)
        self._seen_ns = 0 if run is None else run.robot.clock.now_ns()

    def check(self, run: Run) -> None:
        """Raise AdapterError `load_lost`."""
        if _in_tray(run) == self._carried:
            self._seen_ns = run.robot.clock.now_ns()
        elif self._carried and run.since_s(self._seen_ns) > LOST_S:
            raise AdapterError(
                f"{run.robot.config.robot}: {self._carried} is no longer in the tray; it was lost on the way",
                code="load_lost",
            )


def _in_tray(run: Run) -> str:
    tray = run.robot.telemetry.tray
    return "" if tray is None else tray.value.object


class _Progress:
    """For how long nothing has come closer."""

    def __init__(self, run: Run) -> None:
        self._run = run
        self.restart()

    def restart(self) -> None:
        """A new goal: count from here."""
        self._best, self._since_ns = math.inf, self._run.robot.clock.now_ns()

    def note(self, gap: float) -> None:
        if gap < self._best - STEP_M:
            self._best, self._since_ns = gap, self._run.robot.clock.now_ns()

    @property
    def stuck_s(self) -> float:
        return self._run.since_s(self._since_ns)
