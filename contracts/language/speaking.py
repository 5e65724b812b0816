"""Leaves out what people say of themselves beside a request that brings them something: `speaker.py` has how."""

from itertools import pairwise

from crew.contracts.language.clause import Clause
from crew.contracts.language.closed_kinds import fits
from crew.contracts.language.entry import Entry, stands
from crew.contracts.language.lexicon import Lexicon
from crew.contracts.language.mention import ROBOT_KINDS, MentionKind
from crew.contracts.language.speaker import OF_THEMSELVES
from crew.contracts.language.tokens import Token
from crew.contracts.language.words import REQUESTER, SELF_WORDS

_WISHED = frozenset(("trouble", "bother", "ask", "want", "need", "have", "get", "would", "could", "should", "might"))
_SHOWN = dict.fromkeys(ROBOT_KINDS, "@robot") | {MentionKind.LOCATION: "@place"}
_TELLING = frozenset(("have", "let", "get", "tell", "ask", "make", "so", "could", "can", "may", "would"))


def of_the_speaker(tokens: list[Token], clause: Clause, kept: dict[int, Token], lexicon: Lexicon) -> range | None:
    """The tokens that a clause loses that only says where and how the person is; None if it says more."""
    if not _says_so(tokens, clause, lexicon):
        return None
    _keep_robot(tokens, clause, kept, lexicon)
    return range(clause.start, clause.after)


def told_behind(tokens: list[Token], clause: Clause, lexicon: Lexicon) -> range | None:
    """`bring it to me I'm back here on the couch`: where the person is, without a mark before it."""
    for cut in range(clause.first + 3, clause.after - 1):
        if tokens[cut].norm in ("i'm", "i", "we're", "im") and _is_over(tokens, cut, lexicon):
            told = clause._replace(start=cut, first=cut)
            if _says_so(tokens, told, lexicon):
                return range(cut, clause.after)
    return None


def _says_so(tokens: list[Token], clause: Clause, lexicon: Lexicon) -> bool:
    return _brought(tokens, clause, lexicon) and fits(OF_THEMSELVES, _in_kinds(tokens, clause, lexicon))


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
