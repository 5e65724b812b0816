"""The same request with some words left out or replaced, read again."""

from collections.abc import Iterator

from msgspec.structs import replace

from crew.contracts.codes import GROUP_OF, Group
from crew.contracts.explain.case import Case, finding_of
from crew.contracts.explain.edit import ASKED, Edit
from crew.contracts.language.lexicon import lexicon_of
from crew.contracts.language.licence import shown
from crew.contracts.language.mention import MentionKind
from crew.contracts.language.reading import MAX_CHARACTERS, read_request
from crew.contracts.refusal import Refusal

_NAMES = frozenset(MentionKind) - {MentionKind.ACTION, MentionKind.ROBOT, MentionKind.ROBOT_CLASS, MentionKind.NUMBER}


def request_edits(case: Case, refusal: Refusal) -> Iterator[Edit]:
    """Other words for what a refusal of containment speaks of: what the plan has instead, or nothing."""
    if GROUP_OF[refusal.code] is not Group.CONTAINMENT or len(case.mission.request) > MAX_CHARACTERS:
        return
    yield from _without(case)
    yield from _instead(case)


def _without(case: Case) -> Iterator[Edit]:
    """Without the words: alone, with the small words before them, or with the next name after them."""
    text, reading, finding = case.mission.request, case.mission.reading, finding_of(case)
    spans = {finding.span} if finding is not None and finding.span is not None else set()
    spans |= {m.span for m in reading.excluded} | {u.span for u in reading.unread}
    for start, end in sorted(spans):
        following = [m.span[1] for m in reading.mentions if m.span[0] >= end][:1]
        cuts = [*((begin, end) for begin in _beginnings(text, start)), *((start, after) for after in following)]
        for begin, after in cuts:
            left = f"{text[:begin].rstrip()} {text[after:].lstrip()}".strip()
            if left:
                said = text[begin:after].strip()
                yield Edit(f'the request without "{said}"', ASKED + 0.1 * len(said.split()), _reread(case, left))


def _instead(case: Case) -> Iterator[Edit]:
    """With the plan's values in place of the names that the request gives."""
    values = () if case.instance is None else case.instance.slots.values()
    text = case.mission.request
    for mention in case.mission.reading.mentions:
        if mention.kind not in _NAMES:
            continue
        start, end = mention.span
        for value in values:
            said = shown(value, case.rules.crew)
            if value not in mention.values and said != mention.text:
                words = f'the request with "{said}" instead of "{mention.text}"'
                yield Edit(words, ASKED, _reread(case, f"{text[:start]}{said}{text[end:]}"))


def _reread(case: Case, text: str) -> Case:
    reading = read_request(text, lexicon_of(case.rules))
    return replace(case, mission=replace(case.mission, request=text, reading=reading))


def _beginnings(text: str, start: int) -> list[int]:
    """Where the words to leave out may begin: at the words themselves, or one to four words earlier."""
    found, at = [start], start
    for _ in range(4):
        at = text.rfind(" ", 0, max(0, at - 1)) + 1 if at > 0 else 0
        if at != found[-1]:
            found.append(at)
    return found
