"""Thanks and the like at either end of a clause, without a mark between: `send it to room_a thank you ever so much`."""

from functools import cache

from crew.contracts.language.closed_kinds import class_words, fits, said_between
from crew.contracts.language.courtesies import THANKS, WANTED_FOR
from crew.contracts.language.entry import stands_all
from crew.contracts.language.inflect import Form
from crew.contracts.language.lexicon import Lexicon
from crew.contracts.language.mention import ROBOT_KINDS, MentionKind
from crew.contracts.language.tokens import Token


def beside(tokens: list[Token], first: int, after: int, lexicon: Lexicon) -> range | None:
    """Where the thanks stand in tokens `first` up to `after`; None if there are none beside a request."""
    for cut in range(first + 2, after):
        if tokens[cut].norm in _courteous() and fits((*THANKS, *WANTED_FOR), said_between(tokens, cut, after)):
            return range(cut, after)
    if tokens[first].norm in _courteous():
        for cut in range(after - 2, first + 1, -1):
            if fits(THANKS, said_between(tokens, first, cut)) and _asks(tokens, cut, lexicon):
                return range(first, cut)
    return None


def _asks(tokens: list[Token], at: int, lexicon: Lexicon) -> bool:
    """Whether a request begins here."""
    entries = (e for e in lexicon.names.get(tokens[at].norm, ()) if stands_all(tokens, at, e.words))
    ordered = any(e.kind in ROBOT_KINDS or (e.kind is MentionKind.ACTION and e.form is Form.BASE) for e in entries)
    return ordered or tokens[at].norm in ("please", "could", "can", "would", "will")


@cache
def _courteous() -> frozenset[str]:
    """Words that thanks begin with."""
    return frozenset(w.split()[0] for w in class_words("poorly")) | {
        "thanks", "thank", "ta", "cheers", "many", "much", "bless", "god", "you", "it", "you're", "that's", "there's",
        "i'd", "i", "be", "pretty", "please", "come", "i'm", "we", "so", "and",
    }  # fmt: skip
