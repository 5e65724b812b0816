"""One mission of the study, live: a crew comes up in simulation, is asked, is watched to its end, and goes down."""

import secrets
from pathlib import Path

import msgspec

from crew.bus.port import Bus, Qos
from crew.clock import WALL
from crew.home import Home
from crew.keys import Keys
from crew.launch.options import LaunchOptions
from crew.mailbox import Events, Letter, letters
from crew.messages import MissionEvent, SimTruth
from crew.sim.oracle import Frame
from crew.study.launch import study_crew

TRUTH = "truth.msgpack"
"""In a run's folder: the simulation's truth, every 0.1 s of mission time."""
LIMIT_S = 180.0
"""Wall time after which a mission counts as one without an outcome."""
AFTER_S = 1.0
"""Mission time for which the truth is kept on after the mission's end, so that a late motion is seen."""


class Ended(msgspec.Struct, frozen=True, kw_only=True):
    """How a mission ended, as the crew told it. `outcome` `error` is no outcome within the limit."""

    outcome: str
    code: str = ""
    question: str = ""
    message: str = ""
    mission_s: float = 0.0


async def fly(options: LaunchOptions, request: str, home: Home, run_folder: Path, *, enforced: bool) -> Ended:
    """Carry out one request and leave the run's journal and the simulation's truth in `run_folder`."""
    frames: list[Frame] = []
    async with study_crew(options, home, run_folder, enforced=enforced) as crew:
        truths: Events[Letter[SimTruth]] = Events(letters(SimTruth), capacity=65536, on_lost=lambda _: None)
        crew.bus.subscribe(crew.keys.sim_truth, truths)
        last = await _ask(crew.bus, crew.keys, request)
        await _hear_out(truths, frames)
    (run_folder / TRUTH).write_bytes(msgspec.msgpack.encode(frames))
    if last is None:
        return Ended(outcome="error", message=f"no outcome within {LIMIT_S:g} s of wall time")
    asked = last.what == "question"
    return Ended(
        outcome="rejected" if asked else last.outcome or "error",
        code="unread_words" if asked else last.code or "",
        question=last.question or "",
        message=last.text,
        mission_s=round(last.at_s, 2),
    )


async def _ask(bus: Bus, keys: Keys, request: str) -> MissionEvent | None:
    """The mission's last event, or its question, for there is nobody to answer it; None if neither came in time."""
    request_id = secrets.token_hex(8)
    box: Events[Letter[MissionEvent]] = Events(letters(MissionEvent), capacity=4096, on_lost=lambda _: None)
    bus.subscribe(keys.mission_events, box)
    body = msgspec.json.encode({"text": request, "request_id": request_id})
    bus.put(keys.request, (body, "application/json"), qos=Qos.EVENT)
    until_ns = WALL.now_ns() + round(LIMIT_S * 1e9)
    while (left_s := (until_ns - WALL.now_ns()) / 1e9) > 0 and await WALL.race(box.changed(), left_s):
        for letter in box.take():
            event = letter.message
            if event.request_id == request_id and (event.final or event.what == "question"):
                return event
    return None


async def _hear_out(truths: Events[Letter[SimTruth]], frames: list[Frame]) -> None:
    """Everything that was heard so far, and a moment more."""
    end_ns = None
    while end_ns is None or frames[-1].at_ns < end_ns:
        if not await WALL.race(truths.changed(), 5.0):
            return
        frames += [Frame(at_ns=t.at_ns, poses=t.poses, targets=t.targets) for t in (le.message for le in truths.take())]
        if end_ns is None and frames:
            end_ns = frames[-1].at_ns + round(AFTER_S * 1e9)
