"""Which robots can play the roles of a draft, and which skill brings about what a step needs."""

from collections.abc import Mapping, Sequence
from difflib import get_close_matches

from crew.contracts.scaffold.wish import Wish, WishError
from crew.contracts.site import Rules
from crew.contracts.skill import FluentLiteral, Kind, Skill

MAX_PREPARING = 4
"""Steps that are put in front of a wish to bring about what its skill needs."""


def cast(wishes: Sequence[Wish], rules: Rules) -> dict[str, Kind]:
    """A kind for each role, each role a robot of its own. Raises WishError."""
    roles = list(dict.fromkeys(wish.role for wish in wishes))
    taken: dict[str, str] = {}
    for role in roles:
        needed = {wish.skill for wish in wishes if wish.role == role}
        able = [r.name for r in rules.crew.robots if needed <= {s.name for s in rules.kinds[r.kind].skills}]
        if not able:
            raise WishError(_nobody(role, needed, rules))
        free = next((robot for robot in able if robot not in taken), None)
        if free is None:
            raise WishError(f"no robot is left for {role}: {', '.join(able)} can play it, and other roles need it")
        taken[free] = role
    robots = {role: robot for robot, role in taken.items()}
    return {role: rules.kinds[spec.kind] for role in roles if (spec := rules.crew.robot(robots[role]))}


def _nobody(role: str, needed: set[str], rules: Rules) -> str:
    known = sorted({skill.name for kind in rules.kinds.values() for skill in kind.skills})
    unknown = sorted(needed - set(known))
    if unknown:
        close = get_close_matches(unknown[0], known, n=1, cutoff=0.6)
        hint = f"; did you mean {close[0]!r}?" if close else ""
        return f"no kind of crew {rules.crew.name} has a skill {unknown[0]!r}{hint} (skills: {', '.join(known)})"
    return f"no robot of crew {rules.crew.name} has all of {', '.join(sorted(needed))}, which {role} does"


def skill_of(wish: Wish, kinds: Mapping[str, Kind]) -> Skill:
    skill = kinds[wish.role].skill(wish.skill)
    assert skill is not None, "cast() found a kind that has it"
    return skill


def prepared(wishes: Sequence[tuple[Wish, bool]], kinds: Mapping[str, Kind]) -> list[tuple[Wish, bool]]:
    """The wishes in their order, and in front of each the steps that bring about what its skill needs.

    True marks a step that was put in: a plan may leave it out, since the state may be so already.
    """
    known = {(role, f.name): f.resting for role, kind in kinds.items() for f in kind.fluents}
    steps: list[tuple[Wish, bool]] = []
    for wish, optional in wishes:
        for earlier in _preparing(wish, kinds, known):
            steps.append((earlier, True))
            _assume(earlier, kinds, known)
        steps.append((wish, optional))
        _assume(wish, kinds, known)
    return steps


def _preparing(
    wish: Wish, kinds: Mapping[str, Kind], known: Mapping[tuple[str, str], FluentLiteral | None]
) -> list[Wish]:
    """Skills of the same robot, found breadth-first, that make the wish's preconditions true. Raises WishError."""
    kind, skill = kinds[wish.role], skill_of(wish, kinds)
    start = {f.name: known[wish.role, f.name] for f in kind.fluents}
    waiting: list[tuple[list[str], dict[str, FluentLiteral | None]]] = [([], start)]
    while waiting:
        names, state = waiting.pop(0)
        missing = {f: v for f, v in skill.all_needs.items() if state.get(f) != v}
        if not missing:
            return [Wish(wish.role, name, {}) for name in names]
        if len(names) < MAX_PREPARING:
            waiting += [
                ([*names, other.name], {**state, **other.effects})
                for other in kind.skills
                if other.name not in names and all(state.get(f) == v for f, v in other.all_needs.items())
            ]
    wanted = ", ".join(f"{name} {str(value).lower()}" for name, value in skill.all_needs.items())
    raise WishError(f"{wish.role}.{wish.skill} needs {wanted}, which no skill of a {kind.name} brings about from rest")


def _assume(wish: Wish, kinds: Mapping[str, Kind], known: dict[tuple[str, str], FluentLiteral | None]) -> None:
    for fluent, value in skill_of(wish, kinds).effects.items():
        known[wish.role, fluent] = value
