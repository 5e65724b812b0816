"""What an actor may ask of a bus. Both implementations keep these promises, and one test suite checks both."""

from collections.abc import Awaitable, Callable
from enum import StrEnum
from types import TracebackType
from typing import Protocol, Self, TypeAlias

import msgspec

from crew.wire import Message, encode

Body: TypeAlias = Message | tuple[bytes, str]
"""What is sent: a message (as msgpack), or bytes with their encoding (`encode_json` returns such a pair)."""


class Qos(StrEnum):
    """How a sample travels. ACTUATION and STOP go first and wait for room; STATE may be dropped; EVENT may not."""

    ACTUATION = "actuation"
    STOP = "stop"
    STATE = "state"
    EVENT = "event"


class Sample(msgspec.Struct, frozen=True, gc=False):
    """One arrival. `received_ns` is this process's monotonic wall time; nothing in it proves who sent it."""

    key: str
    payload: bytes
    encoding: str
    received_ns: int


class Reply(msgspec.Struct, frozen=True, gc=False):
    """One answer to a query. With `ok` False the payload is the replier's sentence as UTF-8 text."""

    key: str
    payload: bytes
    encoding: str
    ok: bool

    @property
    def text(self) -> str:
        return self.payload.decode(errors="replace")


class Inbox(Protocol):
    """Where a subscription delivers: called in the bus's own threads, must not block."""

    def offer(self, sample: Sample) -> None: ...


class Declaration(Protocol):
    """A subscription, queryable, token or watch, until it is closed or the bus is."""

    def close(self) -> None: ...


class Publisher(Protocol):
    """A key declared for frequent puts."""

    def put(self, body: Body) -> None: ...

    @property
    def matching(self) -> bool:
        """Whether anybody is known to listen. False too when the role may not publish here."""
        ...

    def close(self) -> None: ...


Handler: TypeAlias = Callable[[Sample], Awaitable[Body]]
"""Answers one query on the loop. A CrewError becomes an error reply; any other exception ends the bus's body."""


class Bus(Protocol):
    """One session on the bus, owned by the `async with` that opened it.

    Methods raise BusError when the session is closed. A put that nobody receives, that is denied or that meets a lost
    router is silent: whoever needs certainty queries, or waits for an event with a deadline.
    """

    async def __aenter__(self) -> Self: ...

    async def __aexit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None: ...

    @property
    def connected(self) -> bool:
        """Whether a router is linked now. Tells a lost bus from others that are lost on it."""
        ...

    @property
    def peer(self) -> str:
        """Common name of the certificate that the other end of this link showed; empty where none was shown.

        All that is known of where a sample came from: its sender's own certificate ends at the router.
        """
        ...

    def put(self, key: str, body: Body, *, qos: Qos) -> None:
        """Send once; from any thread."""
        ...

    def publisher(self, key: str, *, qos: Qos) -> Publisher: ...

    def subscribe(self, key_expr: str, inbox: Inbox, *, remote_only: bool = False) -> Declaration:
        """Deliver to a mailbox. `remote_only` ignores what this session itself puts."""
        ...

    def on_sample(self, key_expr: str, callback: Callable[[Sample], None], *, remote_only: bool = False) -> Declaration:
        """Call back in the bus's thread, past the event loop: for the stop alone."""
        ...

    async def query(self, key_expr: str, body: Body, *, timeout_s: float, qos: Qos = Qos.EVENT) -> list[Reply]:
        """Every reply within `timeout_s` of wall time; an empty list if nobody answered."""
        ...

    def queryable(self, key_expr: str, handler: Handler, *, remote_only: bool = False) -> Declaration:
        """Answer queries on the loop, at most 64 at once; more are answered with an error at once."""
        ...

    def token(self, key: str) -> Declaration:
        """A liveliness token: gone for others when closed, or when this process or its link dies."""
        ...

    def watch_liveliness(self, key_expr: str, callback: Callable[[str, bool], None]) -> Declaration:
        """Call back on the loop with (key, alive), beginning with the tokens that are already there."""
        ...


def packed(body: Body) -> tuple[bytes, str]:
    """A body's bytes and encoding."""
    return encode(body) if isinstance(body, Message) else body
