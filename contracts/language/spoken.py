"""What people say aloud and no form would hold: words said twice, letters spelled out, adjectives that pick none out.

Each of these leaves what is asked for as it is; what may change it (a figure, a negation) is never taken away.
"""

from crew.contracts.language.arrived import other_one, pointed_at, sent_over, stays
from crew.contracts.language.entry import stands_all
from crew.contracts.language.figures import is_numeral
from crew.contracts.language.lexicon import Lexicon, match
from crew.contracts.language.lookahead import ARTICLES
from crew.contracts.language.mention import ROBOT_KINDS, MentionKind
from crew.contracts.language.patterns import past_article
from crew.contracts.language.placed_people import placed_people
from crew.contracts.language.recipients import Said, for_whom, seat, to_whom, who_is_there, who_wants
from crew.contracts.language.tokens import Shape, Token, reworded
from crew.contracts.language.words import AFFECTIVE, word_set

_LONGEST_REPEAT = 4
_NATO = word_set(
    "alpha bravo charlie delta echo foxtrot golf hotel india juliett kilo lima mike november oscar papa quebec romeo "
    "sierra tango uniform victor whiskey xray yankee zulu"
)
_SPELLED = _NATO | word_set("alfa bee apple adam anna able bob boy baker ball bear banana berlin bertha anton")
_NUMBERED = word_set("number no nr called named letter marked labelled labeled")
_LIKE = (("as", "in"), ("for",), ("like",), ("like", "in"), ("as", "for"))
_MOTION = word_set("to at towards toward into from near by for")
_DESCRIBING = word_set(
    "metal metallic mechanical robotic tin iron steel electric electronic big large huge great tall long small tiny "
    "wee short funny faithful loyal obedient wonderful splendid marvellous strong mighty shiny yellow black white grey "
    "gray silver walking walkie fast noisy silly clumsy beautiful amazing clever furry"
)
"""Adjectives that pick none out where a name means one robot only."""
_OPENING = word_set("you it that them her him me us there here")
"""What a clause may end with, and the next one begin."""
_MEANT_TWICE = word_set("again more very over that had no x y")


def spoken(tokens: list[Token], lexicon: Lexicon) -> list[Token]:
    """The tokens of a request as they would be written."""
    tokens = placed_people(_once(_flowing(tokens), lexicon), lexicon)
    out: list[Token] = []
    at = 0
    while at < len(tokens):
        readers = (
            _described, _spelled, _spelled_again, _drop_off, seat, for_whom, to_whom, who_is_there, who_wants,
            stays, pointed_at, sent_over, other_one,
        )  # fmt: skip
        said = (read(tokens, at, lexicon) for read in readers)
        end, plain = next((found for found in said if found is not None), (at + 1, tokens[at : at + 1]))
        out.extend(plain)
        at = end
    return out


def _flowing(tokens: list[Token]) -> list[Token]:
    """`over to, um, the drop-off`: no pause where nothing ends."""
    out: list[Token] = []
    for at, token in enumerate(tokens):
        counted = at + 1 < len(tokens) and is_numeral(tokens, at + 1)
        if token.norm != "," or not out or out[-1].norm not in _GOES_ON or counted:
            out.append(token)
    return out


_GOES_ON = word_set("the an to at into onto of with from ,")


def _once(tokens: list[Token], lexicon: Lexicon) -> list[Token]:
    """`could I could I get the the bottle`: what is said again at once, with at most a comma between."""
    out: list[Token] = []
    for token in tokens:
        out.append(token)
        for length in range(1, _LONGEST_REPEAT + 1):
            if (cut := _repeat(out, length, lexicon)) is not None:
                del out[cut:]
                break
    return out


def _repeat(tokens: list[Token], length: int, lexicon: Lexicon) -> int | None:
    """Where the last words begin, if they only repeat the words before them."""
    second = len(tokens) - length
    comma = second > 0 and tokens[second - 1].norm in (",", "\u2026")
    first = second - comma - length
    if first < 0:
        return None
    said, again = tokens[first : first + length], tokens[second:]
    if [t.norm for t in said] != [t.norm for t in again] or any(t.shape is not Shape.WORD for t in again):
        return None
    turning = lexicon.vocabulary.turning
    counted = any(is_numeral(tokens, k) for k in range(first, len(tokens)))
    kept = counted or any(t.norm in turning or t.norm.endswith("n't") or t.possessive for t in again)
    named = any(e.kind is not MentionKind.ACTION for e in lexicon.names.get(again[0].norm, ()))
    if comma and length == 1 and (again[0].norm in _OPENING or (named and first)):
        return None  # "thank you, you may wave", "load it on the dog, dog to room A"
    letter = length == 1 and (len(again[0].norm) == 1 or again[0].norm in _MEANT_TWICE)
    return None if kept or (letter and again[0].norm != "a") else second - comma


def _described(tokens: list[Token], at: int, lexicon: Lexicon) -> Said | None:
    """`the big metal dog`: of one robot, adjectives pick none out."""
    if tokens[at].norm not in _DESCRIBING or match(lexicon.names, tokens, at) is not None:
        return None
    end = at
    while end < len(tokens) and tokens[end].norm in _DESCRIBING | AFFECTIVE:
        end += 1
    name = match(lexicon.names, tokens, end) if end < len(tokens) else None
    one = name is not None and name.kind in ROBOT_KINDS and len(name.values) == 1 and not name.plural
    return (end, []) if one else None


def _spelled(tokens: list[Token], at: int, lexicon: Lexicon) -> Said | None:
    """`room bravo`: a letter by its name, where the crew has that place and none of this name."""
    word = tokens[at].norm
    if word in _NUMBERED and at and at + 1 < len(tokens):
        joined = match(lexicon.names, [tokens[at - 1], tokens[at + 1]], 0)
        placed = joined is not None and joined.kind is MentionKind.LOCATION and len(joined.words) == 2
        return (at + 1, []) if placed and len(tokens[at + 1].norm) == 1 else None
    if (word not in _NATO and word not in ("alfa", "bee")) or not at:
        return None
    letter = tokens[at]._replace(norm=word[0])
    known = match(lexicon.names, [*tokens[:at], letter], at - 1)
    own = match(lexicon.names, tokens, at - 1)
    placed = known is not None and known.kind is MentionKind.LOCATION and len(known.words) == 2
    return (at + 1, [letter]) if placed and (own is None or len(own.words) < 2) else None


def _spelled_again(tokens: list[Token], at: int, lexicon: Lexicon) -> Said | None:
    """`room B as in bravo`, `room B, B for bravo`: the letter of the place that was just named."""
    start = at + (tokens[at].norm in (",", "-", "("))
    letter = tokens[at - 1].norm if at else ""
    placed = len(letter) == 1 and at > 1 and match(lexicon.names, tokens, at - 2) is not None
    if not placed or start >= len(tokens):
        return None
    said = start + (tokens[start].norm == letter)
    like = next((len(words) for words in _LIKE if stands_all(tokens, said, words)), 0)
    word = said + like
    fits = word < len(tokens) and tokens[word].norm in _SPELLED and tokens[word].norm[0] == letter
    if not fits or (like == 1 and tokens[said].norm == "for" and said == at):
        return None
    return word + 1 + (tokens[at].norm == "(" and word + 1 < len(tokens) and tokens[word + 1].norm == ")"), []


def _drop_off(tokens: list[Token], at: int, lexicon: Lexicon) -> Said | None:
    """`proceed to drop off`: a place of a verb's name, where no thing follows that could be dropped."""
    entry = match(lexicon.names, tokens, at)
    place = next(
        (
            e
            for e in lexicon.names.get(tokens[at].norm, ())
            if e.kind is MentionKind.LOCATION and stands_all(tokens, at, e.words)
        ),
        None,
    )
    verb = entry is not None and any(
        e.kind is MentionKind.ACTION and e.words == entry.words for e in lexicon.names.get(tokens[at].norm, ())
    )
    if place is None or len(place.words) < 2 or not verb or not at or tokens[at - 1].norm not in _MOTION:
        return None
    end = at + len(place.words)
    name = match(lexicon.names, tokens, past_article(tokens, end)) if past_article(tokens, end) < len(tokens) else None
    thing = name is not None and name.kind is MentionKind.OBJECT
    follows = end < len(tokens) and (tokens[end].norm in ARTICLES or tokens[end].norm in ("it", "them"))
    if thing or follows or (place.name, 1) not in {(e.name, len(e.words)) for e in lexicon.names.get(place.name, ())}:
        return None
    return end, [reworded(place.name, tokens[at], tokens[end - 1])]
