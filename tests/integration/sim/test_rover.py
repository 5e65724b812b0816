"""The rover over a real socket: guided driving, holding, and what it refuses or ignores."""

import math

import pytest

from tests.integration.sim.ground import TB3, Ground

ACCEPTED, TEMPORARILY_REJECTED, DENIED, UNSUPPORTED, INT_ONLY = 0, 1, 2, 3, 8
HOLD, GUIDED = 4, 15
GLOBAL_POSITION_INT = 33


def _start(ground: Ground) -> None:
    assert ground.command(TB3, 176, 1, GUIDED) == ACCEPTED
    assert ground.command(TB3, 400, 1) == ACCEPTED


def test_streams_only_heartbeats_until_asked() -> None:
    with Ground() as ground:
        ground.run(3.0)
        assert {message.get_type() for message in ground.messages[TB3]} == {"HEARTBEAT", "OBSTACLE_DISTANCE"}
        heartbeat = ground.last(TB3, "HEARTBEAT")
        assert (heartbeat.type, heartbeat.autopilot, heartbeat.custom_mode) == (10, 3, HOLD)
        assert ground.command(TB3, 511, GLOBAL_POSITION_INT, 100_000) == ACCEPTED
        ground.forget()
        ground.run(2.0)
        assert 20 <= len(ground.all(TB3, "GLOBAL_POSITION_INT")) <= 21
        assert ground.command(TB3, 511, 9999, 100_000) == DENIED


def test_turns_drives_straight_and_stops_at_the_target() -> None:
    with Ground(seed=3) as ground:
        _start(ground)
        ground.command(TB3, 511, GLOBAL_POSITION_INT, 100_000)
        ground.drive(-4.0, 2.0)
        ground.run(3.0)
        assert ground.world.truth().robots["tb3"].speed_mps > 0.4
        ground.run(12.0)
        rover = ground.world.truth().robots["tb3"]
        assert rover.speed_mps < 0.02
        position = ground.last(TB3, "GLOBAL_POSITION_INT")
        assert math.dist(ground.to_world(position.lat, position.lon), (-4.0, 2.0)) < 0.15
        assert math.dist((rover.x_m, rover.y_m), (-4.0, 2.0)) < 0.35
        assert rover.contacts == 0


def test_without_noise_it_stops_within_five_centimetres() -> None:
    with Ground(noise=False) as ground:
        _start(ground)
        for x_m, y_m in ((-5.0, -2.5), (-5.0, 0.0), (-3.0, 0.5)):
            ground.drive(x_m, y_m)
            ground.run(11.0)
            rover = ground.world.truth().robots["tb3"]
            assert (rover.x_m, rover.y_m) == pytest.approx((x_m, y_m), abs=0.06)


def test_hold_stops_within_half_a_metre() -> None:
    with Ground() as ground:
        _start(ground)
        ground.drive(-4.0, 6.0)
        ground.run(5.0)
        before = ground.world.truth().robots["tb3"]
        assert before.speed_mps > 0.5
        assert ground.command(TB3, 176, 1, HOLD) == ACCEPTED
        ground.run(2.0)
        after = ground.world.truth().robots["tb3"]
        assert after.speed_mps < 0.01
        assert math.dist((before.x_m, before.y_m), (after.x_m, after.y_m)) < 0.5
        ground.run(1.0)
        assert ground.mode(TB3) == HOLD


def test_position_target_is_ignored_outside_guided_or_disarmed() -> None:
    with Ground() as ground:
        assert ground.command(TB3, 400, 1) == ACCEPTED
        ground.drive(-4.0, 2.0)
        ground.run(3.0)
        assert ground.world.truth().robots["tb3"].y_m == pytest.approx(-2.5, abs=0.01)
        ground.command(TB3, 400, 0)
        ground.command(TB3, 176, 1, GUIDED)
        ground.drive(-4.0, 2.0)
        ground.run(3.0)
        assert ground.world.truth().robots["tb3"].y_m == pytest.approx(-2.5, abs=0.01)


def test_reposition_changes_the_mode_when_told_to() -> None:
    with Ground(noise=False) as ground:
        ground.command(TB3, 400, 1)
        lat, lon = ground.to_geo(-3.0, -2.5)
        assert ground.command_int(TB3, 192, (-1, 0, 0, 0), lat, lon, 0.0, 6) == TEMPORARILY_REJECTED
        assert ground.command_int(TB3, 192, (0.2, 1, 0, 0), lat, lon, 0.0, 6) == ACCEPTED
        ground.run(2.0)
        assert 0.1 < ground.world.truth().robots["tb3"].speed_mps < 0.25
        assert ground.mode(TB3) == GUIDED
        assert ground.command(TB3, 192, -1, 1, 0, 0, 47.0, 8.0, 0) == INT_ONLY


def test_refusals() -> None:
    with Ground(faults=("tb3_unavailable",)) as ground:
        assert ground.command(TB3, 400, 1) == TEMPORARILY_REJECTED
        assert ground.texts(TB3) == ["PreArm: system fault: vehicle unavailable"]
        assert ground.command(TB3, 512, 1) == ACCEPTED
        assert not ground.last(TB3, "SYS_STATUS").onboard_control_sensors_health & 0x10000000
        ground.world.set_fault("tb3_unavailable", False)
        assert ground.command(TB3, 400, 1) == ACCEPTED
        assert ground.command(TB3, 176, 1, 99) == DENIED
        assert ground.command(TB3, 22) == UNSUPPORTED


def test_an_obstacle_in_the_way_stops_it_physically() -> None:
    with Ground(noise=False) as ground:
        _start(ground)
        ground.drive(-2.0, -2.5)
        ground.run(6.0)
        ground.drive(-2.0, 1.0)
        ground.run(8.0)
        rover = ground.world.truth().robots["tb3"]
        assert rover.y_m < -1.3, "the crate is in the way"
        assert rover.contacts >= 1
