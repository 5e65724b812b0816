"""The names of one crew as phrases: what robots, places, objects and run-time values are called."""

from collections.abc import Iterable, Iterator

from msgspec.structs import replace

from crew.contracts.language.entry import Entry, Words, words_of
from crew.contracts.language.inflect import plurals
from crew.contracts.language.mention import MentionKind
from crew.contracts.language.persons import LOST, PLURALS, names_of_people
from crew.contracts.language.synonyms import places
from crew.contracts.language.words import IN_NEED, NICKNAMES, REQUESTER, ROBOT_WORDS, SELF_WORDS, ZONE_NOUNS
from crew.contracts.plan import SlotValue, Zone
from crew.contracts.site import Rules


def entities(rules: Rules) -> Iterator[Entry]:
    """Robots, classes of robots, places, objects and run-time values, by name and alias."""
    yield from _robots(rules)
    crew = rules.crew
    taken = _taken(rules)
    for place in crew.locations:
        called = {name.replace("_", " ") for name in (place.name, *place.aliases)}
        yield from _named(MentionKind.LOCATION, place.name, place.name, (*place.aliases, *places(called, taken)))
    for part in rules.parts.values():
        yield from _named(MentionKind.LOCATION, part.name, part.name, part.aliases)
    for zone in crew.zones:
        yield from _named(MentionKind.ZONE, zone.name, zone.zone, zone.aliases)
    for thing in crew.objects:
        yield from _named(MentionKind.OBJECT, thing.name, thing.name, thing.aliases)
    for value in crew.values:
        extra = SELF_WORDS if value.name == REQUESTER else ()
        near = value.standoff_m > 0
        entries = list(_named(MentionKind.VALUE, value.name, value.name, (*value.aliases, *extra), near))
        yield from entries
        yield from (replace(e, words=many, plural=True) for e in entries for many in plurals(e.words))
        if "person" in value.aliases:
            people = [replace(entries[0], words=words_of(phrase)) for phrase in names_of_people()]
            yield from people
            yield from (replace(e, words=many, plural=True) for e in people for many in plurals(e.words))
            yield from (replace(entries[0], words=(many,), plural=True) for many in PLURALS)
    for zone in crew.zones:
        yield from _zone_noun_variants(zone.name, zone.zone, (zone.name, *zone.aliases))


def _taken(rules: Rules) -> frozenset[str]:
    """Every name and alias that the crew file and the kinds give."""
    crew = rules.crew
    named = [(thing.name, thing.aliases) for thing in crew.robots]
    named += [(thing.name, thing.aliases) for thing in crew.locations]
    named += [(thing.name, thing.aliases) for thing in crew.zones]
    named += [(thing.name, thing.aliases) for thing in crew.objects]
    named += [(thing.name, thing.aliases) for thing in crew.values]
    named += [(thing.name, thing.aliases) for thing in rules.parts.values()]
    named += [(thing.name, thing.aliases) for thing in rules.kinds.values()]
    return frozenset(" ".join(words_of(phrase)) for name, aliases in named for phrase in (name, *aliases))


def _variants(phrase: str) -> Iterator[Words]:
    """A name's spellings: as written, and with letters and digits apart (`tb3`, `tb 3`)."""
    words = words_of(phrase)
    yield words
    if "_" in phrase and len(words) > 1:
        yield ("".join(words),)  # "rooma"
    apart = tuple(part for word in words for part in _split_digits(word))
    if apart != words:
        yield apart


def _split_digits(word: str) -> tuple[str, ...]:
    stem = word.rstrip("0123456789")
    return (stem, word[len(stem) :]) if len(stem) > 1 and stem != word else (word,)


def _named(
    kind: MentionKind, name: str, value: SlotValue, aliases: Iterable[str], near: bool = False
) -> Iterator[Entry]:
    spellings = list(dict.fromkeys(words for phrase in (name, *aliases) for words in _variants(phrase)))
    heads = {words[0] for words in spellings if len(words) == 1}
    modifiers = frozenset(w for words in spellings if words[-1] in heads for w in words[:-1])
    if near:
        modifiers |= (IN_NEED - {"there"}) | set(LOST)  # "the injured hiker"
    for words in spellings:
        yield Entry(words=words, kind=kind, name=name, values=(value,), modifiers=modifiers, near_is_at=near)


def _zone_noun_variants(name: str, zone: Zone, phrases: Iterable[str]) -> Iterator[Entry]:
    """`northern half` also answers to `northern part`, unless another zone bears that name."""
    for phrase in phrases:
        words = words_of(phrase)
        if len(words) > 1 and words[-1] in ZONE_NOUNS:
            for noun in ZONE_NOUNS:
                yield Entry(words=(*words[:-1], noun), kind=MentionKind.ZONE, name=name, values=(zone,))


def _robots(rules: Rules) -> Iterator[Entry]:
    crew, taken = rules.crew, _taken(rules)
    for robot in crew.robots:
        for words in dict.fromkeys(w for phrase in (robot.name, *robot.aliases) for w in _variants(phrase)):
            yield Entry(words=words, kind=MentionKind.ROBOT, name=robot.name, values=(robot.name,))
    for kind in rules.kinds.values():
        members = tuple(r.name for r in crew.robots if r.kind == kind.name)
        if members:
            called = (kind.name, *kind.aliases)
            nicknames = (n for name in called for n in NICKNAMES.get(name, ()) if n not in taken)
            yield from _class_words((*called, *nicknames), members)
    if crew.robots:
        yield from _class_words((*ROBOT_WORDS, *NICKNAMES["robot"]), tuple(r.name for r in crew.robots))


def _class_words(phrases: Iterable[str], members: tuple[str, ...]) -> Iterator[Entry]:
    name = " or ".join(members)
    for words in dict.fromkeys(w for phrase in phrases for w in _variants(phrase)):
        yield Entry(words=words, kind=MentionKind.ROBOT_CLASS, name=name, values=members)
        for many in plurals(words):
            yield Entry(words=many, kind=MentionKind.ROBOT_CLASS, name=name, values=members, plural=True)
