"""What a robot does where it went, and places named by another one: `and wait there`, `the other table`."""

from crew.contracts.language.entry import stands_all
from crew.contracts.language.lexicon import Lexicon, match
from crew.contracts.language.mention import ROBOT_KINDS, MentionKind
from crew.contracts.language.patterns import past_article
from crew.contracts.language.recipients import Said, names_between, sentence_begins
from crew.contracts.language.tokens import Shape, Token, reworded
from crew.contracts.language.wordings import of_phrases
from crew.contracts.language.words import word_set

_STAYING = ("stay", "wait", "remain", "rest", "stand by", "stand", "sit", "hold", "park", "stop")
_KEPT = ("leave", "keep", "have", "let", "park", "make")
_SENT_OVER = ("send", "bring", "get", "take", "carry", "deliver", "walk", "move")
_PUTTING = word_set("put place set lay")
_THERE = (
    ("there",),
    ("right", "there"),
    ("in", "there"),
    ("over", "there"),
    ("for", "me", "there"),
    ("there", "for", "me"),
)


def stays(tokens: list[Token], at: int, lexicon: Lexicon) -> Said | None:
    """`go to room A and wait there`, `send the dog to room A and leave it there`: a robot stands where it went."""
    start = at
    while start < len(tokens) and tokens[start].norm in ("and", ",", "then", "just"):
        start += 1
    if start == at or start >= len(tokens) or (end := _past_stay(tokens, start)) is None:
        return None
    closed = end >= len(tokens) or tokens[end].norm in (".", "!") or _closing(tokens, end, lexicon)
    first = sentence_begins(tokens, at)
    kinds = [e.kind for e in names_between(tokens, first, at, lexicon)]
    carried = MentionKind.OBJECT in kinds and not _PUTTING & {t.norm for t in tokens[first:at]}
    return (end, []) if closed and MentionKind.LOCATION in kinds and not carried else None


def _closing(tokens: list[Token], at: int, lexicon: Lexicon) -> bool:
    following = past_article(tokens, at + (tokens[at].norm == ","))
    name = match(lexicon.names, tokens, following) if following < len(tokens) else None
    called = name is not None and name.kind in ROBOT_KINDS and following + len(name.words) >= len(tokens)
    return called or (following < len(tokens) and tokens[following].norm in ("please", "over", "thanks", "now"))


def _past_stay(tokens: list[Token], at: int) -> int | None:
    """Past `stay there`, `wait for me`, `leave it there`, `let it rest`."""
    end = at
    kept = tokens[at].norm in _KEPT and at + 1 < len(tokens) and tokens[at + 1].norm in ("it", "him", "her", "them")
    if kept:
        end = at + 2 + (at + 2 < len(tokens) and tokens[at + 2].norm == "to")
    stay = next((len(v.split()) for v in _STAYING if stands_all(tokens, end, tuple(v.split()))), 0)
    stay += bool(stay) and stands_all(tokens, end + stay, ("put",))
    where = end + stay
    there = next((len(w) for w in _THERE if stands_all(tokens, where, w)), 0)
    if not stay and not (kept and there and tokens[at].norm not in ("have", "let", "make")):
        return None
    if tokens[end].norm in ("hold", "stop", "sit", "stand", "park", "rest") and not (there or kept):
        return None
    return where + there


def sent_over(tokens: list[Token], at: int, lexicon: Lexicon) -> Said | None:
    """`the dog is needed in room B, send it over`: there."""
    verb = (
        tokens[at].norm in _SENT_OVER and at + 2 < len(tokens) and tokens[at + 1].norm in ("it", "them", "him", "her")
    )
    if not verb or tokens[at + 2].norm not in ("over", "round", "across", "along"):
        return None
    end = at + 3
    closed = end >= len(tokens) or tokens[end].shape is Shape.MARK or tokens[end].norm in ("please", "now", "and")
    places = {e.name for e in names_between(tokens, 0, at, lexicon) if e.kind is MentionKind.LOCATION}
    there = tokens[at + 2]._replace(norm="there")
    return (end, [*tokens[at : at + 2], there]) if closed and len(places) == 1 else None


def pointed_at(tokens: list[Token], at: int, lexicon: Lexicon) -> Said | None:
    """`grab the red cube there`, `lift the bottle off the table`: where it is, where no place was named."""
    shown, _ = next(_SHOWN.standing(tokens, at), ((), ()))
    end = at + len(shown)
    if not shown or not at:
        return None
    closed = (
        end >= len(tokens) or tokens[end].shape is Shape.MARK or tokens[end].norm in ("and", "please", "then", "now")
    )
    thing = any(
        e.kind is MentionKind.OBJECT and stands_all(tokens, at - len(e.words), e.words)
        for k in range(max(0, at - 3), at)
        for e in lexicon.names.get(tokens[k].norm, ())
    )
    places = any(e.kind is MentionKind.LOCATION for e in names_between(tokens, 0, at, lexicon))
    verbs = {t.norm for t in tokens[sentence_begins(tokens, at) : at]}
    tables = sum(e.kind is MentionKind.LOCATION for e in lexicon.names.get("table", ()))
    off = tokens[at].norm in ("off", "from", "on")
    known = bool(tables) if off else True
    return (end, []) if closed and thing and known and not places and verbs & _TAKING else None


_SHOWN = of_phrases(
    (
        "there",
        "over there",
        "right there",
        "just there",
        "from over there",
        "off the table",
        "from the table",
        "from off the table",
        "up off the table",
        "up from the table",
        "off of the table",
    )
)
_TAKING = word_set("grab take pick lift get fetch hold bring pass hand give grasp seize")


def other_one(tokens: list[Token], at: int, lexicon: Lexicon) -> Said | None:
    """`take it off table A and put it on the other one`: of two places of one noun, the one that was not named."""
    if tokens[at].norm != "other" or not at or tokens[at - 1].norm != "the":
        return None
    if (own := match(lexicon.names, tokens, at)) is not None and own.kind is MentionKind.LOCATION:
        return None
    noun = tokens[at + 1].norm if at + 1 < len(tokens) else ""
    named = [e.name for e in names_between(tokens, 0, at, lexicon) if e.kind is MentionKind.LOCATION]
    pair = (
        {e.name for e in lexicon.names.get(named[0].split("_")[0], ()) if e.kind is MentionKind.LOCATION}
        if named
        else set()
    )
    other = sorted(pair - set(named))
    family = named[0].split("_")[0] if named else ""
    if (
        len(set(named)) != 1
        or len(pair) != 2
        or len(other) != 1
        or noun not in ("one", family, "", ".", "!", "please", ",")
    ):
        return None
    end = at + 1 + (noun in ("one", family))
    words = other[0].split("_")
    return end, [reworded(w, tokens[at], tokens[end - 1]) for w in words]
