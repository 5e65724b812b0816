"""When and where somebody is found, said in any words: `as soon as you've got him`, `to wherever he turns out to be`.

Both are put into words that the reader has: `once found him,` and `to him`. Only what a search of this crew finds
counts; whoever speaks may find somebody as well, and then nobody here knows.
"""

import re
from functools import cache

from crew.contracts.language.entry import Entry
from crew.contracts.language.inflect import Form
from crew.contracts.language.lexicon import Lexicon, match
from crew.contracts.language.lookahead import ARTICLES
from crew.contracts.language.mention import ROBOT_KINDS, MentionKind
from crew.contracts.language.symbols import Naming, Said, spelled
from crew.contracts.language.tokens import Shape, Token, reworded
from crew.contracts.language.words import Role, word_set

_PERSON, _SEARCHER = "PERSON", "SEARCHER"
_LONGEST = 18
_OPENS = frozenset((Role.AND, Role.THEN, Role.FILLER, Role.MODAL, Role.TO, Role.BREAK))

_AFTER = (
    "(?:(?:only |just |right |immediately |directly )?(?:once|when|after|as soon as|the (?:very )?(?:moment|minute|"
    "second|"
    "instant)|whenever|as and when|soon as)(?: that)?)"
)
_UPON = "(?:(?:immediately |right |directly )?(?:upon|on|after|following))"
_ADV = "(?:actually |finally |definitely |positively |safely |successfully |eventually |already |first |just )*"
_SUBJECT = (
    f"(?:it|you|we|they|one|{_SEARCHER}|the (?:search|camera|air team|pilot|crew|team|helicopter|sweep)|somebody)"
)
_HAS = "(?:has|have|had|has got|have got|'s|got)"
_AUX = f"(?:(?:will have|{_HAS}|manages? to|managed to|(?:is|are) able to|can|could|will|does|do|should) {_ADV})"
_HAVE_SHORT = "(?:it's|you've|we've|they've|it'll have|you'll have)"
_VERB = (
    "(?:find|finds|found|locate|locates|located|spot|spots|spotted|detect|detects|detected|see|sees|seen|saw|identify|"
    "identifies|identified|discover|discovers|discovered|sight|sights|sighted|pinpoint|pinpoints|pinpointed|"
    "track down|tracks down|tracked down|recognises?d?|recognizes?d?|confirms?|confirmed|picks? out|picked out|"
    "picks? up|picked up|gets?|got|gotten|has|have|reports?|reported|lays? eyes on|laid eyes on|catches sight of|"
    "(?:gets?|got|has|have|has got|have got|with)? ?(?:a |an |your |its |visual )*(?:fix|visual|visual contact|contact|"
    "eyes|sight|sighting|lock|position|location|"
    "coordinates|lock on) (?:on|of|for|from)|knows? (?:for sure )?where|knew where|fixes|fixed|establishes|established)"
)
_DONE = (
    "(?:found|located|spotted|detected|seen|identified|discovered|sighted|pinpointed|tracked down|picked out|"
    "fixed|recognised|recognized|confirmed found|visually located|in sight|in view|on camera)"
)
_WHOM = f"(?:him|her|them|{_PERSON}|someone|somebody|anyone|anybody|whoever it is|the one|us somebody|who we want)"
_WHO = f"(?:he|she|they|{_PERSON}|someone|somebody|anyone|anybody|that person)"
_WHO_IS = "(?:he's|she's|they're|they've|he has|she has)"
_BE = "(?:is|are|was|were|has been|have been|has|have|gets|get|got|'s|'s been|will have been|been|have all been)"
_BY = f"(?: by (?:it|you|us|{_SEARCHER}|the search|the camera))?"
_FIX = (
    "(?:a |an |the |his |her |their |any |its |your |that )?(?:confirmed |firm |good |positive |exact |clear "
    ")?(?:fix|position|location|coordinates|sighting|visual|visual contact|contact|find|result|hit|whereabouts)"
)
_FIX_OF = f"(?:{_FIX}(?: (?:on|of|for) {_WHOM})?|{_PERSON} 's (?:exact )?(?:position|location|coordinates|whereabouts))"
_KNOWN = "(?:known|confirmed|in|established|clear|reported|available|fixed|determined|there)"

_ONCE: tuple[str, ...] = (
    f"{_AFTER} (?:{_SUBJECT} (?:{_AUX})?|{_HAVE_SHORT} {_ADV}){_ADV}{_VERB} {_WHOM}",
    f"{_AFTER} (?:{_SUBJECT} (?:{_AUX})?|{_HAVE_SHORT} {_ADV}){_ADV}(?:know|knows|knew|sees?|have found|has found|"
    "found) "
    f"(?:for sure )?where (?:{_WHO} (?:is|are)|{_WHO_IS})",
    f"{_AFTER} (?:{_SUBJECT} (?:{_AUX})?|{_HAVE_SHORT} {_ADV}){_ADV}(?:have|has|get|gets|got|know|knows|report|reports|"
    f"reported|confirms?|confirmed|provides?|send|sends|gives?|find|finds|found|makes?|establish|establishes|"
    "established)? ?"
    f"(?:us |me |you )?{_FIX_OF}",
    f"{_AFTER} (?:{_WHO} {_BE}|{_WHO_IS}) {_ADV}(?:been )?{_ADV}{_DONE}{_BY}",
    f"{_AFTER} (?:{_ADV}|being |having been ){_DONE}{_BY}",
    f"{_UPON} (?:having )?(?:finding|locating|spotting|detecting|sighting|seeing|identifying|discovering|found|located|"
    f"spotted) {_WHOM}",
    f"{_UPON} (?:his |her |their |the |a |an |any )?(?:confirmed |positive )?(?:discovery|detection|sighting|find|"
    f"being found|being located|visual contact|contact|identification)(?: (?:of|with) {_WHOM})?{_BY}",
    f"{_AFTER} (?:there's|there is|there has been|we've|we have) {_FIX_OF}",
    f"{_AFTER} {_FIX_OF}(?: (?:is|are|has been|have been|was))?(?: {_KNOWN})",
    f"{_AFTER} (?:the )?(?:search|sweep|scan) (?:has |is )?(?:found|successful|turned up|turns up) ?{_WHOM}?",
)
"""Clauses that say when; the one who is found stands in them as `PERSON` or a pronoun."""

_LIES = "(?:is|are|lies|lie|is lying|happens? to be|turns? out to be|ends? up|may be|might be|is located|are located)"
_WHERE: tuple[str, ...] = (
    f"(?:to |at |over to |out to |up to )?(?:where|wherever|(?:the )?(?:exact )?(?:place|spot|point|position|"
    "location) "
    f"where)(?: exactly)? (?:{_WHO} (?:{_LIES}|(?:is|was|are|were|has been|have been|gets) {_DONE}{_BY})|(?:he's|she's|"
    f"they're)(?: {_DONE})?(?: at)?)",
    f"(?:to |at |over to |out to |up to )?(?:where|wherever|(?:the )?(?:exact )?(?:place|spot|point|position|"
    "location) "
    f"where) (?:{_SUBJECT} (?:{_AUX})?|{_HAVE_SHORT} ){_VERB} {_WHOM}",
    f"to (?:{_PERSON}|whoever|the one|the person) (?:that |who |whom )?(?:it|you|we|{_SEARCHER}) "
    "(?:finds?|found|locates?|located|spots?|spotted|has found|have found|has located|has spotted|detects?)",
)
"""Clauses that say where somebody is."""
_ASKING = frozenset(("know", "me", "us", "see", "out", "report", "check"))
"""Words behind which `where he is` is asked for."""
_ORDERED = (Form.BASE, Form.PRESENT)


def findings(tokens: list[Token], lexicon: Lexicon) -> list[Token]:
    """The tokens of a request with the plain words for when and where somebody is found."""
    if len(set(lexicon.reports.values())) != 1 or "found" not in lexicon.names:
        return tokens
    out: list[Token] = []
    at = 0
    followed = _followed(tokens, lexicon)
    while at < len(tokens):
        found = (followed and _when(tokens, at, lexicon)) or _place(tokens, at, lexicon)
        after, plain = found or (at + 1, tokens[at : at + 1])
        out.extend(plain)
        at = after
    return out


def _followed(tokens: list[Token], lexicon: Lexicon) -> bool:
    """Whether something is asked for that can follow upon the finding: a robot that does not search, or its verb."""
    names = [name for at in range(len(tokens)) if (name := match(lexicon.names, tokens, at)) is not None]
    robots = (n for n in names if n.kind in ROBOT_KINDS and not _searches(n.values, lexicon))
    verbs = (n for n in names if n.kind is MentionKind.ACTION)
    return any(robots) or any(not any(r.skill in lexicon.reports for r in n.means) for n in verbs)


def _when(tokens: list[Token], at: int, lexicon: Lexicon) -> tuple[int, list[Token]] | None:
    """`once found`, whom, and a comma if the request goes on."""
    hit = _matched("once", tokens, at, lexicon)
    if hit is None:
        return None
    after, who = hit
    goes_on = after < len(tokens) and tokens[after].shape is not Shape.MARK
    if goes_on and not _begins(tokens, after, lexicon):
        return None
    last = tokens[after - 1]
    whom = {t.start for t in who}
    verb = next((t for t in reversed(tokens[at + 1 : after]) if t.start not in whom and t.norm not in ARTICLES), last)
    once = [reworded("once", tokens[at]), reworded("found", verb)]
    comma = [Token(",", last.end, last.end, Shape.MARK)] if goes_on else []
    return after, [*once, *who, *comma]


def _place(tokens: list[Token], at: int, lexicon: Lexicon) -> tuple[int, list[Token]] | None:
    """`to him`."""
    hit = _matched("where", tokens, at, lexicon)
    if hit is None:
        return None
    after, who = hit
    closed = after == len(tokens) or tokens[after].shape is Shape.MARK or _begins(tokens, after, lexicon)
    asked = ("where", "is") if at and tokens[at - 1].norm in _ASKING else ("to",)
    return (after, [*(reworded(said, tokens[at]) for said in asked), *who]) if closed and who else None


def _matched(table: str, tokens: list[Token], at: int, lexicon: Lexicon) -> tuple[int, list[Token]] | None:
    """Past what stands here of a table, and whom it names."""
    if tokens[at].norm not in _first(table):
        return None
    said = spelled(tokens, at, lexicon, _naming(lexicon), _LONGEST)
    end = said.longest(_compiled(table))
    return (said.spans[end - 1][1], _whom(tokens, said, end)) if end > 1 else None


def _whom(tokens: list[Token], said: Said, end: int) -> list[Token]:
    """Whom a clause names, as a name or a pronoun."""
    for word, (first, after) in zip(said.words[:end], said.spans[:end], strict=True):
        if word == _PERSON:
            return [t._replace(possessive=False) for t in tokens[first:after]]
        if (plain := _PRONOUNS.get(word)) is not None:
            return [reworded(plain, tokens[first])]
    return []


_PRONOUNS = {
    "him": "him", "he": "him", "he's": "him", "his": "him", "her": "her", "she": "her", "she's": "her", "them": "them",
    "they": "them", "they're": "them", "their": "them", "someone": "someone", "somebody": "someone",
    "anyone": "someone", "anybody": "someone", "whoever": "him", "one": "him",
}  # fmt: skip


def _naming(lexicon: Lexicon) -> Naming:
    """Names for whoever is looked for and for who searches."""
    known = set(lexicon.reports.values())

    def symbol(name: Entry) -> str:
        if name.plural:
            return ""
        if name.kind is MentionKind.VALUE and set(name.values) <= known:
            return _PERSON
        return _SEARCHER if name.kind in ROBOT_KINDS and _searches(name.values, lexicon) else ""

    return symbol


def _searches(robots: tuple[object, ...], lexicon: Lexicon) -> bool:
    return all(lexicon.members.get(str(robot), frozenset()) & set(lexicon.reports) for robot in robots)


def _begins(tokens: list[Token], at: int, lexicon: Lexicon) -> bool:
    """Whether something else that is asked for may begin here."""
    start = at + (tokens[at].norm in ARTICLES)
    name = match(lexicon.names, tokens, start) if start < len(tokens) else None
    if name is not None and (name.kind in ROBOT_KINDS or (name.kind is MentionKind.ACTION and name.form in _ORDERED)):
        return True
    role = entry.role if (entry := match(lexicon.functions, tokens, at)) is not None else None
    special = lexicon.special.get(tokens[at].norm, ())
    return role in _OPENS or any(e.role in (Role.CAUSE, Role.LIGHT, Role.OPENER) for e in special)


@cache
def _compiled(table: str) -> re.Pattern[str]:
    patterns = _ONCE if table == "once" else _WHERE
    return re.compile("|".join(re.sub(r" +", " ", p) for p in patterns))


@cache
def _first(table: str) -> frozenset[str]:
    """Words that such a clause may begin with."""
    return word_set(
        "to at over out up where wherever the place"
        if table == "where"
        else "only just right immediately directly once when after as the whenever soon upon on following"
    )
