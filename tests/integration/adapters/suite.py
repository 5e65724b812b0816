"""The suite that every adapter of a vehicle passes, whatever autopilot is behind it. A flavour is a subclass.

It runs on a simulated vehicle, and on a real autopilot when CREW_SITL names one.
"""

import asyncio
import contextlib
import math
from collections.abc import AsyncIterator
from typing import Any, ClassVar

import pytest
from pymavlink.dialects.v20 import common as mavlink

from crew.adapter import Permit
from crew.adapters.mavlink.command import Command
from crew.contracts.kinds.quadcopter import FlyTo, Land, Takeoff
from crew.contracts.kinds.rover import NavigateTo, Stop
from crew.contracts.snapshot import Point
from crew.errors import AdapterError, Latched
from tests.integration.adapters.stage import SITL, RealStage, SimulatedStage, Stage

STRANGER = 9


def set_mode(main: float, sub: float = 0.0) -> Any:
    """What a pilot's switch or another station's button does."""
    return mavlink.MAVLink_command_long_message(0, 1, mavlink.MAV_CMD_DO_SET_MODE, 0, 1.0, main, sub, 0, 0, 0, 0)


class AdapterSuite:
    """kind and autopilot say who is tested; taken_mode what a pilot changes to, and what that mode is called."""

    kind: ClassVar[str]
    autopilot: ClassVar[str]
    taken: ClassVar[Any]
    taken_mode: ClassVar[str]
    stop_mode: ClassVar[str]

    @contextlib.asynccontextmanager
    async def stage(self, **options: Any) -> AsyncIterator[Stage]:
        """The vehicle, found and fit."""
        stage: Stage = RealStage(self.kind, **options) if SITL else SimulatedStage(self.kind, self.autopilot, **options)
        try:
            await stage.run(stage.adapter.connect())
            await stage.until(lambda: stage.adapter.health() == "", 90.0)
            yield stage
        finally:
            await stage.close()

    # What differs between kinds of vehicle.

    async def get_ready(self, stage: Stage) -> None:
        """Whatever comes before it can travel."""
        raise NotImplementedError

    def travel(self, stage: Stage, far: bool = True) -> Any:
        """The coroutine of a skill that takes it somewhere."""
        raise NotImplementedError

    async def settle(self, stage: Stage) -> None:
        """Make it safe, at the end of a test."""
        raise NotImplementedError

    def place(self, stage: Stage) -> Point:
        at = stage.adapter.fluents()["at"].value
        assert isinstance(at, Point)
        return at

    def speed_mps(self, stage: Stage) -> float:
        motion = stage.adapter._vehicle.telemetry.motion
        assert motion is not None
        return motion.value.speed_mps

    async def under_way(self, stage: Stage) -> "asyncio.Task[None]":
        """A skill that is well on its way."""
        await self.get_ready(stage)
        task: asyncio.Task[None] = asyncio.ensure_future(self.travel(stage))
        await stage.until(lambda: task.done() or self.speed_mps(stage) > 0.3)
        assert not task.done(), task.exception()
        return task

    # The suite.

    async def test_it_is_found_and_tells_what_its_kind_declares(self) -> None:
        async with self.stage() as stage:
            told = stage.adapter.fluents()
            assert {"at", "moving", "battery"} <= set(told)
            assert told["moving"].value is False
            assert stage.adapter._vehicle.flavour.kind == self.kind

    async def test_it_goes_where_it_is_sent_and_stops_there(self) -> None:
        async with self.stage() as stage:
            await self.get_ready(stage)
            await stage.run(self.travel(stage, far=False))
            near = self.place(stage)
            assert math.dist((near.x, near.y), NEAR) < 0.9
            assert self.speed_mps(stage) < 0.4
            await self.settle(stage)

    async def test_a_refusal_names_the_command_and_its_result(self) -> None:
        async with self.stage() as stage:
            nonsense = Command(id=mavlink.MAV_CMD_DO_SET_MODE, params=(1.0, 99.0, 99.0))
            with pytest.raises(AdapterError, match=r"MAV_CMD_DO_SET_MODE refused: MAV_RESULT_\w+") as refused:
                await stage.run(stage.adapter._vehicle.commander.send(nonsense, Permit()))
            assert refused.value.code == "refused"

    async def test_a_lost_link_ends_the_skill_and_a_link_that_is_back_is_noticed(self) -> None:
        async with self.stage() as stage:
            task = await self.under_way(stage)
            stage.relay.cut = True
            await stage.until(task.done, 10.0)
            error = task.exception()
            assert isinstance(error, AdapterError)
            assert error.code in ("link_lost", "position_lost", "no_answer")
            await stage.advance(8.0)
            assert "link lost" in stage.adapter.health()
            stage.relay.cut = False
            await stage.until(lambda: "link lost" not in stage.adapter.health(), 10.0)
            await self.settle(stage)

    async def test_a_reboot_ends_the_skill_and_a_reconnect_finds_it_again(self) -> None:
        async with self.stage() as stage:
            await stage.advance(3.0)
            task = await self.under_way(stage)
            stage.relay.boot_offset_ms = 3000
            await stage.until(task.done, 10.0)
            error = task.exception()
            assert isinstance(error, AdapterError)
            assert error.code == "rebooted"
            assert stage.adapter.health() == "vehicle rebooted: reconnect"
            await stage.run(stage.adapter.connect())
            assert "rebooted" not in stage.adapter.health()
            await self.settle(stage)

    async def test_a_pilot_who_takes_over_keeps_control(self) -> None:
        async with self.stage() as stage:
            task = await self.under_way(stage)
            stage.relay.as_station(self.taken)
            await stage.until(task.done, 10.0)
            error = task.exception()
            assert isinstance(error, AdapterError)
            assert error.code == "mode_changed", str(error)
            stage.relay.sent_by_adapter.clear()
            assert "somebody else has control" in stage.adapter.health()
            with pytest.raises(AdapterError) as refused:
                await stage.run(self.travel(stage))
            assert refused.value.code in ("robot_unavailable", "precondition_failed")
            await stage.run(stage.adapter.safe("hover" if self.kind == "quadcopter" else "stop"))
            await stage.advance(2.0)
            assert stage.relay.commands() == [], "nothing is commanded while a pilot has it"
            assert stage.adapter._vehicle.mode() == self.taken_mode
            stage.adapter.release()
            assert "somebody else" not in stage.adapter.health()
            await self.settle(stage)

    async def test_another_station_that_sends_it_elsewhere_is_noticed_and_left_alone(self) -> None:
        async with self.stage() as stage:
            task = await self.under_way(stage)
            stage.relay.as_station(self.elsewhere(stage))
            await stage.until(task.done, 10.0)
            error = task.exception()
            assert isinstance(error, AdapterError)
            assert error.code == "commanded_by_other"
            stage.relay.sent_by_adapter.clear()
            await stage.advance(1.0)
            assert stage.relay.commands() == []
            stage.adapter.release()
            await self.settle(stage)

    def elsewhere(self, stage: Stage) -> Any:
        """A reposition to where nobody of ours sent it."""
        lat_deg, lon_deg = stage.adapter._vehicle.frame.to_geo(*ELSEWHERE)
        lat, lon = round(lat_deg * 1e7), round(lon_deg * 1e7)
        return mavlink.MAVLink_command_int_message(0, 1, 6, 192, 0, 0, -1.0, 1.0, 0.0, math.nan, lat, lon, 3.0)

    async def test_late_answers_doubled_and_reordered_datagrams_change_nothing(self) -> None:
        async with self.stage() as stage:
            stage.relay.doubling = stage.relay.reordering = True
            stage.relay.ack_delay_s = 1.3
            await self.get_ready(stage)
            await stage.run(self.travel(stage, far=False))
            near = self.place(stage)
            assert math.dist((near.x, near.y), NEAR) < 0.9
            await self.settle(stage)

    async def test_another_system_on_the_same_link_is_not_heard(self) -> None:
        async with self.stage() as stage:
            before, ignored = self.place(stage), stage.adapter._counts.ignored
            for _ in range(5):
                beat = mavlink.MAVLink_heartbeat_message(1, 12, 128, 0, 6, 3)
                nowhere = mavlink.MAVLink_global_position_int_message(1, 1, 1, 0, 99000, 0, 0, 0, 0)
                stage.relay.as_vehicle(beat, STRANGER)
                stage.relay.as_vehicle(nowhere, STRANGER)
            await stage.advance(0.5)
            assert stage.adapter._counts.ignored >= ignored + 10
            assert math.dist((self.place(stage).x, self.place(stage).y), (before.x, before.y)) < 0.8
            assert stage.adapter.health() == ""

    async def test_it_can_be_cancelled_at_any_moment(self) -> None:
        async with self.stage() as stage:
            await self.get_ready(stage)
            for moment_s in (0.0, 0.05, 0.4, 1.1, 2.3):
                task = asyncio.ensure_future(self.travel(stage))
                await stage.advance(moment_s)
                await stage.run(stage.adapter.cancel())
                await stage.until(task.done, 5.0)
                error = task.exception()
                assert isinstance(error, AdapterError), f"after {moment_s} s"
                assert error.code == "cancelled"
                assert self.speed_mps(stage) < 0.4
            await self.settle(stage)

    async def test_it_can_be_stopped_at_any_moment_and_stays_stopped(self) -> None:
        async with self.stage() as stage:
            await self.get_ready(stage)
            for moment_s in (0.05, 0.7, 2.0):
                task = asyncio.ensure_future(self.travel(stage))
                await stage.advance(moment_s)
                stage.adapter.halt()
                await stage.until(task.done, 5.0)
                assert isinstance(task.exception(), Latched), f"after {moment_s} s"
                await stage.until(lambda: self.speed_mps(stage) < 0.3, 10.0)
                with pytest.raises(Latched):
                    await self.travel(stage)
                stage.adapter.release()
            await stage.until(lambda: stage.adapter._vehicle.mode() == self.stop_mode, 3.0)
            await self.settle(stage)


NEAR = (-2.5, -4.2)
FAR = (0.5, -4.6)
ELSEWHERE = (-5.0, 3.0)


class QuadcopterSuite(AdapterSuite):
    """A vehicle that flies."""

    kind = "quadcopter"

    async def get_ready(self, stage: Stage) -> None:
        await stage.run(stage.adapter.execute("takeoff", Takeoff(altitude=3), {}))

    def travel(self, stage: Stage, far: bool = True) -> Any:
        x, y = (9.0, 8.0) if far else NEAR
        return stage.adapter.execute("fly_to", FlyTo(x=x, y=y, altitude=3), {})

    async def settle(self, stage: Stage) -> None:
        await stage.run(stage.adapter.execute("land", Land(), {}), 90.0)
        assert stage.adapter.fluents()["airborne"].value is False

    async def test_it_lands_at_any_moment(self) -> None:
        async with self.stage() as stage:
            for moment_s in (0.3, 2.5):
                await self.get_ready(stage)
                task = asyncio.ensure_future(self.travel(stage))
                await stage.advance(moment_s)
                await stage.run(stage.adapter.safe("land"), 90.0)
                assert task.done()
                assert stage.adapter.fluents()["airborne"].value is False

    async def test_a_home_that_jumps_in_flight_ends_the_skill_and_it_still_lands(self) -> None:
        async with self.stage() as stage:
            task = await self.under_way(stage)
            home = stage.adapter._vehicle.telemetry.home
            assert home is not None
            lat, lon = stage.adapter._vehicle.frame.to_geo(home.value.x_m, home.value.y_m)
            jumped = mavlink.MAVLink_home_position_message(
                round(lat * 1e7),
                round(lon * 1e7),
                round((home.value.amsl_m + 40) * 1000),
                0,
                0,
                0,
                (1, 0, 0, 0),
                0,
                0,
                0,
            )
            stage.relay.as_vehicle(jumped, stage.adapter._vehicle._found.get_srcSystem())
            await stage.until(task.done, 5.0)
            error = task.exception()
            assert isinstance(error, AdapterError)
            assert error.code == "home_jumped"
            assert "home jumped by 40.0 m in flight" in stage.adapter.health()
            await self.settle(stage)


class RoverSuite(AdapterSuite):
    """A vehicle that drives."""

    kind = "rover"

    async def get_ready(self, stage: Stage) -> None:
        pass

    def travel(self, stage: Stage, far: bool = True) -> Any:
        x, y = FAR if far else NEAR
        return stage.adapter.execute("navigate_to", NavigateTo(x=x, y=y), {})

    async def settle(self, stage: Stage) -> None:
        await stage.run(stage.adapter.execute("stop", Stop(), {}))
        assert stage.adapter.fluents()["moving"].value is False
