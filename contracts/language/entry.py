"""One phrase of a crew's words, with what it names or does."""

import msgspec

from crew.contracts.language.inflect import Form
from crew.contracts.language.mention import MentionKind, StepRef
from crew.contracts.language.tokens import Token, tokenize
from crew.contracts.language.words import Role
from crew.contracts.plan import SlotValue

Words = tuple[str, ...]


class Entry(msgspec.Struct, frozen=True, kw_only=True):
    """What a phrase names, or does."""

    words: Words
    role: Role = Role.MENTION
    kind: MentionKind = MentionKind.UNKNOWN
    name: str = ""
    values: tuple[SlotValue, ...] = ()
    plural: bool = False
    means: tuple[StepRef, ...] = ()
    form: Form = Form.BASE
    modifiers: frozenset[str] = frozenset()
    """Adjectives that other aliases of the same thing carry: harmless in front of any of them."""
    near_is_at: bool = False
    """Robots stop beside it anyway, so that "near" says nothing more."""


def stands(tokens: list[Token], at: int, words: Words) -> bool:
    """Whether the words stand here, given that the first one does."""
    if len(words) == 1:
        return True
    second = at + 1 < len(tokens) and tokens[at + 1].norm == words[1]
    return second and tuple(t.norm for t in tokens[at : at + len(words)]) == words


def stands_all(tokens: list[Token], at: int, words: Words) -> bool:
    """Whether the words stand here."""
    if words and at + len(words) > len(tokens):
        return False
    for k, word in enumerate(words):  # noqa: SIM110  (the reader's innermost loop; a generator takes twice the time)
        if tokens[at + k].norm != word:
            return False
    return True


def words_of(phrase: str) -> Words:
    """A name or alias as the tokens that a request would show, without a leading article."""
    words = tuple(t.norm for t in tokenize(phrase))
    return words[1:] if len(words) > 1 and words[0] in ("the", "a", "an") else words
