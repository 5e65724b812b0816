"""A session that has a role's certificate and none of its manners: for showing that the router keeps the rules."""

from types import TracebackType
from typing import Self

import zenoh

from crew.bus.link import Link
from crew.bus.session import open_session

CONNECT_S = 2.0


class Intruder:
    """Puts and listens wherever it likes; what comes of it is up to the router. `with Intruder(link) as intruder`."""

    def __init__(self, link: Link) -> None:
        self._link = link
        self._kept: list[zenoh.Subscriber[None]] = []
        self.session: zenoh.Session

    def __enter__(self) -> Self:
        self.session = open_session(self._link, timeout_s=CONNECT_S, restrained=False)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.session.close()  # type: ignore[no-untyped-call]

    def put(self, key_expr: str, payload: bytes) -> None:
        """Put without asking whether it may; a wildcard too."""
        self.session.put(key_expr, payload)

    def listen(self, key_expr: str) -> list[tuple[str, bytes]]:
        """A list that grows by key and payload of what is heard from others."""
        heard: list[tuple[str, bytes]] = []

        def note(sample: zenoh.Sample) -> None:
            heard.append((str(sample.key_expr), sample.payload.to_bytes()))

        kept = self.session.declare_subscriber(key_expr, note, allowed_origin=zenoh.Locality.REMOTE)
        self._kept.append(kept)
        return heard
