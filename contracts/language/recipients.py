"""For whom something is done, and where they are: `to my armchair`, `for the children`, `to my wife in room A`."""

from collections.abc import Iterator

from crew.contracts.language.entry import Entry, stands_all
from crew.contracts.language.inflect import inflections
from crew.contracts.language.lexicon import Lexicon, match
from crew.contracts.language.lookahead import past_all
from crew.contracts.language.mention import ROBOT_KINDS, MentionKind
from crew.contracts.language.patterns import past_article
from crew.contracts.language.tokens import Shape, Token, reworded
from crew.contracts.language.wordings import of_phrases
from crew.contracts.language.words import word_set

_SENTENCE = frozenset(".!?;")
_SEATS = word_set(
    "armchair chair seat sofa couch bed bedside wheelchair recliner desk bench workstation workplace stool hammock "
    "deckchair side place spot settee cot bunk lap feet position"
)
_OWN_SEATS = word_set("armchair chair seat sofa couch wheelchair bedside recliner settee deckchair side")
"""Where nobody but the speaker sits, so that `send it to my chair` is to send it to the speaker."""
_SEAT_WORDS = word_set("own little old big favourite favorite comfy usual easy rocking sick work")
_COMING = ("bring", "fetch", "come", "get")
_NEUTRAL = ("carry", "deliver", "send", "walk", "go", "transport", "convey", "run", "drive", "head", "move")
_HERE = word_set("me here us")
_BY = (
    ("by", "the"),
    ("at", "the"),
    ("near", "the"),
    ("next", "to", "the"),
    ("beside", "the"),
    ("in", "front", "of", "the"),
)
_FURNITURE = word_set("window door fire fireplace stove wall radiator heater tv television balcony entrance")
_WHOSE = word_set("the my our a an some his her their your all those these")
_PEOPLE = word_set(
    "child children kids kid boys boy girls girl patient patients visitor visitors guest guests nurse nurses doctor "
    "doctors resident residents client clients customer customers wife husband son daughter mother father mum mom dad "
    "grandma grandpa granny grandmother grandfather friend friends colleague colleagues neighbour neighbours lady "
    "ladies gentleman gentlemen man woman men women people person team staff team crowd audience actors actor cast "
    "players speaker speakers students student pupils pupil teacher teachers class trainees workers worker cook cooks "
    "chef waiter waiters family folks lads girlfriend boyfriend partner sister brother aunt uncle cousin baby toddler "
    "toddlers carer carers therapist medic medics surgeon "
    "housekeeping reception kitchen catering maintenance security logistics production wardrobe lab "
    "laboratory pharmacy "
    "theatre ward stage workshop office crowd party crew shift matron midwife sister manager management"
)
_KINDLY = word_set("little old dear young other poor sweet lovely small new")
_TO_MINE = of_phrases(
    ("over to my", "to my", "at my", "by my", "beside my", "next to my", "up to my", "to our", "into my")
)
NEEDING = tuple(
    tuple(said.split())
    for said in (
        "would like",
        "would love",
        "are asking for",
        "is asking for",
        "has asked for",
        "have asked for",
        "need",
        "needs",
        "want",
        "wants",
        "require",
        "requires",
        "could use",
        "could do with",
        "are waiting for",
        "is waiting for",
        "want to play with",
        "would like to play with",
        "wants to play with",
        "want to see",
        "wants to see",
    )
)
Said = tuple[int, list[Token]]
"""Where it is over, and what it is read as."""


def seat(tokens: list[Token], at: int, lexicon: Lexicon) -> Said | None:
    """`bring it to my armchair`: to whoever speaks, since things are brought to nowhere else."""
    link, _ = next(_TO_MINE.standing(tokens, at), ((), ()))
    if not link:
        return None
    seat = at + len(link)
    while seat < len(tokens) and tokens[seat].norm in _SEAT_WORDS:
        seat += 1
    if seat >= len(tokens) or tokens[seat].norm not in _SEATS or tokens[seat].possessive:
        return None
    clause = [t.norm for t in tokens[sentence_begins(tokens, at) : at]]
    verbs = (*_COMING, *_NEUTRAL) if tokens[seat].norm in _OWN_SEATS else _COMING
    verbs = (*verbs, "want", "like", "need") if tokens[at].norm != "to" else verbs
    if not (_HERE & set(clause[-2:]) or _forms(verbs) & set(clause) or "me" in clause):
        return None
    end = seat + 1
    near = next((len(words) for words in _BY if stands_all(tokens, end, words)), 0)
    if near and end + near < len(tokens) and tokens[end + near].norm in _FURNITURE:
        end += near + 1
    first = tokens[at]
    return end, [first._replace(norm="to"), reworded("me", tokens[at + 1], tokens[end - 1])]


def sentence_begins(tokens: list[Token], at: int) -> int:
    """Where the sentence begins that this place is in."""
    return next((k + 1 for k in range(at - 1, -1, -1) if tokens[k].norm in _SENTENCE), 0)


def _forms(verbs: tuple[str, ...]) -> frozenset[str]:
    return frozenset(words[0] for verb in verbs for _, words in inflections((verb,)))


def for_whom(tokens: list[Token], at: int, lexicon: Lexicon) -> Said | None:
    """`take it to room B for the children`: where it goes has been said."""
    if tokens[at].norm != "for" or (end := past_people(tokens, at + 1)) is None:
        return None
    end += end < len(tokens) and tokens[end].norm in ("there", "please")
    closed = end >= len(tokens) or tokens[end].shape is Shape.MARK or tokens[end].norm in ("and", "now")
    kinds = {e.kind for e in names_between(tokens, sentence_begins(tokens, at), at, lexicon)}
    return (end, []) if closed and {MentionKind.LOCATION, MentionKind.OBJECT} <= kinds else None


def to_whom(tokens: list[Token], at: int, lexicon: Lexicon) -> Said | None:
    """`take it to my wife in room A`: to room A."""
    end = past_people(tokens, at + 1) if tokens[at].norm == "to" else None
    if end is None or end + 1 >= len(tokens) or tokens[end].norm not in ("in", "at"):
        return None
    start = past_article(tokens, end + 1)
    name = match(lexicon.names, tokens, start) if start < len(tokens) else None
    placed = name is not None and name.kind is MentionKind.LOCATION
    thing = any(e.kind is MentionKind.OBJECT for e in names_between(tokens, sentence_begins(tokens, at), at, lexicon))
    return (end + 1, [tokens[at]]) if placed and thing else None


def who_is_there(tokens: list[Token], at: int, lexicon: Lexicon) -> Said | None:
    """`the children in room B want the cube`: whoever is there."""
    begin = at and tokens[at - 1].shape is not Shape.MARK and tokens[at - 1].norm not in ("and", "because", "so", "as")
    end = None if begin else past_people(tokens, at)
    if end is None or end + 2 >= len(tokens) or tokens[end].norm not in ("in", "at", "over"):
        return None
    start = past_article(tokens, end + 1 + (tokens[end].norm == "over"))
    name = match(lexicon.names, tokens, start) if start < len(tokens) else None
    if name is None or name.kind is not MentionKind.LOCATION:
        return None
    after = start + len(name.words)
    wish = next((words for words in NEEDING if stands_all(tokens, after, words)), None)
    if wish is None:
        return None
    needs = reworded("needs", tokens[after], tokens[after + len(wish) - 1])
    return after + len(wish), [*tokens[start:after], needs]


def who_wants(tokens: list[Token], at: int, lexicon: Lexicon) -> Said | None:
    """`housekeeping needs the dog in room B`: whoever it is, it is needed."""
    begins = (
        not at or tokens[at - 1].shape is Shape.MARK or tokens[at - 1].norm in ("and", "because", "so", "as", "since")
    )
    end = past_people(tokens, at) if begins else None
    if end is None or end >= len(tokens):
        return None
    wish = next((words for words in NEEDING if stands_all(tokens, end, words)), None)
    start = past_article(tokens, end + len(wish)) if wish is not None else len(tokens)
    name = match(lexicon.names, tokens, start) if start < len(tokens) else None
    if wish is None or name is None or name.kind not in (*ROBOT_KINDS, MentionKind.OBJECT):
        return None
    after = start + len(name.words)
    last = next((k for k in range(after, len(tokens)) if tokens[k].norm in _SENTENCE), len(tokens))
    placed = any(e.kind is MentionKind.LOCATION for e in names_between(tokens, after, last, lexicon))
    need = reworded("need", tokens[end], tokens[end + len(wish) - 1])
    we = reworded("we", tokens[at], tokens[end - 1])
    return (end + len(wish), [we, need]) if placed else None


def past_people(tokens: list[Token], at: int, *, owned: bool = False) -> int | None:
    """Past a noun for people that the crew gives no meaning."""
    end = past_all(tokens, at, _WHOSE | _KINDLY)
    known = end < len(tokens) and tokens[end].norm in _PEOPLE and (owned or not tokens[end].possessive)
    return end + 1 if known else None


def names_between(tokens: list[Token], first: int, after: int, lexicon: Lexicon) -> Iterator[Entry]:
    """The names between two places."""
    for k in range(first, after):
        name = match(lexicon.names, tokens, k)
        if name is not None and name.kind is not MentionKind.ACTION:
            yield name
