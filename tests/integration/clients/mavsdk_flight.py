"""A flight by MAVSDK, which nobody here wrote: `python -m ... KIND AUTOPILOT PORT`. Prints one JSON object.

A process of its own: the library has been seen to abort when a link is lost.
"""

import asyncio
import json
import sys
from collections.abc import AsyncIterator, Callable
from typing import Any, TypeVar

from mavsdk.asyncio import ComponentType, Configuration, Mavsdk
from mavsdk.asyncio.plugins.action import ActionAsync
from mavsdk.asyncio.plugins.telemetry import TelemetryAsync

T = TypeVar("T")


async def first(stream: AsyncIterator[T], good: Callable[[T], bool], seconds: float = 25.0) -> T:
    """The first sample that is good."""
    async with asyncio.timeout(seconds):
        async for sample in stream:
            if good(sample):
                return sample
    raise AssertionError("the stream ended")


async def fly(kind: str, autopilot: str, port: int) -> dict[str, Any]:
    """Connect, wait until healthy, arm, go somewhere, come down; what telemetry said on the way."""
    told: dict[str, Any] = {}
    async with Mavsdk(Configuration.create_with_component_type(ComponentType.GROUND_STATION)) as client:
        await client.add_any_connection(f"udpin://127.0.0.1:{port}")
        system = await client.first_autopilot(timeout_s=10)
        assert system is not None, "no vehicle was discovered"
        telemetry, action = TelemetryAsync(system), ActionAsync(system)
        for rate in ("position", "health", "battery", "home", "in_air", "landed_state", "velocity_ned"):
            setter = getattr(telemetry, f"set_rate_{rate}", None)
            if setter is not None and autopilot == "ardupilot":
                await setter(10.0)
        await first(telemetry.subscribe_health_all_ok(), bool)
        told["healthy"] = True
        start = await first(telemetry.subscribe_position(), lambda p: abs(p.latitude_deg) > 1.0)
        battery = await first(telemetry.subscribe_battery(), lambda b: b.remaining_percent > 0)
        told["battery"] = battery.remaining_percent
        await action.arm()
        await first(telemetry.subscribe_armed(), bool)
        if kind == "quadcopter":
            if autopilot == "px4":
                await action.set_takeoff_altitude(4.0)
            await action.takeoff()
            await first(telemetry.subscribe_in_air(), bool)
            up = await first(telemetry.subscribe_position(), lambda p: p.relative_altitude_m > 1.8)
            told["height_m"] = up.relative_altitude_m
            await asyncio.sleep(1.0)
        goal = (start.latitude_deg + 2.0e-5, start.longitude_deg)
        height_m = start.absolute_altitude_m + (3.0 if kind == "quadcopter" else 0.0)
        await action.goto_location(*goal, height_m, 0.0)
        there = await first(telemetry.subscribe_position(), lambda p: abs(p.latitude_deg - goal[0]) < 5.0e-6)
        told["north_m"] = (there.latitude_deg - start.latitude_deg) * 111_320.0
        if kind == "quadcopter":
            await action.land()
            await first(telemetry.subscribe_armed(), lambda armed: not armed)
        else:
            await action.hold()
            await action.disarm()
            await first(telemetry.subscribe_armed(), lambda armed: not armed)
        told["disarmed"] = True
    return told


if __name__ == "__main__":
    print(json.dumps(asyncio.run(fly(sys.argv[1], sys.argv[2], int(sys.argv[3])))), flush=True)
