"""The sentences that prose and diagrams share: guards, calls and fluents in words."""

from collections.abc import Iterable, Mapping

from crew.contracts.contract import CallPattern, Condition
from crew.contracts.skill import FluentLiteral


def guard_words(condition: Condition) -> str:
    """A guard as a clause: `if destination is requester, requester is not near`."""
    whens = [f"{slot} is {'given' if value == 'given' else value}" for slot, value in condition.when.items()]
    prefix = f"if {' and '.join(whens)}, " if whens else ""
    return prefix + clause(condition.path, condition.value, negated=condition.negated)


def guards_words(conditions: Iterable[Condition]) -> str:
    """Guards that must all hold: `carrier is at pickup; carrier is not moving`."""
    return "; ".join(map(guard_words, conditions))


def clause(path: str, value: FluentLiteral, *, negated: bool = False) -> str:
    """A fluent or status and its value, in words."""
    subject, _, name = path.partition(".")
    if isinstance(value, bool):
        return f"{subject} {'is' if value is not negated else 'is not'} {_spaced(name)}"
    verb = "is not" if negated else "is"
    if name in ("", "status"):
        return f"{subject} {verb} {shown(value)}"
    if name == "at":
        return f"{subject} {verb} at {shown(value)}"
    return f"{_spaced(name)} of {subject} {verb} {shown(value)}"


def fluent_words(fluents: Mapping[str, FluentLiteral]) -> str:
    """Fluents of one robot in words: `not airborne, at $place`."""
    return listed(_fluent(name, value) for name, value in fluents.items())


def _fluent(name: str, value: FluentLiteral) -> str:
    if isinstance(value, bool):
        return _spaced(name) if value else f"not {_spaced(name)}"
    return f"at {shown(value)}" if name == "at" else f"{_spaced(name)} is {shown(value)}"


def call_words(call: CallPattern) -> str:
    """A call as a planner writes it: `navigate_to(target=$person)`."""
    return f"{call.skill}({args_words(call.args)})"


def args_words(args: Mapping[str, str | float]) -> str:
    return ", ".join(f"{name}={shown(value)}" for name, value in args.items())


def shown(value: FluentLiteral) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    return value if isinstance(value, str) else f"{value:g}"


def listed(items: Iterable[str], *, word: str = "and") -> str:
    """`a`, `a and b`, `a, b and c`."""
    *most, last = items
    return f"{', '.join(most)} {word} {last}" if most else last


def escaped(text: str) -> str:
    """Text for a place where markup is read."""
    for char, entity in (("&", "&amp;"), ('"', "&quot;"), ("<", "&lt;"), (">", "&gt;")):
        text = text.replace(char, entity)
    return text


def _spaced(name: str) -> str:
    return name.replace("_", " ")
