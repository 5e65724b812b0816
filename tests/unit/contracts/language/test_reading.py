"""Reading a request: names, polarity, direction, what is unclear and what is not understood."""

import pytest

from crew.contracts.language.lexicon import Lexicon, lexicon_of
from crew.contracts.language.mention import Direction, MentionKind, Reading
from crew.contracts.language.reading import explain_reading, read_request
from tests.unit.contracts.language.lab import lab_rules

AMBIGUOUS = (
    "do not search the north and send the rover to the victim", "if you find the victim, send the rover",
    "search the north or the south", "search unless it rains", "search until noon", "find the victim before landing",
    "search the north, no wait, the south", "do not not search", "search the north and do not search the north",
    "don't avoid the north", "not only search the area", "Do not, under any circumstances, move the rover", "land it",
    "send it to base", "don't send the rover to base, send it to the victim", "either land or search", "no",
)  # fmt: skip
UNREAD = {
    "search the area twice": ["twice"],
    "search the area slowly": ["slowly"],
    "he said search the area": ["he", "said"],
    "search the area 🙂": ["🙂"],
    "search the area at 5 km": ["5", "km"],
    "search the area, avoid the north": ["avoid"],
    "find survivors": ["survivors"],
    "should I search the area": ["should"],
}
UNKNOWN = {
    "send the rover to the rooftop helipad": "rooftop helipad",
    "send the rover to the base of the tower": "base of the tower",
    "send the rover to the middle of the area": "middle of the area",
    "send the rover to the victim's car": "victim's car",
    "find the other victim": "other victim",
    "send the rover to the drone": "drone",
    "search the land": "land",
}


def names(reading: Reading, *, positive: bool = True) -> list[str]:
    return [m.name for m in reading.mentions if m.positive is positive]


def test_names_and_actions_with_their_places_in_the_text(lexicon: Lexicon) -> None:
    reading = read_request("Search the area and send the rover to the victim", lexicon)
    assert names(reading) == ["search", "operational_area", "send", "tb3", "victim"]
    assert [reading.text[slice(*m.span)] for m in reading.mentions] == ["Search", "area", "send", "rover", "victim"]
    assert reading.mentions[-1].direction is Direction.TO
    assert reading.mentions[3].governor == 2
    assert not reading.unread
    assert not reading.ambiguous


@pytest.mark.parametrize("text", AMBIGUOUS)
def test_ambiguous(text: str, lexicon: Lexicon) -> None:
    assert read_request(text, lexicon).ambiguous


@pytest.mark.parametrize(("text", "words"), UNREAD.items())
def test_unread_words_are_kept(text: str, words: list[str], lexicon: Lexicon) -> None:
    assert [u.word for u in read_request(text, lexicon).unread] == words


@pytest.mark.parametrize(("text", "verbatim"), UNKNOWN.items())
def test_unknown_noun_phrases_are_kept_whole(text: str, verbatim: str, lexicon: Lexicon) -> None:
    unknown = [m for m in read_request(text, lexicon).mentions if m.kind is MentionKind.UNKNOWN]
    assert [(m.text, m.values) for m in unknown] == [(verbatim, ())]


def test_longest_name_wins() -> None:
    reading = read_request("do NOT go to room b, go to room_b2", lexicon_of(lab_rules()))
    assert names(reading, positive=False) == ["go", "room_b"]
    assert names(reading) == ["go", "room_b2"]


@pytest.mark.parametrize("end", [", search the north", " but search the north", " then search the north"])
def test_negation_ends(end: str, lexicon: Lexicon) -> None:
    reading = read_request(f"do not search the south{end}", lexicon)
    assert names(reading) == ["search", "north_half"]
    assert names(reading, positive=False) == ["search", "south_half"]


def test_negated_verb_excludes_its_entity_and_a_bare_one_the_skill(lexicon: Lexicon) -> None:
    entity, bare = (read_request(t, lexicon).excluded for t in ("do not move the rover", "do not move"))
    assert [m.bare for m in entity] == [False, False]
    assert [m.bare for m in bare] == [True]


def test_what_an_excluded_robot_was_not_to_do_excludes_nothing_else(lexicon: Lexicon) -> None:
    reading = read_request("find the victim but do not send the rover to the victim", lexicon)
    assert not reading.ambiguous
    assert [m.name for m in reading.excluded if not m.aside] == ["tb3"]


def test_subject_of_a_negation_is_excluded(lexicon: Lexicon) -> None:
    assert names(read_request("the rover must not move, search the area", lexicon)) == ["search", "operational_area"]


def test_origin_and_destination(lexicon: Lexicon) -> None:
    reading = read_request("send the rover from base to the victim", lexicon)
    found = {m.name: m.direction for m in reading.mentions}
    assert (found["base"], found["victim"]) == (Direction.FROM, Direction.TO)


@pytest.mark.parametrize(
    ("text", "last"),
    [("find the victim in the north half and send the rover there", "victim"), ("find the hiker; go to him", "victim")],
)
def test_pronouns_take_their_antecedent(text: str, last: str, lexicon: Lexicon) -> None:
    assert names(read_request(text, lexicon))[-1] == last


def test_class_word_denotes_the_set() -> None:
    reading = read_request("send a dog to room a", lexicon_of(lab_rules()))
    assert reading.mentions[1].values == ("rex", "fido")


@pytest.mark.parametrize("words", ["operational area", "operational_area", "operational-area", "OPERATIONAL AREA"])
def test_spellings_of_a_name(words: str, lexicon: Lexicon) -> None:
    assert names(read_request(f"search the {words}", lexicon)) == ["search", "operational_area"]


def test_over_is_not_rover(lexicon: Lexicon) -> None:
    assert not any(m.kind is MentionKind.ROBOT_CLASS for m in read_request("over and out, dover", lexicon).mentions)


def test_stated_order(lexicon: Lexicon) -> None:
    for text in ("find the victim, then send the rover", "send the rover after finding the victim"):
        reading = read_request(text, lexicon)
        first, second = reading.orders[0]
        assert reading.mentions[first].text in ("find", "finding")
        assert reading.mentions[second].text == "send"


def test_explanation_is_one_sentence(lexicon: Lexicon) -> None:
    reading = read_request("search the area and send the rover to the victim twice, not the north", lexicon)
    expected = "search operational_area, send tb3 to victim; excluded: north_half; not understood: 'twice'"
    assert explain_reading(reading) == expected
    assert explain_reading(read_request("", lexicon)) == "nothing was asked for"
