"""Puts plainer words in place of wordings that say the same, before a request is scanned."""

from crew.contracts.language.afield import AFIELD
from crew.contracts.language.endings import endings
from crew.contracts.language.entry import Words, stands_all
from crew.contracts.language.figures import is_numeral, with_commas
from crew.contracts.language.heights import heights
from crew.contracts.language.lexicon import Lexicon
from crew.contracts.language.lookahead import ARTICLES, named
from crew.contracts.language.mention import ROBOT_KINDS, MentionKind
from crew.contracts.language.once_found import findings
from crew.contracts.language.patterns import replaced
from crew.contracts.language.plainer import PLAINER
from crew.contracts.language.plainer_moves import MOVES
from crew.contracts.language.plainer_walks import WALKS
from crew.contracts.language.portraits import lost_person
from crew.contracts.language.restated import restated
from crew.contracts.language.rewrites import (
    ARROWS,
    DONE_AT,
    HESITATIONS,
    LEADS_ON,
    SENDING,
    WAITING,
    wordings,
    wordings_before_goals,
    wordings_before_objects,
    wordings_before_places,
    wordings_before_robots,
    wordings_before_zones,
)
from crew.contracts.language.spoken import spoken
from crew.contracts.language.staying import staying
from crew.contracts.language.tokens import Shape, Token
from crew.contracts.language.told import told
from crew.contracts.language.wordings import Wordings
from crew.contracts.language.words import PLACE_NOUNS

_GRABBED: tuple[Words, ...] = (("grab",), ("pick", "up"), ("get",), ("go", "get"), ("take",))
_OVER = frozenset(("back", "over", "out", "along", "across", "up", "down", "on", "straight"))
_ARROW_MARKS = frozenset("-=>")
_WAITED = Wordings(dict.fromkeys(WAITING, ("go", "to")))


def rewritten(tokens: list[Token], lexicon: Lexicon) -> list[Token]:
    """The tokens of a request in plainer words."""
    out: list[Token] = []
    at = 0
    tokens = findings(restated(with_commas(tokens), lexicon), lexicon)
    tokens = spoken([t for k, t in enumerate(tokens) if not _hesitation(tokens, k, lexicon)], lexicon)
    for wordings_with_names in (MOVES, WALKS, PLAINER, AFIELD):
        tokens = replaced(tokens, wordings_with_names, lexicon)
    tokens = told(tokens, lexicon)
    tokens = heights(staying(endings(tokens, lexicon), lexicon), lexicon)
    while at < len(tokens):
        words, plain = (
            _arrow(tokens, at)
            or lost_person(tokens, at, lexicon)
            or (_waits(tokens, lexicon) and _before_name(tokens, at, lexicon, _WAITED, MentionKind.LOCATION))
            or _before_name(tokens, at, lexicon, wordings_before_objects(), MentionKind.OBJECT)
            or (
                _ordered(tokens, at)
                and _before_name(tokens, at, lexicon, wordings_before_places(), MentionKind.LOCATION)
            )
            or _before_name(tokens, at, lexicon, wordings_before_zones(), MentionKind.ZONE)
            or _before_goal(tokens, at, lexicon)
            or _done_at(tokens, at, lexicon)
            or _for_me(tokens, at, lexicon)
            or _moved_robot(tokens, at, lexicon)
            or _there_and(tokens, at, lexicon)
            or _picked_and_put(tokens, at, lexicon)
            or _said(tokens, at, lexicon)
        )
        out.extend(_placed(tokens[at : at + words], plain) if words else tokens[at : at + 1])
        at += words or 1
    return out


def _hesitation(tokens: list[Token], at: int, lexicon: Lexicon) -> bool:
    """A sound that says nothing. Between two figures, or two names of one kind, it may correct, and stays."""
    if tokens[at].norm not in HESITATIONS or tokens[at].norm in lexicon.names:
        return False
    behind = next((k for k in range(at + 1, len(tokens)) if not _passed(tokens, k)), None)
    ahead = next((k for k in range(at - 1, -1, -1) if not _passed(tokens, k)), None)
    if behind is None or ahead is None:
        return True
    return not (_sort(tokens, ahead, lexicon) & _sort(tokens, behind, lexicon))


def _passed(tokens: list[Token], at: int) -> bool:
    return tokens[at].norm in (",", "-", "\u2026", ".", *HESITATIONS, *ARTICLES)


def _sort(tokens: list[Token], at: int, lexicon: Lexicon) -> set[str]:
    """What a token could be part of."""
    if is_numeral(tokens, at) or tokens[at].norm in ("minus", ")", "("):
        return {"figure"}
    entries = (e for found in lexicon.names.values() for e in found if tokens[at].norm in e.words)
    return {str(e.kind) for e in entries if e.kind is not MentionKind.ACTION}


def _arrow(tokens: list[Token], at: int) -> tuple[int, Words] | None:
    """`->` means `to`."""
    end = at
    while (
        end < len(tokens)
        and tokens[end].norm in _ARROW_MARKS
        and (end == at or tokens[end - 1].end == tokens[end].start)
    ):
        end += 1
    return (end - at, ("to",)) if "".join(t.norm for t in tokens[at:end]) in ARROWS else None


def _waits(tokens: list[Token], lexicon: Lexicon) -> bool:
    """Whether a robot is named that could be told to wait somewhere."""
    return any(e.kind in ROBOT_KINDS for t in tokens for e in lexicon.names.get(t.norm, ()))


def _before_name(
    tokens: list[Token], at: int, lexicon: Lexicon, table: Wordings, kind: MentionKind
) -> tuple[int, Words] | None:
    """`wait at the charger`, `could I get the bottle`: wordings that hold only before a name of a kind."""
    for words, plain in table.standing(tokens, at):
        name, _ = named(tokens, at + len(words), lexicon)
        if name is not None and name.kind is kind:
            return len(words), plain
    return None


def _ordered(tokens: list[Token], at: int) -> bool:
    """Not `we leave for base`: who speaks may tell of themselves."""
    return not at or tokens[at - 1].norm not in ("i", "we", "they", "he", "she")


def _before_goal(tokens: list[Token], at: int, lexicon: Lexicon) -> tuple[int, Words] | None:
    """`respond to 7.5, 1.5`: wordings that hold only before a place's name or a point."""
    for words, plain in wordings_before_goals().standing(tokens, at):
        end = at + len(words)
        if end < len(tokens) and (is_numeral(tokens, end) or tokens[end].norm in ("x", "(", *PLACE_NOUNS)):
            return len(words), plain
    return _before_name(tokens, at, lexicon, wordings_before_goals(), MentionKind.LOCATION)


def _done_at(tokens: list[Token], at: int, lexicon: Lexicon) -> tuple[int, Words] | None:
    """`the dog should charge`: to go to the place where that is done."""
    for place, verbs in DONE_AT.items():
        known = any(e.kind is MentionKind.LOCATION and e.words == (place,) for e in lexicon.names.get(place, ()))
        for words in (tuple(verb.split()) for verb in verbs if known):
            end = at + len(words)
            closed = end >= len(tokens) or tokens[end].shape is Shape.MARK or tokens[end].norm in ("please", "now")
            if closed and stands_all(tokens, at, words):
                return len(words), ("go", "to", place)
    return None


def _for_me(tokens: list[Token], at: int, lexicon: Lexicon) -> tuple[int, Words] | None:
    """`grab the cube for me`: to fetch it."""
    words = next((w for w in _GRABBED if stands_all(tokens, at, w)), None)
    if words is None:
        return None
    name, end = named(tokens, at + len(words), lexicon)
    if name is None or name.kind is not MentionKind.OBJECT:
        return None
    return (len(words), ("fetch",)) if stands_all(tokens, end, ("for", "me")) else None


def _moved_robot(tokens: list[Token], at: int, lexicon: Lexicon) -> tuple[int, Words] | None:
    """`take the dog to the charger`, `park the rover at base`: to send it there."""
    summoned = tokens[at].norm in SENDING
    if "send" not in lexicon.names or not (summoned or tokens[at].norm in wordings_before_robots().firsts):
        return None
    name, end = named(tokens, at + 1, lexicon)
    if name is None or name.kind not in ROBOT_KINDS:
        return None
    end += end < len(tokens) and tokens[end].norm in _OVER
    leads = ("to", "here") if summoned else LEADS_ON
    return (1, ("send",)) if end < len(tokens) and tokens[end].norm in leads else None


def _there_and(tokens: list[Token], at: int, lexicon: Lexicon) -> tuple[int, Words] | None:
    """`fly to the north half and search it`: to search it is to fly there."""
    moved = tokens[at].norm in ("fly", "go", "head", "move") and at + 1 < len(tokens) and tokens[at + 1].norm == "to"
    name, end = named(tokens, at + 2, lexicon) if moved else (None, at)
    if name is None or name.kind is not MentionKind.ZONE:
        return None
    verb = end + 1
    entries = lexicon.names.get(tokens[verb].norm, ()) if verb < len(tokens) and tokens[verb - 1].norm == "and" else ()
    sweeps = any((r.contract, r.step) in lexicon.zone_steps for e in entries for r in e.means)
    return (2, ()) if sweeps else None


def _picked_and_put(tokens: list[Token], at: int, lexicon: Lexicon) -> tuple[int, Words] | None:
    """`pick up the cube and put it on the table`: whoever puts it there has picked it up."""
    words = next((w for w in (("pick", "up"), ("grab",), ("take",)) if stands_all(tokens, at, w)), None)
    if words is None:
        return None
    name, end = named(tokens, at + len(words), lexicon)
    if name is None or name.kind is not MentionKind.OBJECT:
        return None
    put = any(stands_all(tokens, end, ("and", verb, "it")) for verb in ("put", "place", "set"))
    return (len(words), ()) if put else None


def _said(tokens: list[Token], at: int, lexicon: Lexicon) -> tuple[int, Words]:
    """The longest wording that stands here, with its plain words; 0 if there is none."""
    for words, plain in wordings().standing(tokens, at):
        ahead = at + len(words)
        if len(words) == 1 and words[0] in lexicon.names:
            continue
        counted = words[-1] == "to" and ahead < len(tokens) and is_numeral(tokens, ahead)
        if not counted or len(words) > 2:
            return len(words), plain
    return 0, ()


def _placed(said: list[Token], plain: Words) -> list[Token]:
    """Plain words over what was said: each over one word, the last one over the rest."""
    out = []
    for k, word in enumerate(plain):
        first = min(k, len(said) - 1)
        last = len(said) - 1 if k == len(plain) - 1 else first
        out.append(Token(word, said[first].start, said[last].end, Shape.WORD, said[last].possessive))
    return out
