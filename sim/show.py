"""What the simulation publishes for those who watch: the scene when asked, and what its cameras see."""

from collections.abc import Mapping

import numpy as np
from msgspec.structs import replace
from numpy.typing import NDArray

from crew.bus.port import Body, Bus, Qos, Sample
from crew.clock import WALL, seconds_ns
from crew.keys import Keys
from crew.messages import Pose, SimImage
from crew.sim.scenes import SceneWorld

FRAME_EVERY_NS = seconds_ns(0.25)
"""Mission time between two frames of a camera."""
FRAME_PAUSE_NS = seconds_ns(0.1)
"""Wall time that is left between two frames, however fast mission time runs: nobody sees more than that."""
MOST_BODIES = 253


class Show:
    """Costs next to nothing while nobody watches: a camera that nobody listens to takes no frame."""

    def __init__(self, bus: Bus, keys: Keys, world: SceneWorld, vehicles: Mapping[str, str]) -> None:
        self._world = world
        self._appearance = world.appearance()
        cameras = world.cameras()
        self._cameras = {robot: cameras[vehicle] for robot, vehicle in vehicles.items() if vehicle in cameras}
        scene = replace(self._appearance.scene(), cameras=tuple(self._cameras))

        async def answer(_: Sample) -> Body:
            return scene

        bus.queryable(keys.sim_scene, answer)
        self._publishers = {robot: bus.publisher(keys.sim_camera(robot), qos=Qos.STATE) for robot in self._cameras}
        self._due_ns = self._due_wall_ns = 0

    def moving(self) -> dict[str, Pose]:
        """Where every body is that can move."""
        return self._appearance.moving()

    def frames(self) -> None:
        """Take a frame with every camera that is watched, if it is time for one."""
        now_ns = self._world.time_ns
        if now_ns < self._due_ns or WALL.now_ns() < self._due_wall_ns:
            return
        for robot, publisher in self._publishers.items():
            if publisher.matching:
                publisher.put(_image(robot, now_ns, self._cameras[robot].image()))
        self._due_ns = now_ns + FRAME_EVERY_NS
        self._due_wall_ns = WALL.now_ns() + FRAME_PAUSE_NS


def _image(robot: str, at_ns: int, bodies: NDArray[np.int32]) -> SimImage:
    pixels = np.where(bodies > MOST_BODIES, MOST_BODIES + 2, bodies + 1).astype(np.uint8)
    height, width = bodies.shape
    return SimImage(robot=robot, at_ns=at_ns, width=width, height=height, pixels=pixels.tobytes())
