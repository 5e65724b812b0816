"""What must never happen by the crew's other contracts, as guards for a draft that does the same."""

from collections.abc import Container, Iterator, Mapping

from crew.contracts.contract import Condition, Contract, Never
from crew.contracts.matching import needed_skills
from crew.contracts.scaffold.cast import skill_of
from crew.contracts.scaffold.wish import Wish
from crew.contracts.site import Rules
from crew.contracts.skill import FluentLiteral, Kind


class Guard(Condition, frozen=True, kw_only=True):
    """A condition as a draft writes it."""

    def __str__(self) -> str:
        value = str(self.value).lower() if isinstance(self.value, bool) else self.value
        return f"{{{self.path}: {{not: {value}}}}}" if self.negated else f"{{{self.path}: {value}}}"


def guards_of(
    wish: Wish, args: Mapping[str, str], slots: Container[str], kinds: Mapping[str, Kind], rules: Rules
) -> Iterator[Guard]:
    """A guard for each `never` that speaks of such a call: the first of its conditions must not hold.

    One that compares with a slot which the draft does not have is about other requests.
    """
    for contract in rules.contracts.values():
        for never in contract.never:
            role, _, skill = never.starts.partition(".")
            if skill != wish.skill or not _matches(never, args):
                continue
            roles = {role: wish.role, **_others(contract, role, wish.role, kinds, rules)}
            guard = next((g for c in never.when if (g := _not(c, slots, roles)) is not None), None)
            if guard is not None and not _needed(guard, wish, kinds):
                yield guard


def _needed(guard: Guard, wish: Wish, kinds: Mapping[str, Kind]) -> bool:
    """Whether the skill itself asks for it already."""
    role, _, fluent = guard.path.partition(".")
    needs = skill_of(wish, kinds).all_needs if role == wish.role else {}
    return fluent in needs and (needs[fluent] == guard.value) is not guard.negated


def _matches(never: Never, args: Mapping[str, str]) -> bool:
    """Whether a call with these arguments could be the one that is spoken of; a slot could be anything."""
    said = all(args.get(n, "").startswith("$") or args.get(n) == str(v) for n, v in never.with_args.items())
    return said and all(args.get(n) != str(v) for n, v in never.without_args.items())


def _others(contract: Contract, role: str, mine: str, kinds: Mapping[str, Kind], rules: Rules) -> dict[str, str]:
    """The contract's other roles as the draft's roles that have the skills for them."""
    found: dict[str, str] = {}
    for other in contract.roles:
        needed = needed_skills(contract, other.name, rules)
        able = [name for name, kind in kinds.items() if name != mine and needed <= {s.name for s in kind.skills}]
        if other.name != role and able:
            found[other.name] = able[0]
    return found


def _not(condition: Condition, slots: Container[str], roles: Mapping[str, str]) -> Guard | None:
    """The opposite of a condition on a role's fluent; conditions on anything else are the gate's own business."""
    role, _, fluent = condition.path.partition(".")
    if role not in roles or condition.when:
        return None
    value: FluentLiteral = condition.value
    if isinstance(value, str) and value.startswith("$") and value[1:] not in slots:
        return None
    return Guard(path=f"{roles[role]}.{fluent}", value=value, negated=not condition.negated)
