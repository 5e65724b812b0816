"""Who calls, and what the matter is: `control to the rover`, `new task:`, `order for the dog:`."""

from crew.contracts.language.calls import call
from crew.contracts.language.clause import Clause, names
from crew.contracts.language.closed_kinds import fits, said_between
from crew.contracts.language.courtesies import CALLED_FROM, CALLING_ONE
from crew.contracts.language.lexicon import Lexicon, match
from crew.contracts.language.lookahead import ARTICLES
from crew.contracts.language.mention import ROBOT_KINDS, MentionKind
from crew.contracts.language.stories import CALLED, HEADINGS, LABELS, NEW, OUT_OF_REACH
from crew.contracts.language.tokens import Token


def called(tokens: list[Token], clause: Clause, lexicon: Lexicon) -> range | None:
    """The tokens that a clause loses as a call or a heading, alone or with a robot's name; None if it is neither."""
    if clause.whole and (found := call(tokens, clause.first, clause.after, clause.closed_by, lexicon)) is not None:
        return found
    return _heading(tokens, clause, lexicon) if clause.closed_by == ":" else None


def in_front_of_name(tokens: list[Token], clause: Clause, lexicon: Lexicon) -> range | None:
    """The same, of a clause that ends with the name of the robot that is called, or of a thing out of reach."""
    if (behind := _behind_robot(tokens, clause, lexicon)) is not None:
        return behind
    at = _in_front_of(ROBOT_KINDS, (*CALLED, *CALLING_ONE), tokens, clause, lexicon)
    at = at or _in_front_of((MentionKind.OBJECT,), OUT_OF_REACH, tokens, clause, lexicon)
    return None if at is None else range(clause.start, at)


def _heading(tokens: list[Token], clause: Clause, lexicon: Lexicon) -> range | None:
    """`new task:`, `order for the rover:`, and the words around the noun of an action in `new transport order:`."""
    if fits(HEADINGS, said_between(tokens, clause.first, clause.after)):
        return range(clause.start, clause.after)
    robot = _in_front_of(ROBOT_KINDS, HEADINGS, tokens, clause, lexicon)
    if robot is not None:
        return range(clause.start, robot)
    labelled = clause.after - 1 if tokens[clause.after - 1].norm in LABELS else clause.after
    verb = labelled - 1
    named = verb >= clause.first and any(
        e.kind is MentionKind.ACTION and len(e.words) == 1 for e in lexicon.names.get(tokens[verb].norm, ())
    )
    new = all(tokens[k].norm in NEW or tokens[k].norm in ARTICLES for k in range(clause.first, verb))
    return range(labelled, clause.after) if named and new and labelled < clause.after else None


def _in_front_of(
    kinds: tuple[MentionKind, ...], patterns: tuple[str, ...], tokens: list[Token], clause: Clause, lexicon: Lexicon
) -> int | None:
    """Where the name begins that ends a clause, if the words before it fit a pattern."""
    for at in range(clause.first + 1, clause.after):
        name = match(lexicon.names, tokens, at)
        if name is not None and name.kind in kinds and at + len(name.words) == clause.after:
            end = at - 1 if tokens[at - 1].norm in ARTICLES else at
            return at if end > clause.first and fits(patterns, said_between(tokens, clause.first, end)) else None
    return None


def _behind_robot(tokens: list[Token], clause: Clause, lexicon: Lexicon) -> range | None:
    """`g1 from control`: who calls, behind the robot that is called."""
    name = match(lexicon.names, tokens, clause.first)
    end = clause.first + (0 if name is None else len(name.words))
    called = name is not None and name.kind in ROBOT_KINDS and end < clause.after
    said = called and clause.whole and fits(CALLED_FROM, said_between(tokens, end, clause.after))
    return range(end, clause.after) if said and not names(tokens, clause._replace(first=end), lexicon) else None
