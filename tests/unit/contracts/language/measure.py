"""The table of docs/planner.md: what becomes of requests in many people's wording, with Wilson's intervals of 95%.

`python -m tests.unit.contracts.language.measure FILE PART [--list]`; only with `--list` is any request shown.
"""

import sys
from math import sqrt
from typing import NamedTuple

from crew.library import load_rules
from tests.unit.contracts.language.corpus import Request, compared, corpus, judge

CREWS = {"air": "air_ground", "indoor": "humanoid_quadruped"}
Z_95 = 1.96


class Judgement(NamedTuple):
    """A request with what became of it."""

    request: Request
    outcome: str
    right: bool
    told: str

    @property
    def taken(self) -> bool:
        return self.outcome == "accepted" and not self.right


class Tally(NamedTuple):
    """Counts over one set."""

    requests: int
    right: int
    possible: int
    asked: int
    refused: int
    taken: int

    @property
    def needless(self) -> float:
        """Share of what could be carried out and was refused; asking back counts half."""
        return (self.refused + self.asked / 2) / self.possible if self.possible else 0.0


def judged(file: str, part: str) -> list[Judgement]:
    """Every request of one part of a file, over both crews."""
    found = []
    for prefix, crew in CREWS.items():
        rules = load_rules(crew)
        for request in corpus(f"{prefix}_{part}", file):
            outcome = judge(request.text, rules, request.state)
            wrong = compared(request, outcome, rules)
            spared = request.outcome == "refused" and outcome.outcome in ("refused", "question")
            found.append(Judgement(request, outcome.outcome, spared or not wrong, wrong))
    return found


def tally(found: list[Judgement]) -> Tally:
    possible = [j for j in found if j.request.outcome == "accepted"]
    outcomes = [j.outcome for j in possible]
    return Tally(
        requests=len(found),
        right=sum(j.right for j in found),
        possible=len(possible),
        asked=outcomes.count("question"),
        refused=outcomes.count("refused"),
        taken=sum(j.taken for j in found),
    )


def wilson(share: float, of: int) -> tuple[float, float]:
    """Wilson's interval of 95% for a share of so many."""
    centre, spread = share + Z_95**2 / (2 * of), Z_95 * sqrt(share * (1 - share) / of + Z_95**2 / (4 * of**2))
    return (centre - spread) / (1 + Z_95**2 / of), (centre + spread) / (1 + Z_95**2 / of)


def row(count: Tally) -> str:
    """One row of the table."""
    right = count.right / count.requests
    parts = []
    for share, of in ((right, count.requests), (count.needless, count.possible)):
        low, high = wilson(share, of)
        parts.append(f"{share:.0%} ({low * 100:.0f}-{high * 100:.0f})")
    seen = f"{count.possible} possible: asked {count.asked}, refused {count.refused}"
    return f"{count.requests} | {parts[0]} | {parts[1]} | {count.taken} | {seen}"


if __name__ == "__main__":
    file, part, *options = sys.argv[1:]
    every = judged(file, part)
    print(row(tally(every)))
    for one in every if "--list" in options else ():
        if not one.right:
            print(f"{one.request.outcome}: {one.request.text}\n    {one.told}")
