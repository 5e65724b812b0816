"""Slips of the keyboard: what is recognised is asked back, and none of them turns a request round."""

from collections.abc import Iterator

import pytest

from crew.contracts.language.lexicon import Lexicon, lexicon_of
from crew.contracts.language.reading import read_request
from crew.contracts.language.slips import DOUBTFUL, LOOKED_UP
from crew.contracts.language.spelling import recognised, slips
from crew.contracts.site import Rules
from crew.library import load_rules
from tests.unit.contracts.language.corpus import judge

NEGATED = {
    "air_ground": (
        "do not send the rover to base", "never search the north half", "search the area except the north half",
        "search the area but do not search the north half", "send the rover to base unless the hiker is there",
        "do not drive anywhere", "search without the drone",
    ),
    "humanoid_quadruped": (
        "do not carry the cube to room_b", "don't bring me the bottle", "never go to room_a",
        "carry the cube to room_a or room_b", "bring me anything but the cube",
    ),
}  # fmt: skip

TURNING = frozenset(["do", "don't", "not", "never", "except", "unless", "anywhere", "without", "or", "anything", "but"])


def typed(word: str) -> Iterator[str]:
    """Every wording of a word with two letters swapped, one left out, or one struck twice."""
    for k in range(len(word)):
        yield word[:k] + word[k + 1 :]
        yield word[:k] + word[k] + word[k:]
        yield word[:k] + word[k : k + 2][::-1] + word[k + 2 :]


def mistyped(text: str) -> Iterator[str]:
    words = text.split()
    for k, word in ((k, word) for k, word in enumerate(words) if word in TURNING):
        yield from (" ".join((*words[:k], wrong, *words[k + 1 :])) for wrong in typed(word) if wrong != word)


@pytest.mark.parametrize("crew", list(NEGATED))
def test_no_slip_turns_a_request_round(crew: str) -> None:
    rules = load_rules(crew)
    wrong = [line for text in NEGATED[crew] for line in mistyped(text) if judge(line, rules).outcome == "accepted"]
    assert wrong == []


@pytest.mark.parametrize(
    ("text", "word", "meant"),
    [
        ("snd the rover to base", "snd", "send"),
        ("send the rover to bse", "bse", "base"),
        ("search the noth half", "noth", "north"),
        ("send the Rovre to base", "Rovre", "rover"),
    ],
)
def test_a_slip_in_a_name_or_verb_is_read_and_asked_back(text: str, word: str, meant: str, rules: Rules) -> None:
    judged = judge(text, rules)
    assert judged.outcome == "question"
    assert f"'{word}' (read as '{meant}')" in judged.why


@pytest.mark.parametrize(
    ("text", "word", "meant"),
    [
        ("serach the north half", "serach", "search"),
        ("Serach the north half", "Serach", "search"),
        ("find the victm", "victm", "victim"),
        ("searchh the area", "searchh", "search"),
        ("send the rover to bsae", "bsae", "base"),
        ("search the north hlaf", "hlaf", "half"),
        ("find the hiker and send the rover to tehm", "tehm", "them"),
        ("find the hiker and send the rover to hmi", "hmi", "him"),
        ("sned the rover bakc to bsae", "sned", "send"),
    ],
)
def test_a_slip_that_can_be_nothing_else_is_read_and_shown(text: str, word: str, meant: str, rules: Rules) -> None:
    assert judge(text, rules).outcome == "accepted"
    assert (word, meant) in [(n.word, n.meant) for n in read_request(text, lexicon_of(rules)).noted]


@pytest.mark.parametrize("crew", list(NEGATED))
def test_no_slip_that_is_read_is_a_doubtful_one(crew: str) -> None:
    words = lexicon_of(load_rules(crew)).vocabulary
    for meant in LOOKED_UP & words.names:
        for wrong in typed(meant):
            if slips(wrong, meant) and wrong not in DOUBTFUL and wrong not in words.known:
                assert recognised(wrong, words.names) in (meant, None)


@pytest.mark.parametrize(
    "text", ["send teh rover to base", "find the hiker adn send the rover", "plaese search the area"]
)
def test_a_slip_in_a_word_that_says_nothing_costs_nothing(text: str, rules: Rules) -> None:
    assert judge(text, rules).outcome == "accepted"


@pytest.mark.parametrize("text", ["do nto send the rover to base", "nveer search the area", "search wihtout the drone"])
def test_what_may_be_a_negation_makes_the_request_ambiguous(text: str, lexicon: Lexicon) -> None:
    assert any("may be a slip of" in doubt.why for doubt in read_request(text, lexicon).ambiguous)


@pytest.mark.parametrize(("word", "other"), [("tube", "cube"), ("river", "rover"), ("case", "base"), ("cubes", "cube")])
def test_another_word_is_no_slip(word: str, other: str) -> None:
    assert not slips(word, other)


def test_two_words_that_could_be_meant_are_not_guessed() -> None:
    assert recognised("carrt", frozenset(("cart", "carrot"))) is None
    assert recognised("wset", frozenset(("west", "wet"))) == "west"
