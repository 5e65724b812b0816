"""The stop's benchmark in small: every stop reaches the vehicle's socket through both locks and all of the load."""

import pytest

from tests.bench import stopping


@pytest.mark.hostile
def test_every_stop_arrives_under_a_flood_a_blocked_loop_and_a_burning_core() -> None:
    times_ms = stopping.measure(5)  # one that does not arrive within 5 s raises
    assert len(times_ms) == 5
