"""Reads a request: deterministic, bounded, and never guessing. What it cannot read it names."""

from collections.abc import Iterator
from itertools import pairwise

from msgspec.structs import replace

from crew.contracts.language.beneficiary import beneficiaries
from crew.contracts.language.clauses import pare
from crew.contracts.language.implied import fetched, implied_verbs
from crew.contracts.language.lexicon import Lexicon
from crew.contracts.language.mention import Ambiguity, Direction, Mention, MentionKind, Reading, Unread
from crew.contracts.language.people import people
from crew.contracts.language.phrase import directions, hosts, loose_ends, noun_phrases
from crew.contracts.language.piece import SOFT, Piece, before, behind
from crew.contracts.language.portraits import portrayed
from crew.contracts.language.reference import governors, orders, participles, place_pronouns, pronouns
from crew.contracts.language.respell import respell
from crew.contracts.language.rewrite import rewritten
from crew.contracts.language.scan import Scanner
from crew.contracts.language.scope import contradictions, polarities
from crew.contracts.language.tokens import Token, tokenize
from crew.contracts.language.words import Role

MAX_CHARACTERS = 4_000
MAX_TOKENS = 400
_LATER = frozenset(("later", "afterwards", "afterward", "subsequently", "after that", "after this"))
"""What says when, where one thing only is asked for."""


_FIRST_LINES = (
    "control to crew, once you have found my brother, who is lost, rover to him, keep it there",
    "new task: find the ranger who got lost, my back hurts",
    "crew from control: I can't get up, I'm next to you, bring me the bottle for the demo, bless you, then we're done",
    "dog and drone, fly at 5 m over the area, search it and send the rover to the hiker thank you so much",
)
"""Lines for which every table of wordings is needed."""


def prepared(lexicon: Lexicon) -> Lexicon:
    """The lexicon, with every table of wordings compiled: 0.3 s that no request then waits for."""
    for line in _FIRST_LINES:
        read_request(line, lexicon)
    return lexicon


def read_request(text: str, lexicon: Lexicon) -> Reading:
    """Everything that the request names, with polarity and direction, and everything that was not understood."""
    if len(text) > MAX_CHARACTERS:
        return _too_long(text, MAX_CHARACTERS, f"{len(text)} characters; at most {MAX_CHARACTERS} are read")
    tokens = tokenize(text)
    if len(tokens) > MAX_TOKENS:
        why = f"{len(tokens)} words and marks; at most {MAX_TOKENS} are read"
        return _too_long(text, tokens[MAX_TOKENS].start, why)
    tokens, slips, turns, sure = respell(text, tokens, lexicon)
    tokens, described = portrayed(text, tokens, lexicon)
    tokens, left_out, told = pare(text, rewritten(tokens, lexicon), lexicon)
    pieces = noun_phrases(Scanner(tokens, lexicon).scan())
    unsaid = implied_verbs(pieces, text, tokens, lexicon)
    beneficiaries(pieces, tokens, lexicon)
    _all_stop(pieces, lexicon)
    loose_ends(pieces, lexicon)
    _everything(pieces, lexicon)
    _first(pieces)
    _later(pieces)
    participles(pieces)
    place_pronouns(pieces)
    hosts(pieces, lexicon)
    fetched(pieces, lexicon)
    directions(pieces, tokens)
    doubts = turns + polarities(pieces, tokens)
    if any(p.role is Role.PRONOUN for p in pieces):
        doubts += pronouns(pieces, tokens, lexicon)
        directions(pieces, tokens)
    doubts += people(pieces, tokens, lexicon)
    doubts += contradictions(pieces, tokens)
    governors(pieces)
    told += _whose(text, tokens, pieces, lexicon)
    reading = _assemble(text, tokens, pieces, doubts, [*slips, *unsaid, *told], lexicon)
    noted = tuple(sorted((*sure, *left_out, *described), key=lambda n: n.span))
    return replace(reading, passed_over=noted) if noted else reading


def _whose(text: str, tokens: list[Token], pieces: list[Piece], lexicon: Lexicon) -> list[Unread]:
    """`return to base`, said to nobody: one robot would end what it does, another would go there. Asked back."""
    asked = []
    for piece in (p for p in pieces if p.is_action and p.positive):
        ends = {ref.skill for ref in piece.means if ref.contract in lexicon.preempting}
        others = {ref.skill for ref in piece.means if ref.contract not in lexicon.preempting}
        if ends and others - ends and not any(p.is_robot for p in pieces):
            span = _span(tokens, piece)
            asked.append(Unread(text[slice(*span)], span, "go"))
    return asked


def _too_long(text: str, end: int, why: str) -> Reading:
    """Nothing is read of a request beyond bounds: half of it could mean the opposite."""
    span = (end, len(text))
    return Reading(
        text=text[:end], unread=(Unread(text[end : end + 20], span),), ambiguous=(Ambiguity(f"it has {why}", span),)
    )


def _everything(pieces: list[Piece], lexicon: Lexicon) -> None:
    """`stop everything`, `all robots stop`: every step of the contract that ends what the robots do."""
    for at, piece in enumerate(pieces):
        whole = piece.is_robot and piece.every and set(piece.values) == set(lexicon.robots)
        if piece.role is not Role.EVERYTHING and not whole:
            continue
        called = SOFT | {Role.PUNCTUATION}  # "everybody, stop"
        ending = [p for p in (before(pieces, at), behind(pieces, at, called)) if p is not None and p.is_action]
        sweeps = (p for p in (before(pieces, at),) if p is not None and p.is_action)
        if any((r.contract, r.step) in lexicon.zone_steps for verb in sweeps for r in verb.means):
            piece.become(Role.FILLER)  # "scan everything": the whole area, which is the default
            continue
        refs = [r for verb in ending[:1] for r in verb.means if r.contract in lexicon.preempting]
        if refs:
            ending[0].means = tuple(r for r in lexicon.ending if r.contract == refs[0].contract)
            piece.become(Role.FILLER)
        elif not whole:
            piece.become(Role.UNREAD)


def _all_stop(pieces: list[Piece], lexicon: Lexicon) -> None:
    """`all stop` is said to everything."""
    for all_, verb in pairwise(pieces):
        ends = verb.is_action and any(r.contract in lexicon.preempting for r in verb.means)
        if ends and all_.role is Role.QUANTIFIER and all_.norm == "all":
            all_.become(Role.EVERYTHING)


def _first(pieces: list[Piece]) -> None:
    """`first` says nothing in front of the first verb; elsewhere it would change the order."""
    acted = False
    for piece in pieces:
        acted = acted or piece.is_action
        if piece.role is Role.FIRST and acted:
            then = any(p.role is Role.THEN for p in pieces[pieces.index(piece) :])
            piece.become(Role.FILLER if then else Role.UNREAD)


def _later(pieces: list[Piece]) -> None:
    """`take it there later`: no order of two things, but a time."""
    alone = sum(p.is_action for p in pieces) < 2
    for piece in pieces:
        if piece.role is Role.THEN and piece.norm in _LATER and alone:
            piece.become(Role.UNREAD)


def _assemble(
    text: str, tokens: list[Token], pieces: list[Piece], doubts: list[Ambiguity], asked: list[Unread], lexicon: Lexicon
) -> Reading:
    named = [p for p in pieces if p.kind is not None]
    index = {id(p): k for k, p in enumerate(named)}
    pairs = ((index[id(a)], index[id(b)]) for a, b in orders(pieces))
    return Reading(
        text=text,
        mentions=tuple(_mention(text, tokens, p, index) for p in named),
        unread=tuple(_asked(text, tokens, pieces, asked, lexicon)),
        ambiguous=tuple(sorted(doubts, key=lambda d: d.span)),
        orders=tuple(dict.fromkeys(pairs)),
    )


def _mention(text: str, tokens: list[Token], piece: Piece, index: dict[int, int]) -> Mention:
    span = _span(tokens, piece)
    said = text[slice(*span)]
    return Mention(
        span=span,
        text=said,
        kind=piece.kind or MentionKind.UNKNOWN,
        name=said if piece.kind is MentionKind.UNKNOWN else piece.name,
        positive=piece.positive,
        direction=piece.direction,
        values=piece.values,
        every=piece.every,
        means=piece.means,
        governor=index.get(id(piece.governor)) if piece.governor is not None else None,
        bare=piece.bare,
        aside=piece.aside,
    )


def _asked(text: str, tokens: list[Token], pieces: list[Piece], asked: list[Unread], lexicon: Lexicon) -> list[Unread]:
    """What was not read, and what was read otherwise than it stands, in the order of the text."""
    unread = [u for u in _unread(text, tokens, pieces, lexicon) if u.span not in {a.span for a in asked}]
    return sorted([*unread, *asked], key=lambda u: u.span)


def _sought(piece: Piece, lexicon: Lexicon) -> bool:
    """`look for survivors`: a search reports one, and says if there are more."""
    verb = piece.governor
    return verb is not None and all((r.contract, r.step) in lexicon.zone_steps for r in verb.means)


def _unread(text: str, tokens: list[Token], pieces: list[Piece], lexicon: Lexicon) -> Iterator[Unread]:
    for piece in pieces:
        excluded_unknown = piece.kind is MentionKind.UNKNOWN and not piece.positive
        several = piece.kind is MentionKind.VALUE and piece.every and not _sought(piece, lexicon)
        if piece.role in (Role.UNREAD, Role.WORD) or excluded_unknown or several:
            span = _span(tokens, piece)
            yield Unread(text[slice(*span)], span)


def _span(tokens: list[Token], piece: Piece) -> tuple[int, int]:
    return tokens[piece.first].start, tokens[piece.after - 1].end


def explain_reading(reading: Reading) -> str:
    """The reading in one plain sentence that a person can confirm."""
    parts = [*_clauses(reading)]
    excluded = [m.name for m in reading.excluded]
    if excluded:
        parts.append("excluded: " + ", ".join(excluded))
    if reading.ambiguous:
        parts.append("unclear: " + ", ".join(a.why for a in reading.ambiguous))
    if reading.unread:
        parts.append("not understood: " + ", ".join(map(str, reading.unread)))
    return "; ".join((*parts, *noted_lines(reading))) or "nothing was asked for"


def noted_lines(reading: Reading) -> Iterator[str]:
    """What was read otherwise than it stands, and what was left out, without asking."""
    yield from (f"'{n.word}' read as '{n.meant}'" for n in reading.noted if n.meant)
    left_out = [str(n) for n in reading.noted if not n.meant]
    if left_out:
        yield "left out as no part of the request: " + ", ".join(left_out)


def _clauses(reading: Reading) -> Iterator[str]:
    """One clause for all actions that were asked for, each with what belongs to it, in the order of the request."""
    clauses: list[list[str]] = [[]]
    for index, mention in enumerate(reading.mentions):
        belongs = mention.kind is not MentionKind.ACTION and mention.governor is not None
        if not mention.positive or belongs:
            continue
        words = [mention.name]
        if mention.kind is MentionKind.ACTION:
            words += [_shown(m) for m in reading.wanted if m.governor == index and m.kind is not MentionKind.ACTION]
        clauses.append(words)
    said = ", ".join(" ".join(words) for words in clauses if words)
    if said:
        yield said


def _shown(mention: Mention) -> str:
    prefix = f"{mention.direction} " if mention.direction in (Direction.FROM, Direction.TO) else ""
    return prefix + mention.name


__all__ = ["MAX_CHARACTERS", "Reading", "explain_reading", "noted_lines", "prepared", "read_request"]
