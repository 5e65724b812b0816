"""A folder in the shape of MuJoCo Menagerie, made of capsules: its names, and its joints in its order, nothing else."""

from pathlib import Path

LEGS = {"FL": (0.1934, 0.0465), "FR": (0.1934, -0.0465), "RL": (-0.1934, 0.0465), "RR": (-0.1934, -0.0465)}
WAIST = (("waist_yaw", "0 0 1"), ("waist_roll", "1 0 0"), ("waist_pitch", "0 1 0"))
ARM = (
    ("shoulder_pitch", "0 1 0", "0 0 0"), ("shoulder_roll", "1 0 0", "0 0 0"), ("shoulder_yaw", "0 0 1", "0 0 0"),
    ("elbow", "0 1 0", "0 0 -0.18"), ("wrist_roll", "1 0 0", "0.1 0 0"), ("wrist_pitch", "0 1 0", "0.04 0 0"),
    ("wrist_yaw", "0 0 1", "0.04 0 0"),
)  # fmt: skip
INERTIAL = '<inertial pos="0 0 0" mass="0.5" diaginertia="0.001 0.001 0.001"/>'
MESH = '<mesh name="right_rubber_hand" vertex="0 0 0 0.05 0 0 0 0.05 0 0 0 0.05"/>'


def make(folder: Path) -> Path:
    """Write both models; the folder."""
    for name, text in (("unitree_go2/go2.xml", quadruped()), ("unitree_g1/g1.xml", humanoid())):
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return folder


def quadruped() -> str:
    """Legs in the order FL, FR, RL, RR; motors in the same."""
    legs = "".join(_leg(name, x, y) for name, (x, y) in LEGS.items())
    motors = "".join(
        f'<motor name="{leg}_{part}" joint="{leg}_{part}_joint" ctrlrange="-{limit} {limit}"/>'
        for leg in LEGS
        for part, limit in (("hip", 23.7), ("thigh", 23.7), ("calf", 45.43))
    )
    return f"""<mujoco><compiler angle="radian"/><option cone="elliptic" impratio="100"/>
    <default><joint damping="2" armature="0.01" frictionloss="0.2"/></default>
    <worldbody><body name="base" pos="0 0 0.445"><freejoint/>
      <inertial pos="0 0 0" mass="6.9" diaginertia="0.03 0.1 0.11"/><geom type="box" size="0.19 0.05 0.05" group="3"/>
      {legs}</body></worldbody><actuator>{motors}</actuator>
    <keyframe><key name="home" qpos="0 0 0.27 1 0 0 0{" 0 0.9 -1.8" * 4}"/></keyframe></mujoco>"""


def _leg(name: str, x: float, y: float) -> str:
    side = 0.0955 if y > 0 else -0.0955
    return f"""<body name="{name}_hip" pos="{x} {y} 0">{INERTIAL}<joint name="{name}_hip_joint" axis="1 0 0"/>
      <body name="{name}_thigh" pos="0 {side} 0">{INERTIAL}<joint name="{name}_thigh_joint" axis="0 1 0"/>
        <body name="{name}_calf" pos="0 0 -0.213">{INERTIAL}<joint name="{name}_calf_joint" axis="0 1 0"/>
          <geom name="{name}" type="sphere" size="0.022" pos="0 0 -0.213" group="3"/></body></body></body>"""


def humanoid() -> str:
    """A pelvis that could fall, one joint for each leg, a waist, two arms with rubber hands."""
    right, left = _arm("right", -0.15), _arm("left", 0.15)
    waist, closing = "", ""
    for joint, axis in WAIST:
        waist += f'<body name="{joint}_link">{INERTIAL}<joint name="{joint}_joint" axis="{axis}" range="-2 2"/>'
        closing += "</body>"
    legs = "".join(
        f'<body name="{side}_leg" pos="0 {y} -0.1">{INERTIAL}'
        f'<joint name="{side}_knee_joint" axis="0 1 0" range="-1 1"/></body>'
        for side, y in (("left", 0.1), ("right", -0.1))
    )
    joints = [f"{joint}_joint" for joint, _ in WAIST]
    joints += [f"{side}_{joint}_joint" for side in ("left", "right") for joint, *_ in ARM]
    joints += ["left_knee_joint", "right_knee_joint"]
    motors = "".join(f'<position name="{joint}" joint="{joint}" kp="500" inheritrange="1"/>' for joint in joints)
    return f"""<mujoco><compiler angle="radian"/><option integrator="implicitfast"/><asset>{MESH}</asset>
    <worldbody><body name="pelvis" pos="0 0 0.793"><freejoint name="floating_base_joint"/>
      <inertial pos="0 0 0" mass="4" diaginertia="0.01 0.01 0.01"/>
      {legs}{waist}{left}{right}{closing}</body></worldbody><actuator>{motors}</actuator></mujoco>"""


def _arm(side: str, y: float) -> str:
    opening, closing = "", ""
    for number, (joint, axis, place) in enumerate(ARM):
        spot = f"0 {y} 0.27" if number == 0 else place
        opening += f'<body name="{side}_{joint}_link" pos="{spot}">{INERTIAL}'
        opening += f'<joint name="{side}_{joint}_joint" axis="{axis}" range="-3 3"/><geom size="0.03" group="3"/>'
        closing += "</body>"
    hand = '<geom type="mesh" mesh="right_rubber_hand"/>' if side == "right" else ""
    return f"{opening}{hand}{closing}"
