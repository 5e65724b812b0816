"""What goes wrong with a vehicle is refused or noticed: failsafes off, link lost, reboot, mode changed, no progress."""

import asyncio
import math

import pytest
from pymavlink.dialects.v20 import common as mavlink

from crew.contracts.kinds.quadcopter import FlyTo, Land, Takeoff
from crew.contracts.kinds.rover import NavigateTo
from crew.errors import AdapterError
from tests.integration.adapters.lockstep import Lockstep, lockstep

UP = Takeoff(altitude=3)
AWAY = FlyTo(x=8, y=8, altitude=3)
DRIVE = NavigateTo(x=-1.0, y=-3.5)


async def fly(stage: Lockstep, skill: str, args: Takeoff | FlyTo | Land) -> None:
    await stage.run(stage.iris.execute(skill, args, {}))


def set_parameter(system: int, name: bytes, value: float, kind: int) -> mavlink.MAVLink_param_set_message:
    return mavlink.MAVLink_param_set_message(system, 1, name, value, kind)


def set_mode(system: int, main: float, sub: float = 0.0) -> mavlink.MAVLink_command_long_message:
    return mavlink.MAVLink_command_long_message(
        system, 1, mavlink.MAV_CMD_DO_SET_MODE, 0, 1.0, main, sub, 0.0, 0.0, 0.0, 0.0
    )


@pytest.mark.parametrize("name", [b"NAV_DLL_ACT", b"COM_LOW_BAT_ACT"])
async def test_a_flight_failsafe_that_is_off_refuses_takeoff(name: bytes) -> None:
    async with lockstep("iris") as stage:
        stage.tell("iris", set_parameter(1, name, 0.0, mavlink.MAV_PARAM_TYPE_INT32))
        await stage.advance(0.2)
        with pytest.raises(AdapterError, match=rf"{name.decode()} is 0, allowed is not 0") as refused:
            await fly(stage, "takeoff", UP)
        assert refused.value.code == "failsafe_off"
        assert not stage.world.truth().robots["iris"].armed


async def test_a_drive_failsafe_that_is_off_refuses_to_move() -> None:
    async with lockstep("tb3") as stage:
        stage.tell("tb3", set_parameter(2, b"FS_GCS_ENABLE", 0.0, mavlink.MAV_PARAM_TYPE_INT32))
        await stage.advance(0.2)
        with pytest.raises(AdapterError, match="FS_GCS_ENABLE is 0"):
            await stage.run(stage.tb3.execute("navigate_to", DRIVE, {}))
        assert not stage.world.truth().robots["tb3"].armed


async def test_a_vehicle_in_a_critical_state_takes_no_skill() -> None:
    async with lockstep("tb3") as stage:
        assert stage.tb3.health() == ""
        stage.world.set_fault("tb3_unavailable", True)
        await stage.advance(1.5)
        assert stage.tb3.health() == "the vehicle reports a critical state"
        with pytest.raises(AdapterError, match="critical") as caught:
            await stage.run(stage.tb3.execute("navigate_to", DRIVE, {}))
        assert caught.value.code == "robot_unavailable"


@pytest.mark.parametrize(
    ("fault", "reason"),
    [("iris_unavailable", "pre-arm check"), ("gps_loss", "position lost"), ("battery_low", "battery at 12 %")],
)
async def test_an_unfit_vehicle_says_why_and_takes_no_skill(fault: str, reason: str) -> None:
    async with lockstep("iris") as stage:
        stage.world.set_fault(fault, True)
        await stage.advance(3.0)
        assert reason in stage.iris.health()
        with pytest.raises(AdapterError, match=reason):
            await fly(stage, "takeoff", UP)


async def test_a_refused_arming_tells_the_vehicles_own_reason() -> None:
    async with lockstep("tb3") as stage:
        stage.world.set_fault("tb3_unavailable", True)
        with pytest.raises(AdapterError, match="MAV_CMD_COMPONENT_ARM_DISARM refused") as refused:
            await stage.run(stage.tb3.execute("navigate_to", DRIVE, {}))
        assert refused.value.code == "refused"
        assert "PreArm: system fault" in refused.value.reason


async def test_a_lost_link_ends_the_skill_and_shows_in_health_until_it_is_back() -> None:
    async with lockstep("iris") as stage:
        await fly(stage, "takeoff", UP)
        flying = stage.iris.execute("fly_to", AWAY, {})
        stage.world.set_fault("link_loss", True)
        start_ns = stage.clock.now_ns()
        with pytest.raises(AdapterError) as failed:
            await stage.run(flying)
        assert failed.value.code in ("link_lost", "position_lost", "no_answer")
        assert stage.clock.now_ns() - start_ns < 4e9
        await stage.advance(2.0)
        assert "link lost: no heartbeat for" in stage.iris.health()
        stage.world.set_fault("link_loss", False)
        await stage.until(lambda: stage.iris.health() == "", 20.0)


async def test_a_reboot_ends_the_skill_and_needs_a_reconnect() -> None:
    async with lockstep("iris") as stage:
        await fly(stage, "takeoff", UP)
        stage.utter("iris", mavlink.MAVLink_attitude_message(10, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0))
        with pytest.raises(AdapterError) as failed:
            await fly(stage, "fly_to", AWAY)
        assert failed.value.code == "rebooted"
        assert stage.iris.health() == "vehicle rebooted: reconnect"
        sent, received = stage.iris.link_counts()
        await stage.run(stage.iris.connect())
        assert stage.iris.health() == ""
        assert stage.iris.link_counts() > (sent, received)


async def test_a_mode_changed_underneath_ends_the_skill_and_is_left_alone() -> None:
    async with lockstep("iris") as stage:
        await fly(stage, "takeoff", UP)
        flying = stage.run(stage.iris.execute("fly_to", AWAY, {}))

        async def pilot() -> None:
            await stage.clock.sleep(2.0)
            stage.tell("iris", set_mode(1, 4, 6))

        helper = asyncio.create_task(pilot())
        with pytest.raises(AdapterError, match=r"mode is AUTO\.LAND, expected AUTO\.LOITER") as failed:
            await flying
        await helper
        assert failed.value.code == "mode_changed"
        await stage.until(lambda: not stage.world.truth().robots["iris"].armed, 30.0)
        assert stage.world.truth().robots["iris"].z_m < 0.2


async def test_a_rover_that_does_not_move_has_no_progress() -> None:
    async with lockstep("tb3", options={"tb3": {"stall_s": 3.0}}) as stage:

        async def saboteur() -> None:
            await stage.clock.sleep(2.0)
            disarm = mavlink.MAV_CMD_COMPONENT_ARM_DISARM
            stage.tell("tb3", mavlink.MAVLink_command_long_message(2, 1, disarm, 0, 0, 0, 0, 0, 0, 0, 0))

        helper = asyncio.create_task(saboteur())
        with pytest.raises(AdapterError, match="no progress for 3 s") as failed:
            await stage.run(stage.tb3.execute("navigate_to", DRIVE, {}))
        await helper
        assert failed.value.code == "no_progress"


async def test_numbers_from_the_vehicle_that_are_none_are_dropped() -> None:
    async with lockstep("iris") as stage:
        nowhere = mavlink.MAVLink_attitude_message(10_000_000, math.nan, 0.0, 0.0, 0.0, 0.0, 0.0)
        dropped = stage.iris._vehicle.telemetry.dropped
        nowhere.time_boot_ms = stage.world.time_ns // 1_000_000
        stage.utter("iris", nowhere)
        await stage.advance(0.1)
        assert stage.iris._vehicle.telemetry.dropped == dropped + 1
        assert stage.iris.health() == ""
