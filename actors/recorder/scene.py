"""Draws the world: the ground and what stands on it, the simulation's shapes, robots, trails, goals and fixes."""

from collections.abc import Iterable
from typing import Any

import numpy as np
import rerun as rr

from crew.actors.recorder.blueprint import CAMERA, SCENE, TIMELINE, colours
from crew.actors.recorder.colour import BORDER, FLOOR, OBSTACLE, TONES, faint
from crew.actors.recorder.entry import Area, Mark, Whereabouts
from crew.contracts.plan import Zone
from crew.contracts.site import Rules
from crew.messages import Pose, SimImage, SimScene, SimShape, SimTruth

Place = tuple[float, float, float]
GOAL_M = 0.35
FIX_M = 0.12
NAME_UI = -5.0
"""In the viewer's points, so that a small robot is found in a wide area."""
LABEL_M = 0.9
"""How far above a robot its name stands."""
STEP_M = 0.02
"""A trail grows once its robot has moved so far."""


class Scene:
    """The three-dimensional part of the page. Poses are kept and written many at once."""

    def __init__(self, recording: rr.RecordingStream, rules: Rules) -> None:
        self._recording, self._rules = recording, rules
        self._colours = colours(rules)
        self._poses: dict[str, list[tuple[int, Pose]]] = {}
        self._trails: dict[str, list[tuple[int, Place]]] = {}
        self._tips: dict[str, Place] = {}
        self._written: dict[str, Place] = {}
        self._true = False

    def site(self) -> None:
        """What the crew file says of the place, and a mark for each robot."""
        crew = self._rules.crew
        self._static("ground", _floor(crew.area))
        self._static("border", _outline([crew.area], [BORDER], 0.03))
        if crew.locations:
            self._static(
                "locations",
                rr.Points3D(
                    [(place.x, place.y, 0.05) for place in crew.locations],
                    labels=[place.name for place in crew.locations],
                    radii=0.12,
                    colors=BORDER,
                ),
            )
        if crew.obstacles and crew.sim is None:
            self._static("obstacles", _discs(crew.obstacles))

    def shapes(self, scene: SimScene) -> None:
        """The simulated world's own shapes, one entity for each kind of shape on a body. The truth will be told."""
        self._true = True
        for body, pose in scene.fixed.items():
            self._static(f"body/{body}", _transform(pose))
        grouped: dict[tuple[str, str], list[SimShape]] = {}
        for shape in scene.shapes:
            grouped.setdefault((shape.body, shape.kind), []).append(shape)
        for (body, kind), shapes in grouped.items():
            for path, drawn in _drawn(kind, shapes):
                self._static(f"body/{body}/{path}", *drawn)
        context = [(0, "ground", FLOOR), *_classes(scene)]
        self._recording.log(CAMERA, rr.AnnotationContext(context), static=True)

    def truth(self, truth: SimTruth) -> None:
        """Where everything is."""
        for body, pose in truth.bodies.items():
            self._poses.setdefault(body, []).append((truth.at_ns, pose))
        for robot, (x, y, z, _) in truth.poses.items():
            self._extend(robot, truth.at_ns, (x, y, z))

    def whereabouts(self, at_ns: int, told: Whereabouts) -> None:
        """What a robot believes; it is its place where nobody knows the truth."""
        at = (told.at.x, told.at.y, told.at.z)
        if not self._true:
            self._extend(told.robot, at_ns, at)
        self._recording.log(
            f"{SCENE}/estimate/{told.robot}",
            rr.Points3D([at], radii=0.09, colors=faint(self._colours[told.robot], 160)),
        )

    def mark(self, mark: Mark) -> None:
        """A goal or a fix; a fix is as wide as two standard deviations."""
        path = f"{SCENE}/{mark.name}"
        if mark.at is None:
            self._recording.log(path, rr.Clear(recursive=True))
            return
        x, y, z = mark.at.x, mark.at.y, mark.at.z
        colour = TONES[mark.tone]
        wide = GOAL_M if mark.sigma_m is None else max(FIX_M, min(2 * mark.sigma_m, 50.0))
        self._recording.log(
            path,
            rr.Cylinders3D(
                centers=[(x, y, z + 0.02)], radii=[wide], lengths=[0.04], colors=faint(colour, 110), fill_mode="solid"
            ),
        )
        self._recording.log(f"{path}/pole", rr.LineStrips3D([[(x, y, z), (x, y, z + 1.5)]], colors=colour, radii=0.025))
        self._recording.log(
            f"{path}/label", rr.Points3D([(x, y, z + 1.5)], labels=[mark.label], colors=colour, radii=0.07)
        )

    def area(self, area: Area) -> None:
        """The rectangle that a robot works on."""
        path = f"{SCENE}/zone/{area.name}"
        if area.zone is None:
            self._recording.log(path, rr.Clear(recursive=True))
            return
        colour = self._colours.get(area.name, TONES[area.tone])
        self._recording.log(path, _outline([area.zone], [colour], 0.05, 0.06))

    def image(self, image: SimImage) -> None:
        """What a camera sees."""
        pixels = np.frombuffer(image.pixels, dtype=np.uint8).reshape(image.height, image.width)
        self._recording.log(f"{CAMERA}/{image.robot}", rr.SegmentationImage(pixels))

    def write(self) -> None:
        """Write the poses that were kept."""
        for body, poses in self._poses.items():
            self._send_poses(body, poses)
        for robot, places in self._trails.items():
            self._send_trail(robot, places)
        self._poses.clear()
        self._trails.clear()

    def _extend(self, robot: str, at_ns: int, at: Place) -> None:
        last = self._tips.get(robot)
        if last is None or max(abs(a - b) for a, b in zip(at, last, strict=True)) >= STEP_M:
            self._tips[robot] = at
            self._trails.setdefault(robot, []).append((at_ns, at))

    def _send_poses(self, body: str, poses: list[tuple[int, Pose]]) -> None:
        values = np.array([pose for _, pose in poses], dtype=np.float32)
        self._recording.send_columns(
            f"{SCENE}/body/{body}",
            indexes=[_times(poses)],
            columns=rr.Transform3D.columns(translation=values[:, :3], quaternion=values[:, 3:]),
        )

    def _send_trail(self, robot: str, places: list[tuple[int, Place]]) -> None:
        """One short line for each step: the view shows those up to the cursor."""
        at = np.array([place for _, place in places], dtype=np.float32)
        before = np.vstack([self._written.get(robot, places[0][1]), at[:-1]])
        strips = np.stack([before, at], axis=1)
        self._written[robot] = places[-1][1]
        colour = self._colours.get(robot, BORDER)
        count = len(places)
        self._recording.send_columns(
            f"{SCENE}/trail/{robot}",
            indexes=[_times(places)],
            columns=rr.LineStrips3D.columns(
                strips=list(strips), colors=np.full(count, colour, dtype=np.uint32), radii=[0.035] * count
            ),
        )
        self._recording.send_columns(
            f"{SCENE}/name/{robot}",
            indexes=[_times(places)],
            columns=rr.Points3D.columns(
                positions=at + np.array([0, 0, LABEL_M], dtype=np.float32),
                labels=[robot] * count,
                colors=np.full(count, colour, dtype=np.uint32),
                radii=[NAME_UI] * count,
            ),
        )

    def _static(self, path: str, *drawn: rr.AsComponents) -> None:
        self._recording.log(f"{SCENE}/{path}", *drawn, static=True)


def _times(stamped: Iterable[tuple[int, object]]) -> rr.TimeColumn:
    return rr.TimeColumn(TIMELINE, duration=np.array([at_ns for at_ns, _ in stamped], dtype="timedelta64[ns]"))


def _transform(pose: Pose) -> rr.Transform3D:
    return rr.Transform3D(translation=pose[:3], quaternion=rr.Quaternion(xyzw=pose[3:]))


def _floor(area: Zone) -> rr.Mesh3D:
    corners = [(area.x_min, area.y_min), (area.x_max, area.y_min), (area.x_max, area.y_max), (area.x_min, area.y_max)]
    return rr.Mesh3D(
        vertex_positions=[(x, y, -0.02) for x, y in corners],
        triangle_indices=[(0, 1, 2), (0, 2, 3)],
        vertex_normals=[(0, 0, 1)] * 4,
        vertex_colors=[FLOOR] * 4,
    )


def _outline(zones: Iterable[Zone], colours_: list[int], radius: float, z: float = 0.01) -> rr.LineStrips3D:
    strips = [
        [
            (q.x_min, q.y_min, z),
            (q.x_max, q.y_min, z),
            (q.x_max, q.y_max, z),
            (q.x_min, q.y_max, z),
            (q.x_min, q.y_min, z),
        ]
        for q in zones
    ]
    return rr.LineStrips3D(strips, colors=np.array(colours_, dtype=np.uint32), radii=radius)


def _discs(obstacles: Iterable[tuple[float, float, float]]) -> rr.Cylinders3D:
    found = list(obstacles)
    return rr.Cylinders3D(
        centers=[(x, y, 0.25) for x, y, _ in found],
        radii=[radius for *_, radius in found],
        lengths=[0.5] * len(found),
        colors=OBSTACLE,
        fill_mode="solid",
    )


def _drawn(kind: str, shapes: list[SimShape]) -> Iterable[tuple[str, tuple[rr.AsComponents, ...]]]:
    """Shapes of one kind on one body, as one entity; a mesh is an entity of its own."""
    centers = [shape.pose[:3] for shape in shapes]
    turns = [rr.Quaternion(xyzw=shape.pose[3:]) for shape in shapes]
    colours_ = [_rgba(shape) for shape in shapes]
    half = [shape.half for shape in shapes]
    common: Any = {"quaternions": turns, "colors": colours_, "fill_mode": "solid"}
    match kind:
        case "box":
            yield kind, (rr.Boxes3D(half_sizes=half, centers=centers, **common),)
        case "sphere" | "ellipsoid":
            yield kind, (rr.Ellipsoids3D(half_sizes=half, centers=centers, **common),)
        case "cylinder":
            lengths, radii = [2 * h[2] for h in half], [h[0] for h in half]
            yield kind, (rr.Cylinders3D(lengths=lengths, radii=radii, centers=centers, **common),)
        case "capsule":
            yield kind, (_capsules(shapes, **common),)
        case "mesh":
            for number, shape in enumerate(shapes):
                yield f"mesh{number}", (_mesh(shape), _transform(shape.pose))


def _capsules(shapes: list[SimShape], **common: Any) -> rr.Capsules3D:
    """Rerun's begin at one end, the simulation's lie about their middle."""
    ends = [_turned(shape.pose, (0.0, 0.0, -shape.half[2])) for shape in shapes]
    lengths, radii = [2 * shape.half[2] for shape in shapes], [shape.half[0] for shape in shapes]
    return rr.Capsules3D(lengths=lengths, radii=radii, translations=ends, **common)


def _mesh(shape: SimShape) -> rr.Mesh3D:
    return rr.Mesh3D(
        vertex_positions=np.frombuffer(shape.vertices, dtype="<f4").reshape(-1, 3),
        triangle_indices=np.frombuffer(shape.triangles, dtype="<u4").reshape(-1, 3),
        albedo_factor=_rgba(shape),
    )


def _turned(pose: Pose, offset: Place) -> Place:
    """A point of a body's frame in its parent's."""
    q, v = np.array(pose[3:6]), np.array(offset)
    turned = v + 2 * np.cross(q, np.cross(q, v) + pose[6] * v) + np.array(pose[:3])
    return float(turned[0]), float(turned[1]), float(turned[2])


def _rgba(shape: SimShape) -> tuple[int, int, int, int]:
    red, green, blue, alpha = (round(255 * min(1.0, max(0.0, part))) for part in shape.rgba)
    return red, green, blue, alpha


def _classes(scene: SimScene) -> Iterable[tuple[int, str, tuple[int, int, int, int]]]:
    """Each body's number in an image, its name and the colour of its first shape."""
    first = {shape.body: _rgba(shape) for shape in reversed(scene.shapes)}
    for number, body in enumerate(scene.bodies[:254], start=1):
        yield number, body, first.get(body, FLOOR)
