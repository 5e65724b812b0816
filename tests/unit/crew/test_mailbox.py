import asyncio
import threading
from typing import ClassVar

import pytest

from crew.bus.port import Sample
from crew.mailbox import BATCH, CommandRefusal, Commands, Events, KeepLatest, Mailbox, letters, raw
from crew.wire import Message, Refusal, encode


class Ping(Message, frozen=True):
    schema: ClassVar[str] = "crew.test_ping"
    version: ClassVar[int] = 1

    number: int


class Pong(Message, frozen=True):
    schema: ClassVar[str] = "crew.test_pong"
    version: ClassVar[int] = 1


def sample(word: str, key: str = "a", received_ns: int = 0) -> Sample:
    return Sample(key, word.encode(), "text/plain", received_ns)


def words(samples: list[Sample]) -> list[str]:
    return [each.payload.decode() for each in samples]


class Refused:
    def __init__(self) -> None:
        self.calls: list[tuple[str, str]] = []

    def __call__(self, refusal: CommandRefusal) -> None:
        self.calls.append((refusal.sample.payload.decode(), refusal.why))


class Wall:
    now_ns = 0

    def __call__(self) -> int:
        return self.now_ns


async def test_keep_latest_conflates_each_key() -> None:
    mailbox = KeepLatest(raw)
    for word, key in (("1", "a"), ("2", "b"), ("3", "a")):
        mailbox.offer(sample(word, key))
    assert words(mailbox.take()) == ["3", "2"]
    assert mailbox.conflated == 1
    assert mailbox.take() == []


async def test_keep_latest_bounds_its_keys() -> None:
    mailbox = KeepLatest(raw, max_keys=2)
    for key in "abc":
        mailbox.offer(sample(key, key))
    mailbox.offer(sample("a2", "a"))
    assert words(mailbox.take()) == ["a2", "b"]
    assert mailbox.overflowed == 1


async def test_commands_refuse_when_full_at_once() -> None:
    refused = Refused()
    mailbox = Commands(raw, capacity=2, max_age_s=1.0, on_refused=refused, wall_ns=Wall())
    for word in "123":
        mailbox.offer(sample(word))
    assert refused.calls == [("3", "full")]
    assert words(mailbox.take()) == ["1", "2"]


@pytest.mark.parametrize(("age_ns", "handed_out"), [(999_999_999, True), (1_000_000_000, True), (1_000_000_001, False)])
async def test_commands_are_never_stale(age_ns: int, handed_out: bool) -> None:
    refused, wall = Refused(), Wall()
    mailbox = Commands(raw, capacity=8, max_age_s=1.0, on_refused=refused, wall_ns=wall)
    mailbox.offer(sample("go"))
    wall.now_ns = age_ns
    assert words(mailbox.take()) == (["go"] if handed_out else [])
    assert refused.calls == ([] if handed_out else [("go", "stale")])


async def test_a_command_that_ages_in_a_taken_batch_is_refused_too() -> None:
    refused, wall = Refused(), Wall()
    mailbox = Commands(raw, capacity=8, max_age_s=1.0, on_refused=refused, wall_ns=wall)
    mailbox.offer(sample("1"))
    mailbox.offer(sample("2"))
    assert (await anext(mailbox)).payload == b"1"
    wall.now_ns = 2_000_000_000
    assert mailbox.take() == []
    assert refused.calls == [("2", "stale")]


async def test_a_closed_mailbox_refuses_commands_and_ends() -> None:
    refused = Refused()
    mailbox = Commands(raw, capacity=8, max_age_s=1.0, on_refused=refused, wall_ns=Wall())
    mailbox.offer(sample("1"))
    mailbox.close()
    mailbox.offer(sample("2"))
    assert words([each async for each in mailbox]) == ["1"]
    assert refused.calls == [("2", "closed")]


async def test_events_count_what_is_lost_and_say_so() -> None:
    lost: list[int] = []
    mailbox = Events(raw, capacity=2, on_lost=lost.append)
    for word in "12345":
        mailbox.offer(sample(word))
    assert lost == []
    assert words(mailbox.take()) == ["1", "2"]
    assert (lost, mailbox.lost) == ([3], 3)
    mailbox.offer(sample("6"))
    assert words(mailbox.take()) == ["6"]
    assert lost == [3]


async def test_letters_tell_types_apart_and_count_refusals() -> None:
    mailbox = Events[object](letters(Ping, Pong), capacity=8, on_lost=lambda count: None)
    for body in (encode(Ping(number=1)), (b"\xc1", "nonsense"), encode(Pong()), (b"\x80", encode(Ping(number=1))[1])):
        mailbox.offer(Sample("a", *body, received_ns=0))
    mailbox.close()
    messages = [letter.message async for letter in mailbox]  # type: ignore[attr-defined]
    assert messages == [Ping(number=1), Pong()]
    assert mailbox.refusals == {Refusal.UNKNOWN_ENCODING: 1, Refusal.WRONG_TYPE: 1}


async def test_one_take_drains_at_most_a_batch() -> None:
    mailbox = Events(raw, capacity=1000, on_lost=lambda count: None)
    for number in range(BATCH + 6):
        mailbox.offer(sample(str(number)))
    assert [len(mailbox.take()), len(mailbox.take())] == [BATCH, 6]


async def test_a_flood_leaves_the_loop_its_turns() -> None:
    mailbox = Events(raw, capacity=10 * BATCH, on_lost=lambda count: None)
    for number in range(10 * BATCH):
        mailbox.offer(sample(str(number)))
    mailbox.close()
    turns = 0

    async def count_turns() -> None:
        nonlocal turns
        while True:
            turns += 1
            await asyncio.sleep(0)

    counter = asyncio.create_task(count_turns())
    assert len([each async for each in mailbox]) == 10 * BATCH
    counter.cancel()
    assert turns >= 9


async def test_many_samples_cost_one_wakeup(monkeypatch: pytest.MonkeyPatch) -> None:
    mailbox = Events(raw, capacity=1000, on_lost=lambda count: None)
    wakeups = 0

    def count(*args: object) -> None:
        nonlocal wakeups
        wakeups += 1

    monkeypatch.setattr(asyncio.get_running_loop(), "call_soon_threadsafe", count)
    for number in range(100):
        mailbox.offer(sample(str(number)))
    assert wakeups == 1


async def test_nothing_is_lost_between_threads_and_loop() -> None:
    mailbox = Events(raw, capacity=100_000, on_lost=lambda count: None)
    threads, each = 3, 2000

    def feed() -> None:
        for number in range(each):
            mailbox.offer(sample(str(number)))

    feeders = [threading.Thread(target=feed) for _ in range(threads)]
    for feeder in feeders:
        feeder.start()
    async with asyncio.timeout(10):
        for _ in range(threads * each):
            await anext(mailbox)
    for feeder in feeders:
        feeder.join()


async def test_changed_waits_for_a_sample_from_another_thread() -> None:
    mailbox = KeepLatest(raw)
    feeder = threading.Thread(target=lambda: mailbox.offer(sample("x")))
    feeder.start()
    async with asyncio.timeout(5):
        await mailbox.changed()
    feeder.join()
    assert words(mailbox.take()) == ["x"]


def test_a_sample_after_the_loops_end_is_ignored() -> None:
    async def make() -> Mailbox[Sample]:
        return KeepLatest(raw)

    asyncio.run(make()).offer(sample("late"))


async def test_a_consumer_is_called_within_the_wakeup_that_brings_the_item() -> None:
    mailbox = Events(raw, capacity=8, on_lost=lambda _: None)
    seen: list[str] = []
    consuming = asyncio.ensure_future(mailbox.each(lambda item: seen.append(item.payload.decode())))
    await asyncio.sleep(0)
    await asyncio.to_thread(mailbox.offer, sample("1"))
    mailbox.offer(sample("2"))
    asyncio.get_running_loop().call_soon(seen.append, "after")
    await asyncio.sleep(0)
    await asyncio.sleep(0)
    assert seen == ["1", "2", "after"], "no turn of the loop lies between the wakeup and the consumer"
    mailbox.close()
    await asyncio.wait_for(consuming, 5.0)


async def test_a_consumer_gets_what_was_there_before_and_the_loop_its_turns() -> None:
    mailbox = Events(raw, capacity=1000, on_lost=lambda _: None)
    seen: list[str] = []
    for number in range(2 * BATCH):
        mailbox.offer(sample(str(number)))
    consuming = asyncio.ensure_future(mailbox.each(lambda item: seen.append(item.payload.decode())))
    await asyncio.sleep(0)
    assert len(seen) == BATCH
    mailbox.close()
    await asyncio.wait_for(consuming, 5.0)
    assert seen == [str(number) for number in range(2 * BATCH)]


async def test_a_bug_in_a_consumer_ends_the_consuming_task_alone() -> None:
    mailbox = Events(raw, capacity=8, on_lost=lambda _: None)

    def fail(item: Sample) -> None:
        raise ZeroDivisionError

    consuming = asyncio.ensure_future(mailbox.each(fail))
    mailbox.offer(sample("1"))
    with pytest.raises(ZeroDivisionError):
        await asyncio.wait_for(consuming, 5.0)
    mailbox.offer(sample("2"))
    assert words(mailbox.take()) == ["2"]
