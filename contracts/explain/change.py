"""The smallest change that would have been accepted: a bounded search over small edits, each judged by the gate."""

import heapq
from itertools import count

import msgspec

from crew.contracts.explain.case import Case, PlanCase
from crew.contracts.explain.edit import Edit
from crew.contracts.explain.plan_edits import plan_edits
from crew.contracts.explain.request_edits import request_edits
from crew.contracts.explain.world_edits import world_edits
from crew.contracts.mission.validation import Validation
from crew.contracts.plan import digest
from crew.contracts.refusal import Refusal

MAX_TRIED = 400
"""Cases that are judged before the search gives up."""
MAX_EDITS = 4


class Change(msgspec.Struct, frozen=True, kw_only=True):
    """Edits that together turn a refusal into an acceptance; the gate was asked. `tried`: how many cases it judged."""

    edits: tuple[str, ...]
    tried: int
    question: str = ""
    """What a person would still be asked."""

    def __str__(self) -> str:
        return "; and ".join(self.edits)


def smallest_change(case: Case) -> Change | None:
    """The smallest accepted change that the search finds, or None; also None for a case that is accepted as it is."""
    edits, tried = accepted_edits(case)
    if not edits:
        return None
    verdict = edits[-1].case.judge()
    asked = verdict.question if isinstance(verdict, Validation) else None
    texts = tuple(edit.text for edit in edits)
    return Change(edits=texts, tried=tried, question="" if asked is None else asked.text)


def accepted_edits(case: Case) -> tuple[tuple[Edit, ...], int]:
    """The edits, of which the last leads to a case that the gate accepts, and how many cases it judged.

    Edits answer the refusal at hand and are tried by their summed size, so that what is found first is smallest.
    """
    order = count()
    waiting: list[tuple[float, int, tuple[Edit, ...], Case]] = [(0.0, next(order), (), case)]
    seen = {_identity(case)}
    tried = 0
    while waiting and tried < MAX_TRIED:
        size, _, edits, candidate = heapq.heappop(waiting)
        tried += 1
        refusal = candidate.judge().refusal
        if refusal is None:
            return edits, tried
        if len(edits) >= MAX_EDITS:
            continue
        for edit in _candidates(candidate, refusal):
            identity = _identity(edit.case)
            if identity not in seen:
                seen.add(identity)
                heapq.heappush(waiting, (size + edit.size, next(order), (*edits, edit), edit.case))
    return (), tried


def _candidates(case: Case, refusal: Refusal) -> list[Edit]:
    found = [*world_edits(case, refusal), *request_edits(case, refusal)]
    return [*plan_edits(case, refusal), *found] if isinstance(case, PlanCase) else found


def _identity(case: Case) -> str:
    """Two cases that the gate can't tell apart. The rules never change."""
    return digest(msgspec.structs.asdict(case) | {"rules": 0})
