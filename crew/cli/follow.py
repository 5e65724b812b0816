"""Publishes a request and follows its mission to the end."""

import asyncio
import secrets
import sys
from collections.abc import Callable

import msgspec

from crew.bus.port import Bus, Qos
from crew.cli.answering import signed_answer
from crew.clock import WALL
from crew.errors import BusError
from crew.keys import Keys
from crew.mailbox import Events, Letter, letters
from crew.messages import MissionEvent

ANSWER_S = 10.0
"""How long the gateway may take to take a request."""
Listener = Callable[[MissionEvent], None]


def event_box(bus: Bus, keys: Keys) -> Events[Letter[MissionEvent]]:
    """Every mission event from now on."""
    box: Events[Letter[MissionEvent]] = Events(letters(MissionEvent), capacity=4096, on_lost=_lost)
    bus.subscribe(keys.mission_events, box)
    return box


async def follow_request(
    bus: Bus, keys: Keys, text: str, listener: Listener, *, answer: Callable[[MissionEvent], bool | None]
) -> MissionEvent:
    """Publish a request on its key; return its last event.

    `answer` is asked about a question: yes, no, or None, which returns the question itself as the last event.
    Raises BusError if nobody takes the request, or if the orchestrator is lost on the way.
    """
    request_id = secrets.token_hex(8)
    box = event_box(bus, keys)
    lost = asyncio.Event()
    watch = bus.watch_liveliness(keys.alive("orchestrator"), lambda _, alive: None if alive else lost.set())
    body = msgspec.json.encode({"text": text, "request_id": request_id})
    bus.put(keys.request, (body, "application/json"), qos=Qos.EVENT)
    following = asyncio.create_task(_follow(bus, keys, box, request_id, listener, answer))
    losing = asyncio.create_task(lost.wait())
    try:
        await asyncio.wait({following, losing}, return_when=asyncio.FIRST_COMPLETED)
        if following.done():
            return following.result()
        raise BusError("the orchestrator is gone: what became of the mission is unknown; robots do what they declare")
    finally:
        watch.close()
        following.cancel()
        losing.cancel()


async def _follow(
    bus: Bus,
    keys: Keys,
    box: Events[Letter[MissionEvent]],
    request_id: str,
    listener: Listener,
    answer: Callable[[MissionEvent], bool | None],
) -> MissionEvent:
    heard = False
    while True:
        if not heard and not await WALL.race(box.changed(), ANSWER_S):
            raise BusError(f"nobody took the request within {ANSWER_S:g} s; is the gateway up? (crew status)")
        await box.changed()
        for letter in box.take():
            event = letter.message
            if event.request_id != request_id:
                continue
            heard = True
            listener(event)
            if event.final:
                return event
            if event.what == "question" and event.token is not None:
                said = answer(event)
                if said is None:
                    return event
                reply = signed_answer(keys.crew, event.mission, event.token, yes=said)
                bus.put(keys.mission_confirm(event.mission), reply, qos=Qos.EVENT)


def ask_person(event: MissionEvent) -> bool | None:
    """Put a mission's question to the person at the terminal; None if there is nobody."""
    if not sys.stdin.isatty():
        return None
    print(f"\n{event.question}\n[y/N] ", end="", flush=True)
    return sys.stdin.readline().strip().lower() in ("y", "yes")


def _lost(count: int) -> None:
    print(f"({count} events were lost: this terminal is too slow)", file=sys.stderr)
