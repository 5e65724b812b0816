"""Reading YAML: positions of every node, and mistakes of the text itself."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from crew.contracts.files.source import SourceErrors, locate, nearest_name, parse
from crew.contracts.files.yaml_reader import MAX_BYTES, scalar
from tests.unit.contracts.carry import mistakes

TEXT = """\
# a comment
name: crew
robots:
  iris: {kind: quadcopter, aliases: [drone, eye]}
after:
  - first
  - {second: 2}
"""


def test_plain_data_is_read() -> None:
    assert parse(TEXT, file="f") == {
        "name": "crew",
        "robots": {"iris": {"kind": "quadcopter", "aliases": ["drone", "eye"]}},
        "after": ["first", {"second": 2}],
    }


@pytest.mark.parametrize(
    ("loc", "key", "mark"),
    [
        ((), False, (2, 1)),
        (("name",), True, (2, 1)),
        (("name",), False, (2, 7)),
        (("robots", "iris"), True, (4, 3)),
        (("robots", "iris"), False, (4, 9)),
        (("robots", "iris", "aliases", 1), False, (4, 45)),
        (("after", 1, "second"), False, (7, 14)),
        (("after", 1, "absent"), False, (7, 5)),
        (("absent", "deeper"), False, (2, 1)),
    ],
)
def test_every_node_has_its_place(loc: tuple[str | int, ...], key: bool, mark: tuple[int, int]) -> None:
    assert locate(parse(TEXT, file="f"), loc, key=key) == mark


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("true", True),
        ("False", False),
        ("~", None),
        ("", None),
        ("12", 12),
        ("-7", -7),
        ("012", 12),
        ("0x1F", 31),
        ("0o17", 15),
        ("1.5e3", 1500.0),
        (".5", 0.5),
        ("-.inf", -math.inf),
        ("9" * 40, 1e40),
        ("yes", "yes"),
        ("on", "on"),
        ("1_000", "1_000"),
        ("5:30", "5:30"),
        ("2026-01-01", "2026-01-01"),
    ],
)
def test_scalars_follow_yaml_1_2(text: str, value: object) -> None:
    assert scalar(text) == value
    assert type(scalar(text)) is type(value)


def test_not_a_number_is_read_as_such() -> None:
    assert math.isnan(float(str(scalar(".nan"))))


def test_quoted_scalars_are_text() -> None:
    assert parse("a: '12'\nb: \"true\"\nc: ''\n", file="f") == {"a": "12", "b": "true", "c": ""}


@pytest.mark.parametrize(
    ("text", "line", "column", "words"),
    [
        ("", 1, 1, "not a mapping: found nothing"),
        ("- a\n- b\n", 1, 1, "not a mapping: found a list"),
        ("just words", 1, 1, "not a mapping: found the value 'just words'"),
        ("a: 1\nb: 2\na: 3\n", 3, 1, "duplicate key: found 'a' again; it is already on line 1"),
        ("a: {b: 1, b: 2}\n", 1, 11, "duplicate key"),
        ("a:\n\tb: 1\n", 2, 1, "a tab indents this line"),
        ("a:\n  \tb: 1\n", 2, 3, "a tab indents this line"),
        ("a: &x 1\n", 1, 4, "anchor: found &x"),
        ("a: *x\n", 1, 4, "reference to an anchor: found *x"),
        ("<<: {a: 1}\n", 1, 1, "merge key: found '<<'"),
        ("a: !!int 3\n", 1, 4, "tag: found"),
        ("a: !own 3\n", 1, 4, "tag: found"),
        ("a: 1\n---\nb: 2\n", 2, 1, "a second document begins here"),
        ("%YAML 1.1\n---\na: on\n", 1, 1, "unsupported YAML version: found 1.1, allowed: 1.2"),
        ("1: a\n", 1, 1, "a key that is not text: found '1'"),
        ("true: a\n", 1, 1, "a key that is not text: found 'true'"),
        ("? [a]\n: b\n", 1, 3, "a key that is not text: found a nested structure"),
        ("a: [1, 2\n", 2, 1, "not YAML: while parsing a flow sequence"),
        ("a: b: c\n", 1, 5, "not YAML: mapping values are not allowed here"),
        ("a: 'x\n", 2, 1, "not YAML: while scanning a quoted scalar"),
        ("a: 1\nb: \x01\n", 2, 4, "not YAML: the character '\\x01' is not allowed"),
        ("a: " + "[" * 40 + "]" * 40, 1, 35, "nested too deeply: allowed: 32 levels"),
        ("a: " + "x" * MAX_BYTES, 1, 1, "file too large: found 1000003 bytes, allowed: 1000000 bytes"),
    ],
)
def test_a_mistake_of_the_text_is_reported_with_its_place(text: str, line: int, column: int, words: str) -> None:
    with pytest.raises(SourceErrors) as caught:
        parse(text, file="f.yaml")
    first = caught.value.errors[0]
    assert (first.file, first.line, first.column) == ("f.yaml", line, column)
    assert words in str(first)


def test_mistakes_that_leave_the_rest_readable_are_reported_together() -> None:
    with pytest.raises(SourceErrors) as caught:
        parse("a: &x 1\na: 2\nb: *x\n3: c\n", file="f")
    assert [error.line for error in caught.value.errors] == [1, 2, 3, 4]


def test_many_mistakes_are_counted_not_all_printed() -> None:
    with pytest.raises(SourceErrors) as caught:
        parse("\n".join(f"{n}: x" for n in range(30)), file="f")
    assert str(caught.value).endswith("... and 10 more")


def test_a_byte_order_mark_is_passed_over() -> None:
    assert parse("\ufeffa: 1\n", file="f") == {"a": 1}


def test_the_nearest_name_ignores_case_and_needs_some_likeness() -> None:
    assert nearest_name("Naviagte", ["navigate", "stop"]) == "navigate"
    assert nearest_name("zzz", ["navigate", "stop"]) == ""


@given(st.text(max_size=200) | st.text("ab:-[]{}&*!|>'\"#%@?,\n\t 01~<", max_size=60))
def test_any_text_is_read_or_refused(text: str) -> None:
    errors = mistakes(lambda text: parse(text, file="f"), text)
    assert all(error.line >= 1 and error.column >= 1 for error in errors)
