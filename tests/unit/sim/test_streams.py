"""Stream intervals on simulated time."""

from crew.sim.autopilot.streams import Streams

TICK_NS = 20_000_000


def _count(streams: Streams, message: int, ticks: int = 50) -> int:
    return sum(message in set(streams.due(tick * TICK_NS)) for tick in range(ticks))


def test_a_stream_keeps_its_rate() -> None:
    assert _count(Streams({1: 20.0}), 1) == 20
    assert _count(Streams({1: 0.0}), 1) == 0


def test_interval_sets_stops_and_restores() -> None:
    streams = Streams({1: 5.0})
    streams.set_interval(1, 100_000, 0)
    assert _count(streams, 1) == 10
    streams.set_interval(1, -1, 0)
    assert _count(streams, 1) == 0
    streams.set_interval(1, 0, 0)
    assert _count(streams, 1) == 5


def test_rate_is_limited_to_the_control_rate() -> None:
    streams = Streams({1: 5.0})
    streams.set_interval(1, 1, 0)
    assert _count(streams, 1) == 50


def test_a_late_call_sends_once_and_catches_up() -> None:
    streams = Streams({1: 10.0})
    assert list(streams.due(0)) == [1]
    assert list(streams.due(950_000_000)) == [1]
    assert list(streams.due(990_000_000)) == []
    assert list(streams.due(1_000_000_000)) == [1]
