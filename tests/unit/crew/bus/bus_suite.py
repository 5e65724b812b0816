"""What every bus promises. A subclass provides the fixtures `two` (two open buses) and `settle`."""

import asyncio
import threading
from collections.abc import Awaitable, Callable
from typing import ClassVar

import pytest

from crew.bus.port import Body, Bus, Qos, Sample
from crew.errors import BusError
from crew.mailbox import Events, KeepLatest, letters, raw
from crew.wire import Message, Refusal, WireRefusal, encode, encode_json

WAIT_S = 5.0

Two = tuple[Bus, Bus]
Settle = Callable[[], Awaitable[None]]


class Note(Message, frozen=True):
    schema: ClassVar[str] = "crew.test_note"
    version: ClassVar[int] = 1

    text: str


def no_loss(count: int) -> None:
    raise AssertionError(f"{count} samples lost")


def events() -> Events[Sample]:
    return Events(raw, capacity=1000, on_lost=no_loss)


async def next_text(mailbox: Events[Sample]) -> str:
    async with asyncio.timeout(WAIT_S):
        return (await anext(mailbox)).payload.decode()


def text(word: str) -> Body:
    return word.encode(), "text/plain"


class BusSuite:
    async def test_a_message_arrives_with_key_encoding_and_stamp(self, two: Two, settle: Settle) -> None:
        inbox = Events(letters(Note), capacity=8, on_lost=no_loss)
        two[1].subscribe("crew/t/*/event", inbox)
        await settle()
        two[0].put("crew/t/iris/event", Note(text="hi"), qos=Qos.EVENT)
        async with asyncio.timeout(WAIT_S):
            letter = await anext(inbox)
        assert (letter.key, letter.message) == ("crew/t/iris/event", Note(text="hi"))
        assert letter.received_ns > 0

    async def test_json_and_raw_bytes_travel_with_their_encoding(self, two: Two, settle: Settle) -> None:
        inbox = events()
        two[1].subscribe("crew/t/request", inbox)
        await settle()
        for body in (encode_json(Note(text="a")), encode(Note(text="a")), text("go")):
            two[0].put("crew/t/request", body, qos=Qos.EVENT)
            async with asyncio.timeout(WAIT_S):
                sample = await anext(inbox)
            assert (sample.payload, sample.encoding) == body

    @pytest.mark.parametrize("qos", list(Qos))
    async def test_order_is_kept(self, two: Two, settle: Settle, qos: Qos) -> None:
        inbox = events()
        two[1].subscribe("crew/t/a", inbox)
        await settle()
        for number in range(50):
            two[0].put("crew/t/a", text(str(number)), qos=qos)
        assert [await next_text(inbox) for _ in range(50)] == [str(number) for number in range(50)]

    async def test_a_declared_publisher_knows_its_listeners(self, two: Two, settle: Settle) -> None:
        publisher = two[0].publisher("crew/t/a", qos=Qos.STATE)
        assert publisher.matching is False
        inbox = events()
        two[1].subscribe("crew/t/a", inbox)
        await settle()
        assert publisher.matching is True
        publisher.put(text("x"))
        assert await next_text(inbox) == "x"
        publisher.close()
        with pytest.raises(BusError):
            publisher.put(text("y"))

    async def test_plain_wildcards_never_reach_actuation(self, two: Two, settle: Settle) -> None:
        careless, exact = events(), events()
        two[1].subscribe("crew/t/**", careless)
        two[1].subscribe("crew/t/iris/@act/*", exact)
        await settle()
        two[0].put("crew/t/iris/@act/land", text("land"), qos=Qos.ACTUATION)
        two[0].put("crew/t/iris/state", text("state"), qos=Qos.ACTUATION)
        assert await next_text(exact) == "land"
        assert await next_text(careless) == "state"

    async def test_a_session_hears_itself_unless_it_asked_not_to(self, two: Two, settle: Settle) -> None:
        open_ear, remote = events(), events()
        two[0].subscribe("crew/t/a", open_ear)
        two[0].subscribe("crew/t/a", remote, remote_only=True)
        await settle()
        two[0].put("crew/t/a", text("mine"), qos=Qos.EVENT)
        assert await next_text(open_ear) == "mine"
        two[1].put("crew/t/a", text("theirs"), qos=Qos.EVENT)
        assert await next_text(remote) == "theirs"

    async def test_a_closed_subscription_hears_nothing(self, two: Two, settle: Settle) -> None:
        first, second = events(), events()
        subscription = two[1].subscribe("crew/t/a", first)
        two[1].subscribe("crew/t/a", second)
        await settle()
        subscription.close()
        subscription.close()
        two[0].put("crew/t/a", text("x"), qos=Qos.EVENT)
        assert await next_text(second) == "x"
        assert first.take() == []

    async def test_stop_is_handled_while_the_loop_is_stuck(self, two: Two, settle: Settle) -> None:
        halted = threading.Event()
        two[1].on_sample("crew/t/@stop", lambda sample: halted.set())
        await settle()
        two[0].put("crew/t/@stop", text("stop"), qos=Qos.STOP)
        assert halted.wait(WAIT_S)

    async def test_every_queryable_replies(self, two: Two, settle: Settle) -> None:
        async def answer(question: Sample) -> Body:
            return Note(text=question.payload.decode())

        two[0].queryable("crew/t/iris/card", answer)
        two[1].queryable("crew/t/tb3/card", answer)
        await settle()
        replies = await two[0].query("crew/t/*/card", text("who"), timeout_s=WAIT_S)
        assert sorted(reply.key for reply in replies) == ["crew/t/iris/card", "crew/t/tb3/card"]
        assert all(reply.ok and (reply.payload, reply.encoding) == encode(Note(text="who")) for reply in replies)

    async def test_nobody_to_answer_gives_no_replies_at_once(self, two: Two) -> None:
        async with asyncio.timeout(WAIT_S):
            assert await two[0].query("crew/t/nobody", text("?"), timeout_s=60.0) == []

    async def test_a_silent_answerer_gives_no_reply_in_time(self, two: Two, settle: Settle) -> None:
        async def sleep(question: Sample) -> Body:
            await asyncio.sleep(60.0)
            raise AssertionError

        two[1].queryable("crew/t/status", sleep)
        await settle()
        assert await two[0].query("crew/t/status", text("?"), timeout_s=0.05) == []

    async def test_a_refusal_is_an_error_reply(self, two: Two, settle: Settle) -> None:
        async def refuse(question: Sample) -> Body:
            raise WireRefusal(Refusal.TRUNCATED, "truncated crew.x/1")

        two[1].queryable("crew/t/status", refuse)
        await settle()
        (reply,) = await two[0].query("crew/t/status", text("?"), timeout_s=WAIT_S)
        assert (reply.ok, reply.text) == (False, "truncated crew.x/1")

    async def test_too_many_questions_are_refused_as_busy(self, two: Two, settle: Settle) -> None:
        release = asyncio.Event()

        async def wait(question: Sample) -> Body:
            await release.wait()
            return text("late")

        two[1].queryable("crew/t/status", wait)
        await settle()
        async with asyncio.TaskGroup() as group:
            asked = [group.create_task(two[0].query("crew/t/status", text("?"), timeout_s=WAIT_S)) for _ in range(65)]
            done, _ = await asyncio.wait(asked, timeout=WAIT_S, return_when=asyncio.FIRST_COMPLETED)
            (reply,) = done.pop().result()
            assert (reply.ok, reply.text.partition(" ")[0]) == (False, "busy")
            release.set()
        assert sum(task.result()[0].ok for task in asked) == 64

    async def test_liveliness_tells_history_arrival_and_departure(self, two: Two, settle: Settle) -> None:
        seen: asyncio.Queue[tuple[str, bool]] = asyncio.Queue()
        two[1].token("crew/t/iris/alive")
        await settle()
        two[0].watch_liveliness("crew/t/*/alive", lambda key, alive: seen.put_nowait((key, alive)))
        async with asyncio.timeout(WAIT_S):
            assert await seen.get() == ("crew/t/iris/alive", True)
            token = two[1].token("crew/t/tb3/alive")
            assert await seen.get() == ("crew/t/tb3/alive", True)
            token.close()
            assert await seen.get() == ("crew/t/tb3/alive", False)

    @pytest.mark.parametrize("key", ["crew/*/a", "crew//a", "/crew"])
    async def test_a_put_needs_one_valid_key(self, two: Two, key: str) -> None:
        with pytest.raises(BusError):
            two[0].put(key, text("x"), qos=Qos.EVENT)

    async def test_keep_latest_over_the_bus_gives_the_last(self, two: Two, settle: Settle) -> None:
        states, marker = KeepLatest(raw), events()
        two[1].subscribe("crew/t/a", states)
        two[1].subscribe("crew/t/a", marker)
        await settle()
        for number in range(20):
            two[0].put("crew/t/a", text(str(number)), qos=Qos.EVENT)
        while await next_text(marker) != "19":
            pass
        last = b""
        async with asyncio.timeout(WAIT_S):
            while last != b"19":
                await states.changed()
                for sample in states.take():
                    last = sample.payload
