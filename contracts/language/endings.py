"""Everything is to end: `call the whole thing off`, `stand everything down`, `we're done here, bring everything in`.

Only in a crew with a contract that ends what the robots do. What says that something is over asks for nothing by
itself: it is left out beside an order that ends it, or that sends a robot home.
"""

import re
from functools import cache

from crew.contracts.language.entry import Entry
from crew.contracts.language.inflect import Form
from crew.contracts.language.lexicon import Lexicon, match
from crew.contracts.language.mention import ROBOT_KINDS, MentionKind
from crew.contracts.language.symbols import Naming, spelled
from crew.contracts.language.tokens import Shape, Token, reworded
from crew.contracts.language.words import Role

_ABORT = "abort"
_LONGEST = 8

_ALL = (
    "(?:everything|it all|all of it|all of this|all of that|this all|the lot|the whole lot|(?:the|this) (?:whole|"
    "entire|"
    "complete) (?:thing|lot|show|mission|operation|business|job|search|exercise|affair)|all|(?:all|any|every) "
    "(?:ongoing |"
    "current |further |robot |crew )?(?:activity|activities|operation|operations|task|tasks|job|jobs|mission|missions|"
    "motion|motions|movement|movements|work|action|actions|searches|search|systems|units)|everybody|everyone|ROBOTS|"
    "both|them both|both of them|both of you|you both|them all|all of them|all of you|the two of (?:them|you)|"
    "(?:the|this|that|our) (?:current |present |running |ongoing )?(?:mission|operation|search|task|job|exercise|"
    "tasking|sweep))"
)
_VERBS = (
    "(?:stop|stopping|halt|halting|abort|aborting|end|ending|cancel|cancelling|canceling|terminate|terminating|"
    "quit|quitting|cease|ceasing|discontinue|scrub|scrubbing|shut down|shutting down|stand down|"
    "standing down|call off|calling off|break off|breaking off|turn off|switch off|shut off|power down|close down|"
    "kill|freeze)"
)
_PARTED = (
    "(?:(?:call|calling|break|breaking|turn|turning|switch|switching|shut|shutting) OBJ off|(?:stand|standing|shut|"
    "shutting|power|powering|close|closing|bring|bringing|get|getting) OBJ down)"
)
_ENDS: tuple[str, ...] = (
    f"(?:(?:we're|we are|i'm|i am|we|let's|let us) )?{_VERBS} {_ALL}",
    "(?:(?:we're|we are|i'm|i am|we|let's|let us) )?" + _PARTED.replace("OBJ", _ALL),
    "(?:stop|halt|cease|drop|leave) (?:what|whatever) (?:you are|you're|they are|they're|you) (?:all )?doing",
    "(?:call|calling) it off|scrub it|scrub that mission",
    "(?:bring|bringing|get|getting|pull|call|calling) (?:everything|everyone|everybody|them all|all of them|ROBOTS|"
    "both|"
    "them both|both of them|the robots|the lot)(?: both)?(?: back)? in",
    "(?:get|have|make|want|need|i need|we need|i want) (?:everything|it all) (?:stopped|ended|to stop|stop|to end)",
)
"""Orders that end all."""
_CALLS: tuple[str, ...] = (
    "everything (?:off|stop|halt|end|down)|all (?:off|halt|end|abort|stop)|(?:everyone|everybody|you all|both of you|"
    "you both|all of you) (?:stop|halt|freeze|abort)|(?:everyone|everybody|all|ROBOTS|both of you) (?:to )?(?:stand|"
    "stands) down|stand down|(?:mission|operation|search) abort|(?:emergency|e|crash) stop|estop|(?:we|let's|let us) "
    "stop (?:here|there|now|it here)",
)
"""The same, where nothing else stands in front of them."""
_SO_FAR = "(?: (?:for|as of) (?:today|now|the day|tonight|the moment|good)| here| out here| now| then| today)*"
_OVER: tuple[str, ...] = (
    f"(?:we|i|they) ?(?:'re|'m| are| am|re|m) (?:all )?(?:done|finished|finish|through|ready|good)(?: with (?:this|it|"
    f"everything|that))?{_SO_FAR}",
    f"(?:we're|i'm|we've|we have|i've|we) (?:all )?(?:done|finished|finish|through)(?: with (?:this|it|everything))?"
    f"{_SO_FAR}",
    f"(?:that's|that is|it's|it is|this is) (?:it|all|enough|over|the end|everything){_SO_FAR}",
    f"(?:the )?(?:mission|operation|search|exercise|job|task|work|show|drill)(?: is|'s)? (?:over|complete|completed|"
    f"accomplished|done|finished|ended|at an end|called off|off|cancelled|canceled|aborted){_SO_FAR}",
    "end of (?:the )?(?:mission|operation|exercise|shift|day|drill|work|job|task)",
    f"(?:let's |let us |we |time to |we'll |we can )?(?:call it a (?:day|night)|pack (?:it )?(?:up|in)|wrap (?:it|this|"
    f"things) up|wrap up|knock off|leave it there|leave it at that){_SO_FAR}",
    f"(?:we're|i'm|we are|i am) (?:ending|stopping|finishing|closing|wrapping up|concluding) (?:this|the|our|here)"
    f"(?: (?:run|session|exercise|test|mission|search|operation|job|task|drill|here|today|trial|day))?{_SO_FAR}",
    f"(?:finish|finishing|conclude) (?:all|everything|it all|all of it|here|now){_SO_FAR}",
    f"(?:that'll|that will|this will|that would) do{_SO_FAR}|enough{_SO_FAR}|no more{_SO_FAR}|finished|done|"
    "time's up|time is up|our time is up",
)
"""What says that it is over."""


_CALLED = frozenset(("lads", "guys", "folks", "everyone", "team", "boys", "people", "everybody", "mates", "friends"))
_ASKED = frozenset(("can", "could", "would", "will", "please", "may"))
_OPENS = frozenset(("and", "please", "so", "now", "then", "ok", "okay", "right", "just", "uh", "um", "hey", "again"))


def endings(tokens: list[Token], lexicon: Lexicon) -> list[Token]:
    """The tokens of a request with `abort everything` for whatever orders that."""
    if not lexicon.preempting or _ABORT not in lexicon.names:
        return tokens
    tokens = _parted(tokens, lexicon)
    out: list[Token] = []
    at = 0
    while at < len(tokens):
        said = spelled(tokens, at, lexicon, _naming(lexicon), _LONGEST)
        end = said.longest(_compiled("ends")) or (_begins(tokens, at) and said.longest(_compiled("calls")))
        after = said.spans[end - 1][1] if end else at
        if end and _closed(tokens, after, lexicon):
            everything = reworded("everything", tokens[at + 1 if after - at > 1 else at], tokens[after - 1])
            out.extend((reworded(_ABORT, tokens[at]), everything))
            at = after
        else:
            out.append(tokens[at])
            at += 1
    return out


def _parted(tokens: list[Token], lexicon: Lexicon) -> list[Token]:
    """`that's it we're done lads land the drone`: with the commas that were not written."""
    ends: list[int] = []
    at = next((k for k, t in enumerate(tokens) if t.norm not in _OPENS and t.shape is not Shape.MARK), 0)
    while at < len(tokens):
        said = spelled(tokens, at, lexicon, _naming(lexicon), _LONGEST)
        end = said.longest(_compiled("over"))
        if not end:
            break
        at = said.spans[end - 1][1]
        ends.append(at)
        while at < len(tokens) and tokens[at].norm in (*_CALLED, ","):
            at += 1
    verb = match(lexicon.names, tokens, at) if ends and at < len(tokens) else None
    if verb is None or not any(r.contract in lexicon.preempting for r in verb.means):
        return tokens
    parted = [(t, k + 1 in ends) for k, t in enumerate(tokens) if not (ends[0] <= k < at and t.norm in _CALLED)]
    marked = ((t, Token(",", t.end, t.end, Shape.MARK) if closes else None) for t, closes in parted)
    return [token for pair in marked for token in pair if token is not None]


def is_over(tokens: list[Token], first: int, after: int, lexicon: Lexicon) -> bool:
    """Whether a clause says that all is over, beside an order that fits it."""
    said = " ".join(t.norm for t in tokens[first:after] if t.norm != "please")
    if not lexicon.preempting or _compiled("over").fullmatch(said) is None:
        return False
    rest = [k for k in range(len(tokens)) if not first <= k < after]
    names = [name for k in rest if (name := match(lexicon.names, tokens, k)) is not None]
    ends = any(r.contract in lexicon.preempting for n in names for r in n.means)
    homes = any(n.kind is MentionKind.LOCATION for n in names)
    sweeps = any((r.contract, r.step) in lexicon.zone_steps for n in names for r in n.means if n.form is not Form.PAST)
    return (ends or homes) and not sweeps


def _begins(tokens: list[Token], at: int) -> bool:
    return at == 0 or tokens[at - 1].shape is Shape.MARK or tokens[at - 1].norm in _OPENS


def _naming(lexicon: Lexicon) -> Naming:
    def symbol(name: Entry) -> str:
        everyone = name.kind in ROBOT_KINDS and name.plural and set(name.values) == set(lexicon.robots)
        return "ROBOTS" if everyone else ""

    return symbol


def _closed(tokens: list[Token], at: int, lexicon: Lexicon) -> bool:
    if at >= len(tokens) or tokens[at].shape is Shape.MARK:
        return at >= len(tokens) or tokens[at].norm != "?" or tokens[0].norm in _ASKED
    entry = match(lexicon.functions, tokens, at)
    return entry is not None and entry.role in (Role.AND, Role.THEN, Role.FILLER)


@cache
def _compiled(table: str) -> re.Pattern[str]:
    return re.compile("|".join({"ends": _ENDS, "calls": _CALLS, "over": _OVER}[table]))
