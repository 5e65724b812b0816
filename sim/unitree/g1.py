"""A simulated G1 whose pelvis is held: joint targets as `rt/arm_sdk` takes them, a gripper, the sport and arm services.

It has no aim of its own: where the hand goes is the client's business, joint by joint.
"""

import math
from collections.abc import Mapping
from typing import Any

from crew.sim.unitree.link import Link
from crew.sim.unitree.rpc import Service, Switchboard, number_of

ARM_MOTORS = {
    12: "waist_yaw",
    13: "waist_roll",
    14: "waist_pitch",
    22: "shoulder_pitch",
    23: "shoulder_roll",
    24: "shoulder_yaw",
    25: "elbow",
    26: "wrist_roll",
    27: "wrist_pitch",
    28: "wrist_yaw",
}
"""The SDK's motor numbers of the joints that this model has."""
MOTORS = 29
WEIGHT = 29
"""`motor_cmd[29].q` of `rt/arm_sdk` is its share of the command, 0 to 1."""
FOLLOW_S = 0.05
"""Targets come at 20 Hz and are followed evenly in between."""
SPEED_MAX_RPS = 3.0
REST = {"shoulder_pitch": 0.3, "shoulder_roll": -0.15, "elbow": 1.4}
OPEN_M = 0.048
FINGER_FORCE_N = 14.0
ZERO_TORQUE, DAMP, START = 0, 1, 500
CHARGE_PERCENT = 88  # it stands at its table and hardly drains
ACTIONS = {"release arm": 99, "right hand up": 23, "high wave": 26, "shake hand": 27}
OCCUPIED, UNKNOWN_ACTION, NOT_STARTED = 7400, 7402, 7404
"""The arm service's own codes: rt/arm_sdk is in use; no such action; not in a state that allows it."""
WAVE = (
    (0.9, {"shoulder_pitch": -1.0, "shoulder_roll": -0.7, "elbow": -0.6, "shoulder_yaw": -0.2}),
    (0.4, {"shoulder_yaw": 0.4}),
    (0.4, {"shoulder_yaw": -0.4}),
    (0.4, {"shoulder_yaw": 0.4}),
    (0.4, {"shoulder_yaw": -0.4}),
)
"""Joint targets of a wave and the seconds to reach each."""


class Joint:
    """One servo: its target now, and where it is led."""

    __slots__ = ("goal", "index", "left", "rate", "target")

    def __init__(self, index: int, target: float) -> None:
        self.index, self.target, self.goal = index, target, target
        self.rate, self.left = 0.0, 0

    def lead(self, goal: float, steps: int, limit: float) -> None:
        """Go to a goal in so many control steps, but no faster than `limit` a step."""
        away = goal - self.target
        steps = max(steps, math.ceil(abs(away) / limit), 1)
        self.goal, self.rate, self.left = goal, away / steps, steps


class G1:
    """One robot of the world. `control` at each control step, `tick` at the telemetry's rate."""

    def __init__(self, model: Any, data: Any, name: str, *, link: Link, step_s: float) -> None:
        self.link = link
        self.unfit = False
        """Its motors are off, which its telemetry shows."""
        self._model, self._data = model, data
        self._step_s = step_s
        self._joints: dict[str, Joint] = {}
        self._places: dict[str, tuple[int, int, int]] = {}
        for joint in (*ARM_MOTORS.values(), "finger_left", "finger_right"):
            self._place(name, joint)
        self._fsm = START
        self._weight = 0.0
        self._now_ns = 0
        self._acting: list[tuple[float, Mapping[str, float]]] = []
        self._action_ends_ns = 0
        self.sport, self.arm = self._sport_service(), self._arm_service()
        self._switchboard = Switchboard([self.sport, self.arm])

    def control(self) -> None:
        """Lead every servo that has not reached its goal one step on."""
        for joint in self._joints.values():
            if joint.left:
                joint.left -= 1
                joint.target = joint.goal if not joint.left else joint.target + joint.rate
                self._data.ctrl[joint.index] = joint.target

    def poll(self, now_ns: int) -> int:
        """Take the messages that wait; how many."""
        self._now_ns = now_ns
        count = 0
        for topic, body in self.link.messages():
            count += 1
            if topic == "rt/arm_sdk":
                self._take_arm(body)
            elif topic == "rt/dex1/right/cmd":
                self._take_hand(body)
            elif (answer := self._switchboard.take(topic, body, now_ns)) is not None:
                self.link.publish(*answer)
        return count

    def tick(self, now_ns: int) -> None:
        """Take messages, go on with an action, tell."""
        self.poll(now_ns)
        self._act()
        self.link.publish("rt/lowstate", self._low_state())
        self.link.publish("rt/dex1/right/state", self._hand_state())
        self.link.publish("rt/lf/bmsstate", {"soc": CHARGE_PERCENT})

    # What clients send.

    def _take_arm(self, body: Mapping[str, Any]) -> None:
        commands = body.get("motor_cmd")
        if not isinstance(commands, dict) or self.unfit or self._fsm in (ZERO_TORQUE, DAMP):
            return
        weight = _number(commands.get(WEIGHT), "q")
        if weight is None or not 0.0 <= weight <= 1.0:
            return
        self._weight = weight
        for motor, joint in ARM_MOTORS.items():
            goal = _number(commands.get(motor), "q")
            if weight > 0.0 and goal is not None:
                self._lead(joint, goal, FOLLOW_S)

    def _take_hand(self, body: Mapping[str, Any]) -> None:
        commands = body.get("cmds")
        goal = _number(commands[0], "q") if isinstance(commands, list) and commands else None
        if goal is None or self.unfit:
            return
        for finger in ("finger_left", "finger_right"):
            self._lead(finger, max(0.0, min(OPEN_M, goal)), FOLLOW_S)

    def _lead(self, joint: str, goal: float, seconds: float) -> None:
        servo = self._joints[joint]
        low, high = self._model.actuator_ctrlrange[servo.index].tolist()
        if low < high:
            goal = max(low, min(high, goal))
        servo.lead(goal, round(seconds / self._step_s), SPEED_MAX_RPS * self._step_s)

    # The services.

    def _sport_service(self) -> Service:
        sport = Service("sport", "1.0.0.0")
        sport.offer(7001, lambda _: (0, {"data": self._fsm}))
        sport.offer(7002, lambda _: (0, {"data": 0}))
        sport.offer(7005, lambda _: (0, {"data": 0.0}))
        sport.offer(7101, self._set_fsm)
        sport.offer(7106, self._set_task)
        return sport

    def _set_fsm(self, parameters: Mapping[str, Any]) -> tuple[int, Any]:
        self._fsm = int(number_of(parameters, "data"))
        return 0, None

    def _set_task(self, parameters: Mapping[str, Any]) -> tuple[int, Any]:
        number_of(parameters, "data")
        return 0, None

    def _arm_service(self) -> Service:
        arm = Service("arm", "1.0.0.14")
        arm.offer(7106, self._execute)
        arm.offer(7107, lambda _: (0, [[{"id": number, "name": name} for name, number in ACTIONS.items()], []]))
        return arm

    def _execute(self, parameters: Mapping[str, Any]) -> tuple[int, Any]:
        action = int(number_of(parameters, "data"))
        if action not in ACTIONS.values():
            return UNKNOWN_ACTION, None
        if self._fsm in (ZERO_TORQUE, DAMP):
            return NOT_STARTED, None
        if self._weight > 0.0:
            return OCCUPIED, None
        self._acting = list(WAVE) if action == ACTIONS["high wave"] else []
        self._acting.append((1.0, {joint: REST.get(joint, 0.0) for joint in ARM_MOTORS.values()}))
        self._action_ends_ns = self._now_ns
        return 0, None

    def _act(self) -> None:
        """The next part of an action, once the last one's time is over; rt/arm_sdk ends it."""
        if self._weight > 0.0:
            self._acting = []
        if not self._acting or self._now_ns < self._action_ends_ns:
            return
        seconds, goals = self._acting.pop(0)
        self._action_ends_ns = self._now_ns + round(seconds * 1e9)
        for joint, goal in goals.items():
            self._lead(joint, goal, seconds)

    # What it tells.

    def _low_state(self) -> dict[str, Any]:
        motors: list[dict[str, Any]] = [{"mode": 0, "q": 0.0, "dq": 0.0, "tau_est": 0.0} for _ in range(MOTORS)]
        for motor, joint in ARM_MOTORS.items():
            motors[motor] = {"mode": 0 if self.unfit else 1, **self._motor(joint)}
        return {
            "mode_pr": 0,
            "mode_machine": 5,
            "tick": self._now_ns // 1_000_000,
            "imu_state": {"rpy": [0.0, 0.0, 0.0]},
            "motor_state": motors,
        }

    def _hand_state(self) -> dict[str, Any]:
        """The two fingers as one motor: opening from the middle, and the force with which they press."""
        left, right = self._motor("finger_left"), self._motor("finger_right")
        return {"states": [{name: (left[name] + right[name]) / 2.0 for name in left}]}

    def _motor(self, joint: str) -> dict[str, Any]:
        index, position, speed = self._places[joint]
        data = self._data
        return {
            "q": float(data.qpos[position]),
            "dq": float(data.qvel[speed]),
            "tau_est": float(data.actuator_force[index]),
        }

    def _place(self, name: str, joint: str) -> None:
        model, full = self._model, f"{name}/{joint}"
        index, number = int(model.actuator(full).id), int(model.joint(full).id)
        position = int(model.jnt_qposadr[number])
        self._places[joint] = (index, position, int(model.jnt_dofadr[number]))
        rest = OPEN_M / 2 if joint.startswith("finger") else REST.get(joint, 0.0)
        self._data.qpos[position] = self._data.ctrl[index] = rest
        self._joints[joint] = Joint(index, rest)


def _number(command: object, field: str) -> float | None:
    """A finite number of a motor's command, or None."""
    value = command.get(field) if isinstance(command, dict) else None
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        return None
    return float(value)
