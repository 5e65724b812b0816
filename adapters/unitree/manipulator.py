"""The humanoid's skills: joint targets on rt/arm_sdk, found by inverse kinematics; hand commands on their own topic.

A grasp is what the fingers feel, a handover what the arm feels being pulled. World ENU, metres.
"""

import math
from collections.abc import Mapping

import mink

from crew.adapter import Place, Reading
from crew.adapters.unitree.hand import OPEN_M, SHUT_M, felt, hand_command, is_open
from crew.adapters.unitree.kinematics import READY, REST, TUCKED, Arm, Joints, between, distance_m, hand_pose, withdrawn
from crew.adapters.unitree.options import ManipulatorOptions
from crew.adapters.unitree.robot import FALLEN_RAD, POLL_S, Robot
from crew.adapters.unitree.run import Run
from crew.adapters.unitree.sights import Sights
from crew.adapters.unitree.telemetry import Sample, Seen, Telemetry
from crew.contracts.kinds.humanoid import PickHandover, PickHold, PickPlace, Wave
from crew.contracts.skill import NOTHING, SkillArgs
from crew.contracts.snapshot import ValueReading
from crew.errors import AdapterError, nearest

SPORT, ARM = "sport", "arm"
EXECUTE_ACTION, HIGH_WAVE = 7106, 26
ARM_TOPIC, HAND_TOPIC = "rt/arm_sdk", "rt/dex1/right/cmd"
MOTOR_OF = {
    "waist_yaw": 12, "waist_roll": 13, "waist_pitch": 14, "shoulder_pitch": 22, "shoulder_roll": 23,
    "shoulder_yaw": 24, "elbow": 25, "wrist_roll": 26, "wrist_pitch": 27, "wrist_yaw": 28,
}  # fmt: skip
WEIGHT_MOTOR = 29
KP, KD = 60.0, 1.5
MOVING_RPS, STILL_RPS = 0.1, 0.05
SWING_RPS = 0.8
"""Speed of the fastest joint when the arm goes to a posture."""
TILT_RAD = 0.4
IK_STEPS = 2
"""Solver steps for each setpoint."""
REACHED_M = 0.02
SHUT_S, OPEN_S, SETTLE_S, STOPS_S = 1.2, 1.5, 0.4, 3.0
STALE_S = 1.0
"""A thing that was not seen for so long is out of sight."""
DROP_M = 0.012
"""An object is let go of this far above where it shall lie."""
MISSED_M = 0.06
"""An object that is seen so far from the hand is not in it."""
SWAY_M = 0.15
"""A person's hand that has moved this far is not where the object was going."""
OFFER_FROM_M = 0.1
"""An object is brought to a person's hand from so far above it."""
TUG_TICKS = 2
WAVE_STARTS_S, WAVE_ENDS_S, RAISED_RAD = 2.0, 12.0, 0.6


class ManipulatorSkills:
    """Carries out the kind's skills over one robot."""

    def __init__(self, robot: Robot, options: ManipulatorOptions) -> None:
        self.robot = robot
        self._options = options
        self._arm = Arm(robot.config.models)
        self._sights = Sights(robot, options.stands_at, options.reach_m)
        self._aim: Joints | None = None
        """Joint targets as last sent; None while the arm is not commanded here."""
        self._picked = NOTHING
        self._half_m = DROP_M
        """How far the middle of what was picked is above its underside."""
        self._handed = NOTHING
        self._waved = False

    @staticmethod
    def needs(told: Telemetry) -> dict[str, Sample[object] | None]:
        return {"rt/lowstate": told.low, "rt/dex1/right/state": told.hand}  # type: ignore[dict-item]

    async def connect(self) -> None:
        await self.robot.connect(SPORT, lease=False)

    # What is known.

    def fluents(self) -> Mapping[str, Reading]:
        """As the kind declares them; what was never heard is absent."""
        told = self.robot.telemetry
        found: dict[str, Reading] = {}
        if (low := told.low) is not None:
            found["standing"] = Reading(low.value.imu_state.tilt_rad < FALLEN_RAD, low.stamp_ns)
            found["moving"] = Reading(self._fastest_rps() > MOVING_RPS, low.stamp_ns)
            found["handed"] = Reading(self._handed, low.stamp_ns)
            found["waved"] = Reading(self._waved, low.stamp_ns)
        if (hand := told.hand) is not None:
            found["holding"] = Reading(self._held(), hand.stamp_ns)
        if (battery := told.battery) is not None:
            found["battery"] = Reading(battery.value, battery.stamp_ns)
        return found

    def values(self) -> Mapping[str, ValueReading]:
        """Where things and people are, as the side channel shows them."""
        return self._sights.values()

    def unfit(self) -> tuple[str, str]:
        low = self.robot.telemetry.low
        if low is None:
            return "position_lost", "no joint was heard of yet"
        if low.value.imu_state.tilt_rad > FALLEN_RAD:
            return "fallen", "it has fallen"
        if self.robot.config.fitness and any(low.value.motor_state[motor].mode == 0 for motor in MOTOR_OF.values()):
            return "robot_unavailable", "its arm's motors are off"
        return "", ""

    def still_since(self, start_ns: int) -> bool:
        low = self.robot.telemetry.low
        return low is not None and low.stamp_ns > start_ns and self._fastest_rps() < STILL_RPS

    # What it does.

    def send_stop(self) -> None:
        """Lead every joint to where it is; the hand keeps its grip. An arm that is not commanded here is left alone."""
        if self._aim is not None:
            self._aim = self._joints()
            self.robot.writer.stop_by_message(ARM_TOPIC, self._arm_command(self._aim, 1.0))

    async def stop(self, run: Run) -> None:
        """Hold still. Raises AdapterError `still_moving`."""
        start_ns = self.robot.clock.now_ns()
        self.send_stop()
        while True:
            await run.tick()
            if self.still_since(start_ns):
                return
            if run.since_s(start_ns) > STOPS_S:
                raise AdapterError(f"{self._name}: the arm still moves after {STOPS_S:g} s", code="still_moving")

    async def perform(self, args: SkillArgs, places: Mapping[str, Place], run: Run) -> None:
        """Carry out one skill to its observed end."""
        match args:
            case PickHandover():
                await self._hand_over(run, args.object)
            case PickPlace():
                await self._place(run, args.object, args.location)
            case PickHold():
                await self._pick(run, args.object)
                await self._settle(run)
            case Wave():
                await self._wave(run)
            case _:
                raise AdapterError(f"a humanoid has no skill with {type(args).__name__}", code="unknown_skill")

    async def _pick(self, run: Run, name: str) -> None:
        """Take an object from where it lies, and lift it."""
        seen = self._see_object(name)
        self._picked = name
        self._half_m = self._height_above_surface(seen)
        pose = self._around(seen)
        self._require_reach(pose, f"{name} at ({seen.x:.2f}, {seen.y:.2f}, {seen.z:.2f})")
        if self._aim is None:
            await self._swing(run, TUCKED)
        await self._swing(run, READY)
        await self._open(run)
        await self._go(run, withdrawn(pose, self._options.lift_m))
        await self._go(run, self._around(self._see_object(name)))
        await self._shut(run, name)
        await self._go(run, _raised(self._pose(), self._options.lift_m))
        self._require_held(name, "when it was lifted")

    async def _place(self, run: Run, name: str, location: str) -> None:
        self._surface(location)
        await self._pick(run, name)
        goal = self._over(location)
        self._require_reach(goal, location)
        await self._carry(run, name, _raised(goal, self._options.lift_m))
        await self._carry(run, name, self._over(location))
        await self._let_go(run)
        await self._go(run, withdrawn(self._pose(), self._options.lift_m))
        await self._rest(run)

    async def _hand_over(self, run: Run, name: str) -> None:
        self._handed = NOTHING
        person = self._see_person()
        self._require_reach(self._offer_pose(person), f"the hand of {person.name}")
        await self._pick(run, name)
        person = self._require_person(person)
        await self._carry(run, name, _raised(self._offer_pose(person), OFFER_FROM_M), person)
        await self._settle(run)
        unpulled = self._torques()
        await self._carry(run, name, self._offer_pose(person), person)
        await self._feel_tug(run, name, person, unpulled)
        await self._let_go(run)
        self._handed = name
        await self._go(run, withdrawn(self._pose(), self._options.lift_m))
        await self._rest(run)

    async def _wave(self, run: Run) -> None:
        """The robot's own action, watched from its beginning to its end."""
        self._waved = False
        if felt(self.robot.telemetry, self._options.grip_n):
            raise AdapterError(f"{self._name}: it does not wave with {self._held()} in its hand", code="hand_full")
        await self._rest(run)
        before = self._joints()
        await run.call(ARM, EXECUTE_ACTION, {"data": HIGH_WAVE})
        shoulder = self._arm.names.index("shoulder_pitch")

        def raised() -> bool:
            return abs(self._joints()[shoulder] - before[shoulder]) > RAISED_RAD

        await run.until(raised, WAVE_STARTS_S, "a raised arm", "no_progress")
        await run.until(
            lambda: not raised() and self._fastest_rps() < STILL_RPS, WAVE_ENDS_S, "the wave's end", "no_progress"
        )
        self._waved = True

    # Parts of them.

    async def _carry(self, run: Run, name: str, goal: mink.SE3, person: Seen | None = None) -> None:
        """Go to a pose with an object in the hand, minding that it stays there, and whom it is for."""
        await self._go(run, goal, name, person)
        self._require_held(name, "on the way")

    async def _feel_tug(self, run: Run, name: str, person: Seen, unpulled: list[float]) -> None:
        """Hold out, until the arm's torques say that somebody pulls."""
        start_ns, pulled = self.robot.clock.now_ns(), 0
        while pulled < TUG_TICKS:
            await run.tick()
            pulled = pulled + 1 if math.dist(unpulled, self._torques()) > self._options.tug_nm else 0
            if pulled:
                continue
            self._require_held(name, "while it was held out")
            self._require_person(person)
            if run.since_s(start_ns) > self._options.offer_s:
                raise AdapterError(
                    f"{self._name}: nobody took {name} within {self._options.offer_s:g} s; it is still in the hand",
                    code="not_taken",
                )

    async def _open(self, run: Run) -> None:
        run.publish(HAND_TOPIC, hand_command(OPEN_M))
        await run.until(lambda: is_open(self.robot.telemetry), OPEN_S, "an open hand", "hand_stuck")

    async def _let_go(self, run: Run) -> None:
        await self._open(run)
        self._picked = NOTHING
        await self._settle(run)

    async def _shut(self, run: Run, name: str) -> None:
        run.publish(HAND_TOPIC, hand_command(SHUT_M))
        start_ns = self.robot.clock.now_ns()
        while run.since_s(start_ns) < SHUT_S:
            await run.tick()
        self._require_held(name, "when the hand had closed")

    async def _settle(self, run: Run) -> None:
        """Wait for the arm to come to rest."""
        start_ns = self.robot.clock.now_ns()
        while run.since_s(start_ns) < SETTLE_S or not self.still_since(start_ns):
            await run.tick()
            if run.since_s(start_ns) > STOPS_S:
                raise AdapterError(f"{self._name}: the arm does not come to rest", code="still_moving")

    async def _rest(self, run: Run) -> None:
        """Arm to the side, and give the joints back to the robot."""
        if self._aim is None:
            return
        for posture in (READY, TUCKED, REST):
            await self._swing(run, posture)
        await self._settle(run)
        run.publish(ARM_TOPIC, self._arm_command(self._aim, 0.0))
        self._aim = None

    async def _swing(self, run: Run, posture: Joints) -> None:
        """All joints to a posture at an even pace."""
        start = self._aim or self._joints()
        ticks = max(1, math.ceil(max(abs(a - b) for a, b in zip(start, posture, strict=True)) / (SWING_RPS * POLL_S)))
        for tick in range(1, ticks + 1):
            self._send(run, tuple(a + (b - a) * tick / ticks for a, b in zip(start, posture, strict=True)))
            await run.tick()

    async def _go(self, run: Run, goal: mink.SE3, held: str = "", person: Seen | None = None) -> None:
        """The hand along a straight way to a pose, then corrected by what the joints say it really reached."""
        start = self._pose()
        ticks = max(1, math.ceil(distance_m(start, goal) / (self._options.hand_mps * POLL_S)))
        for tick in range(1, ticks + 1):
            share = tick / ticks
            await self._setpoint(run, between(start, goal, share * share * (3.0 - 2.0 * share)))
            if held:
                self._require_held(held, "on the way")
            if person is not None:
                self._require_person(person)
        await self._correct(run, goal)

    async def _correct(self, run: Run, goal: mink.SE3) -> None:
        """Servos sag under a load: shift the aim by what is missing, a few times."""
        aim = goal
        for _ in range(8):
            await self._setpoint(run, aim)
            missing = goal.translation() - self._arm.pose(self._joints()).translation()
            if math.hypot(*missing.tolist()) < 0.003:
                return
            aim = mink.SE3.from_rotation_and_translation(aim.rotation(), aim.translation() + 0.4 * missing)

    async def _setpoint(self, run: Run, pose: mink.SE3) -> None:
        joints = self._aim or self._joints()
        for _ in range(IK_STEPS):
            joints = self._arm.step(joints, pose)
        self._send(run, joints)
        await run.tick()

    def _send(self, run: Run, joints: Joints) -> None:
        run.publish(ARM_TOPIC, self._arm_command(joints, 1.0))
        self._aim = joints

    def _arm_command(self, joints: Joints, weight: float) -> dict[str, object]:
        motors: dict[int, dict[str, float]] = {
            MOTOR_OF[name]: {"q": q, "dq": 0.0, "tau": 0.0, "kp": KP, "kd": KD}
            for name, q in zip(self._arm.names, joints, strict=True)
        }
        motors[WEIGHT_MOTOR] = {"q": weight, "dq": 0.0, "tau": 0.0, "kp": 0.0, "kd": 0.0}
        return {"mode_pr": 0, "mode_machine": 0, "motor_cmd": motors}

    # What is where.

    def _see_object(self, name: str) -> Seen:
        told = self.robot.telemetry
        sample = told.objects.get(name)
        if sample is None or told.age_s(sample) > STALE_S:
            known = [other for other, s in told.objects.items() if told.age_s(s) <= STALE_S]
            raise AdapterError(
                f"{self._name}: {name} is not in sight; seen now: {', '.join(sorted(known)) or 'nothing'}",
                code="object_not_seen",
            )
        return sample.value

    def _see_person(self) -> Seen:
        near = self._sights.nearest_person()
        if near is None:
            raise AdapterError(f"{self._name}: nobody holds out a hand within reach", code="nobody_near")
        return near

    def _require_person(self, before: Seen) -> Seen:
        """The person as seen now, who must not have gone away."""
        now = self.robot.telemetry.people.get(before.name)
        if now is None or math.dist(before.spot, now.value.spot) > SWAY_M:
            raise AdapterError(
                f"{self._name}: {before.name} has walked away while the object was handed over; it stays in the hand",
                code="target_moved",
            )
        return now.value

    def _require_held(self, name: str, when: str) -> None:
        """The fingers feel it, and it is not seen anywhere else."""
        told = self.robot.telemetry
        sample = told.objects.get(name)
        grip = self._sights.to_world(self._arm.pose(self._joints()))
        astray = ""
        if sample is not None and told.age_s(sample) <= STALE_S:
            seen = sample.value
            if math.dist((seen.x, seen.y, seen.z), grip) > MISSED_M:
                astray = f"; it is seen at ({seen.x:.2f}, {seen.y:.2f}, {seen.z:.2f})"
        if not felt(told, self._options.grip_n) or astray:
            raise AdapterError(f"{self._name}: {name} was not in the hand {when}{astray}", code="grasp_failed")

    def _require_reach(self, goal: mink.SE3, what: str) -> None:
        short_m = self._arm.shortfall_m(READY, goal)
        if short_m > REACHED_M:
            raise AdapterError(f"{self._name}: {what} is out of reach by {short_m:.2f} m", code="out_of_reach")

    def _surface(self, location: str) -> tuple[float, float, float]:
        """Where something can be put at a place: on a part of a robot that is in sight, or on a known surface."""
        told = self.robot.telemetry
        part = told.places.get(location)
        if part is not None and told.age_s(part) <= STALE_S:
            return part.value.x, part.value.y, part.value.z
        spot, height_m = self.robot.config.locations.get(location), self._options.surfaces.get(location)
        if spot is None or height_m is None:
            known = sorted((*self._options.surfaces, *told.places))
            raise AdapterError(
                f"{self._name}: {location} is not in sight and has no known surface{nearest(location, known)}",
                code="place_not_seen",
            )
        return spot[0], spot[1], height_m

    def _height_above_surface(self, seen: Seen) -> float:
        """How high an object's middle is above what it lies on: the nearest surface below it."""
        below = [height_m for height_m in self._options.surfaces.values() if height_m < seen.z]
        return seen.z - max(below) if below else DROP_M

    # Poses in the robot's frame.

    def _around(self, seen: Seen) -> mink.SE3:
        """The hand around an object's middle, turned so that the fingers meet its faces."""
        x, y, z = self._sights.to_base(seen.x, seen.y, seen.z)
        face = seen.yaw - self._sights.heading_rad
        quarters = round((math.atan2(y, x) - face) / (math.pi / 2))
        return hand_pose((x, y, z), face + quarters * math.pi / 2, TILT_RAD)

    def _offer_pose(self, person: Seen) -> mink.SE3:
        x, y, z = self._sights.to_base(person.x, person.y, person.z)
        return hand_pose((x, y, z), math.atan2(y, x), TILT_RAD)

    def _over(self, location: str) -> mink.SE3:
        """The hand where it lets go of what it holds, a little above a place."""
        x, y, z = self._surface(location)
        bx, by, _ = self._sights.to_base(x, y, z)
        return hand_pose((bx, by, z + self._half_m + DROP_M), math.atan2(by, bx), TILT_RAD)

    def _pose(self) -> mink.SE3:
        """Where the hand is led to now."""
        return self._arm.pose(self._aim or self._joints())

    # What the joints say.

    @property
    def _name(self) -> str:
        return self.robot.config.robot

    def _joints(self) -> Joints:
        return tuple(self._motors("q"))

    def _torques(self) -> list[float]:
        return self._motors("tau_est")

    def _motors(self, what: str) -> list[float]:
        low = self.robot.telemetry.low
        if low is None:
            raise AdapterError(f"{self._name}: no joint was heard of yet", code="position_lost")
        return [float(getattr(low.value.motor_state[MOTOR_OF[name]], what)) for name in self._arm.names]

    def _fastest_rps(self) -> float:
        return max(map(abs, self._motors("dq")))

    def _held(self) -> str:
        """What is in the hand: the object that is seen there, or else the one that was picked."""
        if not felt(self.robot.telemetry, self._options.grip_n):
            return NOTHING
        grip = self._sights.to_world(self._arm.pose(self._joints()))
        seen = self._sights.object_at(grip, MISSED_M)
        return seen or (self._picked if self._picked != NOTHING else "unknown")


def _raised(pose: mink.SE3, height_m: float) -> mink.SE3:
    """The same hand, straight above."""
    point = pose.translation().copy()
    point[2] += height_m
    return mink.SE3.from_rotation_and_translation(pose.rotation(), point)
