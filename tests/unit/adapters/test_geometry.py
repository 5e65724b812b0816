"""Frame, camera and pose track: conversions that must undo each other."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from crew.adapters.mavlink.camera import body_to_ned, footprint_m, ground_point
from crew.adapters.mavlink.frame import WorldFrame
from crew.adapters.mavlink.track import Pose, PoseTrack

metres = st.floats(-500, 500)
tilt = st.floats(-0.4, 0.4)
heading = st.floats(-math.pi, math.pi)


@given(metres, metres, st.floats(-70, 70), st.floats(-179, 179))
def test_geodesy_round_trip(x: float, y: float, lat: float, lon: float) -> None:
    frame = WorldFrame((lat, lon, 100.0))
    assert frame.to_world(*frame.to_geo(x, y)) == pytest.approx((x, y), abs=1e-6)


def test_north_is_latitude_and_east_is_longitude() -> None:
    lat, lon = WorldFrame((47.0, 8.0, 0.0)).to_geo(10.0, 0.0)
    assert lat == 47.0
    assert lon > 8.0


@given(st.floats(-10, 10), st.floats(-10, 10), st.floats(2, 10), tilt, tilt, heading, tilt, tilt)
def test_back_projection_finds_the_point_that_a_ray_was_cast_to(
    x: float, y: float, height: float, roll: float, pitch: float, yaw: float, forward: float, right: float
) -> None:
    pose = Pose(x, y, height, roll, pitch, yaw)
    point = ground_point(pose, forward, right, 0.3)
    assert point is not None
    towards = (point[1] - y, point[0] - x, height - 0.3)
    seen = body_to_ned((math.tan(forward), math.tan(right), 1.0), roll, pitch, yaw)
    scale = towards[2] / seen[2]
    assert towards == pytest.approx(tuple(c * scale for c in seen), abs=1e-6)


def test_forward_is_north_and_right_is_east_when_heading_north() -> None:
    level = Pose(1.0, 2.0, 5.0, 0.0, 0.0, 0.0)
    assert ground_point(level, math.atan(0.2), 0.0, 0.0) == pytest.approx((1.0, 3.0))
    assert ground_point(level, 0.0, math.atan(0.2), 0.0) == pytest.approx((2.0, 2.0))


def test_nose_up_looks_ahead_and_right_down_looks_left() -> None:
    x, y = ground_point(Pose(0, 0, 5, 0.0, 0.1, 0.0), 0.0, 0.0, 0.0) or (0, 0)
    assert (x, y) == pytest.approx((0.0, 5 * math.tan(0.1)))
    x, y = ground_point(Pose(0, 0, 5, 0.1, 0.0, 0.0), 0.0, 0.0, 0.0) or (0, 0)
    assert (x, y) == pytest.approx((-5 * math.tan(0.1), 0.0))


def test_a_ray_near_the_horizon_or_from_below_the_plane_gives_no_point() -> None:
    assert ground_point(Pose(0, 0, 5, 0, 0, 0), math.radians(80), 0.0, 0.0) is None
    assert ground_point(Pose(0, 0, 0.2, 0, 0, 0), 0.0, 0.0, 0.3) is None


def test_footprint_of_a_right_angle_is_twice_the_height() -> None:
    assert footprint_m(5.0, 90.0) == pytest.approx(10.0)


def test_poses_are_interpolated_in_time_and_over_the_wrap_of_angles() -> None:
    track = PoseTrack()
    for time_s, x, yaw in ((1.0, 0.0, 3.1), (1.1, 1.0, -3.1)):
        track.add_position(time_s, x, 2 * x, 5.0)
        track.add_attitude(time_s, 0.0, 0.0, yaw)
    pose = track.at(1.05)
    assert pose is not None
    assert (pose.x_m, pose.y_m, pose.height_m) == pytest.approx((0.5, 1.0, 5.0))
    assert abs(pose.heading_rad) == pytest.approx(math.pi, abs=1e-6)


def test_a_pose_is_unknown_far_from_every_sample() -> None:
    track = PoseTrack()
    track.add_position(1.0, 0.0, 0.0, 5.0)
    track.add_attitude(1.0, 0.0, 0.0, 0.0)
    assert track.at(1.4) is not None
    assert track.at(1.6) is None
    assert PoseTrack().at(1.0) is None
