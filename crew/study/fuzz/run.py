"""Runs the fuzz: case after case by seed and number, on as many processes as wanted, and counts."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import get_context
from random import Random

import msgspec
from msgspec.structs import replace

from crew.contracts.gate.authorize import Gate
from crew.contracts.language.lexicon import lexicon_of
from crew.contracts.language.mention import Reading
from crew.contracts.language.reading import read_request
from crew.contracts.site import Rules
from crew.library import load_rules
from crew.study.fuzz.mission import Driver, Outcome
from crew.study.fuzz.plans import make
from crew.study.fuzz.wish import APPROVED, TWO_ROVERS, WISHES
from crew.study.fuzz.world import FuzzWorld

CHUNK = 500
MOST_STORIES = 20
CALM = 0.15
"""The share of cases whose world is in order, so that a right plan must go through."""


class Story(msgspec.Struct, frozen=True):
    """One case that broke a rule, or was refused needlessly: it is run again by its number."""

    case: int
    request: str
    what: tuple[str, ...]
    told: tuple[str, ...]


class Tally(msgspec.Struct, kw_only=True):
    """Counts over many cases."""

    cases: int = 0
    plans: int = 0
    accepted: int = 0
    sent: int = 0
    refused: int = 0
    unsafe: int = 0
    in_order: int = 0
    needless: int = 0
    right: int = 0
    needless_plans: int = 0
    asked_back: int = 0
    ends: dict[str, int] = {}
    stories: list[Story] = []
    needless_stories: list[Story] = []

    def add(self, other: "Tally") -> None:
        """Take in another's counts; of stories the first ones by number stay."""
        for name in self.__struct_fields__:
            mine = getattr(self, name)
            if isinstance(mine, int):
                setattr(self, name, mine + getattr(other, name))
        for end, count in other.ends.items():
            self.ends[end] = self.ends.get(end, 0) + count
        for name in ("stories", "needless_stories"):
            both = sorted([*getattr(self, name), *getattr(other, name)], key=lambda story: story.case)
            setattr(self, name, both[:MOST_STORIES])


class Bench:
    """Rules and readings, made once in each process. A mutated reader needs a new one."""

    def __init__(self) -> None:
        shipped = {crew: load_rules(crew) for crew in ("air_ground", "humanoid_quadruped")}
        air = shipped["air_ground"]
        self.rules: Mapping[str, Rules] = {**shipped, TWO_ROVERS: _two_rovers(air), APPROVED: _approved(air)}
        self._readings: dict[tuple[str, str], Reading] = {}
        self._gate = Gate()

    def case(self, seed: int, number: int) -> tuple[str, Outcome]:
        """One case: the request, and what came of it."""
        chance = Random(f"{seed}:{number}")
        wish = chance.choice(WISHES)
        rules = self.rules[wish.crew]
        calm = chance.random() < CALM
        world = FuzzWorld(wish, rules, f"m{number}", chance, calm=calm)
        plans = [make(wish, rules, world.supports, chance) for _ in range(2)]
        reading = self._reading(wish.crew, wish.text)
        driver = Driver(wish, plans, world, rules, reading, self._gate, chance, calm=calm)
        return wish.text, driver.run()

    def _reading(self, crew: str, text: str) -> Reading:
        found = self._readings.get((crew, text))
        if found is None:
            found = self._readings[crew, text] = read_request(text, lexicon_of(self.rules[crew]))
        return found


def _approved(rules: Rules) -> Rules:
    contracts = dict(rules.contracts)
    for name in ("dispatch_only", "search_and_dispatch"):
        steps = (replace(s, approval=s.name == "dispatch") for s in contracts[name].steps)
        contracts[name] = replace(contracts[name], steps=tuple(steps))
    return replace(rules, contracts=contracts)


def _two_rovers(rules: Rules) -> Rules:
    first = rules.crew.robot("tb3")
    assert first is not None
    second = replace(first, name="tb4", sim="tb4", aliases=())
    crew = replace(rules.crew, robots=(*rules.crew.robots, second))
    return replace(rules, crew=crew)


def run(seed: int, plans: int, processes: int = 1, told: Callable[[int], None] = lambda _: None) -> Tally:
    """Cases from 0 on until so many plans were proposed; `told` hears how many there are.

    Whole chunks are run, so that it comes to the same on any number of processes.
    """
    total, first = Tally(), 0
    with _mapper(processes) as mapped:
        while total.plans < plans:
            chunks = [(seed, first + k * CHUNK, first + (k + 1) * CHUNK) for k in range(processes)]
            first += processes * CHUNK
            for part in mapped(chunks):
                if total.plans < plans:
                    total.add(part)
                    told(total.plans)
    return total


@contextmanager
def _mapper(processes: int) -> Iterator[Callable[[list[tuple[int, int, int]]], Iterable[Tally]]]:
    if processes == 1:
        bench = Bench()
        yield lambda chunks: (count(bench, seed, range(a, b)) for seed, a, b in chunks)
        return
    with ProcessPoolExecutor(processes, mp_context=get_context("spawn")) as pool:
        yield lambda chunks: pool.map(_chunk, chunks)


def _chunk(chunk: tuple[int, int, int]) -> Tally:
    seed, first, last = chunk
    return count(Bench(), seed, range(first, last))


def count(bench: Bench, seed: int, numbers: Iterable[int]) -> Tally:
    """Run these cases one after the other."""
    tally = Tally()
    for number in numbers:
        request, out = bench.case(seed, number)
        tally.cases += 1
        tally.plans += out.plans
        tally.accepted += out.accepted
        tally.sent += out.sent
        tally.refused += out.refused
        tally.in_order += out.in_order
        tally.right += out.right
        tally.asked_back += out.asked_back
        tally.ends[out.end] = tally.ends.get(out.end, 0) + 1
        tally.needless += len(out.needless)
        tally.needless_plans += len(out.needless_plans)
        if out.unsafe:
            tally.unsafe += 1
            _keep(tally.stories, number, request, out.unsafe, out.told)
        if out.needless or out.needless_plans:
            _keep(tally.needless_stories, number, request, [*out.needless, *out.needless_plans], out.told)
    return tally


def _keep(stories: list[Story], number: int, request: str, what: Iterable[str], told: Iterable[str]) -> None:
    if len(stories) < MOST_STORIES:
        stories.append(Story(number, request, tuple(what), tuple(told)))
