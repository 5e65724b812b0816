"""Whether a kind's declaration fits together. A kind is code that anybody may install, so it is read with suspicion."""

from collections.abc import Iterable, Iterator, Mapping
from difflib import get_close_matches

from crew.contracts.skill import Entity, FluentLiteral, Kind, Skill

_PLACE = ("$place", "$point")
_PLACE_ARGS = ("target", "location", "x")
_TYPES: Mapping[str, type | tuple[type, ...]] = {"bool": bool, "place": str, "object": str, "number": (int, float)}


def mistakes(kind: Kind) -> tuple[str, ...]:
    """What is wrong with a declaration, one sentence each; empty if nothing is."""
    return tuple(_mistakes(kind))


def _mistakes(kind: Kind) -> Iterator[str]:
    groups = {
        "skill": [skill.name for skill in kind.skills],
        "fluent": [fluent.name for fluent in kind.fluents],
        "value": [value.name for value in kind.publishes],
        "part": [part.name for part in kind.parts],
    }
    for what, names in groups.items():
        yield from (f"{what} {name} is declared twice" for name in _twice(names))
    for skill in kind.skills:
        yield from (f"skill {skill.name}: {text}" for text in _skill(skill, kind))
    for value in kind.publishes:
        yield from (
            f"value {value.name}: {text}" for text in _unknown("skill", value.by, [s.name for s in kind.skills])
        )
    for part in kind.parts:
        holds = kind.fluent(part.holds)
        if holds is None or holds.domain != "object":
            yield f"part {part.name}: {part.holds!r} is no declared fluent that names an object"


def _skill(skill: Skill, kind: Kind) -> Iterator[str]:
    if not skill.effects and not skill.puts and not skill.reports:
        yield "it has no effect, puts nothing and reports nothing, so nothing could show that it was done"
    named = {"needs": skill.needs, "step_needs": skill.step_needs, "effects": skill.effects, "during": skill.during}
    for where, facts in (*named.items(), *(("may", left) for left in skill.may)):
        yield from _facts(where, facts, skill, kind)
    yield from _arguments(skill)
    if skill.safe and (skill.needs or skill.params or not skill.effects):
        yield "it is called safe, so it may need nothing and take nothing, and must have an effect"
    yield from _unknown("value", skill.reports, [value.name for value in kind.publishes])


def _facts(where: str, facts: Mapping[str, FluentLiteral], skill: Skill, kind: Kind) -> Iterator[str]:
    """Each fact is about a declared fluent, which telemetry can show, and says something that the fluent can be."""
    for name, value in facts.items():
        fluent = kind.fluent(name)
        if fluent is None:
            known = [f.name for f in kind.fluents]
            yield f"{where} speaks of {name!r}, which no telemetry shows{_near(name, known)}"
        elif fluent.relation is not None and where not in ("needs", "step_needs"):
            yield f"{where} speaks of {name!r}, which other robots change as well"
        elif isinstance(value, str) and value.startswith("$"):
            names = _PLACE_ARGS if value in _PLACE else (value[1:],)
            if not any(skill.param(arg) for arg in names):
                yield f"{where} {name} is {value}, but it takes no such argument{_near(value[1:], _params(skill))}"
        elif not _fits(value, _TYPES[fluent.domain]):
            yield f"{where} {name} is {value!r}, but {name} is a {fluent.domain}"


def _fits(value: FluentLiteral, wanted: type | tuple[type, ...]) -> bool:
    return isinstance(value, wanted) and (wanted is bool or not isinstance(value, bool))


def _arguments(skill: Skill) -> Iterator[str]:
    known = _params(skill)
    spoken = [*(n for form in skill.forms for n in form), *(n for pair in skill.ranges for n in pair)]
    yield from _unknown("argument", spoken, known)
    for name in (n for form in skill.forms for n in form):
        param = skill.param(name)
        if param is not None and not param.optional:
            yield f"argument {name} stands in a form, so it must be optional"
    for param in skill.params:
        if param.is_number and (param.ge is None or param.le is None or param.ge >= param.le):
            yield f"argument {param.name} has no bounds; give it ge and le"
    if skill.puts is not None:
        entities = [param.entity for name in skill.puts if (param := skill.param(name))]
        if entities != [Entity.OBJECT, Entity.LOCATION]:
            yield f"puts names {', '.join(skill.puts)}; it names an argument for an object, then one for a location"


def _params(skill: Skill) -> list[str]:
    return [param.name for param in skill.params]


def _unknown(what: str, names: Iterable[str], known: list[str]) -> Iterator[str]:
    for name in dict.fromkeys(names):
        if name not in known:
            yield f"it names {what} {name!r}, which is not declared{_near(name, known)}"


def _near(name: str, known: list[str]) -> str:
    close = get_close_matches(name, known, n=1, cutoff=0.6)
    return f"; did you mean {close[0]!r}?" if close else f" (declared: {', '.join(known) or 'none'})"


def _twice(names: Iterable[str]) -> Iterator[str]:
    seen: set[str] = set()
    for name in names:
        if name in seen:
            yield name
        seen.add(name)
