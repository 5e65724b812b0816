"""The link on a real socket: who is listened to, who is not, and what is said when nobody is there."""

import asyncio
import contextlib
import socket
from collections.abc import Iterator
from typing import Any

import pytest
from pymavlink.dialects.v20 import common as mavlink

from crew.adapter import AdapterConfig, StopLatch
from crew.adapters.mavlink.adapter import MavlinkAdapter
from crew.adapters.mavlink.endpoint import parse_endpoint
from crew.adapters.mavlink.link import LinkCounts, UdpLink
from crew.adapters.settling import Settling
from crew.clock import SimClock
from crew.errors import AdapterError
from tests.integration.adapters.lockstep import AREA
from tests.integration.paced import free_port
from tests.unit.adapters.fake import finish, heartbeat


class Peer:
    """Somebody who sends MAVLink to a port."""

    def __init__(self, port: int, system: int) -> None:
        self._encoder: Any = mavlink.MAVLink(None, srcSystem=system, srcComponent=1)
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.setblocking(False)
        self._to = ("127.0.0.1", port)

    def say(self, message: Any) -> None:
        self.socket.sendto(message.pack(self._encoder), self._to)


@contextlib.contextmanager
def peers(port: int, *systems: int) -> Iterator[list[Peer]]:
    found = [Peer(port, system) for system in systems]
    try:
        yield found
    finally:
        for peer in found:
            peer.socket.close()


def adapter(port: int, **options: Any) -> MavlinkAdapter:
    config = AdapterConfig(
        robot="iris",
        kind="quadcopter",
        connection=f"udpin:127.0.0.1:{port}",
        options=options,
        area=AREA,
        origin=(47.0, 8.0, 500.0),
    )
    return MavlinkAdapter(config, SimClock())


async def settle(clock: SimClock) -> None:
    for _ in range(20):
        await asyncio.sleep(0)
    assert not clock.is_busy


async def test_only_the_wanted_system_at_its_first_address_is_heard() -> None:
    port, clock, counts = free_port(), SimClock(), LinkCounts()
    heard: list[Any] = []
    settled: list[int] = []
    settling = Settling(clock)
    link = UdpLink(
        parse_endpoint(f"udpin:127.0.0.1:{port}"),
        settling,
        StopLatch(),
        lambda m: m.get_srcSystem() == 7,
        heard.append,
        counts,
    )
    settling.on_settled(lambda: settled.append(len(heard)))
    link.open()
    with peers(port, 3, 7, 7) as (other, vehicle, impostor):
        other.say(heartbeat())
        vehicle.say(mavlink.MAVLink_attitude_message(1, 0, 0, 0, 0, 0, 0))  # before its heartbeat: not yet known
        vehicle.say(heartbeat())
        impostor.say(heartbeat())
        vehicle.say(heartbeat())
        vehicle.socket.sendto(b"\xfd\x09\x00", ("127.0.0.1", port))
        await settle(clock)
        assert (counts.received, counts.ignored, counts.malformed) == (6, 3, 1)
        assert [m.get_type() for m in heard] == ["HEARTBEAT", "HEARTBEAT"]
        assert settled == [2]
        link.writer.send(heartbeat())
        assert counts.sent == 1
        assert vehicle.socket.recv(300)
        with pytest.raises(BlockingIOError):
            impostor.socket.recv(300)
    link.close()


async def test_many_strangers_are_counted_and_nothing_else() -> None:
    port, clock, counts = free_port(), SimClock(), LinkCounts()
    endpoint = parse_endpoint(f"udpin:127.0.0.1:{port}")
    link = UdpLink(endpoint, Settling(clock), StopLatch(), lambda m: False, lambda m: None, counts)
    link.open()
    with peers(port, *range(1, 21)) as strangers:
        for stranger in strangers:
            stranger.say(heartbeat())
        await settle(clock)
    assert counts.ignored == counts.received == 20
    link.close()


async def test_a_port_in_use_is_named() -> None:
    port = free_port()
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as taken:
        taken.bind(("127.0.0.1", port))
        with pytest.raises(AdapterError, match=f"UDP port {port}") as failed:
            await adapter(port).connect()
    assert failed.value.code == "port_in_use"


async def test_nobody_there_is_said_with_what_came_instead() -> None:
    port = free_port()
    iris = adapter(port, system_id=1, connect_timeout_s=2.0)
    with peers(port, 9) as (other,):
        connecting = asyncio.ensure_future(iris.connect())
        await asyncio.sleep(0)
        other.say(heartbeat())
        with pytest.raises(AdapterError, match=r"no heartbeat of system 1 .*1 datagrams came, 1 of others") as failed:
            await finish(iris._clock, connecting)  # type: ignore[arg-type]
    assert failed.value.code == "no_vehicle"
    assert iris.health() == "not connected"
    await iris.close()


async def test_missing_telemetry_is_named() -> None:
    port = free_port()
    iris = adapter(port, connect_timeout_s=2.0)
    with peers(port, 1) as (vehicle,):
        connecting = asyncio.ensure_future(iris.connect())
        await asyncio.sleep(0)
        vehicle.say(heartbeat())
        vehicle.say(mavlink.MAVLink_attitude_message(1, 0, 0, 0, 0, 0, 0))
        with pytest.raises(AdapterError, match=r"does not send position \(GLOBAL_POSITION_INT\), home") as failed:
            await finish(iris._clock, connecting)  # type: ignore[arg-type]
    assert failed.value.code == "no_telemetry"
    await iris.close()


async def test_a_heartbeat_of_the_wrong_vehicle_is_refused() -> None:
    port = free_port()
    iris = adapter(port, system_id=2)
    with peers(port, 2) as (vehicle,):
        connecting = asyncio.ensure_future(iris.connect())
        await asyncio.sleep(0)
        vehicle.say(mavlink.MAVLink_heartbeat_message(10, 3, 0, 0, 4, 3))
        with pytest.raises(AdapterError, match="MAV_TYPE_GROUND_ROVER"):
            await finish(iris._clock, connecting)  # type: ignore[arg-type]
    await iris.close()
