"""Whether an instance holds exactly what the request asks for: nothing added, nothing dropped, nothing excluded.

The reading's own defects come first: a request that can be read in two ways is no measure for a plan.
"""

from collections.abc import Iterator

from crew.contracts.codes import Code
from crew.contracts.language.along import left_behind
from crew.contracts.language.coverage import uncovered, unknown
from crew.contracts.language.exclusion import violation
from crew.contracts.language.finding import Case, Finding
from crew.contracts.language.licence import licensed_values, resolved, same, shown, used_slots
from crew.contracts.language.mention import Mention, MentionKind, Reading
from crew.contracts.plan import Instance, InstanceStep, SlotValue
from crew.contracts.site import Rules


def check_containment(reading: Reading, instance: Instance, rules: Rules, *, confirmed: bool) -> Finding | None:
    """The first finding, or None. `confirmed` lifts unread words and nothing else."""
    case = Case(reading, instance, rules.contracts[instance.contract], rules)
    return (
        unclear(reading)
        or _forbidden(case)
        or _licence(case)
        or _robots(case)
        or uncovered(case)
        or _asked(case)
        or _order(case)
        or _words(case)
        or _along(case)
        or (None if confirmed else unread(reading) or unknown(reading))
    )


def check_reading(reading: Reading) -> Finding | None:
    """What can be said against a request without any plan, for when no plan could be made."""
    found = unclear(reading)
    if found is not None:
        return found
    if not reading.actions and any(m.kind is MentionKind.ACTION for m in reading.excluded):
        first = reading.excluded[0]
        excluded = ", ".join(f"'{m.text}'" for m in reading.excluded)
        message = f"the request only excludes ({excluded}) and asks for nothing; say what to do"
        return Finding(code=Code.FORBIDDEN_BY_REQUEST, message=message, field="request", span=first.span)
    unknown = next((m for m in reading.wanted if m.kind is MentionKind.UNKNOWN), None)
    if unknown is not None:
        message = f"'{unknown.text}' in the request is no name that this crew knows; name one of the crew's own"
        return Finding(code=Code.REQUEST_DROPPED, message=message, field="request", span=unknown.span)
    return unread(reading)


def unclear(reading: Reading) -> Finding | None:
    """A request that can be read in more than one way."""
    if not reading.ambiguous:
        return None
    doubt = reading.ambiguous[0]
    text = reading.text[slice(*doubt.span)]
    message = f"the request can be read in more than one way at '{text}': {doubt.why}; say it in plain steps"
    return Finding(code=Code.AMBIGUOUS_REQUEST, message=message, field="request", span=doubt.span)


def unread(reading: Reading) -> Finding | None:
    """Words that nobody took into account."""
    if not reading.unread:
        return None
    words = ", ".join(map(str, reading.unread))
    message = f"not understood in the request: {words}; the plan cannot respect it; confirm without it or rephrase"
    return Finding(code=Code.UNREAD_WORDS, message=message, field="request", span=reading.unread[0].span)


def _forbidden(case: Case) -> Finding | None:
    for mention in case.reading.excluded:
        found = None if mention.aside else violation(mention, case.instance, case.contract, case.rules)
        if found is not None:
            field, observed = found
            message = f"the request excludes '{mention.text}' ({mention.name}); the plan has {observed}; leave it out"
            return Finding(code=Code.FORBIDDEN_BY_REQUEST, message=message, field=field, span=mention.span)
    return None


def _licence(case: Case) -> Finding | None:
    """The slot rule: what the request mentions, otherwise the default, otherwise the planner's choice if it is free."""
    for name, (index, arg) in used_slots(case.instance, case.contract).items():
        slot, value = case.contract.slot(name), case.instance.slots.get(name)
        if slot is None or value is None:
            continue
        allowed = licensed_values(case.reading, slot, case.rules)
        if allowed is None and slot.free:
            continue
        if allowed is None:
            allowed = () if slot.default is None else (resolved(slot.default, slot, case.rules.crew),)
        if not any(same(resolved(value, slot, case.rules.crew), a) for a in allowed):
            return _unlicensed(case, f"steps[{index}].args.{arg}", name, value, allowed)
    return None


def _unlicensed(case: Case, field: str, slot: str, value: SlotValue, allowed: tuple[SlotValue, ...]) -> Finding:
    names = tuple(shown(a, case.rules.crew) for a in allowed)
    observed = shown(value, case.rules.crew)
    said = next(
        (m for m in case.reading.wanted if any(same(v, a) for v in m.values or (m.name,) for a in allowed)), None
    )
    asked = f"the request names {' or '.join(names)}" if names else f"the request names no {slot}"
    message = f"the plan's {slot} is {observed}; {asked}; plan what was asked for"
    span = said.span if said is not None else None
    return Finding(code=Code.NOT_REQUESTED, message=message, field=field, span=span, allowed=names)


def _robots(case: Case) -> Finding | None:
    """A robot that was named for an action is the one that does it."""
    for action in case.reading.actions:
        for robot in case.reading.robots_of(action):
            steps = _meant(case, action)
            if steps and not any(item.call.robot in robot.values for _, item in steps):
                index, item = steps[0]
                names = tuple(str(v) for v in robot.values)
                message = (
                    f"the request wants {robot.name} to '{action.text}'; in the plan {item.call.robot} does it; "
                    f"allowed: {', '.join(names)}"
                )
                return Finding(
                    code=Code.NOT_REQUESTED,
                    message=message,
                    field=f"steps[{index}].robot",
                    span=robot.span,
                    allowed=names,
                )
    return None


def _asked(case: Case) -> Finding | None:
    """Steps that the person must have asked for; where a contract lists none, every step is such a step."""
    asked = {item.step for action in case.reading.actions for _, item in _assigned(case, action)}
    for index, item in enumerate(case.instance.steps):
        if item.step in asked or (case.contract.asks and item.step not in case.contract.asks):
            continue
        verbs = tuple(a.text for a in case.reading.actions)
        said = ", ".join(verbs) or "nothing"
        message = f"the plan has {item.call}, which the request does not ask for; it asks for: {said}"
        return Finding(code=Code.NOT_REQUESTED, message=message, field=f"steps[{index}]", allowed=verbs)
    return None


def _order(case: Case) -> Finding | None:
    """An order that the request states is kept."""
    for first, second in case.reading.orders:
        before, after = (case.reading.mentions[k] for k in (first, second))
        early = [k for k, _ in _meant(case, before)]
        late = [k for k, _ in _meant(case, after)]
        if early and early == late and before.means == after.means:
            message = (
                f"the request asks for '{before.text}' and '{after.text}' one after the other; the plan does it once"
            )
            return Finding(code=Code.REQUEST_DROPPED, message=message, field="steps", span=after.span)
        if early and late and max(late) < min(early):
            message = f"the request wants '{before.text}' before '{after.text}'; the plan does it the other way round"
            return Finding(
                code=Code.NOT_REQUESTED,
                message=message,
                field=f"steps[{late[0]}]",
                span=after.span,
                allowed=(before.text,),
            )
    return None


def _words(case: Case) -> Finding | None:
    """Every action that was asked for is a step of the plan."""
    for action in case.reading.actions:
        missing = _missing(case, action)
        if missing is not None:
            message = f"'{action.text}' in the request is not done by the plan ({case.contract.name}); {missing}"
            return Finding(code=Code.REQUEST_DROPPED, message=message, field="steps", span=action.span)
    return None


def _along(case: Case) -> Finding | None:
    """What the plan takes along was asked to go along."""
    thing = left_behind(case.reading, case.contract, case.rules)
    if thing is None:
        return None
    message = f"the request does not say that '{thing.text}' is to be taken along; say what is to be carried where"
    return Finding(code=Code.AMBIGUOUS_REQUEST, message=message, field="request", span=thing.span)


def _missing(case: Case, action: Mention) -> str | None:
    """What an action asks for that the plan lacks."""
    done = {item.step for _, item in _assigned(case, action)}
    if not done:
        return "plan a step that does it"
    named = {v for r in case.reading.robots_of(action) for v in r.values}
    for robot in case.reading.robots_of(action):
        if robot.every and not set(robot.values) <= {i.call.robot for _, i in _assigned(case, action)}:
            return f"it is asked of {robot.name}"
    if case.contract.asks or named:
        return None
    wanted = {ref.step for ref in action.means if ref.contract == case.contract.name and ref.own}
    absent = sorted(wanted - done)
    return f"it also means {', '.join(absent)}" if absent else None


def _meant(case: Case, action: Mention) -> list[tuple[int, InstanceStep]]:
    """The steps of the plan that an action word can mean."""
    meant = {(ref.step, ref.skill) for ref in action.means if ref.contract == case.contract.name}
    return [(k, item) for k, item in enumerate(case.instance.steps) if (item.step, item.call.skill) in meant]


def _assigned(case: Case, action: Mention) -> Iterator[tuple[int, InstanceStep]]:
    """The steps that an action word means here, narrowed to the robots that were named for it."""
    named = {v for r in case.reading.robots_of(action) for v in r.values}
    return ((k, item) for k, item in _meant(case, action) if not named or item.call.robot in named)


__all__ = ["Finding", "check_containment", "check_reading", "licensed_values"]
