"""One plan under one request, with every declared property that it could break."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from crew.contracts.contract import Contract
from crew.contracts.language.licence import claims
from crew.contracts.language.mention import Reading
from crew.contracts.matching import needed_skills, robot_skills
from crew.contracts.plan import Instance, Plan
from crew.contracts.proof.instances import plans
from crew.contracts.proof.never import Watch, foreign_watches, own_watches
from crew.contracts.proof.request import meant, objection, requests, wider_requests
from crew.contracts.proof.subject import Slots
from crew.contracts.refusal import Refusal
from crew.contracts.site import Rules


class Case(NamedTuple):
    """A plan that the planner may propose and that gets through matching and containment."""

    plan: Plan
    instance: Instance
    reading: Reading
    slots: Slots
    """As the plan binds them, and those that only the request binds."""
    watches: tuple[Watch, ...]


class Refused(NamedTuple):
    """A plan that gets through neither, and why."""

    plan: Plan
    why: str


def cases(contract: Contract, rules: Rules, invariants: Sequence[Contract]) -> Iterator[Case | Refused]:
    """Every plan of a contract, judged against the `never` of the given contracts."""
    for plan, instance in plans(contract, rules):
        if isinstance(instance, Refusal):
            yield Refused(plan, instance.message)
            continue
        for reading in requests(instance, rules):
            finding = objection(reading, instance, rules)
            if finding is None:
                yield _case(plan, instance, reading, contract, rules, invariants)
            else:
                yield Refused(plan, finding.message)


def _case(
    plan: Plan,
    instance: Instance,
    reading: Reading,
    contract: Contract,
    rules: Rules,
    invariants: Sequence[Contract],
) -> Case:
    slots = {**claims(reading, contract, rules), **instance.slots}
    own = own_watches(contract, instance, slots) if contract in invariants else ()
    others = [other for other in invariants if other.name != contract.name]
    foreign = (watch for other in others for watch in _foreign(other, reading, instance, rules))
    return Case(plan, instance, reading, slots, (*own, *foreign))


def _foreign(other: Contract, reading: Reading, instance: Instance, rules: Rules) -> Iterator[Watch]:
    """What another contract forbids, for every request that names its slots and lets this plan through."""
    if not other.never:
        return
    seen: list[Watch] = []
    for wider in wider_requests(reading, instance, other, rules):
        for slots in meant(wider, other, rules):
            for watch in foreign_watches(other, slots, instance, lambda role: able(other, role, rules)):
                if watch not in seen and any(watch.concerns(item.call) for item in instance.steps):
                    seen.append(watch)
    yield from seen


def able(contract: Contract, role: str, rules: Rules) -> list[str]:
    """The robots that can play a role."""
    needed = needed_skills(contract, role, rules)
    return [spec.name for spec in rules.crew.robots if needed <= robot_skills(spec.name, rules)]
