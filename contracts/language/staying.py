"""A robot that is to stay: `keep the rover parked`, `rover to hold position`, `the rover isn't needed`.

Beside something else that is asked for, it is left out of that; beside a landing or a stop it is to stop as well, since
it may be moving. One that stays first and is sent later is sent later: that is what the crew does anyway.
"""

import re
from functools import cache

from crew.contracts.language.entry import Entry
from crew.contracts.language.inflect import Form
from crew.contracts.language.lexicon import Lexicon, match
from crew.contracts.language.lookahead import ARTICLES
from crew.contracts.language.mention import ROBOT_KINDS, MentionKind
from crew.contracts.language.symbols import Naming, spelled
from crew.contracts.language.tokens import Shape, Token, reworded

_LONGEST = 16
_HALTS = frozenset(("hold", "holds", "halt", "halts", "freeze", "freezes", "stop", "stops", "holding"))
_STOP, _FREEZE = "stop", "freeze"
"""What a robot is told, and what it must be able to do: a drone that stops, lands."""

_IT_IS = "(?:(?:it|he|she|they|you) (?:is|are|was|were|stands?|sits?|currently is)|it's(?: at)?|you're(?: at)?)"
_STATE = (
    f"(?:(?:right |exactly |just )?where(?:ver)? {_IT_IS}(?: (?:now|right now|at|currently|already|parked|standing))?|"
    "put|still|parked(?: up)?(?: at PLACE)?|there|right there|in place|in position|in its place|position|station|"
    "its position|its ground|fast|tight|at PLACE|PLACE|at the PLACE|on standby|at standby|standing by|on the ground|"
    "grounded|landed|down on the ground|idle|stationary|motionless|immobile|in reserve|back|behind|as it is|as is|"
    "out of (?:it|this|that)|off|switched off|inactive|alone|untouched|waiting|at rest|at a standstill|on hold|halted)"
)
_STAY = (
    "(?:stays?|staying|remains?|remaining|waits?|waiting|stands? by|standing by|stands? fast|sits? tight|sits?|"
    "keeps?|keeping|hangs? back|rests?|idles?|stands? still|stand still|waits? there)"
)
_HALT = "(?:holds?|holding|halts?|freezes?|stops?)"
_ALONE = "(?:waits?|waiting|stands? by|standing by|stands? fast|sits? tight|stands? still|hangs? back|idles?)"
_BOUND = (
    "(?:(?:is|are|to|shall|should|must|will|can|has to|have to|needs to|need to|is to|may|just|please|simply|then|"
    "meanwhile|only|itself|ought to|'ll) )*"
)
_CAUSE = "(?:have|let|get|make|tell|order|want|i want|ask|instruct|command|leave)"
_NEED = "(?:needed|required|wanted|necessary|to move|to be moved|to go anywhere|involved|to be involved|used)"
_SO_FAR = (
    "(?: (?:for now|for the moment|for the time being|at the moment|for the present|please|throughout|meanwhile|"
    "in the meantime|all the time|the whole time|right now|now|at once|immediately))?"
)
_STAYING: tuple[str, ...] = (
    f"(?:keep|hold) ROBOT {_STATE}",
    f"leave ROBOT {_STATE.replace('at PLACE|', '').replace('at the PLACE|', '')}",
    f"{_CAUSE} ROBOT (?:to )?(?:{_STAY} {_STATE}|{_ALONE})",
    f"(?:with |while |whilst |and )?ROBOT (?:, |: |- )?{_BOUND}(?:{_STAY} {_STATE}|{_ALONE})",
    "(?:with )?ROBOT (?:is )?(?:on standby|standing by|in reserve|kept where it is|"
    "kept on standby|kept back|left where it is|left alone|left out|staying put)",
    "(?:with )?ROBOT (?:parked|grounded|stationary)",
    f"ROBOT (?:is not|isn't|not|isnt|won't be|will not be|is no longer|need not be|needn't be|does not need to be|"
    f"doesn't need to be|doesn't have to be|does not have to be|shall not be|should not be) {_NEED}",
    "ROBOT (?:does not|doesn't|need not|needn't|doesn't need to|does not need to|doesn't have to|does not have to|"
    "won't|will not|is not to|should not|shouldn't|must not|mustn't|not to) (?:move|drive|go anywhere|go|take part|"
    "do anything|fly|take off|budge|leave|set off)(?: at all)?",
)
"""Clauses by which a robot stays, in any request."""
_HALTING: tuple[str, ...] = (
    f"{_HALT} ROBOT {_STATE}",
    f"{_CAUSE} ROBOT (?:to )?{_HALT} {_STATE}",
    f"(?:with |while |whilst |and )?ROBOT (?:, |: |- )?{_BOUND}{_HALT} {_STATE}",
    "ROBOT (?:, |: |- )?(?:please )?(?:stay|remain|wait|stand|keep|sit) (?:put|still|tight|fast|right there|(?:right |"
    "exactly |just )?where you (?:are|stand)|in place|in position)",
)
"""Clauses by which it holds where it is, which is to stop."""
_HELD: tuple[str, ...] = ("hold ROBOT(?: back)?", f"ROBOT (?:, |: |- )?{_BOUND}(?:holds?|holding)")
"""The same beside something else that is asked for."""


def staying(tokens: list[Token], lexicon: Lexicon) -> list[Token]:
    """The tokens of a request with plain words for a robot that is to stay, in a crew that can be told to stop."""
    if not lexicon.preempting:
        return tokens
    out: list[Token] = []
    at = 0
    while at < len(tokens):
        begins = at == 0 or tokens[at - 1].shape is Shape.MARK or tokens[at - 1].norm in _OPENS
        found = _stays(tokens, at, lexicon) if begins or tokens[at].norm in ("with", "while", "whilst") else None
        after, plain = found or (at + 1, tokens[at : at + 1])
        out.extend(plain)
        at = after
    return out


_OPENS = frozenset(("and", "but", "then", "please", "while", "whilst", "so", "just", "meanwhile", "with", "also"))


def _stays(tokens: list[Token], at: int, lexicon: Lexicon) -> tuple[int, list[Token]] | None:
    """What becomes of a clause by which a robot stays."""
    said = spelled(tokens, at, lexicon, _naming(lexicon), _LONGEST, _MARKS)
    halts = said.longest(_compiled("halting"))
    end = max(halts, said.longest(_compiled("staying")))
    others = _asked(tokens, [*range(at), *range(said.spans[end - 1][1], len(tokens))], lexicon) if end else set()
    if not end:
        end = halts = said.longest(_compiled("held"))
        others = _asked(tokens, [*range(at), *range(said.spans[end - 1][1], len(tokens))], lexicon) if end else set()
        if "doing" not in others:
            return None
    after = said.spans[end - 1][1]
    if not _closed(tokens, after) or "ROBOT" not in said.words[:end]:
        return None
    first, past = said.spans[said.words.index("ROBOT")]
    name = [t._replace(possessive=False) for t in tokens[first:past]]
    if _sent_later(tokens, name, after):
        return after, []
    if "doing" in others or not (halts or others):
        return after, [reworded("leave", tokens[at]), *name, reworded("alone", tokens[after - 1])]
    robots = match(lexicon.names, tokens, past - 1) or match(lexicon.names, tokens, first)
    if not _can_stop(tokens, first, past, lexicon) or robots is None:
        return after, [reworded("leave", tokens[at]), *name, reworded("alone", tokens[after - 1])]
    return after, [reworded(_STOP, tokens[at]), *name]


_MARKS = frozenset((",", ":", "-"))


def _asked(tokens: list[Token], places: list[int], lexicon: Lexicon) -> set[str]:
    """What else is asked for: an end (`land`), or anything else (`search`, `rover to base`)."""
    found: set[str] = set()
    for at in places:
        name = match(lexicon.names, tokens, at)
        if name is None or (name.kind is not MentionKind.ACTION and not _goes(tokens, at, name, lexicon)):
            continue
        ends = name.kind is MentionKind.ACTION and any(r.contract in lexicon.preempting for r in name.means)
        if name.kind is not MentionKind.ACTION or name.form is not Form.PAST:
            found.add("ending" if ends else "doing")
    return found


def _goes(tokens: list[Token], at: int, name: Entry, lexicon: Lexicon) -> bool:
    """`rover to base`, `drone up`."""
    after = at + len(name.words)
    if name.kind not in ROBOT_KINDS or after + 1 >= len(tokens) or tokens[after].norm not in ("to", "up", "back"):
        return False
    verb = match(lexicon.names, tokens, after + 1)
    return verb is None or verb.kind is not MentionKind.ACTION


def _sent_later(tokens: list[Token], name: list[Token], after: int) -> bool:
    """`rover stands by; once found, the rover drives to him`."""
    norms = [t.norm for t in tokens[after:]]
    called = name[-1].norm in norms
    return called and ("then" in norms or ("once" in norms and "found" in norms))


def _can_stop(tokens: list[Token], first: int, past: int, lexicon: Lexicon) -> bool:
    while first < past and tokens[first].norm in ARTICLES:
        first += 1
    name = match(lexicon.names, tokens, first)
    able = {r.skill for e in lexicon.names.get(_FREEZE, ()) if e.words == (_FREEZE,) for r in e.means}
    return name is not None and all(able & lexicon.members.get(str(r), frozenset()) for r in name.values)


def _closed(tokens: list[Token], at: int) -> bool:
    return at >= len(tokens) or tokens[at].shape is Shape.MARK or tokens[at].norm in ("and", "but", "while", "then")


def _naming(lexicon: Lexicon) -> Naming:
    def symbol(name: Entry) -> str:
        if name.kind in ROBOT_KINDS and not name.plural:
            return "ROBOT"
        return "PLACE" if name.kind is MentionKind.LOCATION else ""

    return symbol


@cache
def _compiled(table: str) -> re.Pattern[str]:
    patterns = {"staying": _STAYING, "halting": _HALTING, "held": _HELD}[table]
    return re.compile("|".join(f"(?:{pattern}){_SO_FAR}" for pattern in patterns))
