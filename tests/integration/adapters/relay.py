"""A relay between a vehicle and its adapter: the tests' hand on the wire. The same for a simulated and a real vehicle.

It cuts, delays, doubles and reorders, sets boot times back, and speaks to both sides as somebody else would.
"""

import socket
from collections.abc import Callable
from typing import Any

from pymavlink.dialects.v20 import common as mavlink

Address = tuple[str, int]
ACK = "COMMAND_ACK"


class Relay:
    """Datagrams of one vehicle, one frame each. `now_s` is the time that delays are counted in."""

    def __init__(self, now_s: Callable[[], float], port: int = 0) -> None:
        self._now_s = now_s
        self._vehicle_side, self._adapter_side = _socket(port), _socket()
        self._vehicle: Address | None = None
        self.adapter: Address | None = None
        self._held: list[tuple[float, bytes]] = []
        self._swap: bytes | None = None
        self.cut = self.doubling = self.reordering = False
        self.ack_delay_s = 0.0
        self.boot_offset_ms = 0
        self.forwarded = 0
        self.sent_by_adapter: list[Any] = []

    @property
    def port(self) -> int:
        """Where the vehicle sends to."""
        return int(self._vehicle_side.getsockname()[1])

    def pump(self) -> None:
        """Pass on what waits at both sockets."""
        for data, address in _waiting(self._vehicle_side):
            self._vehicle = address
            self._from_vehicle(data)
        for data, _ in _waiting(self._adapter_side):
            self.sent_by_adapter += _decoded(data)
            if not self.cut and self._vehicle is not None:
                self._vehicle_side.sendto(data, self._vehicle)
        due = [data for at_s, data in self._held if at_s <= self._now_s()]
        self._held = [(at_s, data) for at_s, data in self._held if at_s > self._now_s()]
        for data in due:
            self._to_adapter(data)

    def as_station(self, message: Any, system: int = 245) -> None:
        """Speak to the vehicle as another ground station, or as a pilot's remote control would act on it."""
        assert self._vehicle is not None
        encoder: Any = mavlink.MAVLink(None, srcSystem=system, srcComponent=190)
        self._vehicle_side.sendto(message.pack(encoder), self._vehicle)

    def as_vehicle(self, message: Any, system: int) -> None:
        """Speak to the adapter from the vehicle's own address, under any system id."""
        self._to_adapter(bytes(message.pack(mavlink.MAVLink(None, srcSystem=system, srcComponent=1))))

    def inject(self, data: bytes) -> None:
        """Send raw bytes to the adapter from the vehicle's own address."""
        self._to_adapter(data)

    def commands(self) -> list[int]:
        """Ids of the commands that the adapter has sent since `sent_by_adapter` was cleared."""
        return [m.command for m in self.sent_by_adapter if m.get_type() in ("COMMAND_LONG", "COMMAND_INT")]

    def close(self) -> None:
        self._vehicle_side.close()
        self._adapter_side.close()

    def _from_vehicle(self, data: bytes) -> None:
        if self.cut:
            return
        if self.boot_offset_ms:
            data = _set_back(data, self.boot_offset_ms)
        if self.ack_delay_s and any(m.get_type() == ACK for m in _decoded(data)):
            self._held.append((self._now_s() + self.ack_delay_s, data))
        elif self.reordering and self._swap is None:
            self._swap = data
        else:
            self._to_adapter(data)
            if self._swap is not None:
                late, self._swap = self._swap, None
                self._to_adapter(late)

    def _to_adapter(self, data: bytes) -> None:
        assert self.adapter is not None
        for _ in range(2 if self.doubling else 1):
            self._adapter_side.sendto(data, self.adapter)
            self.forwarded += 1


def _set_back(data: bytes, offset_ms: int) -> bytes:
    """The frame with its boot time moved back, under the vehicle's own name."""
    (message,) = _decoded(data)
    if not hasattr(message, "time_boot_ms"):
        return data
    message.time_boot_ms = max(0, message.time_boot_ms - offset_ms)
    encoder: Any = mavlink.MAVLink(None, srcSystem=message.get_srcSystem(), srcComponent=message.get_srcComponent())
    return bytes(message.pack(encoder))


def _decoded(data: bytes) -> list[Any]:
    return list(mavlink.MAVLink(None).parse_buffer(data) or [])


def _waiting(sock: socket.socket) -> list[tuple[bytes, Address]]:
    found = []
    while True:
        try:
            found.append(sock.recvfrom(65536))
        except BlockingIOError:
            return found


def _socket(port: int = 0) -> socket.socket:
    sock = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    sock.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 20)
    sock.bind(("127.0.0.1", port))
    sock.setblocking(False)
    return sock
