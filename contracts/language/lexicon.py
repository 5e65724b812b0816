"""The words of one crew: names, aliases, class words and action words, with everything that each can mean."""

from collections.abc import Iterable, Iterator, Mapping
from functools import cached_property
from itertools import product

import msgspec

from crew.contracts.contract import Contract, Step
from crew.contracts.language.afield import afield_words
from crew.contracts.language.entry import Entry, Words, words_of
from crew.contracts.language.inflect import Form, inflections
from crew.contracts.language.mention import MentionKind, StepRef
from crew.contracts.language.naming import entities
from crew.contracts.language.plainer import plainer_words
from crew.contracts.language.rewrites import wording_words
from crew.contracts.language.spelling import SHORTEST_SWAPPED, Vocabulary
from crew.contracts.language.stories import told_words
from crew.contracts.language.synonyms import also
from crew.contracts.language.templates import fixed_phrases, opening_phrases
from crew.contracts.language.tokens import Token
from crew.contracts.language.words import (
    FUNCTION_WORDS,
    LINKING,
    REQUESTER,
    ROLE_ORDER,
    SILENT,
    SINGLE_WORDS,
    TURNING,
    Role,
)
from crew.contracts.plan import Zone
from crew.contracts.site import Rules
from crew.contracts.skill import Kind, Skill


class Entries(tuple[Entry, ...]):
    """The entries that begin with one word, the longest first."""

    @cached_property
    def by_length(self) -> tuple[tuple[int, dict[Words, Entry]], ...]:
        """The first entry of each wording, by its number of words."""
        table: dict[int, dict[Words, Entry]] = {}
        for entry in self:
            table.setdefault(len(entry.words), {}).setdefault(entry.words, entry)
        return tuple(table.items())


class Lexicon(msgspec.Struct, frozen=True, kw_only=True, dict=True):
    """The phrases of one crew by first word, longest first; within one length, names before function words."""

    names: Mapping[str, Entries]
    functions: Mapping[str, Entries]
    special: Mapping[str, Entries]
    """Function words that hold only before a fitting word (`start searching`, `have the drone land`)."""
    area: Zone
    reports: Mapping[str, str]
    """The one run-time value that a skill reports, by skill."""
    members: Mapping[str, frozenset[str]]
    """The skills that each robot has."""
    robots: tuple[str, ...]
    hosts: Mapping[str, frozenset[str]]
    """The robots that have each part, by the part's name."""
    zone_steps: frozenset[tuple[str, str]]
    """Contract steps that take a zone."""
    object_steps: frozenset[tuple[str, str]]
    """Contract steps of contracts that handle an object."""
    to_requester: frozenset[str]
    """Contracts that can bring something to the person who asks."""
    by_hand: frozenset[str]
    """Those of them that need the person in reach."""
    gestures: frozenset[str]
    """Skills without arguments."""
    ending: tuple[StepRef, ...]
    """All steps of the contracts that end what the robots are doing."""

    def __repr__(self) -> str:
        return f"<lexicon of {', '.join(self.robots)}: {len(self.names)} first words>"

    @cached_property
    def preempting(self) -> frozenset[str]:
        return frozenset(ref.contract for ref in self.ending)

    @cached_property
    def vocabulary(self) -> Vocabulary:
        tables = (self.names, self.functions, self.special)
        entries = [entry for table in tables for found in table.values() for entry in found]
        single = {e.words[0]: e for e in entries if len(e.words) == 1 and e.role is not Role.MENTION}
        return Vocabulary(
            known=frozenset(word for e in entries for word in e.words)
            | SINGLE_WORDS
            | wording_words()
            | told_words()
            | plainer_words()
            | afield_words(),
            names=frozenset(word for found in self.names.values() for e in found for word in e.words),
            silent=frozenset(word for word, e in single.items() if e.role in SILENT),
            pronouns=frozenset(w for w, e in single.items() if e.role in LINKING and len(w) >= SHORTEST_SWAPPED)
            | _PARTS,
            turning=frozenset(word for word, e in single.items() if e.role in TURNING),
        )

    def longest(self, tokens: list[Token], at: int) -> Entry | None:
        """The longest phrase that starts here; a name wins over a function word of the same length."""
        name = match(self.names, tokens, at)
        function = match(self.functions, tokens, at)
        if name is None or function is None:
            return name or function
        return function if len(function.words) > len(name.words) else name


def match(table: Mapping[str, Entries], tokens: list[Token], at: int) -> Entry | None:
    """The longest entry of a table that starts at a token."""
    found = table.get(tokens[at].norm)
    if found is None:
        return None
    for length, of in found.by_length:
        entry = of.get(tuple([t.norm for t in tokens[at : at + length]]))
        if entry is not None:
            return entry
    return None


def build_lexicon(rules: Rules) -> Lexicon:
    """Collect the crew's words. Costs milliseconds; see `lexicon_of` for a cached one."""
    named = list(entities(rules))
    entries = [*named, *_actions(rules, named)]
    plain = {role: phrases for role, phrases in FUNCTION_WORDS.items() if role not in ROLE_ORDER}
    special = {role: FUNCTION_WORDS[role] for role in ROLE_ORDER}
    return Lexicon(
        names=_index(_unique(entries)),
        functions=_index(_function_entries(plain)),
        special=_index(_function_entries(special)),
        area=rules.crew.area,
        reports=_reports(rules),
        members={r.name: frozenset(s.name for s in k.skills) for r in rules.crew.robots if (k := rules.kinds[r.kind])},
        robots=tuple(r.name for r in rules.crew.robots),
        hosts={
            name: frozenset(r.name for r in rules.crew.robots if rules.host_of(name, [r.name])) for name in rules.parts
        },
        zone_steps=frozenset(_steps_using(rules, "zone", own=True)),
        object_steps=frozenset(_steps_using(rules, "object", own=False)),
        to_requester=frozenset(c.name for c in rules.contracts.values() if _hands_over(c) or _delivers(c)),
        by_hand=frozenset(c.name for c in rules.contracts.values() if _hands_over(c)),
        gestures=frozenset(s.name for s in _all_skills(rules.kinds.values()) if not s.params),
        ending=tuple(
            StepRef(c.name, step.name, call, True)
            for c in rules.contracts.values()
            if c.preempts
            for step, call in _calls(c)
        ),
    )


def lexicon_of(rules: Rules) -> Lexicon:
    """The lexicon of these rules, built once and kept with them."""
    cached = rules.__dict__.get("_lexicon")
    if not isinstance(cached, Lexicon):
        cached = rules.__dict__["_lexicon"] = build_lexicon(rules)
    return cached


def _actions(rules: Rules, named: list[Entry]) -> Iterator[Entry]:
    meanings: dict[Words, dict[StepRef, None]] = {}
    for phrase, ref in _word_meanings(rules):
        meanings.setdefault(words_of(phrase), {}).setdefault(ref)
    plainly = {" ".join(words): refs for words, refs in meanings.items()}
    for phrase, refs, verb in list(also(plainly, {" ".join(e.words) for e in named})):
        if verb:
            meanings[words_of(phrase)] = refs
        else:
            yield _action(words_of(phrase), tuple(refs), Form.BASE)
    for words, refs in meanings.items():
        for form, spelled in inflections(words):
            yield _action(spelled, tuple(refs), form)
    for contract in rules.contracts.values():
        for phrase in fixed_phrases(contract.examples):
            words = words_of(phrase)
            refs = {r: None for known, rs in meanings.items() if known == words[: len(known)] for r in rs}
            plain = tuple(w for w in words if w != "the")
            mine = tuple(r for r in refs if r.contract == contract.name)
            alike = (known for known, rs in meanings.items() if len(known) == 1 and set(mine) <= set(rs))
            if mine and words not in meanings:
                tails = dict.fromkeys((words[1:], plain[1:]))
                yield from (_action((*verb, *tail), mine, Form.BASE) for verb in alike for tail in tails)
        for phrase in opening_phrases(contract.examples):
            words = words_of(phrase)
            if words and not any(word in heads for heads in meanings for word in words) and words[0] not in _HARMLESS:
                yield _action(words, tuple(_asked_refs(contract)), Form.BASE)


_PARTS = frozenset(("back", "down", "when", "once"))
"""Words of longer phrases whose slips are recognised."""
_HARMLESS = frozenset(w for phrases in FUNCTION_WORDS.values() for phrase in phrases for w in phrase.split()[:1])


def _action(words: Words, means: tuple[StepRef, ...], form: Form) -> Entry:
    return Entry(words=words, kind=MentionKind.ACTION, name=" ".join(words), means=means, form=form)


def _word_meanings(rules: Rules) -> Iterator[tuple[str, StepRef]]:
    """Every action word with one thing that it can mean."""
    present = [rules.kinds[r.kind] for r in rules.crew.robots if r.kind in rules.kinds]
    skills = {s.name: s for kind in present for s in kind.skills}
    used = set()
    for contract in rules.contracts.values():
        for step, call in _calls(contract):
            skill = skills.get(call)
            used.add(call)
            yield from ((word, StepRef(contract.name, step.name, call, True)) for word in step.words)
            own = frozenset(step.words)
            words = skill.words if skill is not None else ()
            yield from ((w, StepRef(contract.name, step.name, call)) for w in words if w not in own)
    for name, skill in skills.items():
        if name not in used:
            yield from ((word, StepRef("", "", name)) for word in skill.words)


def _calls(contract: Contract) -> Iterator[tuple[Step, str]]:
    for step in contract.steps:
        yield from ((step, name) for name in dict.fromkeys(pattern.skill for pattern in step.do))


def _asked_refs(contract: Contract) -> Iterator[StepRef]:
    return (
        StepRef(contract.name, step.name, call, True) for step, call in _calls(contract) if step.name in contract.asks
    )


def _hands_over(contract: Contract) -> bool:
    needed = (c for c in contract.needs if not c.when and not c.negated)
    return any(c.path.partition(".")[0] == REQUESTER and c.value is True for c in needed)


def _delivers(contract: Contract) -> bool:
    return any(REQUESTER in slot.values for slot in contract.slots)


def _reports(rules: Rules) -> dict[str, str]:
    found: dict[str, str] = {}
    for skill in _all_skills(rules.kinds.values()):
        if len(skill.reports) == 1 and rules.crew.value(skill.reports[0]) is not None:
            found[skill.name] = skill.reports[0]
    return found


def _all_skills(kinds: Iterable[Kind]) -> Iterator[Skill]:
    return (skill for kind in kinds for skill in kind.skills)


def _steps_using(rules: Rules, slot_type: str, *, own: bool) -> Iterator[tuple[str, str]]:
    """Steps whose calls take a slot of the type, or (not `own`) all steps of a contract with such a slot."""
    for contract, step in ((c, s) for c in rules.contracts.values() for s in c.steps):
        slots = [s.name for s in contract.slots if slot_type in s.types]
        refs = (str(v) for pattern in step.do for v in pattern.args.values())
        if slots and (not own or any(r == f"${s}" or r.startswith(f"${s}.") for r, s in product(list(refs), slots))):
            yield contract.name, step.name


def _function_entries(table: Mapping[Role, Iterable[str]]) -> list[Entry]:
    return [Entry(words=tuple(p.split()), role=role, name=p) for role, phrases in table.items() for p in phrases]


def _unique(entries: Iterable[Entry]) -> list[Entry]:
    """The first entry of each phrase, except that a phrase may be both a name and an action."""
    kept: dict[tuple[Words, bool], Entry] = {}
    for entry in entries:
        kept.setdefault((entry.words, entry.kind is MentionKind.ACTION), entry)
    return list(kept.values())


def _index(entries: Iterable[Entry]) -> dict[str, Entries]:
    table: dict[str, list[Entry]] = {}
    for entry in entries:
        if entry.words:
            table.setdefault(entry.words[0], []).append(entry)
    return {first: Entries(sorted(found, key=lambda e: -len(e.words))) for first, found in table.items()}
