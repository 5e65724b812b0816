"""Whether everything that the request names has its place in the plan."""

from crew.contracts.codes import Code
from crew.contracts.language.finding import Case, Finding
from crew.contracts.language.licence import claims, fits, resolved, same, used_slots
from crew.contracts.language.mention import ROBOT_KINDS, Direction, Mention, MentionKind, Reading
from crew.contracts.plan import SlotValue


def uncovered(case: Case) -> Finding | None:
    """Everything that the request names has its place in the plan."""
    values = _present(case)
    acting = {item.call.robot for item in case.instance.steps}
    for mention in case.reading.wanted:
        if mention.kind is MentionKind.ACTION or _is_loose(case.reading, mention):
            continue
        if mention.kind in ROBOT_KINDS:
            covered = acting >= set(mention.values) if mention.every else bool(acting & set(mention.values))
        else:
            covered = _holds(case, mention, values)
        if not covered and not _claimed(case, mention):
            message = f"'{mention.text}' in the request ({mention.name}) has no place in the plan; plan it or ask back"
            return Finding(code=Code.REQUEST_DROPPED, message=message, field="request", span=mention.span)
    return None


def _is_loose(reading: Reading, mention: Mention) -> bool:
    """A name that nobody knows and that is neither a place nor what a verb is to be done with."""
    if mention.kind is not MentionKind.UNKNOWN or mention.direction is not Direction.NONE:
        return False
    at = reading.mentions.index(mention)
    return at == 0 or reading.mentions[at - 1].kind is not MentionKind.ACTION


def unknown(reading: Reading) -> Finding | None:
    """A name that nobody knows: no plan can have a place for it."""
    loose = next((m for m in reading.wanted if _is_loose(reading, m)), None)
    if loose is None:
        return None
    message = f"'{loose.text}' in the request is no name that this crew knows; confirm without it or rephrase"
    return Finding(code=Code.UNREAD_WORDS, message=message, field="request", span=loose.span)


def _present(case: Case) -> list[SlotValue]:
    """The values that calls carry, that they publish, and that the contract's entry guards speak of."""
    crew = case.rules.crew
    found: list[SlotValue] = []
    for name in used_slots(case.instance, case.contract):
        slot, value = case.contract.slot(name), case.instance.slots.get(name)
        if slot is not None and value is not None:
            found.append(resolved(value, slot, crew))
    for item in case.instance.steps:
        kind = case.rules.kind_of(item.call.robot)
        skill = kind.skill(item.call.skill) if kind is not None else None
        found.extend(skill.reports if skill is not None else ())
    roots = {condition.path.partition(".")[0] for condition in case.contract.needs if not condition.when}
    return [*found, *(v.name for v in crew.values if v.name in roots)]


def _holds(case: Case, mention: Mention, values: list[SlotValue]) -> bool:
    """Whether the plan carries what a mention names; a place given as an origin is not honoured by going there."""
    fixed = _constants(case)
    if mention.direction is Direction.TO:
        fixed &= set(case.rules.parts)
    if any(v in fixed for v in mention.values):
        return True
    return mention.direction is not Direction.FROM and any(same(v, p) for v in mention.values for p in values)


def _constants(case: Case) -> set[str]:
    """Names that the contract itself writes into the calls, such as a fixed place for loading."""
    declared = [case.contract.step(item.step) for item in case.instance.steps]
    literals = {str(v) for step in declared if step is not None for p in step.do for v in p.args.values()}
    return literals & {str(v) for item in case.instance.steps for v in item.call.args.values()}


def _claimed(case: Case, mention: Mention) -> bool:
    """Whether the mention binds a slot that no call carries (a claimed origin)."""
    bound = claims(case.reading, case.contract, case.rules)
    slots = [s for s in case.contract.slots if s.name in bound and s.said_from and fits(mention, s)]
    return any(same(v, bound[s.name]) for s in slots for v in mention.values)
