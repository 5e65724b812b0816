"""What the link survives with a clear word: floods of broken and foreign frames, odd numbers, time going backwards."""

import asyncio
import math
import random
import socket
from typing import Any

import pytest
from pymavlink.dialects.v20 import common as mavlink

from crew.adapter import Permit
from crew.contracts.kinds.quadcopter import FlyTo, Land, SearchTarget, Takeoff
from crew.errors import AdapterError
from tests.integration.adapters.lockstep import lockstep
from tests.integration.adapters.stage import SimulatedStage
from tests.integration.sim.ground import IRIS, Ground

FLOOD = 10_000
"""Frames for each second of mission time."""


def broken_frames(seed: int) -> list[bytes]:
    """Frames of every bad sort: cut short, bytes changed, foreign systems, MAVLink 1, noise, two in one."""
    dice = random.Random(seed)
    encoder: Any = mavlink.MAVLink(None, srcSystem=dice.randint(3, 200), srcComponent=1)
    good = [
        bytes(mavlink.MAVLink_attitude_message(dice.randint(0, 1 << 31), *(0.1,) * 6).pack(encoder)),
        bytes(mavlink.MAVLink_heartbeat_message(2, 12, 128, 0, 4, 3).pack(encoder)),
        bytes(mavlink.MAVLink_command_ack_message(22, 0, 0, 0, 255, 190).pack(encoder)),
    ]
    frames = list(good)
    for frame in good:
        frames.append(frame[: dice.randint(0, len(frame) - 1)])
        changed = bytearray(frame)
        changed[dice.randrange(len(changed))] ^= 1 << dice.randrange(8)
        frames.append(bytes(changed))
    frames += [dice.randbytes(dice.randint(1, 300)), b"\xfe" + dice.randbytes(20), good[0] + good[1][:5], b"\xfd"]
    return frames


async def test_a_flood_of_broken_and_foreign_frames_does_not_end_or_mislead_a_flight() -> None:
    """Half of it comes from the vehicle's own address, half from strangers'."""
    stage = SimulatedStage("quadcopter", "px4")
    stranger = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    try:
        await stage.run(stage.adapter.connect())
        await stage.run(stage.adapter.execute("takeoff", Takeoff(altitude=3), {}))
        flying = asyncio.ensure_future(stage.adapter.execute("fly_to", FlyTo(x=2, y=-2, altitude=3), {}))
        sent, began_ns = 0, stage.clock.now_ns()
        assert stage.relay.adapter is not None
        while not flying.done():
            for frame in broken_frames(sent):
                stage.relay.inject(frame)
                stranger.sendto(frame, stage.relay.adapter)
                stage.relay.forwarded += 1
                sent += 2
            await asyncio.sleep(0)
            if sent >= FLOOD * (stage.clock.now_ns() - began_ns) / 1e9:
                await stage.advance(0.05)
        flying.result()
        iris, counts = stage.world.truth().robots["iris"], stage.adapter._counts
        assert math.dist((iris.x_m, iris.y_m), (2, -2)) < 1.0
        assert sent >= FLOOD * 2
        assert counts.malformed > sent / 6
        assert counts.ignored > sent / 2
        assert stage.adapter.health() == ""
    finally:
        stranger.close()
        await stage.close()


async def test_strangers_who_speak_first_do_not_keep_the_vehicle_out() -> None:
    stage = SimulatedStage("rover", "px4")
    strangers = [socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in range(20)]
    try:
        assert stage.relay.adapter is not None
        connecting = asyncio.ensure_future(stage.adapter.connect())
        await asyncio.sleep(0)
        for number, stranger in enumerate(strangers):
            stranger.sendto(broken_frames(number)[0], stage.relay.adapter)
            stage.relay.forwarded += 1
        await stage.run(connecting)
        assert stage.adapter._vehicle.flavour.title == "PX4 rover"
    finally:
        for stranger in strangers:
            stranger.close()
        await stage.close()


def test_the_vehicle_survives_the_same_and_counts_it() -> None:
    with Ground() as ground:
        before = ground.world.counts()["iris"].dropped
        sent = 0
        while sent < FLOOD:
            for frame in broken_frames(sent):
                ground.send_bytes("iris", frame)
                sent += 1
            ground.world.poll()
        assert ground.world.counts()["iris"].dropped > before + sent / 3
        assert ground.command(IRIS, 400, 1) == 0, "it still takes orders"


async def test_reordered_old_telemetry_is_no_reboot_and_an_old_position_moves_nothing_back() -> None:
    stage = SimulatedStage("quadcopter", "px4")
    try:
        await stage.run(stage.adapter.connect())
        await stage.advance(3.0)
        boot_ms = stage.world.time_ns // 1_000_000
        stage.relay.as_vehicle(mavlink.MAVLink_attitude_message(boot_ms - 400, *(0.0,) * 6), 1)
        await stage.advance(0.1)
        assert stage.adapter.health() == ""
        stage.relay.as_vehicle(mavlink.MAVLink_attitude_message(boot_ms - 2500, *(0.0,) * 6), 1)
        await stage.advance(0.1)
        assert stage.adapter.health() == "vehicle rebooted: reconnect"
    finally:
        await stage.close()


@pytest.mark.parametrize("value", [math.nan, math.inf, -1.0, 1e30])
async def test_a_failsafe_parameter_that_is_out_of_all_range_refuses_the_takeoff(value: float) -> None:
    stage = SimulatedStage("quadcopter", "ardupilot")
    try:
        await stage.run(stage.adapter.connect())
        stage.world._copter.parameters._values["FS_GCS_TIMEOUT"] = value
        with pytest.raises(AdapterError, match=r"FS_GCS_TIMEOUT is .*, allowed is above 0 and at most 60 s") as refused:
            await stage.run(stage.adapter.execute("takeoff", Takeoff(altitude=3), {}))
        assert refused.value.code == "failsafe_off"
        assert not stage.world.truth().robots["iris"].armed
    finally:
        await stage.close()


@pytest.mark.parametrize("zone", [(3.0, 3.0, 3.0, 7.0), (3.0, 3.0, 4.0, 4.0)])
async def test_a_zone_that_is_a_line_or_a_point_is_no_zone(zone: tuple[float, float, float, float]) -> None:
    async with lockstep("iris") as stage:
        await stage.run(stage.iris.execute("takeoff", Takeoff(altitude=3), {}))
        x_min, x_max, y_min, y_max = zone
        args = SearchTarget(x_min=x_min, x_max=x_max, y_min=y_min, y_max=y_max, altitude=3)
        with pytest.raises(
            AdapterError, match=r"search_target: the zone x \[3, 3\], y .* is a line or a point"
        ) as refused:
            await stage.run(stage.iris.execute("search_target", args, {}))
        assert refused.value.code == "bad_argument"


async def test_a_height_above_the_ceiling_is_refused_by_adapter_and_vehicle() -> None:
    async with lockstep("iris") as stage:
        await stage.run(stage.iris.execute("takeoff", Takeoff(altitude=3), {}))
        with pytest.raises(AdapterError, match=r"height 45 m is not within 0 and 10 m") as refused:
            await stage.run(stage.iris.execute("fly_to", FlyTo(x=0, y=0, altitude=45), {}))
        assert refused.value.code == "out_of_bounds"
        flavour = stage.iris._vehicle.flavour
        above = flavour.go_to(stage.iris._vehicle.place(0.0, 0.0, 45.0), 2.0, None)[0]
        with pytest.raises(AdapterError, match="outside geofence"):
            await stage.run(stage.iris._vehicle.commander.send(above, Permit()))
        await stage.run(stage.iris.execute("land", Land(), {}))
