"""Whoever is at a place of the crew: `my wife is in room A, take the bottle to her` is to take it there.

Only in a crew that brings things and looks for nobody: elsewhere a person is who is to be found.
"""

from crew.contracts.language.entry import stands_all
from crew.contracts.language.lexicon import Lexicon, match
from crew.contracts.language.mention import MentionKind
from crew.contracts.language.patterns import past_article
from crew.contracts.language.recipients import NEEDING, past_people
from crew.contracts.language.tokens import Shape, Token, reworded
from crew.contracts.language.words import word_set

_BEING = tuple(
    tuple(said.split())
    for said in (
        "is sitting", "are sitting", "is waiting", "are waiting", "is lying", "is resting", "is staying", "is now",
        "are now", "is over", "are over", "is down", "is up", "is back", "is", "are", "sits", "waits", "wait", "sit",
        "lives", "lies", "has moved to", "moved to", "over", "down", "",
    )
)  # fmt: skip
_STATES = word_set("thirsty hungry bored waiting ready parched cold asking")
_ANYBODY = word_set("someone somebody everyone everybody they people")
_PRONOUNS = word_set("her him them")
_SUBJECTS = word_set("she he they who she'd he'd they'd")
_OPENS = word_set("and because so as since but well")


def placed_people(tokens: list[Token], lexicon: Lexicon) -> list[Token]:
    """The tokens of a request with the place for the person who is there, where one is told to be."""
    if not lexicon.to_requester or lexicon.reports:
        return tokens
    for at in range(len(tokens)):
        begins = not at or tokens[at - 1].shape is Shape.MARK or tokens[at - 1].norm in _OPENS
        found = _told(tokens, at, lexicon) if begins else None
        if found is not None:
            plain, end = found
            return [*tokens[:at], *plain, *_there(tokens[end:])]
    return tokens


def _told(tokens: list[Token], at: int, lexicon: Lexicon) -> tuple[list[Token], int] | None:
    """The place of a person who is told to be there, and where that is over."""
    anybody = at + 1 if tokens[at].norm in _ANYBODY else None
    end = past_people(tokens, at, owned=True) or anybody
    if end is None:
        return None
    being = () if tokens[end - 1].possessive else next(w for w in _BEING if stands_all(tokens, end, w))
    link = end + len(being)
    start = link + (link < len(tokens) and tokens[link].norm in ("in", "at"))
    if start == link and "to" not in being:
        return None
    first = past_article(tokens, start)
    name = match(lexicon.names, tokens, first) if first < len(tokens) else None
    if name is None or name.kind is not MentionKind.LOCATION:
        return None
    after = first + len(name.words)
    place = tokens[start:after]
    if stands_all(tokens, after, ("is",)) or stands_all(tokens, after, ("are",)):
        state = after + 1 + (after + 1 < len(tokens) and tokens[after + 1].norm in ("very", "so", "really"))
        told = state < len(tokens) and tokens[state].norm in _STATES and _over(tokens, state + 1)
        return (place, state + 1) if told else None
    said = bool(being and being != ("over",)) or tokens[end - 1].possessive
    if not said:
        return None
    subject = after + (after < len(tokens) and tokens[after].norm in ("and", ","))
    subject += subject < len(tokens) and tokens[subject].norm == "and"
    if subject < len(tokens) and tokens[subject].norm in _SUBJECTS:
        need = _needs(tokens, subject)
        return None if need is None else ([*place, reworded("needs", tokens[subject], tokens[need - 1])], need)
    return (place, after) if _over(tokens, after) and {t.norm for t in tokens[after:]} & _PRONOUNS else None


def _needs(tokens: list[Token], at: int) -> int | None:
    """Past `she'd like`, `he needs`."""
    if tokens[at].norm.endswith("'d"):
        wished = at + 1 < len(tokens) and tokens[at + 1].norm in ("like", "love")
        return at + 2 if wished else None
    wish = next((words for words in NEEDING if stands_all(tokens, at + 1, words)), None)
    return None if wish is None else at + 1 + len(wish)


def _over(tokens: list[Token], at: int) -> bool:
    return at >= len(tokens) or tokens[at].shape is Shape.MARK or tokens[at].norm in ("so", "and")


def _there(tokens: list[Token]) -> list[Token]:
    """`to her` is there."""
    out: list[Token] = []
    for token in tokens:
        if token.norm in _PRONOUNS and out and out[-1].norm == "to":
            out[-1] = reworded("there", out[-1], token)
        else:
            out.append(token)
    return out
