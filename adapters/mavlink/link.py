"""The UDP link to one vehicle: an unblocked socket, a parser, counters. Decides nothing about motion."""

import asyncio
import errno
import socket
import struct
from collections.abc import Callable
from typing import Any

import msgspec
from pymavlink.dialects.v20 import common as mavlink

from crew.adapter import StopLatch
from crew.adapters.datagram import Address, waiting
from crew.adapters.mavlink.endpoint import Endpoint
from crew.adapters.mavlink.signing import SigningState, VerifyingParser
from crew.adapters.mavlink.writer import Writer
from crew.adapters.settling import Settling
from crew.errors import AdapterError

BUFFER_BYTES = 1 << 20


class LinkCounts(msgspec.Struct):
    """Datagrams on the link; the last four are kinds of `received` or of sends that did not happen."""

    sent: int = 0
    received: int = 0
    ignored: int = 0
    """Valid, but from another system or another address."""
    malformed: int = 0
    unsent: int = 0
    """The socket refused them: link down or buffer full."""


class UdpLink:
    """Datagrams to and from the vehicle that `wanted` recognises by its first heartbeat.

    `handle` gets every message of that vehicle, on the loop. Everything else is ignored and counted.
    """

    def __init__(
        self,
        endpoint: Endpoint,
        settling: Settling,
        latch: StopLatch,
        wanted: Callable[[Any], bool],
        handle: Callable[[Any], None],
        counts: LinkCounts,
        signing: SigningState | None = None,
    ) -> None:
        self._endpoint = endpoint
        self._settling = settling
        self._wanted = wanted
        self._handle = handle
        self._socket: socket.socket | None = None
        self._loop: asyncio.AbstractEventLoop | None = None
        self._parser: Any = mavlink.MAVLink(None) if signing is None else VerifyingParser(signing)
        self._parser.robust_parsing = True
        self._destination: Address | None = None if endpoint.listen else endpoint.address
        self._system: int | None = None
        self._vehicle: Address | None = None
        self.counts = counts
        self._signing = signing
        self.writer = Writer(latch, self._transmit)
        if signing is not None:
            signing.sign(self.writer.encoder)

    @property
    def reachable(self) -> bool:
        """Whether there is an address to send to."""
        return self._socket is not None and self._destination is not None

    def unsigned_text(self) -> str:
        """How many frames were refused for their signature, in words; empty on a link that is not signed."""
        return "" if self._signing is None else f", {self._signing.rejected} unsigned or wrongly signed"

    def open(self) -> None:
        """Bind and start reading. Raises AdapterError `port_in_use` naming the port."""
        self._loop = asyncio.get_running_loop()
        sock = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        sock.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, BUFFER_BYTES)
        sock.setblocking(False)
        try:
            if self._endpoint.listen:
                sock.bind(self._endpoint.address)
        except OSError as error:
            sock.close()
            raise _bind_error(self._endpoint, error) from error
        self._socket = sock
        self._loop.add_reader(sock.fileno(), self._readable)

    def close(self) -> None:
        if self._socket is not None and self._loop is not None:
            self._loop.remove_reader(self._socket.fileno())
            sock, self._socket = self._socket, None
            sock.close()
        self._settling.close()

    def _transmit(self, data: bytes) -> None:
        sock = self._socket
        if sock is None or self._destination is None:
            self.counts.unsent += 1
            return
        try:
            sock.sendto(data, self._destination)
        except OSError:
            self.counts.unsent += 1
        else:
            self.counts.sent += 1

    def _readable(self) -> None:
        if self._socket is None:
            return
        for data, address in waiting(self._socket):
            self.counts.received += 1
            self._take(data, address)
        if self._socket is not None:
            self._settling.note()

    def _take(self, data: bytes, address: Address) -> None:
        if self._vehicle not in (None, address):
            self.counts.ignored += 1
            return
        messages = parse_datagram(self._parser, data)
        if messages is None:
            self.counts.malformed += 1
            return
        mine = [message for message in messages if self._is_mine(message, address)]
        if not mine:
            self.counts.ignored += 1
        for message in mine:
            self._handle(message)

    def _is_mine(self, message: Any, address: Address) -> bool:
        if self._vehicle is None:
            if message.get_type() != "HEARTBEAT" or not self._wanted(message):
                return False
            self._vehicle, self._system = address, message.get_srcSystem()
            self._destination = address
        return address == self._vehicle and message.get_srcSystem() == self._system


def parse_datagram(parser: Any, data: bytes) -> list[Any] | None:
    """The frames of one datagram, or None if any part of it is damaged. Frames never span datagrams."""
    parser.buf, parser.buf_index = bytearray(), 0
    try:
        messages = parser.parse_buffer(data) or []
    except (mavlink.MAVError, struct.error, ValueError):
        return None
    damaged = not messages or parser.buf_len() > 0 or any(m.get_type() == "BAD_DATA" for m in messages)
    return None if damaged else messages


def _bind_error(endpoint: Endpoint, error: OSError) -> AdapterError:
    if error.errno == errno.EADDRINUSE:
        return AdapterError(
            f"UDP port {endpoint.port} on {endpoint.host} is in use; is another ground station running?",
            code="port_in_use",
        )
    return AdapterError(f"cannot listen on {endpoint.host}:{endpoint.port}: {error.strerror}", code="bad_connection")
