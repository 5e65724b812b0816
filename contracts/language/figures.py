"""Single figures: signed numbers in digits or words, in metres. A figure in any other unit is not read at all."""

from typing import NamedTuple

from crew.contracts.language.tokens import Shape, Token
from crew.contracts.language.words import DIGIT_WORDS, METRES, OTHER_UNITS, TENS_WORDS

_SIGNS = {"minus": -1.0, "negative": -1.0, "plus": 1.0}
_PARTED = frozenset(("point", "decimal", "minus", "negative", "plus"))
_SOUNDS = frozenset(("um", "uh", "er", "erm", "hmm", "like"))
_TAINTED = frozenset(("%", "/", "*", "^", "$", "#", "'"))


class Figure(NamedTuple):
    """A number and the token after it."""

    value: float
    after: int
    metres: bool
    """Whether the unit was said."""


def norm_at(tokens: list[Token], at: int) -> str:
    """A token's text, or nothing beyond the ends."""
    return tokens[at].norm if 0 <= at < len(tokens) else ""


def skip(tokens: list[Token], at: int, *words: str) -> int:
    """The next position, past one of the words if it stands here."""
    return at + 1 if norm_at(tokens, at) in words else at


def is_numeral(tokens: list[Token], at: int) -> bool:
    """Whether a token carries a number, in digits or in words."""
    token = tokens[at]
    return token.shape is Shape.NUMBER or token.norm in DIGIT_WORDS or token.norm in TENS_WORDS


def with_commas(tokens: list[Token]) -> list[Token]:
    """`three comma six point five`: the mark for the word, where it can be no decimal comma.

    That is where what follows has a sign or a decimal point of its own, or what precedes it has one, and behind `to`
    and its like, where a single figure would be no place.
    """
    out: list[Token] = []
    for at, token in enumerate(tokens):
        spoken = token.norm == "comma" and at > 0 and is_numeral(tokens, at - 1)
        second = figure(tokens, at + 1) if spoken else None
        ahead = {"point", "decimal"} & {t.norm for t in tokens[max(0, at - 4) : at]}
        parted = second is not None and (ahead or _PARTED & {t.norm for t in tokens[at + 1 : second.after]})
        placed = second is not None and second.after >= len(tokens) - 2 and _placed(tokens, at - 2)
        sure = second is not None and (parted or placed) and not second.metres
        out.append(token._replace(norm=",", shape=Shape.MARK) if sure else token)
    return out


def _placed(tokens: list[Token], at: int) -> bool:
    """Whether a place is to follow behind this token, but for sounds of hesitation."""
    while at > 0 and (tokens[at].norm in _SOUNDS or tokens[at].shape is Shape.MARK):
        at -= 1
    return at >= 0 and tokens[at].norm in ("to", "towards", "position", "coordinates", "point", "location", "waypoint")


def figure(tokens: list[Token], at: int) -> Figure | None:
    """A signed number with an optional unit of metres."""
    sign, at = _sign(tokens, at)
    found = _magnitude(tokens, at)
    if found is None:
        return None
    value, after = _and_a_half(tokens, *found)
    metres = norm_at(tokens, after) in METRES
    after += metres
    if _tainted(tokens, after):
        return None
    return Figure(sign * value, after, metres)


def _sign(tokens: list[Token], at: int) -> tuple[float, int]:
    word = norm_at(tokens, at)
    if word in _SIGNS:
        return _SIGNS[word], at + 1
    if word in ("-", "+") and at + 1 < len(tokens) and tokens[at + 1].start == tokens[at].end:
        glued = at > 0 and tokens[at - 1].end == tokens[at].start and tokens[at - 1].shape is not Shape.MARK
        if not glued:
            return (-1.0 if word == "-" else 1.0), at + 1
    return 1.0, at


def _magnitude(tokens: list[Token], at: int) -> tuple[float, int] | None:
    if at >= len(tokens):
        return None
    token = tokens[at]
    if token.shape is Shape.NUMBER:
        return float(token.norm), at + 1
    if token.norm in TENS_WORDS:
        unit = DIGIT_WORDS.get(norm_at(tokens, at + 1), 0)
        joined = 0 < unit < 10
        return _with_decimals(tokens, TENS_WORDS[token.norm] + (unit if joined else 0), at + 1 + joined)
    if token.norm in DIGIT_WORDS:
        second = DIGIT_WORDS.get(norm_at(tokens, at + 1), 10)
        spelled = 0 < DIGIT_WORDS[token.norm] < 10 and second < 10 and norm_at(tokens, at + 2) in METRES
        if spelled:  # "altitude one zero metres"
            return float(10 * DIGIT_WORDS[token.norm] + second), at + 2
        return _with_decimals(tokens, DIGIT_WORDS[token.norm], at + 1)
    return None


def _and_a_half(tokens: list[Token], value: float, at: int) -> tuple[float, int]:
    """`three and a half`."""
    half = [t.norm for t in tokens[at : at + 3]] == ["and", "a", "half"] and value.is_integer()
    return (value + 0.5, at + 3) if half else (value, at)


def _with_decimals(tokens: list[Token], whole: int, at: int) -> tuple[float, int]:
    """`five point two five`."""
    digits = ""
    if norm_at(tokens, at) in ("point", "decimal"):
        end = at + 1
        while (digit := DIGIT_WORDS.get(norm_at(tokens, end), 10)) < 10:
            digits, end = digits + str(digit), end + 1
        at = end if digits else at
    return float(f"{whole}.{digits or 0}"), at


def _tainted(tokens: list[Token], at: int) -> bool:
    """Whether what follows changes the number: another unit, a fraction, an odd character."""
    if at >= len(tokens):
        return False
    token = tokens[at]
    if token.norm in OTHER_UNITS or token.shape is Shape.ODD:
        return True
    return token.norm in _TAINTED or (token.shape is Shape.NUMBER and tokens[at - 1].end == token.start)
