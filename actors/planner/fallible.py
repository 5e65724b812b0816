"""A model of errors: correct plans, corrupted by chance. It stands for no language model, and every proposal says so.

Each error is drawn at the rate that `fallible_rates.json` gives for the context; the same seed, request, context and
attempt give the same plan. `docs/planner.md` describes the errors.
"""

import hashlib
import re
from collections.abc import Callable, Iterator, Sequence
from functools import cache
from importlib.resources import files
from random import Random

import msgspec

from crew.actors.planner.embedded import Abstention, PlannerState, propose
from crew.contracts.gate.arguments import bounds
from crew.contracts.plan import ArgValue, Call, Plan
from crew.contracts.render.prompt import Context
from crew.contracts.site import Rules
from crew.contracts.skill import Entity, Param, Skill
from crew.errors import CrewError
from crew.messages import PlannerAsk, PlannerProposal

NAME = "fallible"
LABEL = "a model of errors, not a language model"
NEGATION = re.compile(r"\b(?:do not|don'?t|never|not|without|except(?: for)?|but no)\b", re.IGNORECASE)
INVENTED = ("scan_environment", "detect_victim", "go_to_goal", "move_forward", "transport_item", "notify_operator")
SYNONYMS = {
    "altitude": "height",
    "target": "destination",
    "location": "place",
    "object": "item",
    "x": "lon",
    "y": "lat",
}
OUTSIDE_M = 25.0
"""How far beyond a bound a wrong number may lie, metres."""


class Rates(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Probabilities: the first five of each step, the others of each plan."""

    invented_skill: float
    wrong_argument: float
    wrong_robot: float
    substituted_place: float
    substituted_unknown_place: float
    wrong_order: float
    dropped_step: float
    wrong_contract: float
    disregarded_negation: float

    def scaled(self, factor: float) -> "Rates":
        return Rates(*(getattr(self, name) * factor for name in self.__struct_fields__))


class ErrorModel(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The rates file. `after_feedback` multiplies every rate when a refused plan is made anew."""

    about: str
    after_feedback: float
    contexts: dict[str, Rates]


class Corrupted(msgspec.Struct, frozen=True):
    """A plan with the errors that were put into it, such as `wrong_argument in step 2`; none if it is left correct."""

    plan: Plan | None
    errors: tuple[str, ...] = ()
    reason: str = ""


@cache
def shipped() -> ErrorModel:
    """The error model that is shipped. Raises CrewError if its file is damaged."""
    text = files("crew.actors.planner").joinpath("fallible_rates.json").read_text(encoding="utf-8")
    try:
        return msgspec.json.decode(text, type=ErrorModel)
    except msgspec.MsgspecError as error:
        raise CrewError(f"fallible_rates.json: {error}") from error


class FallibleBackend:
    """The embedded planner's plans, corrupted. `seed` is the crew's."""

    def __init__(self, rules: Rules, context: Context, seed: int, model: ErrorModel | None = None) -> None:
        self._rules, self._context, self._seed = rules, context, seed
        self._model = shipped() if model is None else model

    async def propose(self, ask: PlannerAsk) -> PlannerProposal:
        state = PlannerState(airborne=ask.airborne, values=ask.values, requester_near=ask.requester_near)
        made = self.plan(ask.request, state, ask.attempt)
        told = f"{LABEL}: {', '.join(made.errors) or 'no error drawn'}"
        return PlannerProposal(
            mission=ask.mission, attempt=ask.attempt, planner=NAME, plan=made.plan, reason=made.reason, remark=told
        )

    def plan(self, request: str, state: PlannerState, attempt: int = 0) -> Corrupted:
        """The plan for one attempt, with the errors that were drawn."""
        chance = Random(_seed_of(self._seed, self._context, attempt, request))
        rates = self._model.contexts[self._context.value]
        if attempt:
            rates = rates.scaled(self._model.after_feedback)
        errors: list[str] = []
        heard = NEGATION.sub(" ", request)
        if chance.random() < rates.disregarded_negation and heard != request:
            errors.append("disregarded_negation")
        else:
            heard = request
        proposed = propose(heard, self._rules, state)
        if isinstance(proposed, Abstention):
            return Corrupted(None, tuple(errors), proposed.reason)
        return _corrupt(proposed, rates, self._rules, chance, errors)


def _seed_of(seed: int, context: Context, attempt: int, request: str) -> int:
    text = f"{seed}|{context.value}|{attempt}|{request}"
    return int.from_bytes(hashlib.sha256(text.encode()).digest()[:8], "big")


def _corrupt(plan: Plan, rates: Rates, rules: Rules, chance: Random, errors: list[str]) -> Corrupted:
    steps = list(plan.steps)
    if chance.random() < rates.dropped_step and len(steps) > 1:
        errors.append(f"dropped_step {steps.pop(chance.randrange(len(steps))).skill}")
    if chance.random() < rates.wrong_order and len(steps) > 1:
        at = chance.randrange(len(steps) - 1)
        steps[at], steps[at + 1] = steps[at + 1], steps[at]
        errors.append(f"wrong_order in steps {at} and {at + 1}")
    for index, call in enumerate(steps):
        for name, rate, change in _step_errors(call, rates, rules):
            if chance.random() < rate:
                changed = change(steps[index], rules, chance)
                if changed is not None and changed != steps[index]:
                    steps[index] = changed
                    errors.append(f"{name} in step {index}")
    contract = plan.contract
    others = sorted(set(rules.contracts) - {contract})
    if chance.random() < rates.wrong_contract and others:
        contract = chance.choice(others)
        errors.append(f"wrong_contract instead of {plan.contract}")
    return Corrupted(Plan(contract, tuple(steps)), tuple(errors))


Change = Callable[[Call, Rules, Random], Call | None]


def _step_errors(call: Call, rates: Rates, rules: Rules) -> Iterator[tuple[str, float, Change]]:
    """Every error that one step may get, always in this order, so that a rate changes no other draw."""
    unknown = any(_unknown(value, param, rules) for param, value in _named(call, rules))
    yield "substituted_place", rates.substituted_unknown_place if unknown else rates.substituted_place, _substitute
    yield "wrong_argument", rates.wrong_argument, _wrong_argument
    yield "wrong_robot", rates.wrong_robot, _wrong_robot
    yield "invented_skill", rates.invented_skill, _invent


def _substitute(call: Call, rules: Rules, chance: Random) -> Call | None:
    """Another place or object of the crew, where the step names one."""
    for param, value in _named(call, rules):
        others = [name for name in _names(param, rules) if name != value]
        if others:
            return Call(call.robot, call.skill, {**call.args, param.name: chance.choice(others)})
    return None


def _wrong_argument(call: Call, rules: Rules, chance: Random) -> Call:
    """An argument under another name, left out, outside its bounds, or one that does not exist."""
    if not call.args:
        return Call(call.robot, call.skill, {"speed": 1.0})
    name = chance.choice(sorted(call.args))
    value, rest = call.args[name], {k: v for k, v in call.args.items() if k != name}
    how = chance.randrange(3)
    if how == 0:
        return Call(call.robot, call.skill, {**rest, SYNONYMS.get(name, f"{name}_value"): value})
    if how == 1:
        return Call(call.robot, call.skill, rest)
    return Call(call.robot, call.skill, {**call.args, name: _outside(call, name, value, rules, chance)})


def _outside(call: Call, name: str, value: ArgValue, rules: Rules, chance: Random) -> ArgValue:
    """A number beyond its bound; a name with a word too many."""
    skill = _skill(call, rules)
    param = None if skill is None else skill.param(name)
    if param is None or isinstance(value, str):
        return f"{value}_site"
    return round(bounds(param, rules)[1] + chance.uniform(0.5, OUTSIDE_M), 1)


def _wrong_robot(call: Call, rules: Rules, chance: Random) -> Call | None:
    others = [robot.name for robot in rules.crew.robots if robot.name != call.robot]
    return Call(chance.choice(others), call.skill, call.args) if others else None


def _invent(call: Call, rules: Rules, chance: Random) -> Call:
    known = {skill.name for kind in rules.kinds.values() for skill in kind.skills}
    return Call(call.robot, chance.choice([name for name in INVENTED if name not in known]), call.args)


def _named(call: Call, rules: Rules) -> Sequence[tuple[Param, str]]:
    """The arguments of a call that name a place or an object."""
    skill = _skill(call, rules)
    params = () if skill is None else skill.params
    return [(p, v) for p in params if not p.is_number and isinstance(v := call.args.get(p.name), str)]


def _skill(call: Call, rules: Rules) -> Skill | None:
    kind = rules.kind_of(call.robot)
    return None if kind is None else kind.skill(call.skill)


def _unknown(value: str, param: Param, rules: Rules) -> bool:
    return value not in (*_names(param, rules), *rules.parts, *(v.name for v in rules.crew.values))


def _names(param: Param, rules: Rules) -> list[str]:
    crew = rules.crew
    return [thing.name for thing in (crew.objects if param.entity is Entity.OBJECT else crew.locations)]
