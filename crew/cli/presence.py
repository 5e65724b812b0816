"""Which parts of a crew are frozen: their process is there, and nothing is heard of it. Pure; times are wall time."""

from collections.abc import Iterable

import msgspec

from crew.clock import seconds_ns

ROUTER, ORCHESTRATOR = "router", "orchestrator"
GONE_NS = seconds_ns(0.5)
"""After its token is gone; a process that died is known as dead by then. The router lets a token go after 2 s."""
BEAT_NS = seconds_ns(2.7)
"""Without the orchestrator's heartbeat: a loop that stands still keeps its token. A lost bus is known by 2 s."""
RETURN_NS = seconds_ns(2.5)
"""After the bus is back, in which tokens return and heartbeats are heard again."""


class Change(msgspec.Struct, frozen=True):
    """A part has fallen silent, or is heard again after it was told as frozen."""

    name: str
    frozen: bool
    for_s: float
    """Since when it was silent, seconds."""


class Presence:
    """Folds tokens, heartbeats, the bus's state and deaths into who is frozen."""

    def __init__(self, names: Iterable[str]) -> None:
        self._names = set(names)
        self._away: dict[str, int] = {}
        self._frozen: dict[str, int] = {}
        self._beat_ns = 0
        self._bus_ns: int | None = None
        self._judged_from_ns = 0

    def token(self, name: str, alive: bool, now_ns: int) -> None:
        """A part's liveliness token came or went."""
        if alive:
            self._away.pop(name, None)
        else:
            self._away.setdefault(name, now_ns)

    def beat(self, now_ns: int) -> None:
        """The orchestrator's heartbeat was heard."""
        self._beat_ns = now_ns

    def bus(self, connected: bool, now_ns: int) -> None:
        """Whether this session has a link to the router."""
        if not connected:
            self._bus_ns = now_ns if self._bus_ns is None else self._bus_ns
        elif self._bus_ns is not None:
            self._bus_ns, self._judged_from_ns = None, now_ns + RETURN_NS

    def died(self, name: str) -> None:
        """A process has ended: from now on it is dead, whatever is heard."""
        self._names.discard(name)
        self._frozen.pop(name, None)

    def look(self, now_ns: int) -> list[Change]:
        """What has changed since the last look. While the bus is lost nothing is known of anybody but the router."""
        if self._bus_ns is None and now_ns < self._judged_from_ns:
            silent = {name: since for name, since in self._frozen.items() if name != ROUTER}
        elif self._bus_ns is None:
            silent = self._silent(now_ns)
        else:
            silent = self._frozen | ({ROUTER: self._bus_ns} if now_ns - self._bus_ns > GONE_NS else {})
        silent = {name: since for name, since in silent.items() if name in self._names}
        fresh = [Change(n, True, (now_ns - since) / 1e9) for n, since in silent.items() if n not in self._frozen]
        back = [Change(n, False, (now_ns - since) / 1e9) for n, since in self._frozen.items() if n not in silent]
        self._frozen = {name: self._frozen.get(name, since) for name, since in silent.items()}
        return [*back, *fresh]

    def _silent(self, now_ns: int) -> dict[str, int]:
        gone = {name: since for name, since in self._away.items() if now_ns - since > GONE_NS}
        if self._beat_ns and now_ns - self._beat_ns > BEAT_NS:
            gone.setdefault(ORCHESTRATOR, self._beat_ns)
        return gone
