"""The second testbed's figures: its simulation's pace while the quadruped walks, and what an arm's step costs."""

import time
from statistics import median

from crew.adapters.unitree.kinematics import READY, Arm, Joints, between, hand_pose
from crew.sim.apartment.world import Apartment
from crew.sim.config import WorldConfig
from tests.integration.paced import free_port

FORWARD = {"x": 0.4, "y": 0.0, "z": 0.3}
STEPS = 200


def walking_pace(seconds: float) -> float:
    """Simulated seconds for each second of wall time, the quadruped walking in a circle."""
    links = {name: f"udp:127.0.0.1:{free_port()}" for name in ("g1", "go2")}
    with Apartment(WorldConfig(scene="apartment", map="far", links=links)) as apartment:
        began = time.perf_counter()
        for second in range(1, round(seconds) + 1):
            apartment._go2._move(FORWARD)
            apartment.advance(second * 1_000_000_000 - 500_000_000)
            apartment._go2._move(FORWARD)
            apartment.advance(second * 1_000_000_000)
        assert apartment._go2.walking
        return seconds / (time.perf_counter() - began)


def arm_step_ms() -> float:
    """The median of one solver step along a way of the hand."""
    arm, times = Arm(), list[float]()
    joints: Joints = READY
    start, goal = arm.pose(READY), hand_pose((0.08, -0.47, 0.63), -1.4, 0.4)
    for step in range(STEPS):
        pose = between(start, goal, step / STEPS)
        began = time.perf_counter()
        joints = arm.step(joints, pose)
        times.append(time.perf_counter() - began)
    return median(times) * 1e3
