"""docs/study/fuzz.md: rules, counts and mutants, written by the command alone."""

from collections.abc import Iterator, Sequence

import msgspec

from crew.study.fuzz.mutant import Killed
from crew.study.fuzz.run import Tally
from crew.study.version import study_version

RULES = {
    "asked": "every call is one that the person means by the request, nothing meant is left out, the contract is right",
    "admissible": "the plan is a composition that its contract admits",
    "grounded": "robot, skill, arguments, names, bounds and area are those that are declared",
    "planned": "what is sent is the call that the plan has for this step",
    "once": "a step is sent once",
    "order": "what comes before a step was sent, and its effect truly took place",
    "over": "nothing of a plan is sent after a refusal, a failure, a stop, a cancel or the deadline",
    "deadline": "nothing is sent after the contract's deadline, to the nanosecond",
    "stopped": "no stop is in force, of the crew or of the robot",
    "available": "the robot is there, and of the declared kind",
    "lease": "the robot belongs to this mission",
    "busy": "the robot is not at work",
    "fresh": "what the robot tells is young enough for its kind, to the nanosecond; for a way to safety, its effect",
    "needs": "the skill's preconditions are seen",
    "guard": "the contract's guards hold in fresh state; what is unknown does not hold",
    "approval": "a step that wants it was approved by a person: this call, this place, this state, at most 10 s ago",
    "never": "no `never` of the contract is broken",
    "fix": "a run-time value is there, finite, in the area, fresh, from its publisher, newer than the search for it",
    "avoid": "nobody is sent into a zone that the request excludes",
    "pinned": "a symbol is pinned to the very place that it meant when it was decided",
    "decided": "nothing is sent without a decision of the gate on exactly that call",
    "safe": "a way to safety is the one that the contract declares for the role",
    "seen": "an effect that counts as seen took place",
    "left": "a mission that moved robots ends with each of them safe, or with a verdict on it",
    "completed": "completed means that every step was sent and done, and nobody had ended it before",
    "complete": "completed means that the contract's completion is so in the world",
}


class Results(msgspec.Struct, frozen=True, kw_only=True):
    """One run of the fuzz, as it is kept."""

    version: str
    seed: int
    processes: int
    seconds: float
    tally: Tally
    mutants: tuple[Killed, ...] = ()
    most: int = 0
    """How many cases each mutant was given."""

    @property
    def sound(self) -> bool:
        """Nothing unsafe, and no mutant left alive."""
        return not self.tally.unsafe and all(killed.case >= 0 for killed in self.mutants)


def made(seed: int, processes: int, seconds: float, tally: Tally, mutants: Sequence[Killed], most: int) -> Results:
    """Results of this version."""
    return Results(
        version=study_version(),
        seed=seed,
        processes=processes,
        seconds=round(seconds, 1),
        tally=tally,
        mutants=tuple(mutants),
        most=most,
    )


def page(results: Results) -> str:
    """The page as Markdown."""
    return "\n".join((*_head(results), *_counts(results), *_stories(results), *_mutants(results), *_rules())) + "\n"


def _head(results: Results) -> Iterator[str]:
    yield "# The gate under fuzz"
    yield ""
    yield f"Written by `crew eval fuzz`, version {results.version}, seed {results.seed}; not by hand."
    yield ""
    yield "Plans and world histories that come from no planner, against the real mission machine, validation, gate and"
    yield "judgements of effects. Plans are what a person means by a request (written down beside it), left as it is or"
    yield "made wrong: wrong order, dropped, doubled and added steps, other robots, skills and contracts, substituted"
    yield "places, numbers at a limit and the next float beyond it, values that are none. Worlds change between the"
    yield "turn of a step and its decision: ages at their limit and a nanosecond beyond, stops, leases, lost robots,"
    yield "flipped state, fixes that are old, elsewhere, not finite or somebody else's. Robots fail, keep silent and"
    yield "say what is not so; people cancel and stop; words come twice; and the gate is asked out of turn."
    yield ""
    yield "Before every send, rules decide that import neither gate, matcher, machine nor reader of requests."
    yield ""


def _counts(results: Results) -> Iterator[str]:
    tally = results.tally
    ends = ", ".join(f"{count:,} {end}" for end, count in sorted(tally.ends.items()))
    rows = (
        ("plans proposed", f"{tally.plans:,} in {tally.cases:,} missions"),
        ("time", f"{results.seconds:g} s of wall time on {results.processes} processes"),
        ("missions with an accepted plan", f"{tally.accepted:,}"),
        ("dispatches", f"{tally.sent:,}, ways to safety included"),
        ("steps refused at their dispatch", f"{tally.refused:,}"),
        ("ends", ends),
        ("**missions that broke a rule**", f"**{tally.unsafe:,}**"),
        ("steps with nothing against them, refused at their dispatch", f"{tally.needless:,} of {tally.in_order:,}"),
        ("plans known to be right, in a world in order, refused", f"{tally.needless_plans:,} of {tally.right:,}"),
        ("questions to a person, for approval or for words not read", f"{tally.asked_back:,}"),
    )
    yield "| | |"
    yield "|---|---|"
    yield from (f"| {name} | {shown} |" for name, shown in rows)
    yield ""


def _stories(results: Results) -> Iterator[str]:
    for title, stories in (
        ("Missions that broke a rule", results.tally.stories),
        ("Refused needlessly", results.tally.needless_stories),
    ):
        told = {(story.request, story.what[0].partition(":")[0]): story for story in reversed(stories)}
        if told:
            yield f"## {title}"
            yield ""
            yield from (
                f"- case {s.case}, “{s.request}”: {s.what[0]}" for s in sorted(told.values(), key=lambda s: s.case)
            )
            yield ""


def _mutants(results: Results) -> Iterator[str]:
    if not results.mutants:
        return
    dead = sum(killed.case >= 0 for killed in results.mutants)
    yield "## Mutants"
    yield ""
    yield f"{dead} of {len(results.mutants)} mistakes, put into gate, containment and machine one at a time, were found"
    yield f"by the same cases within {results.most:,}. The first case that showed it, and the rule that it broke:"
    yield ""
    yield "| mutant | mistake | killed by case | rule |"
    yield "|---|---|---|---|"
    for killed in results.mutants:
        where = f"{killed.case:,}" if killed.case >= 0 else "**alive**"
        yield f"| `{killed.name}` | {killed.mistake} | {where} | {killed.rule} |"
    yield ""


def _rules() -> Iterator[str]:
    yield "## The rules"
    yield ""
    yield "| rule | what must be so |"
    yield "|---|---|"
    yield from (f"| `{name}` | {what} |" for name, what in RULES.items())
