"""One robot's loopback socket: topics as msgpack datagrams, counted. Must not know what the topics mean.

A datagram is `[topic, body]`. Whatever is not that is dropped and counted, never raised.
"""

import socket
from collections.abc import Iterator, Mapping
from typing import Any

import msgspec

Address = tuple[str, int]
Body = Mapping[str, Any]
BUFFER_BYTES = 1 << 20


class LinkCount(msgspec.Struct, frozen=True, kw_only=True):
    """Datagrams since the start; dropped: those received that were not understood."""

    sent: int
    received: int
    dropped: int


class Link:
    """Topics go to the client's listening port; whatever comes in is taken from anybody on loopback."""

    def __init__(self, client: Address) -> None:
        self._client = client
        self._encoder, self._decoder = msgspec.msgpack.Encoder(), msgspec.msgpack.Decoder()
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, BUFFER_BYTES)
        self._socket.setblocking(False)
        self._socket.bind(("127.0.0.1", 0))
        self.address: Address = self._socket.getsockname()
        self.sent = self.received = self.dropped = 0
        self.cut = False
        """Nothing comes out and nothing goes in: a radio out of reach."""

    @property
    def count(self) -> LinkCount:
        return LinkCount(sent=self.sent, received=self.received, dropped=self.dropped)

    def publish(self, topic: str, body: Body) -> None:
        """Send one message to the client."""
        if self.cut:
            return
        try:
            self._socket.sendto(self._encoder.encode((topic, body)), self._client)
        except OSError:  # nobody there, or a full buffer: a datagram is lost
            return
        self.sent += 1

    def messages(self) -> Iterator[tuple[str, dict[str, Any]]]:
        """What waits at the socket; while the link is cut it is read, counted and lost."""
        while True:
            try:
                data = self._socket.recv(65536)
            except BlockingIOError:
                return
            except ConnectionRefusedError:  # loopback's word that an earlier datagram found nobody
                continue
            self.received += 1
            if self.cut:
                continue
            message = self._decode(data)
            if message is None:
                self.dropped += 1
            else:
                yield message

    def close(self) -> None:
        self._socket.close()

    def _decode(self, data: bytes) -> tuple[str, dict[str, Any]] | None:
        try:
            found = self._decoder.decode(data)
        except msgspec.DecodeError:
            return None
        match found:
            case [str(topic), dict(body)]:
                return topic, body
        return None
