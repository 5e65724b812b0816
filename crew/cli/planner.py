"""`crew planner try`: one request planned and judged, without any robot and without any network."""

import os
from collections.abc import Mapping, Sequence
from typing import Any

import msgspec

from crew.actors.orchestrator.planning import requester_near
from crew.actors.planner.backend import answer
from crew.actors.planner.choice import check_choice
from crew.actors.planner.process import make_backend
from crew.actors.planner.retrieval import Library
from crew.actors.specs import PlannerChoice
from crew.cli.output import coloured, plan_lines, say, say_json
from crew.cli.session import run
from crew.contracts.gate.authorize import Gate
from crew.contracts.language.containment import check_reading
from crew.contracts.language.lexicon import build_lexicon
from crew.contracts.language.mention import Mention, Reading
from crew.contracts.language.reading import noted_lines, read_request
from crew.contracts.mission.provenance import sources
from crew.contracts.mission.validation import Validation, validate
from crew.contracts.mission_state import MissionState
from crew.contracts.plan import Plan
from crew.contracts.render.prompt import Context, Facts, build_prompt, registry_digest
from crew.contracts.site import Rules
from crew.contracts.skill import NOTHING
from crew.contracts.snapshot import STATUSES, Point, RobotState, Snapshot, Stamped, StampedValue, ValueReading
from crew.errors import UsageError, nearest
from crew.library import demo_request, load_rules
from crew.messages import PlannedStep, PlannerAsk

NOW_NS = 1_000_000_000


class TryResult(msgspec.Struct, frozen=True, kw_only=True):
    """What `crew planner try --json` prints; these fields stay."""

    proposal: Mapping[str, Any] | None
    reason: str
    mentions: list[Mapping[str, Any]]
    unread: list[str]
    noted: list[str]
    verdict: Mapping[str, Any]


def run_try(text: str, crew: str, choice: PlannerChoice, state: tuple[str, ...], as_json: bool) -> int:
    """0 if the plan is accepted, 3 if it is refused or a person would be asked."""
    return run(_try(text, crew, choice, state, as_json))


def run_prompt(text: str, crew: str, context: str, as_json: bool) -> int:
    """Print what a model would be shown, and the digests that travel with its proposal."""
    check_choice(PlannerChoice(context=context), os.environ)
    rules = load_rules(crew)
    text = text or demo_request(crew)
    prompt = build_prompt(text, Context(context), Library(rules).narrow(text), Facts(), previous=None, feedback=None)
    if as_json:
        digests = {"prompt_digest": prompt.digest, "schema_digest": prompt.schema_digest}
        say_json({**msgspec.to_builtins(prompt), **digests, "registry_digest": registry_digest(rules)})
        return 0
    say(coloured("--- system", "dim"))
    say(prompt.system.rstrip())
    say(coloured("--- tool", "dim"))
    say(msgspec.json.format(msgspec.json.encode(prompt.tool)).decode())
    for turn in prompt.turns:
        say(coloured(f"--- {turn['role']}", "dim"))
        say(turn["content"])
    return 0


async def _try(text: str, crew: str, choice: PlannerChoice, state: tuple[str, ...], as_json: bool) -> int:
    rules = load_rules(crew)
    backend = make_backend(choice, rules, os.environ)
    world = assumed(state, rules)
    reading = read_request(text, build_lexicon(rules))
    ask = PlannerAsk(
        mission="try",
        attempt=0,
        request=text,
        airborne={n: bool(r.fluents["airborne"].value) for n, r in world.robots.items() if "airborne" in r.fluents},
        values={n: v.reading.status for n, v in world.values.items()},
        requester_near=requester_near(world),
    )
    proposal = await answer(backend, ask, choice.name)
    mission = MissionState(id="try", request=text, reading=reading)
    verdict = None if proposal.plan is None else validate(proposal.plan, mission, world, rules, NOW_NS, Gate())
    accepted = verdict is not None and verdict.refusal is None and verdict.question is None
    if as_json:
        say_json(_result(proposal.plan, proposal.reason, reading, verdict))
    else:
        _say(proposal.plan, proposal.reason, reading, verdict, rules)
    return 0 if accepted else 3


def assumed(assignments: tuple[str, ...], rules: Rules) -> Snapshot:
    """A world from `robot.fluent=value` and `value.near=true`, `.at=place` or `.status=ok`. Raises UsageError."""
    robots = {r.name: _robot(r.name, rules) for r in rules.crew.robots}
    values: dict[str, StampedValue] = {}
    for text in assignments:
        path, equals, written = text.partition("=")
        head, _, attribute = path.partition(".")
        if not equals or not attribute:
            raise UsageError(f"--state {text!r} is no assignment; write <robot>.<fluent>=<value> or <value>.near=true")
        published = [v.name for v in rules.crew.values] + [o.name for o in rules.crew.objects]
        if head in robots:
            robots[head] = _with_fluent(robots[head], attribute, written, rules)
        elif head in published:
            values[head] = _with_attribute(values.get(head) or _value(head, rules), attribute, written, rules)
        else:
            known = [*robots, *published]
            raise UsageError(f"--state {text!r} names nothing of this crew{nearest(head, known)}")
    return Snapshot(robots=robots, values=values)


def _robot(name: str, rules: Rules) -> RobotState:
    """A healthy robot that waits for its first task."""
    kind = rules.kind_of(name)
    assert kind is not None
    fluents = {f.name: Stamped(f.resting, NOW_NS, NOW_NS) for f in kind.fluents if f.resting is not None}
    return RobotState(name=name, kind_digest=kind.digest, fluents=fluents)


def _with_fluent(robot: RobotState, name: str, written: str, rules: Rules) -> RobotState:
    kind = rules.kind_of(robot.name)
    assert kind is not None
    fluent = kind.fluent(name)
    if fluent is None:
        raise UsageError(f"{robot.name} has no fluent {name!r}{nearest(name, [f.name for f in kind.fluents])}")
    path = f"{robot.name}.{name}"
    value: bool | float | str
    if fluent.domain == "bool":
        value = _bool(path, written)
    elif fluent.domain == "number":
        value = _number(path, written)
    else:
        things = [o.name for o in rules.crew.objects] + [NOTHING]
        value = _one_of(path, written, things if fluent.domain == "object" else [p.name for p in rules.crew.locations])
    return msgspec.structs.replace(robot, fluents={**robot.fluents, name: Stamped(value, NOW_NS, NOW_NS)})


def _value(name: str, rules: Rules) -> StampedValue:
    area = rules.crew.area
    centre = Point((area.x_min + area.x_max) / 2, (area.y_min + area.y_max) / 2)
    source = min(rules.publishers_of(name), default="")
    return StampedValue(ValueReading(name=name, status="ok", position=centre, stamp_ns=NOW_NS), source, NOW_NS)


def _with_attribute(value: StampedValue, attribute: str, written: str, rules: Rules) -> StampedValue:
    reading, path = value.reading, f"{value.reading.name}.{attribute}"
    if attribute == "near":
        reading = msgspec.structs.replace(reading, near=_bool(path, written))
    elif attribute == "at":
        place = rules.crew.location(_one_of(path, written, [p.name for p in rules.crew.locations]))
        assert place is not None
        reading = msgspec.structs.replace(reading, position=Point(place.x, place.y))
    elif attribute == "status":
        status = _one_of(path, written, STATUSES)
        position = reading.position if status == "ok" else None
        reading = msgspec.structs.replace(reading, status=status, position=position)
    else:
        raise UsageError(f"{reading.name} has no attribute {attribute!r}{nearest(attribute, ['near', 'at', 'status'])}")
    return msgspec.structs.replace(value, reading=reading)


def _bool(path: str, written: str) -> bool:
    return _one_of(path, written, ("true", "false")) == "true"


def _number(path: str, written: str) -> float:
    try:
        return float(written)
    except ValueError as error:
        raise UsageError(f"--state {path}: {written!r} is no number") from error


def _one_of(path: str, written: str, valid: Sequence[str]) -> str:
    if written not in valid:
        raise UsageError(f"--state {path}: {written!r} is no value of it{nearest(written, valid)}")
    return written


def _result(plan: Plan | None, reason: str, reading: Reading, verdict: Validation | None) -> TryResult:
    return TryResult(
        proposal=None if plan is None else msgspec.to_builtins(plan),
        reason=reason,
        mentions=[_mention(m) for m in reading.mentions],
        unread=[u.word for u in reading.unread],
        noted=list(noted_lines(reading)),
        verdict=_verdict(verdict, reason, reading),
    )


def _mention(mention: Mention) -> Mapping[str, Any]:
    values = [msgspec.to_builtins(v) for v in mention.values]
    return {
        "span": mention.span,
        "text": mention.text,
        "kind": str(mention.kind),
        "polarity": "positive" if mention.positive else "negative",
        "direction": str(mention.direction),
        "value": None if not values else values[0] if len(values) == 1 else values,
    }


def _verdict(verdict: Validation | None, reason: str, reading: Reading) -> Mapping[str, Any]:
    if verdict is None:
        finding = check_reading(reading)
        code, more = (None, "") if finding is None else (str(finding.code), f"; {finding.message}")
        return {"accepted": False, "code": code, "message": f"no plan: {reason}{more}", "question": None}
    if verdict.refusal is not None:
        return {
            "accepted": False,
            "code": str(verdict.refusal.code),
            "message": verdict.refusal.message,
            "field": verdict.refusal.field,
            "question": None,
        }
    if verdict.question is not None:
        return {
            "accepted": False,
            "code": "unread_words",
            "message": "a person is asked",
            "question": verdict.question.text,
        }
    return {"accepted": True, "code": None, "message": "accepted", "question": None}


def _say(plan: Plan | None, reason: str, reading: Reading, verdict: Validation | None, rules: Rules) -> None:
    say("the request as it was read:")
    for mention in reading.mentions:
        sign = "" if mention.positive else "not "
        direction = f" ({mention.direction})" if mention.direction != "none" else ""
        say(f"  {mention.text!r:28} {sign}{mention.kind}: {mention.name}{direction}")
    for unread in reading.unread:
        say(f"  {unread.word!r:28} " + (f"asked back: read as {unread.meant!r}" if unread.meant else "not understood"))
    for noted in reading.noted:
        say(f"  {noted.word!r:28} " + (f"read as {noted.meant!r}" if noted.meant else "left out as no request"))
    for doubt in reading.ambiguous:
        say(f"  {reading.text[slice(*doubt.span)]!r:28} ambiguous: {doubt.why}")
    if plan is not None:
        say(f"the plan: {plan.contract}")
        for line in plan_lines(_planned(plan, reading, verdict, rules)):
            say(f"  {line}")
    result = _verdict(verdict, reason, reading)
    colour = "green" if result["accepted"] else "amber" if result["question"] else "red"
    code = f"{result['code']}: " if result["code"] else ""
    say(coloured(f"verdict: {code}{result['question'] or result['message']}", colour))


def _planned(plan: Plan, reading: Reading, verdict: Validation | None, rules: Rules) -> list[PlannedStep]:
    instance = None if verdict is None else verdict.instance
    if instance is None:
        return [PlannedStep(step="?", robot=c.robot, skill=c.skill, args=c.args) for c in plan.steps]
    return [
        PlannedStep(
            step=s.step,
            robot=s.call.robot,
            skill=s.call.skill,
            args=s.call.args,
            sources=sources(s, instance, reading, rules),
        )
        for s in instance.steps
    ]
