"""A role's own look at the table before it speaks: the router's denial is silent, this one is not."""

from functools import lru_cache

import zenoh

from crew.access import Identity, Way
from crew.errors import BusError


class Rights:
    """What one session may do. A guest's session asks nobody: the router judges it."""

    def __init__(self, identity: Identity | None) -> None:
        self._identity = identity
        self._may = {way: tuple(identity.may(way)) for way in Way} if identity else {}
        self._hears = {way: tuple(identity.hears(way)) for way in Way} if identity else {}

    def to_write(self, way: Way, key: str) -> None:
        """Raise BusError if the role may not put or ask on `key`, or hold a token there."""
        if self._identity is not None:
            self._check(self._identity.name, f"may not {_WRITES[way]}", key, self._may[way])

    def to_read(self, way: Way, key_expr: str) -> None:
        """Raise BusError if the role may not subscribe to `key_expr`, answer or watch tokens there."""
        if self._identity is not None:
            self._check(self._identity.name, f"may not {_READS[way]}", key_expr, self._hears[way])

    @staticmethod
    def _check(name: str, what: str, key: str, allowed: tuple[str, ...]) -> None:
        if not _covered(key, allowed):
            raise BusError(f"{name} {what} {key}; who may is in crew/access.py (crew doctor --authority)")


_WRITES = {Way.PUT: "put on", Way.ASK: "ask", Way.ALIVE: "announce itself on"}
_READS = {Way.PUT: "subscribe to", Way.ASK: "answer", Way.ALIVE: "watch"}


@lru_cache(maxsize=4096)
def _covered(key: str, allowed: tuple[str, ...]) -> bool:
    wanted = zenoh.KeyExpr(key)
    return any(zenoh.KeyExpr(expression).includes(wanted) for expression in allowed)
