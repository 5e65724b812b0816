"""How a robot is told: `get the drone up`, `task it with a search`, put into the words that its crew has for that.

Every rule needs the robot's name in its place, and that each robot that may be meant can do it.
"""

from crew.contracts.language.entry import Entry, stands_all
from crew.contracts.language.figures import is_numeral
from crew.contracts.language.lexicon import Lexicon, match
from crew.contracts.language.lookahead import ARTICLES, SOFT, named, past_all
from crew.contracts.language.mention import ROBOT_KINDS, MentionKind
from crew.contracts.language.patterns import begins
from crew.contracts.language.rewrites import ASSIGNING, DOWN_ON, LOWERING, RAISING, TASKING, UP_IN
from crew.contracts.language.tokens import Shape, Token, reworded
from crew.contracts.language.words import METRES

_LAUNCH, _LAND, _TELL = "launch", "land", "tell"
_DOWN = (("down",), ("back", "down"), ("to", "ground"), ("to", "the", "ground"))
_ENDS_UP = frozenset(("and", "then", "to", "so", "please", "now"))

Rule = tuple[int, list[Token]]
"""How many tokens are replaced, and by what."""


def told(tokens: list[Token], lexicon: Lexicon) -> list[Token]:
    """The tokens of a request in the crew's own words for what is told to a robot."""
    out: list[Token] = []
    at = 0
    while at < len(tokens):
        rules = (rule(tokens, at, lexicon) for rule in (_raised, _flown, _lowered, _height, _bare, _tasked, _assigned))
        words, plain = next((found for found in rules if found is not None), (1, tokens[at : at + 1]))
        out.extend(plain)
        at += words
    return out


def _raised(tokens: list[Token], at: int, lexicon: Lexicon) -> Rule | None:
    """`get the drone in the air`, `get the drone up to 8 metres`."""
    if tokens[at].norm not in RAISING or (end := _robot(tokens, at + 1, lexicon, _LAUNCH)) is None:
        return None
    up = next((words for words in UP_IN if stands_all(tokens, end, words)), None)
    if up is None:
        return None
    after = end + len(up)
    if up == ("up",) and _over_zone(tokens, after, lexicon):
        over = reworded("over", tokens[after])
        return after + 1 - at, [reworded(_LAUNCH, tokens[at]), *tokens[at + 1 : end], over]
    climbs = after < len(tokens) and tokens[after].norm == "to"
    if len(up) == 1 and not (_closed(tokens, after) and (not climbs or _numeral(tokens, after + 1))):
        return None
    return after - at, [reworded(_LAUNCH, tokens[at]), *tokens[at + 1 : end]]


def _over_zone(tokens: list[Token], at: int, lexicon: Lexicon) -> bool:
    """`to the north half and` do something there."""
    name, end = named(tokens, at + 1, lexicon)
    zone = name is not None and name.kind is MentionKind.ZONE
    return zone and stands_all(tokens, at, ("to",)) and stands_all(tokens, end, ("and",))


def _flown(tokens: list[Token], at: int, lexicon: Lexicon) -> Rule | None:
    """`put the drone over the north half`: to fly over it."""
    raises = tokens[at].norm in RAISING or tokens[at].norm in ("run", "have", "launch", "dispatch", "move", "direct")
    if not raises or (end := _robot(tokens, at + 1, lexicon, _LAUNCH)) is None:
        return None
    over = end + any(stands_all(tokens, end, (word,)) for word in ("out", "up"))
    name, _ = named(tokens, over + 1, lexicon)
    above = any(stands_all(tokens, over, (word,)) for word in ("over", "across", "above"))
    if not above or name is None or name.kind is not MentionKind.ZONE:
        return None
    return over + 1 - at, [reworded("fly", tokens[at]), *tokens[at + 1 : end], reworded("over", tokens[over])]


def _lowered(tokens: list[Token], at: int, lexicon: Lexicon) -> Rule | None:
    """`put the drone on the ground`."""
    if tokens[at].norm not in LOWERING or (end := _robot(tokens, at + 1, lexicon, _LAND)) is None:
        return None
    down = next((words for words in DOWN_ON if stands_all(tokens, end, words)), None)
    if down is None or not _ended(tokens, end + len(down)):
        return None
    return end + len(down) - at, [reworded(_LAND, tokens[at]), *tokens[at + 1 : end]]


def _bare(tokens: list[Token], at: int, lexicon: Lexicon) -> Rule | None:
    """`drone up, ...`, `drone down`, `ground the drone`: to launch it, to land it."""
    if not begins(tokens, at):
        return None
    end = _robot(tokens, at + 1, lexicon, _LAND) if tokens[at].norm == "ground" else None
    if end is not None and _ended(tokens, end):
        return 1, [reworded(_LAND, tokens[at])]
    for verb, ways in ((_LAUNCH, UP_IN), (_LAND, _DOWN)):
        end = _robot(tokens, at, lexicon, verb)
        way = next((w for w in ways if end is not None and stands_all(tokens, end, w)), None)
        if end is None or way is None:
            continue
        after = end + len(way)
        climbs = after < len(tokens) and tokens[after].norm in ("to", "at") and _numeral(tokens, after + 1)
        if climbs or (_ended(tokens, after) and not stands_all(tokens, after, ("?",))):
            return after - at, [reworded(verb, tokens[after - 1]), *tokens[at:end]]
    return None


def _height(tokens: list[Token], at: int, lexicon: Lexicon) -> Rule | None:
    """`drone up, eight metres, and search the east half`: at that height, where a drone is to search."""
    if not at or tokens[at - 1].norm not in (",", "-", "(") or not is_numeral(tokens, at):
        return None
    unit = next((k for k in range(at + 1, min(at + 4, len(tokens))) if not is_numeral(tokens, k)), at)
    closed = unit + 1 >= len(tokens) or tokens[unit + 1].shape is Shape.MARK
    flies = any(_robot(tokens, k, lexicon, _LAUNCH) is not None for k in range(at))
    sweeps = (_action(tokens, k, lexicon) for k in range(len(tokens)))
    searches = any((r.contract, r.step) in lexicon.zone_steps for e in sweeps if e is not None for r in e.means)
    if not (closed and flies and searches and tokens[unit].norm in METRES):
        return None
    return 1, [reworded("at", tokens[at]), tokens[at]]


def _tasked(tokens: list[Token], at: int, lexicon: Lexicon) -> Rule | None:
    """`task the drone with a search of the north half`."""
    end = _robot(tokens, at + 1, lexicon) if tokens[at].norm in TASKING else None
    if end is None or not stands_all(tokens, end, ("with",)):
        return None
    noun = end + 1 + (end + 1 < len(tokens) and tokens[end + 1].norm in ARTICLES)
    verb = _action(tokens, noun, lexicon)
    if verb is None or not any((r.contract, r.step) in lexicon.zone_steps for r in verb.means):
        return None
    return end + 1 - at, [reworded("have", tokens[at]), *tokens[at + 1 : end], reworded("do", tokens[end])]


def _assigned(tokens: list[Token], at: int, lexicon: Lexicon) -> Rule | None:
    """`assign the drone to search`."""
    end = _robot(tokens, at + 1, lexicon) if tokens[at].norm in ASSIGNING else None
    if end is None or not stands_all(tokens, end, ("to",)) or _action(tokens, end + 1, lexicon) is None:
        return None
    placed = match(lexicon.names, tokens, end + 1)
    if placed is not None and placed.kind is not MentionKind.ACTION:
        return None
    return 1, [reworded(_TELL, tokens[at])]


def _robot(tokens: list[Token], at: int, lexicon: Lexicon, verb: str = "") -> int | None:
    """Past one robot's name that stands here, if each robot it may mean has the skill of the verb."""
    at = past_all(tokens, at, SOFT)
    name = match(lexicon.names, tokens, at) if at < len(tokens) else None
    if name is None or name.kind not in ROBOT_KINDS or name.plural:
        return None
    able = {r.skill for e in lexicon.names.get(verb, ()) if e.words == (verb,) for r in e.means}
    can = all(able & lexicon.members.get(str(robot), frozenset()) for robot in name.values)
    return at + len(name.words) if can or not verb else None


def _action(tokens: list[Token], at: int, lexicon: Lexicon) -> Entry | None:
    entries = lexicon.names.get(tokens[at].norm, ()) if at < len(tokens) else ()
    return next((e for e in entries if e.kind is MentionKind.ACTION and stands_all(tokens, at, e.words)), None)


def _closed(tokens: list[Token], at: int) -> bool:
    return _ended(tokens, at) or tokens[at].norm in _ENDS_UP


def _ended(tokens: list[Token], at: int) -> bool:
    return at >= len(tokens) or tokens[at].shape is Shape.MARK or tokens[at].norm in ("and", "then", "now", "please")


def _numeral(tokens: list[Token], at: int) -> bool:
    return at < len(tokens) and is_numeral(tokens, at)
