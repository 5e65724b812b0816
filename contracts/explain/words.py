"""The words of the request that a decision turns on."""

from collections.abc import Iterator, Mapping

import msgspec

from crew.contracts.codes import GROUP_OF, Group
from crew.contracts.explain.case import CallCase, Case, finding_of
from crew.contracts.language.licence import slots_in
from crew.contracts.language.mention import Mention, MentionKind
from crew.contracts.plan import Call, SlotValue
from crew.contracts.refusal import Refusal


class Words(msgspec.Struct, frozen=True, kw_only=True):
    """A part of the request. `span` is in characters of its text."""

    span: tuple[int, int]
    text: str
    why: str


def words_involved(case: Case, refusal: Refusal | None) -> tuple[Words, ...]:
    """The words that a refusal of containment names; otherwise those that the judged call comes from."""
    if refusal is not None and GROUP_OF[refusal.code] is Group.CONTAINMENT:
        finding = finding_of(case)
        span = None if finding is None or finding.code is not refusal.code else finding.span
        if span is not None:
            return (Words(span=span, text=case.mission.request[slice(*span)], why="what the refusal speaks of"),)
    call = _call(case, refusal)
    return () if call is None else tuple(_origins(call, case))


def _call(case: Case, refusal: Refusal | None) -> Call | None:
    """The call that is spoken of: of a plan, the one that the refusal's field names."""
    if isinstance(case, CallCase):
        return case.call
    index = step_index(refusal)
    return case.plan.steps[index] if index is not None and index < len(case.plan.steps) else None


def step_index(refusal: Refusal | None) -> int | None:
    """The index in `steps[2].args.x`; None if the field names no step."""
    head, bracket, rest = ("", "", "") if refusal is None else refusal.field.partition("[")
    number = rest.partition("]")[0]
    return int(number) if head == "steps" and bracket and number.isdigit() else None


def _origins(call: Call, case: Case) -> Iterator[Words]:
    carried = _carried(call, case)
    for mention in case.mission.reading.mentions:
        why = _why(mention, call, carried)
        if why:
            yield Words(span=mention.span, text=mention.text, why=why)


def _carried(call: Call, case: Case) -> dict[str, SlotValue]:
    """What a call carries, by argument; a zone or a point under the name of its slot."""
    carried: dict[str, SlotValue] = dict(call.args)
    if (instance := case.instance) is not None and (contract := case.rules.contracts.get(instance.contract)):
        steps = [contract.step(item.step) for item in instance.steps if item.call == call]
        patterns = [pattern for step in steps if step is not None for pattern in step.do]
        slots = {name for pattern in patterns for name in slots_in(pattern.args.values())}
        carried |= {name: value for name, value in instance.slots.items() if name in slots}
    return carried


def _why(mention: Mention, call: Call, carried: Mapping[str, SlotValue]) -> str:
    """What a mention has to do with a call; empty if nothing."""
    if mention.kind is MentionKind.ACTION:
        return "asks for the skill" if any(ref.skill == call.skill for ref in mention.means) else ""
    if call.robot in mention.values:
        return "names the robot"
    names = {name for name, value in carried.items() if value in mention.values}
    if names:
        return f"names {', '.join(sorted(names & set(call.args) or names))}"
    unresolved = mention.kind is MentionKind.UNKNOWN and mention.name in carried.values()
    return "is no name that this crew knows" if unresolved else ""
