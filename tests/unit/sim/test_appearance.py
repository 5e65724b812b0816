"""What is drawn of a compiled model: the shapes that are seen, not those that only touch."""

import mujoco

from crew.sim.appearance import Appearance

MODEL = """<mujoco><worldbody><body name="b"><freejoint/>
  <geom type="sphere" size="0.1" group="2"/><geom type="box" size="0.1 0.1 0.1" group="3"/>
  <geom type="box" size="0.2 0.2 0.2"/></body><geom type="plane" size="1 1 1"/></worldbody></mujoco>"""


def test_what_only_touches_is_not_drawn() -> None:
    model = mujoco.MjModel.from_xml_string(MODEL)
    shapes = Appearance(model, mujoco.MjData(model)).scene().shapes
    assert [(shape.kind, round(shape.half[0], 3)) for shape in shapes] == [("sphere", 0.1), ("box", 0.2)]
