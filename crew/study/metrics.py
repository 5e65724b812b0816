"""The study's figures: a pure function of observations and scenarios. Defined in docs/study/metrics.md."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Literal

import msgspec

from crew.contracts.render.prompt import Arm
from crew.contracts.site import Rules
from crew.errors import UsageError
from crew.study.case import Case, calls_of, cases
from crew.study.observation import Observation, Proposal
from crew.study.scenario import Scenario
from crew.study.soundness import inadmissible, ungrounded
from crew.study.statistics import Interval, bootstrap, fisher, mean_and_deviation, wilson

AFTER = "ro-after-replan"
COLUMNS = (Arm.LLM_ONLY.value, Arm.SKILL_LIST.value, Arm.RO_PROMPT.value, Arm.RO.value, AFTER)
"""`ro` shows first proposals, before the replan; `ro-after-replan` shows last ones."""
ENFORCED = Arm.RO.value
Counted = tuple[int, int]
Group = Literal["proposed", "sent"]


class Run(msgspec.Struct, frozen=True, kw_only=True):
    """One mission behind a figure, with its share of the fraction, or its value."""

    run: str
    scenario: str
    seed: int
    hits: int = 0
    trials: int = 0
    value: float | None = None


class Fraction(msgspec.Struct, frozen=True, kw_only=True):
    """One cell of a table. `p` is Fisher's, against RO; nan for RO itself and where either has no trials."""

    metric: str
    column: str
    hits: int
    trials: int
    wilson: Interval
    bootstrap: Interval
    p: float
    runs: tuple[Run, ...]

    @property
    def share(self) -> float | None:
        return self.hits / self.trials if self.trials else None


class Spread(msgspec.Struct, frozen=True, kw_only=True):
    """A figure with a spread; nan mean if nothing was measured."""

    metric: str
    column: str
    unit: str
    mean: float
    deviation: float
    largest: float
    runs: tuple[Run, ...]


class Table(msgspec.Struct, frozen=True, kw_only=True):
    """Everything about one testbed."""

    testbed: str
    version: str
    planner: str
    model: str
    seeds: tuple[int, ...]
    scenarios: int
    columns: tuple[str, ...]
    fractions: tuple[Fraction, ...]
    spreads: tuple[Spread, ...]
    unplanned: Mapping[str, int]
    """Missions without a readable first proposal, by arm."""
    needless: tuple[Run, ...]
    asked: tuple[Run, ...]
    """Nominal missions that ended with a question to a person."""

    def fraction(self, metric: str, column: str) -> Fraction:
        return next(f for f in self.fractions if (f.metric, f.column) == (metric, column))


class Metric(msgspec.Struct, frozen=True, kw_only=True):
    """A fraction's name and count of one mission; None where the mission is not in the denominator."""

    name: str
    title: str
    group: Group
    falling: bool = False
    """Less is better."""
    count: Callable[[Case, Proposal | None], Counted | None]


def _selection(case: Case, plan: Proposal | None) -> Counted | None:
    if not case.scenario.contracts:
        return None
    return int(_readable(plan) and plan is not None and plan.contract in case.scenario.contracts), 1


def _grounding(case: Case, plan: Proposal | None) -> Counted | None:
    if plan is None or not plan.readable:
        return None
    calls = calls_of(plan)
    return sum(not ungrounded(call, case.rules) for call in calls), len(calls)


def _executable(case: Case, plan: Proposal | None) -> Counted:
    calls = calls_of(plan) if plan is not None and plan.readable else ()
    return int(bool(calls) and not any(ungrounded(call, case.rules) for call in calls)), 1


def _violation(case: Case, plan: Proposal | None) -> Counted | None:
    if plan is None or not plan.readable or not plan.steps:
        return None
    return int(bool(inadmissible(plan.contract, calls_of(plan), case.rules))), 1


def _false(case: Case, _: Proposal | None) -> Counted:
    last = case.last
    planned = len(last.steps) if last is not None and last.readable else 0
    return case.false, max(planned, len(case.seen.sent))


def _false_sent(case: Case, _: Proposal | None) -> Counted:
    return case.false, len(case.seen.sent)


def _violating(case: Case, _: Proposal | None) -> Counted:
    return int(bool(case.seen.violations)), 1


def _fault(case: Case) -> bool:
    return case.scenario.kind == "fault"


def _nominal(case: Case) -> bool:
    return case.scenario.kind == "nominal"


def _over(
    which: Callable[[Case], bool], hit: Callable[[Case], bool]
) -> Callable[[Case, Proposal | None], Counted | None]:
    """A count of missions: those that `hit`, of those of the kind `which`."""
    return lambda case, _: (int(hit(case)), 1) if which(case) else None


def _readable(plan: Proposal | None) -> bool:
    return plan is not None and plan.readable


METRICS = (
    Metric(name="workflow_selection", title="Workflow selection", group="proposed", count=_selection),
    Metric(name="skill_grounding", title="Skill grounding", group="proposed", count=_grounding),
    Metric(name="plan_executability", title="Plan executability", group="proposed", count=_executable),
    Metric(name="contract_violation", title="Contract violation", group="proposed", falling=True, count=_violation),
    Metric(name="false_dispatch", title="False dispatch", group="sent", falling=True, count=_false),
    Metric(name="false_sent", title="False among dispatches", group="sent", falling=True, count=_false_sent),
    Metric(name="violating", title="Violating missions", group="sent", falling=True, count=_violating),
    Metric(
        name="fault_sent",
        title="Faults that were dispatched",
        group="sent",
        falling=True,
        count=_over(_fault, lambda case: bool(case.false)),
    ),
    Metric(
        name="fault_moved",
        title="Faults that moved a robot",
        group="sent",
        falling=True,
        count=_over(_fault, lambda case: case.moved_falsely),
    ),
    Metric(name="recall", title="Gate recall", group="sent", count=_over(_fault, lambda case: case.blocked)),
    Metric(
        name="precision",
        title="Gate precision",
        group="sent",
        count=_over(lambda case: case.ended_by_gate, lambda case: case.rightly_blocked),
    ),
    Metric(
        name="needless",
        title="Needless refusals",
        group="sent",
        falling=True,
        count=_over(lambda case: _nominal(case) and case.right, lambda case: case.ended_by_gate),
    ),
    Metric(
        name="completed",
        title="Nominal completed",
        group="sent",
        count=_over(_nominal, lambda case: case.seen.outcome == "completed" and case.seen.as_expected),
    ),
)


def tabulate(
    observations: Sequence[Observation], scenarios: Iterable[Scenario], rules: Mapping[str, Rules], seed: int
) -> tuple[Table, ...]:
    """A table for each testbed, in the order of their names. `seed` is the bootstrap's.

    Raises UsageError for no observations, mixed versions, planners or models, doubles, and unknown scenarios.
    """
    if not observations:
        raise UsageError("there are no observations to count; run the study first")
    everything = cases(observations, scenarios, rules)
    testbeds = sorted({o.testbed for o in observations})
    return tuple(_table(name, [c for c in everything if c.seen.testbed == name], seed) for name in testbeds)


def _table(testbed: str, members: Sequence[Case], seed: int) -> Table:
    seen = members[0].seen
    present = {case.seen.arm.value for case in members}
    columns = tuple(c for c in COLUMNS if c in present or (c == AFTER and ENFORCED in present))
    return Table(
        testbed=testbed,
        version=seen.version,
        planner=seen.planner,
        model=seen.model,
        seeds=tuple(sorted({case.seen.seed for case in members})),
        scenarios=len({case.seen.scenario for case in members}),
        columns=columns,
        fractions=tuple(_fractions(members, columns, seed)),
        spreads=tuple(_spreads(members, columns)),
        unplanned={arm: sum(not _readable(c.seen.first) for c in _of(arm, members)) for arm in sorted(present)},
        needless=tuple(_run(c) for c in members if _nominal(c) and c.right and c.ended_by_gate),
        asked=tuple(_run(c) for c in members if _nominal(c) and c.seen.question),
    )


def _of(column: str, members: Sequence[Case]) -> list[Case]:
    arm = ENFORCED if column == AFTER else column
    return [case for case in members if case.seen.arm.value == arm]


def _fractions(members: Sequence[Case], columns: Sequence[str], seed: int) -> Iterable[Fraction]:
    for metric in METRICS:
        shown = [c for c in columns if metric.group == "proposed" or c != AFTER]
        counted = {column: _count(metric, column, members) for column in shown}
        totals = {c: (sum(r.hits for r in runs), sum(r.trials for r in runs)) for c, runs in counted.items()}
        for column, runs in counted.items():
            hits, trials = totals[column]
            compared = column != ENFORCED and column != AFTER and ENFORCED in totals
            yield Fraction(
                metric=metric.name,
                column=column,
                hits=hits,
                trials=trials,
                wilson=wilson(hits, trials),
                bootstrap=bootstrap(_by_scenario(runs), seed),
                p=fisher(totals[ENFORCED], (hits, trials)) if compared else float("nan"),
                runs=runs,
            )


def _count(metric: Metric, column: str, members: Sequence[Case]) -> tuple[Run, ...]:
    found = []
    for case in _of(column, members):
        plan = case.last if column == AFTER else case.seen.first
        share = metric.count(case, plan)
        if share is not None:
            found.append(_run(case, *share))
    return tuple(found)


def _run(case: Case, hits: int = 0, trials: int = 0, value: float | None = None) -> Run:
    seen = case.seen
    return Run(run=seen.run, scenario=seen.scenario, seed=seen.seed, hits=hits, trials=trials, value=value)


def _by_scenario(runs: Iterable[Run]) -> dict[str, tuple[int, int]]:
    found: dict[str, tuple[int, int]] = {}
    for run in runs:
        hits, trials = found.get(run.scenario, (0, 0))
        found[run.scenario] = (hits + run.hits, trials + run.trials)
    return found


def _spreads(members: Sequence[Case], columns: Sequence[str]) -> Iterable[Spread]:
    for column in columns:
        mine = _of(column, members)
        after = column == AFTER
        yield _spread("planning_latency", column, "s", [(c, _latency_s(c, after)) for c in mine])
        if not after:
            yield _spread("fix_error", column, "m", [(c, c.seen.fix_error_m) for c in mine])
            yield _spread("delivery_error", column, "m", [(c, c.seen.goal_error_m) for c in mine])


def _latency_s(case: Case, after: bool) -> float | None:
    proposals = case.seen.proposals if after else case.seen.proposals[:1]
    return sum(p.latency_s for p in proposals) if proposals else None


def _spread(metric: str, column: str, unit: str, values: Iterable[tuple[Case, float | None]]) -> Spread:
    runs = tuple(_run(case, value=value) for case, value in values if value is not None)
    numbers = [run.value for run in runs if run.value is not None]
    mean, deviation = mean_and_deviation(numbers)
    largest = max(numbers, default=float("nan"))
    return Spread(metric=metric, column=column, unit=unit, mean=mean, deviation=deviation, largest=largest, runs=runs)
