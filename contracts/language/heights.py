"""How high a search is flown, said with a verb or in another order: `flying at 4 metres`, `high six meter`.

Put into words that the figures' reader has: `at 4 metres`. Before the search, flying to a height is taking off to it.
Nothing is said of how it is flown: a height is read only where its figure has a unit or a noun (`altitude`).
"""

import re

from crew.contracts.language.entry import Words, stands_all
from crew.contracts.language.figures import Figure, figure, norm_at
from crew.contracts.language.inflect import Form
from crew.contracts.language.lexicon import Lexicon
from crew.contracts.language.mention import MentionKind
from crew.contracts.language.tokens import Shape, Token, reworded

_NOUNS = frozenset(("altitude", "height", "elevation", "alt"))
_OF_FLIGHT = frozenset((
    "flight", "flying", "search", "searching", "cruise", "cruising", "operating", "constant", "steady", "working",
    "scan", "sweep", "hover", "fixed", "safe",
))  # fmt: skip
_STAYS = (
    "(?:fly|flying|flies|hover|hovering|hovers|cruise|cruising|cruises|stay|staying|stays|keep|keeping|keeps|remain|"
    "remaining|operate|operating|loiter|loitering|go|going|climb|climbing|rise|rising|ascend|ascending|get|level off)"
)
_LEADS = (
    f"(?:(?:while|whilst|and|by|and then) )?{_STAYS}(?: (?:up|it|itself|out|it up|along|low))? (?:at|on|in|to|from|"
    "with)|"
    "(?:(?:and|while) )?(?:maintain|maintaining|maintains|hold|holding|holds|keep|keeping|use|using|set|setting|take)|"
    "(?:with )?(?:altitude|height) (?:set |is |to be |should be |will be )?(?:to|at|is)|"
    "set (?:altitude|height|the altitude|the height|your altitude|your height) (?:to|at)|"
    "at (?:a |an )?(?:altitude|height) (?:at|on|in)"
)
_LONGEST_LEAD = 6
_PATTERN = re.compile(_LEADS)
_BEGINS = frozenset(re.findall("[a-z]+", _LEADS))
_RISES = frozenset(("fly", "flies", "go", "climb", "rise", "ascend", "get", "hover", "stay", "going", "flying"))
_THEN_ONLY = frozenset(("when", "once", "if", "until", "till", "after", "before", "unless", "as", "where", "whenever"))
"""What would make a height one for another moment."""


def heights(tokens: list[Token], lexicon: Lexicon) -> list[Token]:
    """The tokens of a request with plain words for the height of a search."""
    sweeps = [at for at in range(len(tokens)) if _sweeps(tokens, at, lexicon)]
    if not sweeps:
        return tokens
    out: list[Token] = []
    at = 0
    while at < len(tokens):
        found = _flown(tokens, at, sweeps, lexicon) or _turned(tokens, at) or _noun(tokens, at)
        after, plain = found or (at + 1, tokens[at : at + 1])
        out.extend(plain)
        at = after
    return out


def _flown(tokens: list[Token], at: int, sweeps: list[int], lexicon: Lexicon) -> tuple[int, list[Token]] | None:
    """`flying at 4 metres`, `maintain an altitude of 4 metres`."""
    lead = _lead(tokens, at)
    if not lead:
        return None
    begin = at + len(lead)
    first, value = _height(tokens, begin, noun=lead[-1] not in ("at", "on", "in", "to", "from", "with", "is"))
    if value is None or norm_at(tokens, value.after) in _THEN_ONLY:
        return None
    verb = next((k for k, word in enumerate(lead) if word in _RISES), None)
    if verb is not None and not any(k < at for k in sweeps) and any(k >= value.after for k in sweeps):
        if "launch" not in lexicon.names:
            return None
        joined = tokens[at : at + verb]
        return begin, [*joined, reworded("launch", tokens[at + verb]), reworded("to", tokens[begin - 1])]
    return first, [reworded("at", tokens[at])]


def _lead(tokens: list[Token], at: int) -> Words:
    """The longest wording in front of a height that stands here."""
    if tokens[at].norm not in _BEGINS:
        return ()
    said = [t.norm for t in tokens[at : at + _LONGEST_LEAD]]
    ends = range(len(said), 0, -1)
    return next((tuple(said[:end]) for end in ends if _PATTERN.fullmatch(" ".join(said[:end]))), ())


def _height(tokens: list[Token], at: int, *, noun: bool) -> tuple[int, Figure | None]:
    """Where a height begins without its article, and its figure; None where it has neither a noun nor a unit."""
    begin = at + (norm_at(tokens, at) in ("a", "an", "the", "your"))
    named = begin
    while norm_at(tokens, named) in _OF_FLIGHT:
        named += 1
    if norm_at(tokens, named) in _NOUNS:
        start = named + 1
        while norm_at(tokens, start) in ("of", ":", "=", "at", "is", "to", "flying", "flight"):
            start += 1
        return named, figure(tokens, start)
    value = figure(tokens, begin)
    return begin, value if value is not None and value.metres and not noun else None


def _turned(tokens: list[Token], at: int) -> tuple[int, list[Token]] | None:
    """`high six meter`, `@ 6 m`."""
    value = figure(tokens, at + 1) if tokens[at].norm in ("high", "@") else None
    if value is None or not value.metres:
        return None
    if tokens[at].norm == "@":
        return at + 1, [reworded("at", tokens[at])]
    opens = at == 0 or tokens[at - 1].shape is Shape.MARK or tokens[at - 1].norm in ("at", "in", "half", "area", "with")
    return (value.after, [*tokens[at + 1 : value.after], reworded("high", tokens[at])]) if opens else None


def _noun(tokens: list[Token], at: int) -> tuple[int, list[Token]] | None:
    """`flight altitude 5 metres`, `flight level 5 metres`."""
    flown = tokens[at].norm in _NOUNS and norm_at(tokens, at + 1) == "of" and norm_at(tokens, at + 2) in _OF_FLIGHT
    if flown and figure(tokens, at + 3) is not None:
        return at + 3, [tokens[at]]
    if tokens[at].norm not in _OF_FLIGHT or norm_at(tokens, at + 1) not in (*_NOUNS, "level"):
        return None
    start = at + 2
    while norm_at(tokens, start) in ("of", ":", "=", "at", "is"):
        start += 1
    return (at + 2, [reworded("altitude", tokens[at])]) if figure(tokens, start) is not None else None


def _sweeps(tokens: list[Token], at: int, lexicon: Lexicon) -> bool:
    return any(
        e.kind is MentionKind.ACTION
        and e.form is not Form.PAST
        and stands_all(tokens, at, e.words)
        and any((r.contract, r.step) in lexicon.zone_steps for r in e.means)
        for e in lexicon.names.get(tokens[at].norm, ())
    )
