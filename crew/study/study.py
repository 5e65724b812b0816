"""A study: scenarios in arms with seeds, carried out side by side, kept one by one, so that it can be resumed."""

import shutil
import subprocess
import sys
import threading
from collections.abc import Callable, Sequence
from contextlib import suppress
from pathlib import Path
from queue import Empty, SimpleQueue

import msgspec

from crew.actors.specs import PlannerChoice
from crew.contracts.render.prompt import Arm
from crew.contracts.site import Rules
from crew.errors import CrewError, UsageError
from crew.study.live import LIMIT_S
from crew.study.observation import Observation, Results
from crew.study.publish import publish
from crew.study.scenario import Scenario
from crew.study.worker import SEEN, Answer, Task

RUNS = "runs"
TRIES = 3
"""How often a mission is begun whose crew does not come up, or for which the machine is too slow."""
PATIENCE_S = LIMIT_S + 60.0
RECYCLE = 12
"""Missions after which a worker is replaced, so that nothing piles up in it."""
Tell = Callable[[Observation, int, int], None]
"""Told a finished mission, how many are done, and how many there are in all."""


class Wanted(msgspec.Struct, frozen=True, kw_only=True):
    """What a study is to consist of."""

    crew: str
    """Name or path of the crew file."""
    testbed: str
    rules: Rules
    scenarios: tuple[Scenario, ...]
    """All that are known."""
    only: tuple[str, ...] = ()
    """Names of those that are carried out; empty means all."""
    arms: tuple[Arm, ...]
    seeds: tuple[int, ...]
    planning: PlannerChoice
    planner: str
    """Who plans, as results name it."""
    version: str
    out: Path
    jobs: int = 2


def tasks(wanted: Wanted) -> list[Task]:
    """Every mission, those of one scenario together, so that a study that is ended early shows all arms."""
    return [
        Task(
            crew=wanted.crew,
            scenario=scenario,
            arm=arm,
            seed=seed,
            planning=wanted.planning,
            planner=wanted.planner,
            version=wanted.version,
            out=str(wanted.out),
            run=f"{RUNS}/{wanted.testbed}-{scenario.name}-{arm.value}-{seed}",
        )
        for seed in wanted.seeds
        for scenario in wanted.scenarios
        if not wanted.only or scenario.name in wanted.only
        for arm in wanted.arms
    ]


def run_study(wanted: Wanted, tell: Tell) -> Results:
    """Carry out what the folder does not hold yet, and publish all that it holds.

    Raises UsageError before anything is run if the folder holds missions of another version or planner, and
    CrewError if a crew does not come up or the machine is too slow for it; what was done until then is kept.
    """
    wanted.out.mkdir(parents=True, exist_ok=True)
    return run_tasks(wanted, tasks(wanted), tell)


def run_tasks(wanted: Wanted, everything: Sequence[Task], tell: Tell) -> Results:
    """The same for some of the missions."""
    known = {seen.run for seen in kept(wanted)}
    missing = [task for task in everything if task.run not in known]
    done = len(everything) - len(missing)

    def told(seen: Observation) -> None:
        nonlocal done
        done += 1
        tell(seen, done, len(everything))

    for task in missing:
        shutil.rmtree(wanted.out / task.run, ignore_errors=True)
    carry_out_all(missing, wanted.jobs, told)
    return write_results(wanted)


def kept(wanted: Wanted) -> list[Observation]:
    """Every mission that the folder holds. Raises UsageError for one that may not be mixed with those wanted."""
    found = []
    digests = {scenario.name: scenario.digest for scenario in wanted.scenarios}
    for path in sorted((wanted.out / RUNS).glob(f"*/{SEEN}")):
        try:
            seen = msgspec.json.decode(path.read_bytes(), type=Observation)
        except msgspec.MsgspecError as error:
            raise UsageError(f"{path} is no mission of this version ({error}); choose an empty folder") from error
        _check_same("crew", seen.testbed, wanted.testbed, path)
        _check_same("version", seen.version, wanted.version, path)
        _check_same("planner", seen.planner, wanted.planner, path)
        _check_same("model", seen.model, wanted.planning.model, path)
        _check_same(f"scenario {seen.scenario}", seen.scenario_digest, digests.get(seen.scenario, "none"), path)
        found.append(seen)
    return found


def write_results(wanted: Wanted) -> Results:
    """All missions of the folder, in an order that does not depend on when each was run, and what they come to."""
    found = sorted(kept(wanted), key=lambda seen: seen.key)
    results = Results(version=wanted.version, observations=tuple(found))
    publish(results, wanted.scenarios, wanted.rules, wanted.out)
    return results


def carry_out_all(missing: Sequence[Task], jobs: int, told: Callable[[Observation], None]) -> None:
    """Run tasks side by side. The first that fails ends it all, once those under way are done."""
    waiting: SimpleQueue[Task] = SimpleQueue()
    for task in missing:
        waiting.put(task)
    finished: SimpleQueue[Observation | CrewError | None] = SimpleQueue()
    workers = [_Worker(waiting, finished) for _ in range(min(jobs, len(missing)))]
    failed: CrewError | None = None
    left = len(workers)
    try:
        for worker in workers:
            worker.start()
        while left:
            match finished.get():
                case None:
                    left -= 1
                case CrewError() as error:
                    failed = failed or error
                    _empty(waiting)
                case Observation() as seen:
                    told(seen)
    finally:
        _empty(waiting)
        for worker in workers:
            worker.end()
    if failed is not None:
        raise failed


class _Worker(threading.Thread):
    """Hands tasks to a process of its own, and replaces it when it ends or hangs."""

    def __init__(self, waiting: "SimpleQueue[Task]", finished: "SimpleQueue[Observation | CrewError | None]") -> None:
        super().__init__(daemon=True)
        self._waiting, self._finished = waiting, finished
        self._process: subprocess.Popen[bytes] | None = None
        self._handed = 0
        self._over = False

    def run(self) -> None:
        try:
            while True:
                self._finished.put(self._try(self._waiting.get_nowait()))
        except Empty:
            pass
        finally:
            self.end()
            self._finished.put(None)

    def end(self) -> None:
        """Hand out nothing more, and end the process: it holds nothing that is not kept."""
        self._over = True
        self._end_process()

    def _end_process(self) -> None:
        process, self._process = self._process, None
        if process is None:
            return
        process.kill()
        process.wait()
        for stream in (process.stdin, process.stdout):
            if stream is not None:
                with suppress(OSError):
                    stream.close()

    def _try(self, task: Task) -> Observation | CrewError:
        said = ""
        for repeats in range(TRIES):
            if self._over:
                break
            shutil.rmtree(Path(task.out) / task.run, ignore_errors=True)
            answer = self._ask(msgspec.structs.replace(task, repeats=repeats))
            if answer.observation is not None:
                return answer.observation
            said = answer.error
            self._end_process()
        return CrewError(f"{task.run}: the mission could not be carried out: {said}; run the same command to go on")

    def _ask(self, task: Task) -> Answer:
        process = self._ready()
        assert process.stdin is not None
        assert process.stdout is not None
        guard = threading.Timer(PATIENCE_S, process.kill)
        guard.start()
        try:
            process.stdin.write(msgspec.json.encode(task) + b"\n")
            process.stdin.flush()
            line = process.stdout.readline()
        except (OSError, ValueError) as error:
            return Answer(error=f"its process is gone: {error}")
        finally:
            guard.cancel()
        if not line:
            return Answer(error=f"its process ended with code {process.wait()}")
        return msgspec.json.decode(line, type=Answer)

    def _ready(self) -> "subprocess.Popen[bytes]":
        if self._process is None or self._handed >= RECYCLE:
            self._end_process()
            command = [sys.executable, "-m", "crew.study.worker"]
            self._process = subprocess.Popen(
                command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, start_new_session=True
            )
            self._handed = 0
        self._handed += 1
        return self._process


def _check_same(what: str, found: str, wanted: str, path: Path) -> None:
    if found != wanted:
        raise UsageError(
            f"{path} is of {what} {found or 'none'!r}, this is {wanted or 'none'!r}: they are never mixed; "
            "choose an empty folder with --out"
        )


def _empty(waiting: "SimpleQueue[Task]") -> None:
    with suppress(Empty):
        while True:
            waiting.get_nowait()
