"""A name that is said again in other words: `the dog, er, the quadruped I mean` corrects nothing.

Only where both names mean the same one thing, where the second is one of the robots that the first may mean, or where
it says whom a pronoun means: `drive to him, to the climber I mean`.
"""

from crew.contracts.language.entry import Entry, Words, stands_all
from crew.contracts.language.lexicon import Lexicon, match
from crew.contracts.language.lookahead import ARTICLES, SOFT, past_all
from crew.contracts.language.mention import ROBOT_KINDS, MentionKind
from crew.contracts.language.rewrites import HESITATIONS
from crew.contracts.language.stories import SPEAKS
from crew.contracts.language.tokens import Shape, Token
from crew.contracts.language.wordings import of_phrases
from crew.contracts.language.words import IN_NEED

_LINKS = of_phrases(
    (
        "i mean", "i meant", "or rather", "sorry", "that is", "that is to say", "i should say", "or should i say",
        "correction", "excuse me", "pardon", "pardon me", "i beg your pardon", "beg your pardon", "well", "you know",
        "in other words", "namely", "meaning", "which is", "which means", "rather", "what i mean is", "oops", "as in",
        "to be precise", "to be exact", "to be clear", "a k a", "also known as", "aka", "or",
    )
)  # fmt: skip
_OR: Words = ("or",)
_TAILS: tuple[Words, ...] = tuple(
    tuple(said.split())
    for said in (
        "i mean", "i meant", "rather", "that is", "i should say", "that is to say", "to be precise", "to be exact",
        "i ought to say", "as i should say", "as i'm supposed to say", "as i am supposed to say", "as you call it",
        "as they call it", "as we call it", "as it's called", "as it is called", "if you like", "if you prefer",
        "if you will", "so to speak", "of course", "to be clear", "i suppose i should say", "is what i mean",
        "is what i meant", "same thing", "i should call it", "i should have said", "it's the same",
        "whatever it's called",
    )
)  # fmt: skip
_MARKS = frozenset((",", "-", "\u2026", "(", ")", ";", "."))
_KINDS = (*ROBOT_KINDS, MentionKind.OBJECT, MentionKind.LOCATION, MentionKind.ZONE, MentionKind.VALUE)
_PRONOUNS = {
    "him": (MentionKind.VALUE,), "her": (MentionKind.VALUE,), "them": (MentionKind.VALUE,),
    "it": (MentionKind.OBJECT, *ROBOT_KINDS),
}  # fmt: skip
_PLACED = frozenset(("to", "into", "in", "at", "on", "onto", "over", "for", "from", "of"))
_WHOLE = frozenset(("everything", "all", "on", "in", "of"))


def restated(tokens: list[Token], lexicon: Lexicon) -> list[Token]:
    """The tokens of a request without names that are said again at once, kept in the narrower wording."""
    out: list[Token] = []
    at = 0
    while at < len(tokens):
        found = _again(tokens, at, lexicon) if tokens[at].shape is Shape.WORD else None
        if found is None:
            out.append(tokens[at])
            at += 1
            continue
        again, at = found
        out.extend(again)
    return out


def _again(tokens: list[Token], at: int, lexicon: Lexicon) -> tuple[list[Token], int] | None:
    """The name that follows in other words, and where it is over."""
    name = match(lexicon.names, tokens, at)
    if name is not None and (shown := _one_of_that_kind(tokens, at, name, lexicon)) is not None:
        return tokens[at : at + len(name.words)], shown
    if (again := _verb_again(tokens, at, lexicon)) is not None:
        return [], again
    if (twice := _called_twice(tokens, at, name)) is not None:
        return [], twice
    begin = at + (1 if name is None or name.kind is MentionKind.ACTION else len(name.words))
    if tokens[begin - 1].possessive:
        return None
    second, links = _past_links(tokens, begin)
    named = _past_opening(tokens, second, at, name)
    other = match(lexicon.names, tokens, named) if begin < second < len(tokens) and named < len(tokens) else None
    if other is None or not _same(tokens[at], name, other):
        return None
    end = named + len(other.words)
    tail = next((t for t in _TAILS for k in (end, end + 1) if stands_all(tokens, k, t) and _marks(tokens, end, k)), ())
    if not tail and not links - {_OR}:
        return None
    after = end
    if tail:
        after += (tokens[end].norm in _MARKS) + len(tail)
    closed = after < len(tokens) and tokens[after].norm in (",", "-", ")") and begin < second
    told = closed and after + 1 < len(tokens) and tokens[after + 1].norm in SPEAKS  # "..., I'm over here"
    return tokens[named:end], after + (closed and not told)


def _one_of_that_kind(tokens: list[Token], at: int, name: Entry, lexicon: Lexicon) -> int | None:
    """Where `the cube, the red one,` is over: the adjective is one that another of its names has."""
    after = at + len(name.words)
    if name.kind is MentionKind.ACTION or name.plural or len(name.values) != 1 or after >= len(tokens):
        return None
    the = after + (tokens[after].norm in _MARKS)
    end = the + 3
    said = [t.norm for t in tokens[the:end]]
    if len(said) < 3 or said[0] != "the" or said[2] != "one":
        return None
    others = (e for found in lexicon.names.values() for e in found if e.values == name.values and len(e.words) > 1)
    if said[1] not in {e.words[0] for e in others}:
        return None
    return end + (end < len(tokens) and tokens[end].norm == "," and the > after)


def _verb_again(tokens: list[Token], at: int, lexicon: Lexicon) -> int | None:
    """Where the second verb of `land it, I mean land the drone` begins."""
    if at + 1 >= len(tokens) or tokens[at + 1].norm not in _PRONOUNS:
        return None
    second, links = _past_links(tokens, at + 2)
    same = second < len(tokens) and tokens[second].norm == tokens[at].norm and second > at + 2
    verbs = lexicon.names.get(tokens[at].norm, ())
    name_at = _past_opening(tokens, second + 1, at, None)
    named = match(lexicon.names, tokens, name_at) if name_at < len(tokens) else None
    known = same and bool(links - {_OR}) and any(e.kind is MentionKind.ACTION for e in verbs)
    return second if known and named is not None and named.kind is not MentionKind.ACTION else None


def _called_twice(tokens: list[Token], at: int, name: Entry | None) -> int | None:
    """Where the second `rover` of `rover, rover, go to base` begins."""
    if name is None or name.kind not in ROBOT_KINDS or not (at == 0 or tokens[at - 1].shape is Shape.MARK):
        return None
    again = at + len(name.words)
    again += again < len(tokens) and tokens[again].norm in (",", "-", "\u2026")
    return again if stands_all(tokens, again, name.words) else None


def _past_links(tokens: list[Token], at: int) -> tuple[int, set[Words]]:
    """Past marks, hesitations and corrections, and which there were of the latter two."""
    said: set[Words] = set()
    while at < len(tokens):
        link, _ = next(_LINKS.standing(tokens, at), ((), ()))
        if tokens[at].norm in HESITATIONS:
            link = (tokens[at].norm,)
        elif tokens[at].norm not in _MARKS and not link:
            break
        said |= {link} if link else set()
        at += len(link) or 1
    return at, said


def _past_opening(tokens: list[Token], at: int, first: int, name: Entry | None) -> int:
    """Past the preposition that stood before the first name, articles, and adjectives that pick nothing out."""
    owner = first - 1
    while owner >= 0 and tokens[owner].norm in ARTICLES:
        owner -= 1
    link = tokens[at].norm if at < len(tokens) else ""
    at += link == "back"
    link = tokens[at].norm if at < len(tokens) else ""
    at += link == "to" or (link in _PLACED and owner >= 0 and tokens[owner].norm == link)
    passed = SOFT | (IN_NEED - {"there"})
    if name is not None and name.kind is MentionKind.ZONE:
        passed |= _WHOLE
    return past_all(tokens, at, passed)


def _marks(tokens: list[Token], begin: int, end: int) -> bool:
    return all(t.norm in _MARKS for t in tokens[begin:end])


def _same(said: Token, name: Entry | None, other: Entry) -> bool:
    """Whether the second name ends at what the first word or name stood for."""
    if other.kind not in _KINDS or len(other.values) != 1 or other.plural:
        return False
    if other.kind in _PRONOUNS.get(said.norm, ()):
        return True
    if name is None:
        return said.norm in other.words  # "the water, the water bottle I mean"
    robots = name.kind in ROBOT_KINDS and other.kind in ROBOT_KINDS
    if not robots and name.kind is not other.kind:
        return False
    narrower = set(other.values) <= set(name.values) if robots else other.values == name.values
    return narrower and not name.plural
