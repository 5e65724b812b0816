"""The bus over Zenoh, through the router. Zenoh's callback threads only hand over; everything else is on the loop."""

import asyncio
import time
from collections.abc import Callable
from types import TracebackType
from typing import Any, Self, TypeVar

import zenoh
from zenoh.handlers import Callback

from crew.access import Way
from crew.bus.keyexpr import checked_key_expr, is_key
from crew.bus.link import Link
from crew.bus.port import Body, Handler, Inbox, Qos, Reply, Sample, packed
from crew.bus.rights import Rights
from crew.bus.scope import Scope
from crew.bus.session import CONNECT_TIMEOUT_S, open_session
from crew.errors import BusError, CrewError

T = TypeVar("T")

_BLOCK, _DROP = zenoh.CongestionControl.BLOCK, zenoh.CongestionControl.DROP
_QOS: dict[Qos, dict[str, Any]] = {
    Qos.ACTUATION: {"congestion_control": _BLOCK, "priority": zenoh.Priority.REAL_TIME, "express": True},
    Qos.STOP: {"congestion_control": _BLOCK, "priority": zenoh.Priority.REAL_TIME, "express": True},
    Qos.STATE: {"congestion_control": _DROP, "priority": zenoh.Priority.DATA_HIGH, "express": False},
    Qos.EVENT: {"congestion_control": _BLOCK, "priority": zenoh.Priority.DATA, "express": True},
}
"""Blocking and dropping samples never share a priority: they would share its queue."""

_ERROR_TEXT = "text/plain"


class ZenohBus:
    """One client session, opened and closed by `async with`. BusError if no router answers in time.

    What the role has no right to is refused here, with BusError, before the router would silently drop it.
    """

    def __init__(self, link: Link, *, timeout_s: float = CONNECT_TIMEOUT_S) -> None:
        self._link = link
        self._role = link.role
        self._rights = Rights(link.identity)
        self._timeout_s = timeout_s
        self._scope = Scope()
        self._declared: set[_Declared] = set()

    async def __aenter__(self) -> Self:
        opening = asyncio.ensure_future(asyncio.to_thread(open_session, self._link, timeout_s=self._timeout_s))
        try:
            self._session = await asyncio.shield(opening)
        except asyncio.CancelledError:
            opening.add_done_callback(_close_late)
            raise
        await self._scope.__aenter__()
        return self

    async def __aexit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        try:
            await self._scope.__aexit__(kind, error, trace)
        finally:
            await asyncio.to_thread(self._session.close)

    @property
    def connected(self) -> bool:
        return bool(self._session.info.routers_zid())

    @property
    def peer(self) -> str:
        return next((link.auth_identifier or "" for link in self._session.info.links()), "")

    def put(self, key: str, body: Body, *, qos: Qos) -> None:
        self._rights.to_write(Way.PUT, key)
        payload, encoding = packed(body)
        try:
            self._session.put(_checked_key(key), payload, encoding=encoding, **_QOS[qos])
        except zenoh.ZError as error:
            raise self._refused(error, key) from error

    def publisher(self, key: str, *, qos: Qos) -> "_Publisher":
        self._rights.to_write(Way.PUT, key)
        publisher = self._try(lambda: self._session.declare_publisher(_checked_key(key), **_QOS[qos]), key)
        return _Publisher(self, publisher, key)

    def subscribe(self, key_expr: str, inbox: Inbox, *, remote_only: bool = False) -> "_Declared":
        return self._subscribe(key_expr, inbox.offer, remote_only, indirect=True)

    def on_sample(self, key_expr: str, callback: Callable[[Sample], None], *, remote_only: bool = False) -> "_Declared":
        """In the thread that read it from the link: one thread fewer that a busy machine must find time for."""
        return self._subscribe(key_expr, callback, remote_only, indirect=False)

    def _subscribe(
        self, key_expr: str, callback: Callable[[Sample], None], remote_only: bool, *, indirect: bool
    ) -> "_Declared":
        self._rights.to_read(Way.PUT, key_expr)
        deliver = self._scope.caught(callback)

        def on_sample(sample: zenoh.Sample) -> None:
            if sample.kind == zenoh.SampleKind.PUT:
                deliver(_received(sample))

        return self._declare(
            lambda: self._session.declare_subscriber(
                checked_key_expr(key_expr), Callback(on_sample, indirect=indirect), allowed_origin=_origin(remote_only)
            ),
            key_expr,
        )

    async def query(self, key_expr: str, body: Body, *, timeout_s: float, qos: Qos = Qos.EVENT) -> list[Reply]:
        self._rights.to_write(Way.ASK, key_expr)
        loop = asyncio.get_running_loop()
        done: asyncio.Future[None] = loop.create_future()
        replies: list[Reply] = []
        payload, encoding = packed(body)

        def on_reply(reply: zenoh.Reply) -> None:
            if (taken := _taken(reply, key_expr)) is not None:
                replies.append(taken)

        def finish() -> None:
            if not done.done():
                done.set_result(None)

        def on_done() -> None:
            if not loop.is_closed():
                loop.call_soon_threadsafe(finish)

        self._try(
            lambda: self._session.get(
                checked_key_expr(key_expr),
                Callback(on_reply, on_done, indirect=True),
                target=zenoh.QueryTarget.ALL,
                consolidation=zenoh.ConsolidationMode.NONE,
                timeout=timeout_s,
                payload=payload,
                encoding=encoding,
                **_QOS[qos],
            ),
            key_expr,
        )
        await done
        return replies

    def queryable(self, key_expr: str, handler: Handler, *, remote_only: bool = False) -> "_Declared":
        self._rights.to_read(Way.ASK, key_expr)

        def on_query(query: zenoh.Query) -> None:
            self._scope.serve(_asked(query), handler, lambda body: _answer(query, key_expr, body))

        return self._declare(
            lambda: self._session.declare_queryable(
                checked_key_expr(key_expr), Callback(on_query, indirect=True), allowed_origin=_origin(remote_only)
            ),
            key_expr,
        )

    def token(self, key: str) -> "_Declared":
        self._rights.to_write(Way.ALIVE, key)
        return self._declare(lambda: self._session.liveliness().declare_token(_checked_key(key)), key)

    def watch_liveliness(self, key_expr: str, callback: Callable[[str, bool], None]) -> "_Declared":
        self._rights.to_read(Way.ALIVE, key_expr)

        def on_change(sample: zenoh.Sample) -> None:
            self._scope.call(callback, str(sample.key_expr), sample.kind == zenoh.SampleKind.PUT)

        watched = Callback(on_change, indirect=True)
        return self._declare(
            lambda: self._session.liveliness().declare_subscriber(checked_key_expr(key_expr), watched, history=True),
            key_expr,
        )

    def _declare(self, declare: Callable[[], Any], key_expr: str) -> "_Declared":
        declared = _Declared(self._try(declare, key_expr), self._declared)
        self._declared.add(declared)
        return declared

    def _try(self, call: Callable[[], T], key_expr: str) -> T:
        try:
            return call()
        except zenoh.ZError as error:
            raise self._refused(error, key_expr) from error

    def _refused(self, error: zenoh.ZError, key_expr: str) -> BusError:
        reason = str(error).partition(" at /")[0]
        return BusError(f"bus refused {self._role} on {key_expr}: {reason}; was the session closed too early?")


class _Declared:
    """Keeps a Zenoh entity alive (it is undeclared when forgotten) until it is closed."""

    def __init__(self, entity: Any, alive: "set[_Declared]") -> None:
        self._entity = entity
        self._alive = alive

    def close(self) -> None:
        if self in self._alive:
            self._alive.discard(self)
            self._entity.undeclare()


class _Publisher:
    def __init__(self, bus: ZenohBus, publisher: zenoh.Publisher, key: str) -> None:
        self._bus = bus
        self._publisher = publisher
        self._key = key

    def put(self, body: Body) -> None:
        payload, encoding = packed(body)
        try:
            self._publisher.put(payload, encoding=encoding)
        except zenoh.ZError as error:
            raise self._bus._refused(error, self._key) from error

    @property
    def matching(self) -> bool:
        status: Any = self._bus._try(lambda: self._publisher.matching_status, self._key)
        return bool(status.matching)

    def close(self) -> None:
        self._bus._try(self._publisher.undeclare, self._key)


def _close_late(opening: "asyncio.Future[zenoh.Session]") -> None:
    """Close a session that opened after its owner was cancelled."""
    if not opening.cancelled() and opening.exception() is None:
        opening.result().close()  # type: ignore[no-untyped-call]


def _checked_key(key: str) -> str:
    if not is_key(key):
        raise BusError(f"wildcard in {key!r}: one key is put or declared at a time; name it in full")
    return key


def _origin(remote_only: bool) -> zenoh.Locality:
    return zenoh.Locality.REMOTE if remote_only else zenoh.Locality.ANY


def _received(sample: zenoh.Sample) -> Sample:
    return Sample(
        str(sample.key_expr), sample.payload.to_bytes(), str(sample.encoding), received_ns=time.monotonic_ns()
    )


def _asked(query: zenoh.Query) -> Sample:
    payload = query.payload.to_bytes() if query.payload is not None else b""
    encoding = str(query.encoding) if query.encoding is not None else ""
    return Sample(str(query.key_expr), payload, encoding, received_ns=time.monotonic_ns())


def _answer(query: zenoh.Query, key_expr: str, body: Body | CrewError) -> None:
    with query:
        if isinstance(body, CrewError):
            query.reply_err(str(body).encode(), encoding=_ERROR_TEXT)
            return
        payload, encoding = packed(body)
        key = key_expr if is_key(key_expr) else str(query.key_expr)
        query.reply(key, payload, encoding=encoding)


def _taken(reply: zenoh.Reply, asked: str) -> Reply | None:
    """A reply as the port has it; None for Zenoh's own notice that the time is up."""
    if (sample := reply.ok) is not None:
        return Reply(str(sample.key_expr), sample.payload.to_bytes(), str(sample.encoding), ok=True)
    error = reply.err
    if error is None or str(error.encoding) != _ERROR_TEXT:
        return None
    return Reply(asked, error.payload.to_bytes(), _ERROR_TEXT, ok=False)
