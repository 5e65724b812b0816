"""One vehicle's UDP socket: MAVLink 2 datagrams in and out, counted. Must not know what the messages mean.

With a key it signs and takes only what is signed, by the protocol library's own check. Signatures need the date, which
a real vehicle has from its receiver: the one thing here that is not simulated time.

One datagram is one frame. Whatever is not a well-formed frame is dropped and counted, never raised.
"""

import socket
import time
from collections.abc import Iterator
from typing import Any

import msgspec
from pymavlink.dialects.v20 import common as mavlink

Address = tuple[str, int]
BUFFER_BYTES = 1 << 20
BROADCAST = 0
EPOCH_2015_NS = 1_420_070_400_000_000_000  # signatures count from 2015


class LinkCount(msgspec.Struct, frozen=True, kw_only=True):
    """Datagrams since the start. received counts every datagram, dropped those of them that were not understood."""

    sent: int
    received: int
    dropped: int


def parse_endpoint(text: str) -> Address:
    """`udp:HOST:PORT` as an address. Raises ValueError."""
    scheme, _, rest = text.partition(":")
    host, _, port = rest.rpartition(":")
    if scheme != "udp" or not host or not port.isdigit() or not 0 < int(port) < 65536:
        raise ValueError(f"link {text!r} is not udp:HOST:PORT")
    return host, int(port)


class Link:
    """Streams go to the ground side's listening port; an answer goes to whoever asked."""

    def __init__(self, ground: Address, system: int, *, key: bytes | None = None) -> None:
        self.system = system
        self._ground = ground
        self._asker = ground
        self._mav = mavlink.MAVLink(None, srcSystem=system, srcComponent=mavlink.MAV_COMP_ID_AUTOPILOT1)
        if key is not None:
            self._sign(key)
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, BUFFER_BYTES)
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, BUFFER_BYTES)
        self._socket.setblocking(False)
        self._socket.bind(("127.0.0.1", 0))
        self.address: Address = self._socket.getsockname()
        self.sent = self.received = self.dropped = 0
        self.cut = False

    @property
    def count(self) -> LinkCount:
        return LinkCount(sent=self.sent, received=self.received, dropped=self.dropped)

    def send(self, message: Any) -> None:
        """Send to the ground side."""
        self._send(message, self._ground)

    def answer(self, message: Any) -> None:
        """Send to whoever sent the datagram that is being handled."""
        self._send(message, self._asker)

    def datagrams(self) -> Iterator[Any]:
        """The messages waiting at the socket; while the link is cut they are read, counted and lost."""
        while True:
            try:
                data, self._asker = self._socket.recvfrom(2048)
            except BlockingIOError:
                self._asker = self._ground
                return
            self.received += 1
            if self.cut:
                continue
            message = decode(self._mav, data)
            if message is None:
                self.dropped += 1
            else:
                yield message

    def close(self) -> None:
        self._socket.close()

    def _sign(self, key: bytes) -> None:
        """Sign what is sent, take nothing that is not signed."""
        signing = self._mav.signing
        signing.secret_key, signing.sign_outgoing = key, True
        signing.timestamp = (time.time_ns() - EPOCH_2015_NS) // 10_000

    def _send(self, message: Any, to: Address) -> None:
        if self.cut:
            return
        frame = message.pack(self._mav)
        self._mav.seq = (self._mav.seq + 1) % 256
        try:
            self._socket.sendto(frame, to)
        except OSError:  # nobody there, or a full buffer: a datagram is lost, as on the air
            return
        self.sent += 1


def decode(mav: Any, data: bytes) -> Any | None:
    """The message of one MAVLink 2 frame, or None if `data` is not exactly one that this dialect knows."""
    if len(data) < 12 or data[0] != mavlink.PROTOCOL_MARKER_V2:
        return None
    try:
        message = mav.decode(bytearray(data))
    except (mavlink.MAVError, UnicodeDecodeError):
        return None
    return None if message.get_msgId() < 0 or message.get_type().startswith("UNKNOWN") else message
