"""`crew demo`: bring a crew up, publish one request, wait for its end, bring the crew down."""

import time
from collections.abc import Mapping

import msgspec

from crew.bus.port import Bus
from crew.cli.follow import follow_request
from crew.cli.output import coloured, say, say_event, say_json
from crew.cli.progress import proof_progress
from crew.cli.session import EXIT_CODES, home, run
from crew.errors import UsageError
from crew.keys import Keys
from crew.launch.live import UNSECURED, LiveCrew, live_crew
from crew.launch.options import LaunchOptions
from crew.library import demo_request, load_crew_file
from crew.mailbox import KeepLatest, Letter, letters
from crew.messages import MissionEvent, SimTruth
from crew.study.arrival import goal_error_m, true_places
from crew.verify import REPORT


class DemoStep(msgspec.Struct, frozen=True, kw_only=True):
    """One step of the plan and how it ended."""

    robot: str
    skill: str
    args: Mapping[str, str | float]
    outcome: str
    code: str | None


class DemoResult(msgspec.Struct, frozen=True, kw_only=True):
    """What `crew demo --json` prints; these fields stay."""

    mission: str
    outcome: str
    code: str | None
    question: str | None
    contract: str | None
    steps: tuple[DemoStep, ...]
    goal_error_m: float | None
    poses: Mapping[str, tuple[float, float, float, float]]
    """Where every robot truly ended: x, y, z, yaw, world ENU, metres and radians."""
    run: str
    wall_s: float
    sim_s: float
    message: str
    objects: Mapping[str, tuple[float, float, float]]
    """Where each object truly was at the end: x, y, z, world ENU, metres."""


def run_demo(options: LaunchOptions, request: str | None, as_json: bool) -> int:
    """Exit code by the mission's outcome; a question counts as rejected, for there is nobody to answer it.

    Without a request the crew file's own is made. Raises UsageError if it has none.
    """
    return run(_demo(options, demo_request(options.crew) if request is None else request, as_json))


async def _demo(options: LaunchOptions, request: str, as_json: bool) -> int:
    began = time.monotonic()
    if real := [robot.name for robot in load_crew_file(options.crew).robots if robot.connection]:
        raise UsageError(
            f"a demo moves simulated robots only, and {', '.join(real)} has a real connection; use crew up"
        )
    async with live_crew(options, home(), proof_progress) as crew:
        if not as_json:
            _introduce(crew, request, time.monotonic() - began)
        last = await _follow(crew.bus, crew.keys, request, quiet=as_json)
        truth = await _newest_truth(crew.bus, crew.keys)
    result = _result(last, truth, crew, time.monotonic() - began)
    if as_json:
        say_json(result)
    else:
        _conclude(result)
    return EXIT_CODES[result.outcome]


async def _follow(bus: Bus, keys: Keys, request: str, *, quiet: bool) -> MissionEvent:
    def listen(event: MissionEvent) -> None:
        if not quiet:
            say_event(event)

    return await follow_request(bus, keys, request, listen, answer=lambda _: None)


async def _newest_truth(bus: Bus, keys: Keys) -> SimTruth | None:
    """The simulation's next truth: nobody listens to it while the mission runs."""
    truths: KeepLatest[Letter[SimTruth]] = KeepLatest(letters(SimTruth))
    bus.subscribe(keys.sim_truth, truths)
    await truths.changed()
    found = truths.take()
    return found[-1].message if found else None


def _result(last: MissionEvent, truth: SimTruth | None, crew: LiveCrew, wall_s: float) -> DemoResult:
    asked = last.question
    steps = last.steps or ()
    return DemoResult(
        mission=last.mission,
        outcome=last.outcome or "rejected",
        code=last.code or ("unread_words" if last.what == "question" else None),
        question=asked,
        contract=last.contract,
        steps=tuple(DemoStep(robot=s.robot, skill=s.skill, args=s.args, outcome=s.outcome, code=s.code) for s in steps),
        goal_error_m=None if truth is None else goal_error_m(steps, truth, crew.rules),
        poses={} if truth is None else truth.poses,
        objects={} if truth is None else true_places(truth, crew.rules),
        run=str(crew.run_folder),
        wall_s=round(wall_s, 2),
        sim_s=round(last.at_s, 2),
        message=last.text,
    )


def _introduce(crew: LiveCrew, request: str, ready_s: float) -> None:
    if crew.unsecured:
        say(coloured(UNSECURED, "amber"))
    robots = ", ".join(
        f"{r.robot} ({r.kind}{': ' + r.unavailable if r.unavailable else ''})" for r in crew.status.robots
    )
    say(f"{crew.name} is up after {ready_s:.1f} s: {robots}")
    say(f"request: {request}\n")


def _conclude(result: DemoResult) -> None:
    say()
    if result.question:
        say(f"a person would be asked: {result.question}")
    if result.goal_error_m is not None:
        say(f"distance to the true goal: {result.goal_error_m:.2f} m")
    for name, (x, y, z) in result.objects.items():
        say(f"{name} is truly at ({x:.2f}, {y:.2f}, {z:.2f})")
    colour = "green" if result.outcome == "completed" else "red"
    say(coloured(f"{result.outcome}{f' ({result.code})' if result.code else ''}", colour))
    say(f"{result.sim_s:.1f} s of mission time in {result.wall_s:.1f} s; the run is in {result.run}")
    say(f"check it: crew verify {result.run}")
    say(f"read it: {result.run}/{REPORT}")
