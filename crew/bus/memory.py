"""The bus in memory, for tests and for chaos: the same promises as over Zenoh, within one process."""

import asyncio
import time
from collections.abc import Callable
from types import TracebackType
from typing import Self

from crew.bus.fabric import Answer, Link, MemoryFabric, Route, Watch
from crew.bus.keyexpr import checked_key_expr, is_key
from crew.bus.port import Body, Handler, Inbox, Qos, Reply, Sample, packed
from crew.bus.scope import Scope
from crew.errors import BusError, CrewError


class MemoryBus:
    """One session on a `MemoryFabric`, opened and closed by `async with`."""

    def __init__(self, fabric: MemoryFabric) -> None:
        self._fabric = fabric
        self._scope = Scope()
        self._link = Link(self._scope)
        self._open = False
        self._declared: list[_Declared] = []

    async def __aenter__(self) -> Self:
        await self._scope.__aenter__()
        self._open = True
        return self

    async def __aexit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        try:
            await self._scope.__aexit__(kind, error, trace)
        finally:
            self._open = False
            for declared in self._declared:
                declared.close()

    def disconnect(self) -> None:
        """Cut the link, as a dead router would."""
        self._fabric.set_connected(self._link, False)

    def reconnect(self) -> None:
        self._fabric.set_connected(self._link, True)

    @property
    def connected(self) -> bool:
        return self._link.connected

    @property
    def peer(self) -> str:
        return ""

    def put(self, key: str, body: Body, *, qos: Qos) -> None:
        payload, encoding = packed(body)
        self._fabric.send(self._link, Sample(self._one_key(key), payload, encoding, time.monotonic_ns()))

    def publisher(self, key: str, *, qos: Qos) -> "_Publisher":
        return _Publisher(self, self._fabric, self._link, self._one_key(key), qos)

    def subscribe(self, key_expr: str, inbox: Inbox, *, remote_only: bool = False) -> "_Declared":
        return self.on_sample(key_expr, inbox.offer, remote_only=remote_only)

    def on_sample(self, key_expr: str, callback: Callable[[Sample], None], *, remote_only: bool = False) -> "_Declared":
        route = Route(self._link, self._checked(key_expr), remote_only, deliver=self._scope.caught(callback))
        return self._declare(route)

    async def query(self, key_expr: str, body: Body, *, timeout_s: float, qos: Qos = Qos.EVENT) -> list[Reply]:
        loop = asyncio.get_running_loop()
        complete = asyncio.Event()
        replies: list[Reply] = []
        missing = 0

        def arrived(reply: Reply) -> None:
            nonlocal missing
            replies.append(reply)
            missing -= 1
            if missing == 0:
                complete.set()

        def on_reply(key: str, payload: bytes, encoding: str, ok: bool) -> None:
            if not loop.is_closed():
                loop.call_soon_threadsafe(arrived, Reply(key, payload, encoding, ok))

        payload, encoding = packed(body)
        question = Sample(self._checked(key_expr), payload, encoding, time.monotonic_ns())
        missing = self._fabric.ask(self._link, question, on_reply)
        try:
            async with asyncio.timeout(timeout_s):
                if missing:
                    await complete.wait()
        except TimeoutError:
            pass
        return list(replies)

    def queryable(self, key_expr: str, handler: Handler, *, remote_only: bool = False) -> "_Declared":
        def answer(question: Sample, back: Answer) -> None:
            self._scope.serve(question, handler, lambda body: _send_back(back, body))

        return self._declare(Route(self._link, self._checked(key_expr), remote_only, answer=answer))

    def token(self, key: str) -> "_Declared":
        return self._declare(Route(self._link, self._one_key(key), token=True))

    def watch_liveliness(self, key_expr: str, callback: Callable[[str, bool], None]) -> "_Declared":
        watch = Watch(self._link, self._checked(key_expr), callback)
        self._fabric.add_watch(watch)
        return self._keep(_Declared(lambda: self._fabric.remove_watch(watch)))

    def _declare(self, route: Route) -> "_Declared":
        self._fabric.add_route(route)
        return self._keep(_Declared(lambda: self._fabric.remove_route(route)))

    def _keep(self, declared: "_Declared") -> "_Declared":
        self._declared.append(declared)
        return declared

    def _checked(self, key_expr: str) -> str:
        if not self._open:
            raise BusError(f"bus closed, asked for {key_expr}: use it inside its 'async with'")
        return checked_key_expr(key_expr)

    def _one_key(self, key: str) -> str:
        if not is_key(key):
            raise BusError(f"wildcard in {key!r}: one key is put or declared at a time; name it in full")
        return self._checked(key)


class _Declared:
    def __init__(self, remove: Callable[[], None]) -> None:
        self._remove = remove

    def close(self) -> None:
        self._remove()


class _Publisher:
    def __init__(self, bus: MemoryBus, fabric: MemoryFabric, link: Link, key: str, qos: Qos) -> None:
        self._bus = bus
        self._fabric = fabric
        self._link = link
        self._key = key
        self._qos = qos
        self._open = True

    def put(self, body: Body) -> None:
        if not self._open:
            raise BusError(f"publisher of {self._key} is closed: declare another one")
        self._bus.put(self._key, body, qos=self._qos)

    @property
    def matching(self) -> bool:
        return self._fabric.listened(self._link, self._key)

    def close(self) -> None:
        self._open = False


def _send_back(back: Answer, body: Body | CrewError) -> None:
    if isinstance(body, CrewError):
        back(str(body).encode(), "text/plain", False)
    else:
        back(*packed(body), True)
