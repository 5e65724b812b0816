"""A table of wordings with the plainer words for each, looked up by what stands at a place in a request."""

from collections.abc import Iterator, Mapping

from crew.contracts.language.entry import Words
from crew.contracts.language.templates import expansions
from crew.contracts.language.tokens import Token


class Wordings:
    """Of two that are the same the first counts."""

    def __init__(self, plain: Mapping[Words, Words]) -> None:
        self._plain = plain
        lengths: dict[str, set[int]] = {}
        for words in plain:
            lengths.setdefault(words[0], set()).add(len(words))
        self._lengths = {first: tuple(sorted(of, reverse=True)) for first, of in lengths.items()}
        self.firsts = frozenset(lengths)
        """The words that a wording begins with."""

    def standing(self, tokens: list[Token], at: int) -> Iterator[tuple[Words, Words]]:
        """Every wording that stands here, with its plain words, the longest first."""
        for length in self._lengths.get(tokens[at].norm, ()):
            words = tuple([token.norm for token in tokens[at : at + length]])
            plain = self._plain.get(words)
            if plain is not None:
                yield words, plain

    @property
    def words(self) -> frozenset[str]:
        """Every word of every wording."""
        return frozenset(word for words in self._plain for word in words)


def of_templates(templates: tuple[tuple[str, str], ...]) -> Wordings:
    """The table that templates of wordings and plain words spell out."""
    found: dict[Words, Words] = {}
    for template, plain in templates:
        for wording in expansions(template):
            found.setdefault(tuple(wording.split()), tuple(plain.split()))
    return Wordings(found)


def of_phrases(phrases: tuple[str, ...]) -> Wordings:
    """A table of phrases that only have to stand somewhere."""
    return Wordings(dict.fromkeys((tuple(phrase.split()) for phrase in phrases), ()))
