"""Counterexamples as numbered stories: what a person asked for, what the planner answered, what happened then."""

from collections.abc import Iterable, Iterator

from crew.contracts.language.mention import MentionKind
from crew.contracts.proof.model import Model
from crew.contracts.proof.trouble import Facts, Note
from crew.contracts.refusal import show

_PLAIN = {
    "leased": "",
    "said_done": "",
    "cancel": "A person cancels the mission.",
    "stop": "A person stops the crew.",
    "deadline": "The contract's deadline passes.",
}


def story(model: Model, notes: Iterable[Note], end: str) -> tuple[str, ...]:
    """The notes of a path as sentences, the last one saying what is wrong."""
    told = [*_opening(model), *(said for note in notes if (said := _told(note, model))), end]
    return tuple(f"{number}. {_sentence(text)}" for number, text in enumerate(told, start=1))


def _sentence(text: str) -> str:
    return text if text.endswith((".", "?", "!")) else f"{text}."


def _opening(model: Model) -> Iterator[str]:
    named = [m.name for m in model.reading.wanted if m.kind is not MentionKind.ACTION]
    steps = ", ".join(model.reading.wanted[k].name for k, m in enumerate(model.reading.wanted) if m.means)
    asked = f"{steps or 'something'}; the request names {', '.join(named) if named else 'nothing else'}"
    yield f"A person asks for {asked}"
    calls = ", ".join(str(item.call) for item in model.instance.steps)
    yield f"The planner answers with {model.contract.name}: {calls}"


def _told(note: Note, model: Model) -> str:
    if note.what in _PLAIN:
        return _PLAIN[note.what]
    seen = _facts(note.facts)
    match note.what:
        case "sent":
            return f"{note.call} is sent{f' while {seen}' if seen else ''}"
        case "refused":
            return f"The gate refuses {note.call}: {note.why}"
        case "done":
            return f"{note.call} is done: {seen or 'on the word of the robot alone, it has no effect'}"
        case "failed":
            return f"{note.call} fails"
        case "stays":
            return f"{model.instance.roles[note.who]}, the {note.who}, stays as it is"
        case "is_safe":
            return f"{model.instance.roles[note.who]}, the {note.who}, is in its safe state: {seen}"
        case "make_safe":
            return f"{note.call} is sent to make the {note.who} safe"
        case "not_commanded":
            return f"The safe call {note.call} is refused: {note.why}"
        case "complete":
            return f"The mission is complete{f': {seen}' if seen else ''}"
    return f"Every step is done, but the mission is not complete: {note.why}"


def _facts(facts: Facts) -> str:
    return ", ".join(f"{var} is {show(value)}" for var, value in facts)
