"""One mission of the study, live: a crew comes up in simulation, is asked, is watched to its end, and goes down."""

import secrets
from pathlib import Path

import msgspec

from crew.bus.port import Bus, Qos
from crew.clock import SECOND_NS, WALL
from crew.errors import BusError
from crew.home import Home
from crew.keys import Keys
from crew.launch.options import LaunchOptions
from crew.mailbox import Events, Letter, letters
from crew.messages import MissionEvent, RobotValue, SimFault, SimTruth
from crew.sim.oracle import Frame
from crew.study.launch import StudyCrew, study_crew
from crew.study.scenario import Scenario

TRUTH, ENDED = "truth.msgpack", "ended.json"
"""In a run's folder: the simulation's truth, every 0.1 s of mission time, and how the mission ended."""
HAND = "hand"
"""The body of a simulated vehicle that is its hand."""
LIMIT_S = 180.0
"""Wall time after which a mission counts as one without an outcome."""
READY_S = 10.0
"""Wall time in which the simulation and whoever observes all the time must be heard."""
AFTER_S = 1.0
"""Mission time for which the truth is kept on after the mission's end, so that a late motion is seen."""


class Ended(msgspec.Struct, frozen=True, kw_only=True):
    """How a mission ended, as the crew told it. `outcome` `error` is no outcome within the limit."""

    outcome: str
    code: str = ""
    question: str = ""
    message: str = ""
    began_ns: int
    """Mission time of the request."""
    mission_s: float = 0.0
    dropped: int = 0
    """How often somebody has left the lockstep meanwhile: time went on without them."""


async def fly(
    options: LaunchOptions,
    scenario: Scenario,
    home: Home,
    run_folder: Path,
    *,
    enforced: bool,
    after_s: float = AFTER_S,
) -> Ended:
    """Carry out a scenario; leaves the run's journal, the simulation's truth and the end in `run_folder`.

    The truth is kept on for `after_s` of mission time after the end.
    """
    options = msgspec.structs.replace(options, faults=scenario.faults_at_once)
    frames: list[Frame] = []
    async with study_crew(options, home, run_folder, enforced=enforced) as crew:
        truths: Events[Letter[SimTruth]] = Events(letters(SimTruth), capacity=65536, on_lost=lambda _: None)
        crew.bus.subscribe(crew.keys.sim_truth, truths)
        began_ns = await _begin(crew, truths, frames, scenario)
        last = await _ask(crew.bus, crew.keys, scenario.request)
        await _hear_out(truths, frames, crew, after_s)
    ended = _ended(last, began_ns, frames[-1].dropped - frames[0].dropped)
    (run_folder / TRUTH).write_bytes(msgspec.msgpack.encode(frames))
    (run_folder / ENDED).write_bytes(msgspec.json.encode(ended))
    return ended


def _ended(last: MissionEvent | None, began_ns: int, dropped: int) -> Ended:
    if last is None:
        return Ended(outcome="error", message=f"no outcome within {LIMIT_S:g} s of wall time", began_ns=began_ns)
    asked = last.what == "question"
    return Ended(
        outcome="rejected" if asked else last.outcome or "error",
        code="unread_words" if asked else last.code or "",
        question=last.question or "",
        message=last.text,
        began_ns=began_ns,
        mission_s=round(last.at_s, 2),
        dropped=dropped,
    )


async def _begin(crew: StudyCrew, truths: Events[Letter[SimTruth]], frames: list[Frame], scenario: Scenario) -> int:
    """Wait until the world is seen, and set the clock of faults that begin later; the mission time now."""
    values: Events[Letter[RobotValue]] = Events(letters(RobotValue), capacity=4096, on_lost=lambda _: None)
    crew.bus.subscribe(crew.keys.robot_values, values)
    missing = _always_seen(crew)
    while missing:
        if not await WALL.race(values.changed(), READY_S):
            raise BusError(f"{', '.join(sorted(missing))} was not published within {READY_S:g} s")
        missing -= {letter.message.reading.name for letter in values.take()}
    if not await WALL.race(truths.changed(), READY_S):
        raise BusError(f"the simulation told no truth within {READY_S:g} s")
    _take(truths, frames, crew)
    began_ns = frames[-1].at_ns
    for name, after_s in scenario.faults_later.items():
        at_s = began_ns / SECOND_NS + after_s
        crew.bus.put(crew.keys.sim_fault, SimFault(name=f"{name}@{at_s:.3f}", on=True), qos=Qos.EVENT)
    return began_ns


def _always_seen(crew: StudyCrew) -> set[str]:
    """Run-time values that some robot observes all the time, whatever it does."""
    rules = crew.rules
    found = ((v.name, rules.publication(r.name, v.name)) for v in rules.crew.values for r in rules.crew.robots)
    return {name for name, published in found if published is not None and not published.by}


async def _ask(bus: Bus, keys: Keys, request: str) -> MissionEvent | None:
    """The mission's last event, or its question, for there is nobody to answer it; None if neither came in time."""
    request_id = secrets.token_hex(8)
    box: Events[Letter[MissionEvent]] = Events(letters(MissionEvent), capacity=4096, on_lost=lambda _: None)
    bus.subscribe(keys.mission_events, box)
    body = msgspec.json.encode({"text": request, "request_id": request_id})
    bus.put(keys.request, (body, "application/json"), qos=Qos.EVENT)
    until_ns = WALL.now_ns() + round(LIMIT_S * SECOND_NS)
    while (left_s := (until_ns - WALL.now_ns()) / SECOND_NS) > 0 and await WALL.race(box.changed(), left_s):
        for letter in box.take():
            event = letter.message
            if event.request_id == request_id and (event.final or event.what == "question"):
                return event
    return None


async def _hear_out(truths: Events[Letter[SimTruth]], frames: list[Frame], crew: StudyCrew, after_s: float) -> None:
    """Everything that was heard so far, and a moment more."""
    _take(truths, frames, crew)
    end_ns = frames[-1].at_ns + round(after_s * SECOND_NS)
    while frames[-1].at_ns < end_ns and await WALL.race(truths.changed(), READY_S):
        _take(truths, frames, crew)


def _take(truths: Events[Letter[SimTruth]], frames: list[Frame], crew: StudyCrew) -> None:
    hands = {robot.name: f"{robot.sim}/{HAND}" for robot in crew.rules.crew.robots}
    while heard := truths.take():
        for truth in (letter.message for letter in heard):
            seen = {robot: truth.bodies[body][:3] for robot, body in hands.items() if body in truth.bodies}
            poses, targets, dropped = truth.poses, truth.targets, truth.dropped
            frame = Frame(at_ns=truth.at_ns, poses=poses, targets=targets, hands=seen, dropped=dropped)
            frames.append(frame)
