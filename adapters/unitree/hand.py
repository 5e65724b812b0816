"""What the gripper feels, and what it is told: openings in metres from its middle, forces in newtons. Pure."""

from crew.adapters.unitree.telemetry import Telemetry

OPEN_M, SHUT_M = 0.046, 0.0
NOTHING_M = 0.006
"""A hand that closes this far has nothing between its fingers."""


def felt(told: Telemetry, grip_n: float) -> bool:
    """Whether the fingers press on something between them."""
    sample = told.hand
    if sample is None:
        return False
    motor = sample.value.states[0]
    return motor.q > NOTHING_M and motor.tau_est < -grip_n


def is_open(told: Telemetry) -> bool:
    """Whether the hand has opened."""
    return told.hand is not None and told.hand.value.states[0].q > 0.9 * OPEN_M


def hand_command(opening_m: float) -> dict[str, object]:
    """`rt/dex1/right/cmd`: one motor, led to an opening."""
    return {"cmds": [{"mode": 1, "q": opening_m, "dq": 0.0, "tau": 0.0, "kp": 5.0, "kd": 0.05}]}
