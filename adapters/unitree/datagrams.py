"""The back end without DDS: the SDK's topics as msgpack datagrams on a loopback socket (docs/unitree-link.md)."""

import asyncio
import socket

import msgspec

from crew.adapters.datagram import Address, waiting
from crew.adapters.settling import Settling
from crew.adapters.unitree.transport import Body, Counts, Take
from crew.errors import AdapterError


def parse_address(text: str) -> Address:
    """`udpin:HOST:PORT` as an address to listen on. Raises AdapterError `bad_connection`."""
    scheme, _, rest = text.partition(":")
    host, _, port = rest.rpartition(":")
    if scheme != "udpin" or not host or not port.isdecimal() or not 0 < int(port) < 65536:
        raise AdapterError(f"connection {text!r} is not understood; write udpin:HOST:PORT", code="bad_connection")
    return host, int(port)


class Datagrams:
    """Listens on a port, and answers the first peer that speaks well-formed topics there, and no other."""

    def __init__(self, address: Address, settling: Settling, counts: Counts) -> None:
        self._address, self._settling, self._counts = address, settling, counts
        self._socket: socket.socket | None = None
        self._peer: Address | None = None
        self._take: Take = lambda topic, body: None
        self._encoder, self._decoder = msgspec.msgpack.Encoder(), msgspec.msgpack.Decoder()

    @property
    def reachable(self) -> bool:
        return self._peer is not None

    def open(self, take: Take) -> None:
        """Bind and listen. Raises AdapterError `port_in_use`."""
        self._take = take
        sock = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        sock.setblocking(False)
        try:
            sock.bind(self._address)
        except OSError as error:
            sock.close()
            where = f"{self._address[0]}:{self._address[1]}"
            raise AdapterError(
                f"cannot listen on {where}: {error.strerror}; is another adapter running?", code="port_in_use"
            ) from error
        self._socket = sock
        asyncio.get_running_loop().add_reader(sock.fileno(), self._readable)

    def close(self) -> None:
        if self._socket is not None:
            asyncio.get_running_loop().remove_reader(self._socket.fileno())
            sock, self._socket = self._socket, None
            sock.close()
        self._settling.close()

    def publish(self, topic: str, body: Body) -> None:
        """Send one message to the robot; what can't be sent is counted."""
        sock, peer = self._socket, self._peer
        try:
            if sock is None or peer is None:
                raise OSError
            sock.sendto(msgspec.msgpack.encode((topic, body)), peer)
        except OSError:
            self._counts.unsent += 1
        else:
            self._counts.sent += 1

    def _readable(self) -> None:
        if self._socket is None:
            return
        for data, address in waiting(self._socket):
            self._counts.received += 1
            self._hand_on(data, address)
        if self._socket is not None:
            self._settling.note()

    def _hand_on(self, data: bytes, address: Address) -> None:
        message = self._decode(data)
        if message is None or (self._peer is not None and address != self._peer):
            self._counts.malformed += 1
            return
        self._peer = address
        self._take(*message)

    def _decode(self, data: bytes) -> tuple[str, Body] | None:
        try:
            found = self._decoder.decode(data)
        except msgspec.DecodeError:
            return None
        match found:
            case [str(topic), dict(body)]:
                return topic, body
        return None
