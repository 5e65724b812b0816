"""Who calls whom, as on a radio: `control to crew`, `iris, this is beach control`, `reception here`.

It goes from what is read, but for the name of a robot. Only stations of the closed kinds below call: `this is a test`
and `this is wrong` are no stations, and a robot that calls (`iris to control`) reports.
"""

import re
from functools import cache

from crew.contracts.language.entry import Entry
from crew.contracts.language.lexicon import Lexicon
from crew.contracts.language.mention import ROBOT_KINDS, MentionKind
from crew.contracts.language.symbols import spelled
from crew.contracts.language.tokens import Token
from crew.contracts.language.words import word_set

_LONGEST = 14
_MARKS = frozenset(("-",))

_NUMBER = "(?:one|two|three|four|five|six|seven|eight|nine|zero|ten|[0-9]+)"
_SPELLED = (
    "(?:alpha|alfa|bravo|charlie|delta|echo|foxtrot|golf|hotel|india|juliet|juliett|kilo|lima|mike|november|oscar|papa|"
    "quebec|romeo|sierra|tango|uniform|victor|whiskey|whisky|x ray|xray|yankee|zulu)"
)
_NOUN = (
    "(?:control|controller|command|commander|ops|operations|operator|operators|headquarters|hq|central|dispatch|"
    "dispatcher|dispatching|base camp|base control|centre|center|desk|office|reception|lab|laboratory|stage|lead|"
    "leader|"
    "tower|post|station|rescue|coastguard|coast guard|security|marshal|marshals|steward|stewards|warden|ranger|rangers|"
    "police|medic|medics|ward|supervisor|coordinator|coordination|manager|management|director|chief|captain|studio|"
    "gallery|backstage|kitchen|theatre|theater|flight|ground|safety|lifeguard|lifeguards|watch|shift|clinic|hospital|"
    "lookout|foreman|concierge|workshop|warehouse|porters|porter|nursing|matron|pharmacy|maintenance|pilot|fire "
    "service|"
    "fire brigade|search team|rescue team|rescue service|control room|ops room|operations room|incident room|home|farm|"
    "farmhouse|lodge|hut|school|hotel|museum|shop|counter|front of house|house|gate|scene|site office|event|race|beach)"
)
_MINE = "(?:the |our |your |a )?"
_STATION = (
    f"(?:{_MINE}(?:(?!not |no |never |if |only |just |my )[a-z]+ ){{0,2}}(?:NAME |PLACE )?{_NOUN}(?: {_NUMBER}){{0,3}}|"
    f"{_SPELLED}(?: {_SPELLED})?(?: {_NUMBER}){{0,3}}|(?!not |no |only |part |step |phase |test |take |half |room |"
    f"day |attempt |number |zone |option )[a-z]+ {_NUMBER}(?: {_NUMBER}){{0,2}})"
)
_PLAIN_STATION = (
    "(?:the )?(?:(?!not |no |never |if |this |that |is |it |i |we )[a-z]+ )?(?:control|command|ops|operations|"
    "dispatch|hq|"
    "headquarters|central|coastguard|reception|control room|mission control|ground control|incident command)"
)
_BEFORE = (
    "(?:air|ground|search|rescue|drone|robot|rover|field|uas|uav|flight|response|mission|lab|stage|delivery|ROBOT) "
)
_CREW = (
    f"(?:(?:the |our |my |whole |entire |dear |all )*(?:{_BEFORE})?(?:crew|crews|team|teams|squad|crew members|"
    "colleagues)|"
    "(?:all|any|every) (?:stations|station|callsigns|call signs|callsign|units|unit|teams|crews|crew|hands|parties)|"
    "everyone|"
    "everybody|you all|all of you)"
)
_ROBOT = "(?:ROBOT(?:(?: and| ,)? ROBOT)*)"
_HAIL = "(?:hello |hi |hey |attention |good (?:morning|day|afternoon|evening) |right |ok |okay |go ahead |uh |um )?"
_TO = "(?:to|for|calling|call)"
_IS = "(?:this is|it is|it's|here is|here's|you have|you've got)"
_SPEAKS = "(?: speaking| calling| here| again)?"

_WHOLE: tuple[str, ...] = (
    f"{_HAIL}{_IS} {_STATION}{_SPEAKS}",
    f"{_HAIL}{_STATION} (?:speaking|calling|here)",
    f"{_HAIL}(?:from )?{_PLAIN_STATION}{_SPEAKS}",
    f"{_HAIL}{_STATION} (?:{_TO} {_CREW}|from {_STATION})",
    f"{_SPELLED}(?: {_SPELLED})?(?: {_NUMBER}){{1,3}}",
    f"{_HAIL}{_CREW}(?: (?:from|this is) {_STATION}{_SPEAKS})?",
    f"(?:calling|message (?:to|for)|orders? (?:to|for)|instructions? (?:to|for)|to|attention|for|hello|dear) {_CREW}",
    "(?:calling|attention) (?:all |both )?robots",
    "(?:how do you read|do you read(?: me)?|are you there|come in(?: please)?|come in over|radio check|go ahead|"
    "ready to copy|stand by to copy|prepare to copy|message follows|traffic follows)",
)
"""Clauses that go whole."""
_LEADING: tuple[str, ...] = (
    f"{_HAIL}{_STATION} {_TO} (?:the |our )?{_ROBOT}",
    f"PLACE to {_ROBOT}",
    f"{_HAIL}(?:{_IS} )?{_STATION} (?:calling|to|for) {_ROBOT}",
    f"(?:calling|message (?:to|for)|orders? (?:to|for)|instructions? (?:to|for)|attention|come in) {_ROBOT}",
)
"""Clauses of which the robots' names stay, behind the rest."""
_TRAILING: tuple[str, ...] = (
    f"{_HAIL}(?:{_ROBOT} )(?:from|this is) {_STATION}{_SPEAKS}",
    f"{_ROBOT} (?:crew|team|squad|operator|pilot|unit)",
    f"{_ROBOT} (?:come in|do you read|how do you read|do you copy)",
)
"""Clauses of which they stay, in front."""


def call(tokens: list[Token], first: int, after: int, closed_by: str, lexicon: Lexicon) -> range | None:
    """The tokens that a clause loses as a call; None if it is none."""
    if not closed_by:
        return None
    said = spelled(tokens[:after], first, lexicon, _naming, _LONGEST, _MARKS)
    if not said.spans or said.spans[-1][1] != after:
        return None
    if any(_bears(t.norm) for t in tokens[first:after]):
        return None  # "after lunch stage to crew", "I think control to rover"
    words = " ".join(said.words)
    if _compiled("whole").fullmatch(words):
        return range(first, after)
    robots = [k for k, word in enumerate(said.words) if word == "ROBOT"]
    if robots and _compiled("leading").fullmatch(words):
        return range(first, said.spans[robots[0]][0])
    if robots and _compiled("trailing").fullmatch(words):
        return range(said.spans[robots[-1]][1], after)
    return None


def _bears(word: str) -> bool:
    """Whether a word may say when, whether or how, and so is no part of a station's name."""
    return word in _BEARING or word.endswith(("ly", "n't"))


_BEARING = word_set(
    "after before until till when whenever once while unless if whether tomorrow tonight today yesterday later "
    "soon noon midnight lunch dinner breakfast tea minutes minute hours hour seconds maybe perhaps think guess "
    "suppose believe wonder hope fear doubt said says told asked wants but or nor and as so because since "
    "though although instead except without only just not no never i he she they at by in on with twice thrice "
    "o'clock past test drill exercise joke kidding pretend wrong false wait stop wish slow fast later tea-time "
    "during between within every each next last "
)


def _naming(name: Entry) -> str:
    if name.kind in ROBOT_KINDS:
        return "" if name.plural else "ROBOT"
    if name.kind is MentionKind.LOCATION:
        return "PLACE"
    return "" if name.kind in (MentionKind.ACTION, MentionKind.VALUE) else "NAME"


@cache
def _compiled(table: str) -> re.Pattern[str]:
    return re.compile("|".join({"whole": _WHOLE, "leading": _LEADING, "trailing": _TRAILING}[table]))
