"""Writes contracts/language/slips.py: which slips of the crews' words may be another English word.

`python -m tests.unit.contracts.language.make_slips KNOWN COMMON`: text files with a word a line, KNOWN of all words
that people write (a slip that stands in it is a word by itself), COMMON without rarities (a slip that could be meant
for one of these, too, is doubtful). The shipped table was made from the word counts of symspellpy 6.10.1 and
pyspellchecker 0.9.1, both MIT: KNOWN is what either counts at all, COMMON what they count 300,000 and 100 times or
more. A word that only a dictionary knows (`sned`, to lop) is typed by nobody who commands robots. Nothing of them is
needed to run.
"""

import sys
import textwrap
from collections.abc import Iterator
from pathlib import Path

import crew
from crew.contracts.language.lexicon import lexicon_of
from crew.contracts.language.spelling import SHORTEST, SHORTEST_SWAPPED, slips, swapped
from crew.library import load_rules

TABLE = Path(crew.__file__).parent / "contracts" / "language" / "slips.py"
HEAD = '''"""Words of the shipped crews whose slips were looked up, and slips among them that may be another word.

Made by tests/unit/contracts/language/make_slips.py; not to be edited.
"""

from crew.contracts.language.words import word_set

'''


def looked_up() -> set[str]:
    """The names, verbs, pronouns and prepositions of the shipped crews that are long enough."""
    crews = ("air_ground", "humanoid_quadruped")
    known = (lexicon_of(load_rules(crew_name)).vocabulary for crew_name in crews)
    words = (w for vocabulary in known for w in vocabulary.names | vocabulary.pronouns)
    return {w for w in words if len(w) >= SHORTEST_SWAPPED and w.isalpha()}


def typed(word: str) -> Iterator[str]:
    """Every slip of a word that the reader knows: a letter left out, struck twice, or two swapped."""
    for k in range(len(word)):
        yield word[:k] + word[k + 1 :]
        yield word[:k] + word[k] + word[k:]
        yield word[:k] + word[k : k + 2][::-1] + word[k + 2 :]


def origins(slip: str) -> set[str]:
    """Every string that a slip could have been meant for, by the same slips."""
    letters = "abcdefghijklmnopqrstuvwxyz"
    longer = {slip[:k] + x + slip[k:] for k in range(1, len(slip) + 1) for x in letters}
    swapped = {slip[:k] + slip[k : k + 2][::-1] + slip[k + 2 :] for k in range(len(slip) - 1)}
    single = {slip[:k] + slip[k + 1 :] for k in range(1, len(slip)) if slip[k] == slip[k - 1]}
    return {w for w in longer | swapped | single if slips(slip, w)}


def doubtful(word: str, known: set[str], common: set[str]) -> set[str]:
    """Slips of a word that are a word by themselves, or may be meant for another."""
    read = swapped if len(word) < SHORTEST else slips
    made = {slip for slip in typed(word) if read(slip, word)}
    return {slip for slip in made if slip in known or (origins(slip) & common) - {word}}


def table(known: set[str], common: set[str]) -> str:
    words = looked_up()
    odd = sorted(set().union(*(doubtful(w, known, common) for w in words)))
    return HEAD + _constant("LOOKED_UP", sorted(words)) + "\n" + _constant("DOUBTFUL", odd)


def _constant(name: str, words: list[str]) -> str:
    lines = textwrap.wrap(" ".join(words), 114)
    return f'{name}: frozenset[str] = word_set(\n    """\n' + "".join(f"    {x}\n" for x in lines) + '    """\n)\n'


if __name__ == "__main__":
    lists = [{w.strip().lower() for w in Path(path).read_text(encoding="utf-8").split()} for path in sys.argv[1:3]]
    TABLE.write_text(table(*lists), encoding="utf-8")
