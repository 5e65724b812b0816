"""Slots that no step reads, and claims that nobody compares."""

from collections.abc import Iterator

from crew.contracts.contract import Condition, Contract
from crew.contracts.language.licence import slots_in
from crew.contracts.odd.fact import skills_of
from crew.contracts.odd.oddity import Oddity, Written
from crew.contracts.site import Rules


def odd_slots(of: Written, rules: Rules) -> Iterator[Oddity]:
    """Slots of one contract that change nothing."""
    contract = of.contract
    calls = ((step.role, call.skill) for step in contract.steps for call in step.do)
    reported = {value for role, name in calls for k in skills_of(role, name, contract, rules) for value in k.reports}
    carried = {n for step in contract.steps for call in step.do for n in slots_in(call.args.values())}
    compared = {name for condition in _conditions(contract) for name in _named(condition)}
    for slot in contract.slots:
        if slot.name in carried or set(slot.values) & reported:
            continue
        loc = ("slots", slot.name)
        if slot.said_from and slot.name not in compared:
            what = f"the claim {slot.name} is read from requests and compared with nothing"
            advice = f"add a guard such as {{if: {{{slot.name}: given}}, <object slot>.at: ${slot.name}}}"
            yield of.oddity(loc, what, advice)
        elif not slot.said_from:
            what = f"no step reads the slot {slot.name}"
            yield of.oddity(loc, what, "pass it to a step, or remove it")


def _conditions(contract: Contract) -> Iterator[Condition]:
    yield from contract.needs
    yield from contract.complete
    for step in contract.steps:
        yield from step.needs


def _named(condition: Condition) -> Iterator[str]:
    if isinstance(condition.value, str) and condition.value.startswith("$"):
        yield condition.value[1:]
    yield condition.path.partition(".")[0]
    yield from condition.when
