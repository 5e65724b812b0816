"""Clauses that are no part of the request: what people say of themselves, who is calling, headings, stories.

A clause of a closed kind (`stories.py`) is left out and noted. Any other one that only tells something becomes one
unread piece, which is asked back. What names anything of the crew, a figure, a condition or a negation stays as it is.
"""

from collections.abc import Iterator
from functools import cache
from itertools import islice, pairwise
from typing import NamedTuple

from crew.contracts.language.beside import beside
from crew.contracts.language.calls import call
from crew.contracts.language.closed_kinds import class_words, fits, said_between
from crew.contracts.language.courtesies import (
    CALLED_FROM,
    CALLING,
    CALLING_ALL,
    CALLING_ONE,
    ENDEARED,
    THANKS,
    WANTED_FOR,
)
from crew.contracts.language.endings import is_over
from crew.contracts.language.entry import Entry, stands
from crew.contracts.language.figures import is_numeral
from crew.contracts.language.frames import framing
from crew.contracts.language.inflect import Form
from crew.contracts.language.lexicon import Lexicon, match
from crew.contracts.language.lookahead import ARTICLES
from crew.contracts.language.mention import ROBOT_KINDS, MentionKind, Unread
from crew.contracts.language.speaker import OF_THEMSELVES
from crew.contracts.language.stories import (
    ABOUT_A_PERSON,
    CALLED,
    CLASSES,
    FINITE,
    HARMLESS,
    HEADINGS,
    JOINED,
    LABELS,
    NEW,
    OUT_OF_REACH,
    OWN_CHOICE,
    POSSESSORS,
    PURPOSES,
    SPEAKS,
    SUBJECTS,
)
from crew.contracts.language.tokens import Shape, Token
from crew.contracts.language.words import REQUESTER, SELF_WORDS

_BOUNDS = frozenset(".!?;:,-()\u2026")
_WHY_WORDS = frozenset(("as", "since", "for"))
_PEOPLE = frozenset(("him", "her", "them", "he", "she", "they", "his", "their"))
_AUXILIARY = frozenset(
    ("have", "has", "get", "gets", "got", "need", "needs", "want", "wants", "like", "likes", "give", "make")
)
_WISHED = frozenset(("trouble", "bother", "ask", "want", "need", "have", "get", "would", "could", "should", "might"))
_SHOWN = dict.fromkeys(ROBOT_KINDS, "@robot") | {MentionKind.LOCATION: "@place"}
_ASKS = frozenset((
    "i", "we", "i'd", "we'd", "i'll", "we'll", "could", "can", "would", "will", "please", "let", "have",
))  # fmt: skip
"""What opens a request behind what it is for."""
_TELLING = frozenset(("have", "let", "get", "tell", "ask", "make", "so", "could", "can", "may", "would"))
_LONGEST_SUBJECT = 4
_LONGEST_CLAUSE = 24


class Clause(NamedTuple):
    """Tokens `first` up to `after`, without the words that join it (from `start`)."""

    start: int
    first: int
    after: int
    closed_by: str
    whole: bool
    """It lies between marks, not only between joining words."""


class Pared(NamedTuple):
    """What is left to be read, what was left out without asking, and what is asked back."""

    tokens: list[Token]
    noted: list[Unread]
    asked: list[Unread]


def pare(text: str, tokens: list[Token], lexicon: Lexicon) -> Pared:
    """Take out the clauses that are no part of the request."""
    gone: set[int] = set()
    kept: dict[int, Token] = {}
    noted: list[Unread] = []
    asked: list[Unread] = []
    for clause in _clauses(tokens):
        said = range(clause.start, clause.after)
        if gone & set(said) or len(said) > _LONGEST_CLAUSE:
            continue
        if (dropped := _harmless(tokens, clause, lexicon, kept)) is not None:
            gone.update(dropped)
            if dropped:
                noted.append(_unread(text, tokens, dropped))
        elif clause.whole and any(
            _harmless(tokens, part, lexicon, {}) is not None for part in _parts_of(tokens, clause)
        ):
            continue
        elif not any(is_numeral(tokens, k) for k in said) and _tells(tokens, clause, lexicon):
            gone.update(said)
            asked.append(_unread(text, tokens, range(clause.first, clause.after)))
    left = [kept.get(k, token) for k, token in enumerate(tokens) if k in kept or k not in gone]
    return Pared(left, noted, asked)


def _unread(text: str, tokens: list[Token], said: range) -> Unread:
    span = (tokens[said[0]].start, tokens[said[-1]].end)
    return Unread(text[slice(*span)], span)


def _clauses(tokens: list[Token]) -> Iterator[Clause]:
    """Whole clauses between marks first, then their parts between joining words."""
    begin = 0
    for end in range(len(tokens) + 1):
        if end < len(tokens) and not (tokens[end].shape is Shape.MARK and tokens[end].norm in _BOUNDS):
            continue
        if end > begin:
            yield from _parts(tokens, begin, end)
        begin = end + 1


def _parts(tokens: list[Token], begin: int, end: int) -> Iterator[Clause]:
    closed_by = tokens[end].norm if end < len(tokens) else ""
    whole = Clause(begin, _past_joined(tokens, begin, end), end, closed_by, whole=True)
    yield whole
    yield from _parts_of(tokens, whole)


def _parts_of(tokens: list[Token], whole: Clause) -> Iterator[Clause]:
    """What joining words part a clause into; nothing where there are none."""
    cuts = [k for k in range(whole.start + 1, whole.after) if _joins(tokens, k)]
    if tokens[whole.start].norm == "for":  # "for the demo I need ..."
        asks = (k for k in range(whole.start + 2, min(whole.start + 10, whole.after)) if tokens[k].norm in _ASKS)
        cuts = sorted({*cuts, *islice(asks, 1)})
    for start, after in pairwise((whole.start, *cuts, whole.after)):
        if (start, after) != (whole.start, whole.after):
            closed_by = whole.closed_by if after == whole.after else ""
            yield Clause(start, _past_joined(tokens, start, after), after, closed_by, whole=False)


def _joins(tokens: list[Token], at: int) -> bool:
    word, following = tokens[at].norm, tokens[at + 1].norm if at + 1 < len(tokens) else ""
    if word in _WHY_WORDS:
        return following in SPEAKS
    if word == "so":
        return following not in _degrees()
    return word in JOINED and (at == 0 or tokens[at - 1].norm not in JOINED)


def _past_joined(tokens: list[Token], at: int, end: int) -> int:
    while at < end and tokens[at].norm in JOINED:
        at += 1
    return at


def _harmless(tokens: list[Token], clause: Clause, lexicon: Lexicon, kept: dict[int, Token]) -> range | None:
    """The tokens that a harmless clause loses; None if it is none."""
    said = said_between(tokens, clause.first, clause.after)
    if not said:
        return None
    whole = range(clause.start, clause.after)
    if is_over(tokens, clause.first, clause.after, lexicon):
        return whole
    if fits(HARMLESS, said) and not _names(tokens, clause, lexicon, but=MentionKind.VALUE):
        return whole
    if clause.whole and said in framing():
        return None
    purpose = (clause.whole or tokens[clause.start].norm == "for") and fits(
        PURPOSES, said_between(tokens, clause.start, clause.after)
    )
    if purpose and not _names(tokens, clause, lexicon):
        return whole
    if clause.whole and fits(OWN_CHOICE, said):
        return whole
    if _brought(tokens, clause, lexicon) and fits(OF_THEMSELVES, _in_kinds(tokens, clause, lexicon)):
        _keep_robot(tokens, clause, kept, lexicon)
        return whole
    if fits((*THANKS, *CALLING_ALL), said):
        return whole
    if clause.whole and fits(ENDEARED, said) and not _names(tokens, clause, lexicon):
        return whole
    if fits((*WANTED_FOR, *CALLING), said) and not _names(tokens, clause, lexicon, but=MentionKind.VALUE):
        return whole
    value = _person(lexicon)
    if value and fits(ABOUT_A_PERSON, said) and not _names(tokens, clause, lexicon, but=MentionKind.VALUE):
        _keep_person(tokens, clause, value, kept)
        return whole
    if (spoken := _call(tokens, clause, lexicon)) is not None:
        return spoken
    if clause.closed_by == ":" and (dropped := _heading(tokens, clause, lexicon)) is not None:
        return dropped
    if clause.whole and (told := _told_behind(tokens, clause, lexicon)) is not None:
        return told
    if clause.whole and (found := beside(tokens, clause.first, clause.after, lexicon)) is not None:
        return found
    called = _in_front_of(ROBOT_KINDS, (*CALLED, *CALLING_ONE), tokens, clause, lexicon)
    behind = _behind_robot(tokens, clause, lexicon)
    if behind is not None:
        return behind
    called = called or _in_front_of((MentionKind.OBJECT,), OUT_OF_REACH, tokens, clause, lexicon)
    return None if called is None else range(clause.start, called)


def _keep_robot(tokens: list[Token], clause: Clause, kept: dict[int, Token], lexicon: Lexicon) -> None:
    """Keep the one robot that the clause names, where it is told something: `I'm next to the humanoid, have it ...`."""
    entries = ((k, e) for k in range(clause.first, clause.after) for e in lexicon.names.get(tokens[k].norm, ()))
    robots = [k for k, e in entries if e.kind in ROBOT_KINDS and len(e.words) == 1 and not e.plural]
    called = [k for k in range(clause.after, len(tokens)) if tokens[k].norm == "it" and tokens[k - 1].norm in _TELLING]
    if len(set(robots)) == 1 and called:
        kept[called[0]] = tokens[called[0]]._replace(norm=tokens[robots[0]].norm)


def _brought(tokens: list[Token], clause: Clause, lexicon: Lexicon) -> bool:
    """Whether something is asked for by whoever speaks: `bring me the bottle`, `I need the cube`."""
    norms = [t.norm for k, t in enumerate(tokens) if k not in range(clause.start, clause.after)]
    wished = any(who in ("i", "we") and verb in _WISHED for who, verb in pairwise(norms))
    named = any(e.name == REQUESTER for n in norms for e in lexicon.names.get(n, ()))
    return bool(lexicon.to_requester) and (named or wished or bool({"me", "us", "my", "i'd", "here"} & set(norms)))


def _told_behind(tokens: list[Token], clause: Clause, lexicon: Lexicon) -> range | None:
    """`bring it to me I'm back here on the couch`: where the person is, without a mark before it."""
    for cut in range(clause.first + 3, clause.after - 1):
        if tokens[cut].norm in ("i'm", "i", "we're", "im") and _is_over(tokens, cut, lexicon):
            told = clause._replace(start=cut, first=cut)
            if _brought(tokens, told, lexicon) and fits(OF_THEMSELVES, _in_kinds(tokens, told, lexicon)):
                return range(cut, clause.after)
    return None


def _is_over(tokens: list[Token], at: int, lexicon: Lexicon) -> bool:
    """Whether what was asked for is said: `to me`, or a name, and no word that leads on."""
    names = (
        e for k in range(max(0, at - 3), at) for e in lexicon.names.get(tokens[k].norm, ()) if k + len(e.words) == at
    )
    named = any(stands(tokens, at - len(e.words), e.words) for e in names if e.kind is not MentionKind.ACTION)
    return named or tokens[at - 1].norm in ("me", "us", "please", "here", "it")


def _shown(name: Entry) -> str | None:
    """What stands for a name in a pattern."""
    spoken_of = name.name == REQUESTER and " ".join(name.words) not in SELF_WORDS
    return "@me" if spoken_of else _SHOWN.get(name.kind)


def _in_kinds(tokens: list[Token], clause: Clause, lexicon: Lexicon) -> str:
    """The words of a clause, with `@robot` and `@place` for the names of the crew."""
    said, at = [], clause.first
    while at < clause.after:
        names = (e for e in lexicon.names.get(tokens[at].norm, ()) if stands(tokens, at, e.words))
        kinds = ((e, _shown(e)) for e in names if at + len(e.words) <= clause.after)
        name, shown = next(((e, kind) for e, kind in kinds if kind), (None, tokens[at].norm))
        said.append(str(shown))
        at += 1 if name is None else len(name.words)
    return " ".join(said)


def _call(tokens: list[Token], clause: Clause, lexicon: Lexicon) -> range | None:
    return call(tokens, clause.first, clause.after, clause.closed_by, lexicon) if clause.whole else None


def _heading(tokens: list[Token], clause: Clause, lexicon: Lexicon) -> range | None:
    """`new task:`, `order for the rover:`, and the words around the noun of an action in `new transport order:`."""
    if fits(HEADINGS, said_between(tokens, clause.first, clause.after)):
        return range(clause.start, clause.after)
    robot = _in_front_of(ROBOT_KINDS, HEADINGS, tokens, clause, lexicon)
    if robot is not None:
        return range(clause.start, robot)
    labelled = clause.after - 1 if tokens[clause.after - 1].norm in LABELS else clause.after
    verb = labelled - 1
    named = verb >= clause.first and any(
        e.kind is MentionKind.ACTION and len(e.words) == 1 for e in lexicon.names.get(tokens[verb].norm, ())
    )
    new = all(tokens[k].norm in NEW or tokens[k].norm in ARTICLES for k in range(clause.first, verb))
    return range(labelled, clause.after) if named and new and labelled < clause.after else None


def _in_front_of(
    kinds: tuple[MentionKind, ...], patterns: tuple[str, ...], tokens: list[Token], clause: Clause, lexicon: Lexicon
) -> int | None:
    """Where the name begins that ends a clause, if the words before it fit a pattern."""
    for at in range(clause.first + 1, clause.after):
        name = match(lexicon.names, tokens, at)
        if name is not None and name.kind in kinds and at + len(name.words) == clause.after:
            end = at - 1 if tokens[at - 1].norm in ARTICLES else at
            return at if end > clause.first and fits(patterns, said_between(tokens, clause.first, end)) else None
    return None


def _behind_robot(tokens: list[Token], clause: Clause, lexicon: Lexicon) -> range | None:
    """`g1 from control`: who calls, behind the robot that is called."""
    name = match(lexicon.names, tokens, clause.first)
    end = clause.first + (0 if name is None else len(name.words))
    called = name is not None and name.kind in ROBOT_KINDS and end < clause.after
    said = called and clause.whole and fits(CALLED_FROM, said_between(tokens, end, clause.after))
    return range(end, clause.after) if said and not _names(tokens, clause._replace(first=end), lexicon) else None


def _keep_person(tokens: list[Token], clause: Clause, value: str, kept: dict[int, Token]) -> None:
    """Keep whom the clause tells of, where `him` or `her` follows."""
    if not any(t.norm in _PEOPLE for t in tokens[clause.after :]):
        return
    people = frozenset((*class_words("people"), *class_words("person")))
    who = [k for k in range(clause.first, clause.after) if tokens[k].norm in people]
    others = any(t.norm in people for k, t in enumerate(tokens) if k not in range(clause.first, clause.after))
    if who and not others:
        kept[who[-1]] = tokens[who[-1]]._replace(norm=value, possessive=False)


def _person(lexicon: Lexicon) -> str:
    """The one run-time value that is a person, by a name of one word; empty if there is none."""
    known = set(lexicon.reports.values())
    named = {e.name for e in lexicon.names.get("person", ()) if e.kind is MentionKind.VALUE and e.name in known}
    return next(iter(named)) if len(named) == 1 == len(known) else ""


def _tells(tokens: list[Token], clause: Clause, lexicon: Lexicon) -> bool:
    """Whether a clause only tells something: its own subject, a finite verb, and nothing of the crew."""
    norms = [t.norm for t in tokens[clause.first : clause.after]]
    reason = not clause.whole and tokens[clause.start].norm in ("because", "'cause", "since", "as")
    if not norms or (len(norms) < 3 and not reason) or clause.closed_by == "?":
        return False
    if any(t.shape is not Shape.WORD for t in tokens[clause.first : clause.after]):
        return False
    if " ".join(norms) in framing():
        return False
    turning = lexicon.vocabulary.turning
    if any(n in turning or n.endswith("n't") for n in norms) or _names(tokens, clause, lexicon):
        return False
    asking = (k for k, n in enumerate(norms, clause.first) if n not in _AUXILIARY and _is_action(lexicon, tokens, k))
    if any(not _past(lexicon, tokens, k) for k in asking):
        return False
    opens = norms[0] in SUBJECTS or (norms[0] in POSSESSORS and norms[1:2] and norms[1] not in FINITE)
    behind = norms[1 : _LONGEST_SUBJECT + 1]
    past = any(_past(lexicon, tokens, k) for k in range(clause.first + 1, clause.after))
    told = past or any(n in FINITE for n in behind) or ("'" in norms[0] and norms[0] in SUBJECTS)
    return bool(opens and told) and not (norms[0] in ("i", "we", "i'd", "you") and _wishes(norms))


def _wishes(norms: list[str]) -> bool:
    """`I would like ...`, `I want ...`: a request."""
    return (
        any(n in ("want", "need", "like", "wish", "would", "prefer", "love") for n in norms[1:4]) or norms[0] == "i'd"
    )


def _is_action(lexicon: Lexicon, tokens: list[Token], at: int) -> bool:
    return any(
        e.kind is MentionKind.ACTION and _stands(tokens, at, e.words) for e in lexicon.names.get(tokens[at].norm, ())
    )


def _past(lexicon: Lexicon, tokens: list[Token], at: int) -> bool:
    """Whether a verb of the crew is told of, and asks for nothing."""
    entries = [e for e in lexicon.names.get(tokens[at].norm, ()) if _stands(tokens, at, e.words)]
    return bool(entries) and all(e.kind is MentionKind.ACTION and e.form is Form.PAST for e in entries)


def _stands(tokens: list[Token], at: int, words: tuple[str, ...]) -> bool:
    return tuple(t.norm for t in tokens[at : at + len(words)]) == words


def _names(tokens: list[Token], clause: Clause, lexicon: Lexicon, but: MentionKind | None = None) -> bool:
    """Whether a clause names a robot, a place, an object or a run-time value."""
    return any(
        e.kind not in (MentionKind.ACTION, but) and e.name != REQUESTER and _stands(tokens, k, e.words)
        for k in range(clause.first, clause.after)
        for e in lexicon.names.get(tokens[k].norm, ())
    )


@cache
def _degrees() -> frozenset[str]:
    """What `so` strengthens."""
    words = (w.split()[0] for name in ("feeling", "late", "very") for w in CLASSES[name].split("|"))
    return frozenset(words) | {"far", "much", "that"}
