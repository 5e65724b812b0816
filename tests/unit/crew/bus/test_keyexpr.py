import pytest
import zenoh
from hypothesis import given
from hypothesis import strategies as st

from crew.bus.keyexpr import checked_key_expr, intersects, is_key
from crew.errors import BusError

CHUNKS = st.sampled_from(["a", "b", "*", "**", "@a", "@b"])
EXPRESSIONS = st.lists(CHUNKS, min_size=1, max_size=6).map("/".join)


@given(EXPRESSIONS, EXPRESSIONS)
def test_intersection_is_zenohs(left: str, right: str) -> None:
    ours = zenoh.KeyExpr.autocanonize(left).intersects(zenoh.KeyExpr.autocanonize(right))
    assert intersects(left, right) == ours


@pytest.mark.parametrize(
    ("left", "right", "meet"),
    [
        ("a/**", "a", True),
        ("a/*", "a", False),
        ("**", "a/@act/b", False),
        ("**/@act/**", "a/@act/b", True),
        ("a/*/b", "a/@act/b", False),
        ("a/@act/*", "a/@act/b", True),
        ("*", "@stop", False),
    ],
)
def test_verbatim_chunks_match_only_themselves(left: str, right: str, meet: bool) -> None:
    assert intersects(left, right) is meet
    assert intersects(right, left) is meet


@pytest.mark.parametrize("bad", ["", "/a", "a/", "a//b", "a*", "a/b$*", "a?x", "a#b", "***"])
def test_malformed_expressions_are_refused(bad: str) -> None:
    with pytest.raises(BusError, match="invalid key expression"):
        checked_key_expr(bad)


def test_a_key_has_no_wildcard() -> None:
    assert is_key("a/@act/b")
    assert not is_key("a/*/b")
