"""What the vehicle says in words: STATUSTEXT, its chunks put together, kept with the time of receipt."""

from collections import deque
from typing import Any

import msgspec

WARNING = 4
"""MAV_SEVERITY_WARNING: lower numbers are worse."""
CHUNK = 50
"""Characters in a full chunk; a shorter one is the last."""


class StatusText(msgspec.Struct, frozen=True):
    text: str
    severity: int
    stamp_ns: int


class StatusLog:
    """The latest complete texts."""

    def __init__(self) -> None:
        self._texts: deque[StatusText] = deque(maxlen=100)
        self._open: dict[int, list[str]] = {}

    def add(self, message: Any, now_ns: int) -> None:
        text = str(message.text)
        if message.id:
            chunks = self._chunks(message.id, message.chunk_seq)
            chunks.append(text)
            if len(text) >= CHUNK:
                return
            text = "".join(self._open.pop(message.id))
        self._texts.append(StatusText(text.strip(), int(message.severity), now_ns))

    def since(self, start_ns: int, worst: int = WARNING) -> list[str]:
        """Different texts received since `start_ns` with a severity of at most `worst`, oldest first."""
        found = (t.text for t in self._texts if t.stamp_ns >= start_ns and t.severity <= worst)
        return list(dict.fromkeys(found))

    def _chunks(self, number: int, sequence: int) -> list[str]:
        if sequence == 0 or number not in self._open:
            if len(self._open) >= 8:
                self._open.clear()
            self._open[number] = []
        return self._open[number]
