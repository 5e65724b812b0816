import asyncio
import threading
from collections.abc import AsyncIterator, Iterator

import pytest

from crew.bus.fabric import MemoryFabric
from crew.bus.memory import MemoryBus
from crew.bus.port import Body, Qos, Sample
from crew.errors import BusError
from tests.unit.crew.bus.bus_suite import WAIT_S, BusSuite, Settle, events, text


@pytest.fixture
def fabric() -> Iterator[MemoryFabric]:
    with MemoryFabric() as fabric:
        yield fabric


@pytest.fixture
async def two(fabric: MemoryFabric) -> AsyncIterator[tuple[MemoryBus, MemoryBus]]:
    async with MemoryBus(fabric) as first, MemoryBus(fabric) as second:
        yield first, second


@pytest.fixture
def settle(fabric: MemoryFabric) -> Settle:
    async def wait() -> None:
        assert await asyncio.to_thread(fabric.settled)

    return wait


class TestMemoryBus(BusSuite):
    pass


class TestFaults:
    @pytest.fixture
    async def heard(self, two: tuple[MemoryBus, MemoryBus], settle: Settle) -> "Heard":
        return Heard(two, settle)

    async def test_dropped_samples_are_lost(self, fabric: MemoryFabric, heard: "Heard") -> None:
        fabric.drop_next("crew/t/**", 2)
        assert await heard.after("1", "2", "3") == ["3"]

    async def test_duplicated_samples_arrive_twice(self, fabric: MemoryFabric, heard: "Heard") -> None:
        fabric.duplicate_next("crew/t/a")
        assert await heard.after("1", "2") == ["1", "1", "2"]

    async def test_reordered_samples_arrive_last_to_first(self, fabric: MemoryFabric, heard: "Heard") -> None:
        fabric.reorder_next("crew/t/a", 3)
        assert await heard.after("1", "2", "3", "4") == ["3", "2", "1", "4"]

    async def test_faults_on_another_key_spare_this_one(self, fabric: MemoryFabric, heard: "Heard") -> None:
        fabric.drop_next("crew/t/b", 5)
        assert await heard.after("1") == ["1"]

    async def test_delayed_samples_are_overtaken(self, fabric: MemoryFabric, heard: "Heard") -> None:
        fabric.delay("crew/t/a", 0.02)
        heard.put("late")
        fabric.delay("crew/t/a", 0.0)
        assert await heard.after("soon") == ["soon", "late"]

    async def test_a_cut_link_loses_silently_and_recovers(self, heard: "Heard") -> None:
        heard.sender.disconnect()
        assert await heard.after("lost") == []
        heard.sender.reconnect()
        assert await heard.after("back") == ["back"]

    async def test_a_cut_link_hides_tokens_until_it_is_back(
        self, two: tuple[MemoryBus, MemoryBus], settle: Settle
    ) -> None:
        seen: list[tuple[str, bool]] = []
        two[0].watch_liveliness("crew/t/*/alive", lambda key, alive: seen.append((key, alive)))
        two[1].token("crew/t/iris/alive")
        two[1].disconnect()
        two[1].reconnect()
        await settle()
        await asyncio.sleep(0)
        assert [alive for _, alive in seen] == [True, False, True]

    async def test_a_lost_query_runs_into_its_timeout(self, fabric: MemoryFabric, heard: "Heard") -> None:
        async def answer(question: Sample) -> Body:
            return text("here")

        heard.receiver.queryable("crew/t/status", answer)
        fabric.drop_next("crew/t/status")
        assert await heard.sender.query("crew/t/status", text("?"), timeout_s=0.02) == []
        assert len(await heard.sender.query("crew/t/status", text("?"), timeout_s=WAIT_S)) == 1


class Heard:
    """Puts words on a key and returns what the other bus heard."""

    def __init__(self, two: tuple[MemoryBus, MemoryBus], settle: Settle) -> None:
        self.sender, self.receiver = two
        self._settle = settle
        self._inbox = events()
        self.receiver.subscribe("crew/t/a", self._inbox)

    def put(self, word: str) -> None:
        self.sender.put("crew/t/a", text(word), qos=Qos.EVENT)

    async def after(self, *words: str) -> list[str]:
        for word in words:
            self.put(word)
        await self._settle()
        return [sample.payload.decode() for sample in self._inbox.take()]


async def test_delivery_is_on_another_thread(two: tuple[MemoryBus, MemoryBus], settle: Settle) -> None:
    threads: list[threading.Thread] = []
    two[1].on_sample("crew/t/@stop", lambda sample: threads.append(threading.current_thread()))
    two[0].put("crew/t/@stop", text("stop"), qos=Qos.STOP)
    await settle()
    assert threads[0] is not threading.current_thread()


async def test_a_bug_in_a_callback_ends_the_body_with_it(fabric: MemoryFabric) -> None:
    def bug(sample: Sample) -> None:
        raise ZeroDivisionError

    async def body() -> None:
        async with MemoryBus(fabric) as bus:
            bus.on_sample("crew/t/a", bug)
            bus.put("crew/t/a", text("x"), qos=Qos.EVENT)
            await asyncio.sleep(WAIT_S)

    with pytest.raises(ZeroDivisionError):
        await body()


async def test_a_bug_in_a_handler_ends_the_body_with_it(fabric: MemoryFabric) -> None:
    async def bug(question: Sample) -> Body:
        raise ZeroDivisionError

    async def body() -> None:
        async with MemoryBus(fabric) as bus:
            bus.queryable("crew/t/a", bug)
            await bus.query("crew/t/a", text("x"), timeout_s=WAIT_S)

    with pytest.raises(ZeroDivisionError):
        await body()


async def test_the_bodys_own_error_leaves_as_it_is(fabric: MemoryFabric) -> None:
    with pytest.raises(KeyError):
        async with MemoryBus(fabric):
            raise KeyError("mine")


async def test_a_closed_bus_says_so(fabric: MemoryFabric) -> None:
    bus = MemoryBus(fabric)
    async with bus:
        publisher = bus.publisher("crew/t/a", qos=Qos.STATE)
    with pytest.raises(BusError, match="closed"):
        bus.put("crew/t/a", text("x"), qos=Qos.EVENT)
    with pytest.raises(BusError, match="closed"):
        publisher.put(text("x"))
