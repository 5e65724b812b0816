"""What both back ends offer: topics out, topics in, and counts. A body has the SDK's own fields, as mappings."""

from collections.abc import Callable, Mapping
from typing import Any, Protocol

import msgspec

Body = Mapping[str, Any]
Take = Callable[[str, Body], None]


class Counts(msgspec.Struct):
    """Messages on the link since the adapter began; the last two are kinds of `received` and of sends that failed."""

    sent: int = 0
    received: int = 0
    malformed: int = 0
    unsent: int = 0


class Transport(Protocol):
    """One robot's topics. `publish` may be called from any thread and never waits; `take` is called on the loop."""

    def open(self, take: Take) -> None:
        """Begin to listen. Raises AdapterError."""
        ...

    def close(self) -> None: ...

    @property
    def reachable(self) -> bool:
        """Whether there is anybody to send to."""
        ...

    def publish(self, topic: str, body: Body) -> None: ...
