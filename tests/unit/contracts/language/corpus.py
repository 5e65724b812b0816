"""The corpus of requests and the judgement of one of them: propose, check arguments, match, check containment."""

from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

import msgspec
from ruamel.yaml import YAML

from crew.actors.planner.embedded import Abstention, PlannerState, propose
from crew.contracts.gate.arguments import check_call
from crew.contracts.language.containment import check_containment, check_reading
from crew.contracts.language.lexicon import lexicon_of
from crew.contracts.language.reading import read_request
from crew.contracts.matching import match
from crew.contracts.plan import Instance, Plan, SlotValue, Spot, Zone
from crew.contracts.refusal import Refusal
from crew.contracts.site import Rules

ON_GROUND = PlannerState(airborne={"iris": False})


class Request(msgspec.Struct, frozen=True, kw_only=True):
    """One line of the corpus."""

    text: str
    outcome: str
    contract: str = ""
    slots: Mapping[str, Any] = {}
    code: str | list[str] = []
    unread: list[str] = []
    missed: bool = False
    """Could be accepted, but is not read yet."""
    near: bool | None = None
    """Whether the person who asks is in reach, as far as the planner knows."""

    @property
    def state(self) -> PlannerState:
        return msgspec.structs.replace(ON_GROUND, requester_near=self.near)

    @property
    def codes(self) -> list[str]:
        return [self.code] if isinstance(self.code, str) else self.code


class Judged(msgspec.Struct, frozen=True, kw_only=True):
    """What became of a request."""

    outcome: str
    code: str = ""
    why: str = ""
    plan: Plan | None = None
    instance: Instance | None = None


def corpus(half: str, file: str = "requests_air_ground.yaml") -> list[Request]:
    return msgspec.convert(_halves(file)[half], list[Request])


@cache
def _halves(file: str) -> Mapping[str, Any]:
    return YAML(typ="safe").load((Path(__file__).parent / file).read_text(encoding="utf-8"))  # type: ignore[no-any-return]


def judge(text: str, rules: Rules, state: PlannerState = ON_GROUND) -> Judged:
    """The embedded planner's plan under the checks that need no robots."""
    plan = propose(text, rules, state)
    if isinstance(plan, Abstention):
        finding = check_reading(read_request(text, lexicon_of(rules)))
        return Judged(outcome="refused", code=finding.code if finding else "", why=plan.reason)
    return judge_plan(text, plan, rules)


def judge_plan(text: str, plan: Plan, rules: Rules) -> Judged:
    """Any plan under the checks that need no robots."""
    refusal = next((r for call in plan.steps if (r := check_call(call, rules))), None)
    instance = match(plan, rules) if refusal is None else refusal
    if isinstance(instance, Refusal):
        return Judged(outcome="refused", code=instance.code, why=instance.message, plan=plan)
    reading = read_request(text, lexicon_of(rules))
    finding = check_containment(reading, instance, rules, confirmed=False)
    if finding is None:
        return Judged(outcome="accepted", plan=plan, instance=instance)
    told = check_containment(reading, instance, rules, confirmed=True)
    outcome = "question" if told is None else "refused"
    return Judged(outcome=outcome, code=finding.code, why=finding.message, plan=plan, instance=instance)


def value_of(written: object, rules: Rules) -> SlotValue:
    """A slot's value as the corpus writes it: a zone's name, `[x, y]`, `[x_min, x_max, y_min, y_max]`, or itself."""
    if isinstance(written, list):
        numbers = [float(n) for n in written]
        return Spot(*numbers) if len(numbers) == 2 else Zone(*numbers)
    zone = next((z.zone for z in rules.crew.zones if z.name == written), None)
    return zone if zone is not None else str(written) if isinstance(written, str) else float(str(written))


def mistake(request: Request, rules: Rules) -> str:
    """What is wrong with the outcome of a request; empty if it is right."""
    return compared(request, judge(request.text, rules, request.state), rules)


def compared(request: Request, judged: Judged, rules: Rules) -> str:
    """What of an outcome is not as the corpus has it; empty if all is."""
    if judged.outcome != request.outcome:
        return f"{judged.outcome} {judged.code} ({judged.why})"
    if request.codes and judged.code not in request.codes:
        return f"code {judged.code} ({judged.why})"
    if judged.instance is None or request.outcome == "refused":
        return ""
    if request.contract and judged.instance.contract != request.contract:
        return f"contract {judged.instance.contract}"
    wanted = {name: value_of(written, rules) for name, written in request.slots.items()}
    wrong = {
        name: judged.instance.slots.get(name) for name, v in wanted.items() if judged.instance.slots.get(name) != v
    }
    return f"slots {wrong}" if wrong else ""
