"""A plain ground station for the tests: one UDP socket and a MAVLink dialect, driven in simulated time."""

import math
import socket
from collections.abc import Callable
from types import TracebackType
from typing import Any, Self

from pymavlink.dialects.v20 import common as mavlink

from crew.sim.config import WorldConfig
from crew.sim.world import World

SLICE_NS = 50_000_000
S = 1_000_000_000
IRIS, TB3 = 1, 2
NAN = math.nan


class Ground:
    """A world with one ground socket a robot. `messages` keeps everything that was received, by robot system id."""

    def __init__(self, *, heartbeat: bool = True, **config: Any) -> None:
        self._sockets = {"iris": _listener(), "tb3": _listener()}
        links = {name: f"udp:127.0.0.1:{sock.getsockname()[1]}" for name, sock in self._sockets.items()}
        self.world = World(WorldConfig(links=links, **config))
        self._mav = mavlink.MAVLink(None, srcSystem=255, srcComponent=190)
        self._peers: dict[str, Any] = {}
        self._now_ns = 0
        self.heartbeat = heartbeat
        self.messages: dict[int, list[Any]] = {IRIS: [], TB3: []}
        self.origin = self.world.map.origin

    def __enter__(self) -> Self:
        self.run(0.1)  # the vehicles' first telemetry tells where they are
        if self.heartbeat:
            self._beat()
        self.run(0.1)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.world.close()
        for sock in self._sockets.values():
            sock.close()

    # Time.

    def run(self, seconds: float) -> None:
        self.wait(lambda: False, seconds)

    def wait(self, ready: Callable[[], bool], seconds: float) -> bool:
        """Advance until `ready`, at most `seconds` of simulated time; whether it became ready."""
        for _ in range(round(seconds * S / SLICE_NS)):
            if ready():
                return True
            if self.heartbeat and self._now_ns % S == 0:
                self._beat()
            self._now_ns += SLICE_NS
            self.world.advance(self._now_ns)
            self._receive()
        return ready()

    # Wire.

    def send(self, robot: str, message: Any) -> None:
        self.send_bytes(robot, message.pack(self._mav))

    def send_bytes(self, robot: str, data: bytes) -> None:
        self._sockets[robot].sendto(data, self._peers[robot])

    def exchange(self, robot: str, message: Any) -> None:
        """Send, let the vehicle handle it and collect the answers; no simulated time passes."""
        self.send(robot, message)
        self.world.poll()
        self._receive()

    def command(self, system: int, command: int, *params: float) -> int:
        """COMMAND_LONG; the result of its COMMAND_ACK."""
        full = (*params, *(0.0,) * (7 - len(params)))
        return self._acknowledged(system, mavlink.MAVLink_command_long_message(system, 1, command, 0, *full))

    def command_int(
        self, system: int, command: int, params: tuple[float, float, float, float], x: int, y: int, z: float, frame: int
    ) -> int:
        message = mavlink.MAVLink_command_int_message(system, 1, frame, command, 0, 0, *params, x, y, z)
        return self._acknowledged(system, message)

    def go(self, x_m: float, y_m: float, height_m: float, speed: float = -1.0, yaw: float = NAN) -> int:
        lat, lon = self.to_geo(x_m, y_m)
        return self.command_int(IRIS, 192, (speed, 1, 0, yaw), lat, lon, height_m, 6)

    def drive(self, x_m: float, y_m: float) -> None:
        lat, lon = self.to_geo(x_m, y_m)
        message = mavlink.MAVLink_set_position_target_global_int_message(
            0, TB3, 1, 6, 0b110111111000, lat, lon, 0, *(0,) * 8
        )
        self.exchange("tb3", message)

    def to_geo(self, x_m: float, y_m: float) -> tuple[int, int]:
        """World to 1e-7 deg, worked out here on its own."""
        lat = self.origin.lat_deg + math.degrees(y_m / 6378137.0)
        lon = self.origin.lon_deg + math.degrees(x_m / 6378137.0 / math.cos(math.radians(self.origin.lat_deg)))
        return round(lat * 1e7), round(lon * 1e7)

    def to_world(self, lat: int, lon: int) -> tuple[float, float]:
        y_m = math.radians(lat * 1e-7 - self.origin.lat_deg) * 6378137.0
        x_m = math.radians(lon * 1e-7 - self.origin.lon_deg) * 6378137.0
        return x_m * math.cos(math.radians(self.origin.lat_deg)), y_m

    # What was received.

    def all(self, system: int, kind: str) -> list[Any]:
        return [m for m in self.messages[system] if m.get_type() == kind]

    def last(self, system: int, kind: str) -> Any:
        return self.all(system, kind)[-1]

    def texts(self, system: int) -> list[str]:
        return [m.text for m in self.all(system, "STATUSTEXT")]

    def armed(self, system: int) -> bool:
        return bool(self.last(system, "HEARTBEAT").base_mode & 128)

    def mode(self, system: int) -> int:
        return int(self.last(system, "HEARTBEAT").custom_mode)

    def forget(self) -> None:
        for messages in self.messages.values():
            messages.clear()

    # Short cuts.

    def take_off(self, height_m: float = 5.0) -> None:
        assert self.command(IRIS, 400, 1) == 0
        assert self.command(IRIS, 22, NAN, 0, 0, NAN, NAN, NAN, self.origin.alt_m + height_m) == 0
        assert self.wait(lambda: self.world.truth().robots["iris"].z_m > height_m - 0.3, 15.0)
        self.run(1.5)

    def _beat(self) -> None:
        for robot in self._peers:
            self.send(robot, mavlink.MAVLink_heartbeat_message(6, 8, 0, 0, 4, 3))

    def _acknowledged(self, system: int, message: Any) -> int:
        self.forget()
        self.exchange({IRIS: "iris", TB3: "tb3"}[system], message)
        ack = self.last(system, "COMMAND_ACK")
        assert ack.command == message.command
        return int(ack.result)

    def _receive(self) -> None:
        for robot, sock in self._sockets.items():
            while True:
                try:
                    data, self._peers[robot] = sock.recvfrom(2048)
                except BlockingIOError:
                    break
                message = self._mav.decode(bytearray(data))
                self.messages[message.get_srcSystem()].append(message)


def _listener() -> socket.socket:
    sock = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    sock.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 20)
    sock.bind(("127.0.0.1", 0))
    sock.setblocking(False)
    return sock
