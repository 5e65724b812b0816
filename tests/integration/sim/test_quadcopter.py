"""The quadcopter over a real socket: a flight from discovery to disarming, and what it refuses."""

import math
import statistics

import pytest
from pymavlink.dialects.v20 import common as mavlink

from tests.integration.sim.ground import IRIS, NAN, Ground

ACCEPTED, TEMPORARILY_REJECTED, DENIED, UNSUPPORTED = 0, 1, 2, 3
LOITER, LAND = 4 << 16 | 3 << 24, 4 << 16 | 6 << 24


def test_discovered_healthy_and_at_home() -> None:
    with Ground() as ground:
        ground.run(1.5)
        heartbeat = ground.last(IRIS, "HEARTBEAT")
        assert (heartbeat.type, heartbeat.autopilot, heartbeat.base_mode & 1) == (2, 12, 1)
        status = ground.last(IRIS, "SYS_STATUS")
        assert status.onboard_control_sensors_health == status.onboard_control_sensors_present
        assert status.onboard_control_sensors_health & 0x10000000
        home = ground.last(IRIS, "HOME_POSITION")
        assert ground.to_world(home.latitude, home.longitude) == pytest.approx((-4.0, -4.0), abs=0.02)
        assert home.altitude == 488_000
        assert ground.last(IRIS, "EXTENDED_SYS_STATE").landed_state == 1
        assert ground.last(IRIS, "GPS_RAW_INT").fix_type == 3


def test_streams_have_the_agreed_rates() -> None:
    with Ground() as ground:
        ground.run(0.8)
        ground.forget()
        ground.run(4.0)
        rates = {"HEARTBEAT": 1, "SYS_STATUS": 2, "EXTENDED_SYS_STATE": 5, "HOME_POSITION": 1, "BATTERY_STATUS": 1}
        rates |= {"GLOBAL_POSITION_INT": 20, "LOCAL_POSITION_NED": 10, "ATTITUDE": 20, "GPS_RAW_INT": 1}
        assert {kind: len(ground.all(IRIS, kind)) / 4 for kind in rates} == rates


def test_flight_from_arming_to_disarming() -> None:
    with Ground(seed=2) as ground:
        ground.take_off(5.0)
        assert ground.mode(IRIS) == LOITER
        assert ground.last(IRIS, "EXTENDED_SYS_STATE").landed_state == 2
        assert ground.go(5.0, 5.0, 5.0) == ACCEPTED
        beyond, fastest = [], []
        for _ in range(200):
            ground.run(0.05)
            iris = ground.world.truth().robots["iris"]
            beyond.append((iris.x_m + iris.y_m - 10.0) / math.sqrt(2))
            fastest.append(iris.speed_mps)
        assert max(beyond) < 0.5
        assert 2.7 < max(fastest) < 3.4
        iris = ground.world.truth().robots["iris"]
        assert math.dist((iris.x_m, iris.y_m, iris.z_m), (5.0, 5.0, 5.0)) < 0.5
        assert _fix_error_m(ground) < 0.5
        assert ground.command(IRIS, 176, 1, 4, 3) == ACCEPTED
        assert ground.command(IRIS, 21) == ACCEPTED
        ground.run(1.2)
        assert (ground.mode(IRIS), ground.last(IRIS, "EXTENDED_SYS_STATE").landed_state) == (LAND, 4)
        assert ground.wait(lambda: not ground.armed(IRIS), 20.0)
        assert ground.texts(IRIS) == ["Landing detected", "Disarmed"]
        assert abs(ground.world.truth().robots["iris"].z_m) < 0.02


def _fix_error_m(ground: Ground) -> float:
    """Back-project each LANDING_TARGET through the telemetry nearest to it; the mean's distance to the victim."""
    xs, ys = [], []
    for target in ground.all(IRIS, "LANDING_TARGET"):
        at_ms = target.time_usec // 1000
        attitude = min(ground.all(IRIS, "ATTITUDE"), key=lambda m: abs(m.time_boot_ms - at_ms))
        position = min(ground.all(IRIS, "GLOBAL_POSITION_INT"), key=lambda m: abs(m.time_boot_ms - at_ms))
        x, y = ground.to_world(position.lat, position.lon)
        forward, right, down = _rotate(math.tan(target.angle_x), math.tan(target.angle_y), 1.0, attitude)
        scale = (position.relative_alt / 1000 - 0.25) / down
        xs.append(x + scale * right)
        ys.append(y + scale * forward)
    assert len(xs) > 10
    return math.dist((statistics.fmean(xs), statistics.fmean(ys)), (5.0, 5.0))


def _rotate(x: float, y: float, z: float, attitude: object) -> tuple[float, float, float]:
    """Body FRD to NED."""
    roll, pitch, yaw = (getattr(attitude, name) for name in ("roll", "pitch", "yaw"))
    y, z = y * math.cos(roll) - z * math.sin(roll), y * math.sin(roll) + z * math.cos(roll)
    x, z = x * math.cos(pitch) + z * math.sin(pitch), -x * math.sin(pitch) + z * math.cos(pitch)
    return x * math.cos(yaw) - y * math.sin(yaw), x * math.sin(yaw) + y * math.cos(yaw), z


def test_loiter_again_changes_nothing_and_a_reposition_to_nowhere_brakes() -> None:
    with Ground() as ground:
        ground.take_off(4.0)
        ground.go(8.0, -4.0, 4.0)
        ground.run(2.5)
        moving = ground.world.truth().robots["iris"]
        assert moving.speed_mps > 2.0
        assert ground.command(IRIS, 176, 1, 4, 3) == ACCEPTED
        ground.run(0.5)
        assert ground.world.truth().robots["iris"].speed_mps > 2.0
        assert ground.command(IRIS, 192, -1, 1, 0, NAN, NAN, NAN, NAN) == ACCEPTED
        ground.run(5.0)
        still = ground.world.truth().robots["iris"]
        assert still.speed_mps < 0.4
        assert still.x_m - moving.x_m < 5.0
        assert abs(still.z_m - 4.0) < 0.3


def test_yaw_altitude_and_speed_of_a_reposition_are_kept() -> None:
    with Ground(noise=False) as ground:
        ground.take_off(3.0)
        lat, lon = ground.to_geo(-1.0, -4.0)
        assert ground.command_int(IRIS, 192, (0.8, 1, 0, 0.0), lat, lon, 488.0 + 4.0, 0) == ACCEPTED
        ground.run(2.0)
        assert ground.world.truth().robots["iris"].speed_mps < 1.9
        ground.run(6.0)
        iris = ground.world.truth().robots["iris"]
        assert (iris.x_m, iris.y_m, iris.z_m) == pytest.approx((-1.0, -4.0, 4.0), abs=0.1)
        assert iris.yaw_rad == pytest.approx(math.pi / 2, abs=0.05)  # north


def test_hover_stays_within_the_noise() -> None:
    with Ground(seed=4) as ground:
        ground.take_off(5.0)
        errors = []
        for _ in range(100):
            ground.run(0.2)
            iris = ground.world.truth().robots["iris"]
            errors.append(math.dist((iris.x_m, iris.y_m), (-4.0, -4.0)))
        assert max(errors) < 0.75
        assert statistics.fmean(errors) < 0.4


def test_refused_before_arming_with_a_reason() -> None:
    with Ground() as ground:
        assert ground.command(IRIS, 22, NAN, NAN, NAN, NAN, NAN, NAN, NAN) == TEMPORARILY_REJECTED
        assert ground.texts(IRIS) == ["Takeoff denied: disarmed"]
        assert ground.last(IRIS, "STATUSTEXT").severity <= 4
        kinds = [message.get_type() for message in ground.messages[IRIS]]
        assert kinds.index("COMMAND_ACK") < kinds.index("STATUSTEXT")
        assert ground.go(0.0, 0.0, 5.0) == TEMPORARILY_REJECTED
        assert ground.command(IRIS, 400, 1) == ACCEPTED
        assert ground.go(0.0, 0.0, 5.0) == TEMPORARILY_REJECTED, "landed"


def test_refused_in_the_air() -> None:
    with Ground() as ground:
        ground.take_off(2.0)
        assert ground.command(IRIS, 400, 0) == TEMPORARILY_REJECTED
        assert ground.texts(IRIS) == ["Disarming denied: not landed"]
        lat, lon = ground.to_geo(0.0, 0.0)
        assert ground.command_int(IRIS, 192, (-1, 0, 0, NAN), lat, lon, 5.0, 6) == DENIED, "no mode change flag"
        assert ground.command_int(IRIS, 192, (-1, 1, 0, NAN), lat, lon, 5.0, 1) == DENIED, "a local frame"
        assert ground.command(IRIS, 176, 1, 4, 9) == DENIED
        assert ground.command(IRIS, 176, 0, 4, 3) == DENIED
        assert ground.command(IRIS, 31999) == UNSUPPORTED
        ground.run(1.0)
        assert ground.armed(IRIS)


def test_takeoff_without_an_altitude_uses_the_parameter() -> None:
    with Ground(noise=False) as ground:
        assert ground.command(IRIS, 400, 1) == ACCEPTED
        assert ground.command(IRIS, 22, NAN, NAN, NAN, NAN, NAN, NAN, NAN) == ACCEPTED
        ground.run(6.0)
        assert ground.world.truth().robots["iris"].z_m == pytest.approx(2.5, abs=0.1)


def test_armed_without_a_takeoff_disarms_itself() -> None:
    with Ground() as ground:
        assert ground.command(IRIS, 400, 1) == ACCEPTED
        ground.run(9.0)
        assert ground.armed(IRIS)
        ground.run(2.5)
        assert not ground.armed(IRIS)


def test_return_flies_home_and_lands() -> None:
    with Ground(noise=False) as ground:
        ground.take_off(3.0)
        ground.go(0.0, -4.0, 3.0)
        ground.run(5.0)
        assert ground.command(IRIS, 20) == ACCEPTED
        assert ground.wait(lambda: not ground.world.truth().robots["iris"].armed, 30.0)
        iris = ground.world.truth().robots["iris"]
        assert (iris.x_m, iris.y_m) == pytest.approx((-4.0, -4.0), abs=0.2)


def test_geofence_refuses_a_reposition_beyond_it() -> None:
    with Ground() as ground:
        ground.exchange("iris", mavlink.MAVLink_param_set_message(IRIS, 1, b"GF_MAX_HOR_DIST", 6.0, 9))
        ground.take_off(2.0)
        assert ground.go(1.9, -4.0, 3.0) == ACCEPTED
        assert ground.go(2.1, -4.0, 3.0) == DENIED
        assert ground.texts(IRIS) == ["Reposition denied: outside geofence"]
