"""What buses in memory share: a dispatcher thread, liveliness, and switches that spoil delivery for tests and chaos."""

import heapq
import itertools
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from types import TracebackType
from typing import Self

from crew.bus.faults import FaultKind, Faults
from crew.bus.keyexpr import intersects, is_key
from crew.bus.port import Sample
from crew.bus.scope import Scope

Answer = Callable[[bytes, str, bool], None]
"""Takes the payload, encoding and `ok` of one reply."""

Ask = Callable[[str, bytes, str, bool], None]
"""Takes the key, payload, encoding and `ok` of one reply."""


@dataclass(eq=False)
class Link:
    """One bus's place in the fabric."""

    scope: Scope
    connected: bool = True


@dataclass(eq=False)
class Route:
    """A declared subscription (`deliver`), queryable (`answer`) or token (neither)."""

    link: Link
    key_expr: str
    remote_only: bool = False
    deliver: Callable[[Sample], None] | None = None
    answer: Callable[[Sample, Answer], None] | None = None
    token: bool = False


@dataclass(eq=False)
class Watch:
    """Who is told about tokens, and what was told so far."""

    link: Link
    key_expr: str
    callback: Callable[[str, bool], None]
    seen: set[str] = field(default_factory=set)


class MemoryFabric:
    """Joins `MemoryBus`es as a router would: `with MemoryFabric() as fabric`.

    Samples are delivered asynchronously and in order by one thread. The switches act on later samples whose key
    intersects the given key expression; they may be called from any thread.
    """

    def __init__(self) -> None:
        self._changed = threading.Condition()
        self._due: list[tuple[float, int, Callable[[], None]]] = []
        self._order = itertools.count()
        self._closed = False
        self._delivering = False
        self._routes: list[Route] = []
        self._watches: list[Watch] = []
        self._faults = Faults()
        self._thread = threading.Thread(target=self._dispatch, name="memory-fabric", daemon=True)

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        with self._changed:
            self._closed = True
            self._changed.notify_all()
        self._thread.join()

    # Switches.

    def drop_next(self, key_expr: str, count: int = 1) -> None:
        """Lose the next `count` samples or queries."""
        with self._changed:
            self._faults.add(FaultKind.DROP, key_expr, count)

    def duplicate_next(self, key_expr: str, count: int = 1) -> None:
        """Deliver each of the next `count` samples twice."""
        with self._changed:
            self._faults.add(FaultKind.DUPLICATE, key_expr, count)

    def reorder_next(self, key_expr: str, count: int) -> None:
        """Hold the next `count` samples and deliver them last to first."""
        with self._changed:
            self._faults.add(FaultKind.REORDER, key_expr, count)

    def delay(self, key_expr: str, seconds: float) -> None:
        """Deliver what follows on this expression `seconds` of wall time later; 0 ends it."""
        with self._changed:
            self._faults.delay(key_expr, seconds)

    def set_connected(self, link: Link, connected: bool) -> None:
        """Cut or restore a bus's link: nothing is buffered, tokens vanish and return, declarations stay."""
        with self._changed:
            link.connected = connected
            self._update_watches()

    def settled(self, timeout_s: float = 5.0) -> bool:
        """Wait until nothing is on its way any more; False after `timeout_s`. Not from the dispatcher's thread."""
        with self._changed:
            return self._changed.wait_for(lambda: not self._due and not self._delivering, timeout_s)

    # The buses' side.

    def add_route(self, route: Route) -> None:
        with self._changed:
            self._routes.append(route)
            self._update_watches()

    def remove_route(self, route: Route) -> None:
        with self._changed:
            if route in self._routes:
                self._routes.remove(route)
                self._update_watches()

    def add_watch(self, watch: Watch) -> None:
        with self._changed:
            self._watches.append(watch)
            self._update_watches()

    def remove_watch(self, watch: Watch) -> None:
        with self._changed:
            if watch in self._watches:
                self._watches.remove(watch)

    def send(self, link: Link, sample: Sample) -> None:
        """Deliver to every subscription that the sample reaches."""
        with self._changed:
            delay_s = self._faults.delay_s(sample.key)
            for spoiled in self._faults.applied(sample):
                for route in self._reached(link, spoiled.key):
                    if route.deliver is not None:
                        self._schedule(_delivery(route.deliver, spoiled), delay_s)

    def listened(self, link: Link, key: str) -> bool:
        """Whether a sample to `key` would reach a subscription."""
        with self._changed:
            return any(route.deliver is not None for route in self._reached(link, key))

    def ask(self, link: Link, sample: Sample, reply: Ask) -> int:
        """Pass a query on to every queryable that it reaches; their number. `reply` runs on the dispatcher's thread."""
        with self._changed:
            reached = [route for route in self._reached(link, sample.key) if route.answer is not None]
            if not self._faults.dropped(sample.key):
                for route in reached:
                    self._schedule(self._question(link, route, sample, reply), self._faults.delay_s(sample.key))
            return len(reached)

    # Inside, under the lock.

    def _reached(self, link: Link, key: str) -> list[Route]:
        return [
            route
            for route in self._routes
            if not route.token and _joined(link, route.link, route.remote_only) and intersects(route.key_expr, key)
        ]

    def _question(self, link: Link, route: Route, sample: Sample, reply: Ask) -> Callable[[], None]:
        key = route.key_expr if is_key(route.key_expr) else sample.key

        def back(payload: bytes, encoding: str, ok: bool) -> None:
            with self._changed:
                if _joined(link, route.link, remote_only=False):
                    self._schedule(lambda: reply(key, payload, encoding, ok), 0.0)

        def pass_on() -> None:
            if route.answer is not None:
                route.answer(sample, back)

        return pass_on

    def _update_watches(self) -> None:
        tokens = [route for route in self._routes if route.token]
        for watch in self._watches:
            alive = {
                token.key_expr
                for token in tokens
                if _joined(watch.link, token.link, remote_only=False) and intersects(watch.key_expr, token.key_expr)
            }
            changes = [(key, False) for key in sorted(watch.seen - alive)]
            changes += [(key, True) for key in sorted(alive - watch.seen)]
            watch.seen = alive
            for key, is_alive in changes:
                self._schedule(_notice(watch, key, is_alive), 0.0)

    def _schedule(self, deliver: Callable[[], None], delay_s: float) -> None:
        heapq.heappush(self._due, (time.monotonic() + delay_s if delay_s else 0.0, next(self._order), deliver))
        self._changed.notify_all()

    def _dispatch(self) -> None:
        while (deliver := self._next()) is not None:
            deliver()

    def _next(self) -> Callable[[], None] | None:
        with self._changed:
            self._delivering = False
            self._changed.notify_all()
            while not self._closed:
                wait_s = self._due[0][0] - time.monotonic() if self._due else None
                if wait_s is not None and wait_s <= 0:
                    self._delivering = True
                    return heapq.heappop(self._due)[2]
                self._changed.wait(wait_s)
            return None


def _joined(sender: Link, receiver: Link, remote_only: bool) -> bool:
    if sender is receiver:
        return not remote_only
    return sender.connected and receiver.connected


def _delivery(deliver: Callable[[Sample], None], sample: Sample) -> Callable[[], None]:
    def run() -> None:
        deliver(Sample(sample.key, sample.payload, sample.encoding, received_ns=time.monotonic_ns()))

    return run


def _notice(watch: Watch, key: str, alive: bool) -> Callable[[], None]:
    return lambda: watch.link.scope.call(watch.callback, key, alive)
