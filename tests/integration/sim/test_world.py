"""The world itself: reproducible, indifferent to slicing and garbage, exact in its counts."""

import random
import struct
from typing import Any

import pytest
from pymavlink.dialects.v20 import common as mavlink

from crew.sim.config import WorldConfig
from crew.sim.truth import Truth
from crew.sim.world import World
from tests.integration.sim.ground import IRIS, TB3, Ground

LINKS = {"iris": "udp:127.0.0.1:9", "tb3": "udp:127.0.0.1:9"}


def _mission(seed: int) -> Truth:
    with Ground(seed=seed) as ground:
        ground.command(TB3, 176, 1, 15)
        ground.command(TB3, 400, 1)
        ground.drive(-4.0, 3.0)
        ground.take_off(3.0)
        ground.go(2.0, 0.0, 4.0)
        ground.run(3.0)
        return ground.world.truth()


def test_same_seed_and_datagrams_give_bit_identical_truth() -> None:
    first = _mission(7)
    assert first == _mission(7)
    assert first != _mission(8)


def test_neither_slicing_nor_looking_matters() -> None:
    with World(WorldConfig(links=LINKS)) as whole, World(WorldConfig(links=LINKS)) as sliced:
        whole.advance(1_000_000_000)
        for end_ms in range(0, 1001, 50):
            sliced.advance(end_ms * 1_000_000)
            sliced.truth()
        assert whole.truth() == sliced.truth()
        assert whole.time_ns == 1_000_000_000


def test_time_never_runs_past_the_slice() -> None:
    with World(WorldConfig(links=LINKS)) as world:
        world.advance(50_000_000)
        assert world.time_ns == 48_000_000
        world.advance(10)
        assert world.time_ns == 48_000_000


def test_poll_answers_without_advancing_and_counts_are_exact() -> None:
    with Ground() as ground:
        before, time_ns = ground.world.counts()["iris"], ground.world.time_ns
        for _ in range(20):
            ground.send("iris", mavlink.MAVLink_param_request_read_message(IRIS, 1, b"GF_ACTION", -1))
        assert ground.world.poll() == 20
        after = ground.world.counts()["iris"]
        assert (after.sent - before.sent, after.received - before.received) == (20, 20)
        assert ground.world.time_ns == time_ns


def test_garbage_is_dropped_counted_and_harmless() -> None:
    with Ground() as ground:
        noise = random.Random(0)
        for _ in range(200):
            ground.send_bytes("iris", noise.randbytes(noise.randrange(0, 280)))
            ground.send_bytes("tb3", b"\xfd" + noise.randbytes(40))
        ground.world.poll()
        counts = ground.world.counts()
        assert (counts["iris"].dropped, counts["tb3"].dropped) == (200, 200)
        assert ground.command(IRIS, 400, 1) == 0


def test_odd_numbers_in_good_frames_are_refused_or_ignored() -> None:
    with Ground() as ground:
        ground.take_off(2.0)
        inf, nan = float("inf"), float("nan")
        for command in (22, 21, 176, 178, 192, 400, 511, 512):
            assert ground.command(IRIS, command, *(inf,) * 7) != 0
        for command in (176, 178, 400, 511, 512):
            assert ground.command(IRIS, command, *(nan,) * 7) != 0
            assert ground.command(TB3, command, *(nan,) * 7) != 0
        big = struct.unpack("<f", b"\xff\xff\x7f\x7f")[0]
        for command in (178, 400, 511, 512):
            ground.command(TB3, command, *(big,) * 7)
        ground.run(1.0)
        assert ground.armed(IRIS)
        assert ground.world.truth().robots["iris"].z_m > 1.0


def test_another_systems_command_is_ignored() -> None:
    with Ground() as ground:
        ground.forget()
        ground.exchange("iris", mavlink.MAVLink_command_long_message(7, 1, 400, 0, 1, 0, 0, 0, 0, 0, 0))
        assert not ground.all(IRIS, "COMMAND_ACK")
        ground.run(1.5)
        assert not ground.armed(IRIS)


def test_request_message_sends_it_once() -> None:
    with Ground() as ground:
        ground.run(1.0)
        assert ground.command(IRIS, 512, 242) == 0
        assert len(ground.all(IRIS, "HOME_POSITION")) == 1
        assert ground.command(IRIS, 512, 148) == 0
        assert ground.last(IRIS, "AUTOPILOT_VERSION").capabilities & 16
        assert ground.command(IRIS, 512, 9999) == 2


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"links": {"iris": "udp:127.0.0.1:9"}}, "links: has"),
        ({"links": {"iris": "x", "tb3": "udp:127.0.0.1:9"}}, "is not udp:HOST:PORT"),
        ({"faults": ("gps_los",)}, "nearest: gps_loss"),
        ({"map": "Q"}, "no map 'Q' of the scene air_ground"),
    ],
)
def test_a_wrong_configuration_is_refused(change: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        World(WorldConfig(**{"links": LINKS, **change}))
