"""Which messages are due: intervals on simulated time. Must not build or send a message."""

from collections.abc import Iterator, Mapping

NS = 1_000_000_000
RATE_MAX_HZ = 50.0  # the control rate; nothing is measured more often


class Streams:
    """Intervals by message id. rates_hz: every message that may be streamed, with its default rate (0 is off)."""

    def __init__(self, rates_hz: Mapping[int, float]) -> None:
        self._default_ns = {message: _interval_ns(rate) for message, rate in rates_hz.items()}
        self._interval_ns = dict(self._default_ns)
        self._next_ns: dict[int, int] = {}
        for message in rates_hz:
            self._schedule(message, 0)

    def knows(self, message: int) -> bool:
        return message in self._interval_ns

    def set_interval(self, message: int, interval_us: float, now_ns: int) -> None:
        """As SET_MESSAGE_INTERVAL means it: -1 is off, 0 the default, other values are limited to 50 Hz."""
        if interval_us == 0:
            self._interval_ns[message] = self._default_ns[message]
        elif interval_us < 0:
            self._interval_ns[message] = 0
        else:
            self._interval_ns[message] = max(int(interval_us * 1000), _interval_ns(RATE_MAX_HZ))
        self._schedule(message, now_ns)

    def due(self, now_ns: int) -> Iterator[int]:
        """The ids of the messages to send now; each keeps its own phase."""
        for message, at_ns in self._next_ns.items():
            if at_ns <= now_ns:
                interval = self._interval_ns[message]
                self._next_ns[message] = at_ns + interval * ((now_ns - at_ns) // interval + 1)
                yield message

    def _schedule(self, message: int, now_ns: int) -> None:
        self._next_ns.pop(message, None)
        if self._interval_ns[message] > 0:
            self._next_ns[message] = now_ns


def _interval_ns(rate_hz: float) -> int:
    return int(NS / rate_hz) if rate_hz > 0 else 0
