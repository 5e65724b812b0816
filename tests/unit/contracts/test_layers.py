"""The layout of diagrams: whatever the graph, boxes stay apart, arrows lead down and pass no box."""

from itertools import combinations, pairwise

from hypothesis import given, settings
from hypothesis import strategies as st

from crew.contracts.render.layers import GAP_X, Size, Spot, lay_out

Graph = tuple[dict[str, Size], list[tuple[str, str]]]


@st.composite
def graphs(draw: st.DrawFn) -> Graph:
    count = draw(st.integers(1, 12))
    side = st.floats(20, 300)
    sizes = {f"s{n}": Size(draw(side), draw(side)) for n in range(count)}
    pairs = [(f"s{a}", f"s{b}") for a, b in combinations(range(count), 2)]
    return sizes, draw(st.lists(st.sampled_from(pairs), unique=True)) if pairs else []


def overlaps(a: Spot, a_size: Size, b: Spot, b_size: Size) -> bool:
    return abs(a.x - b.x) * 2 < a_size.w + b_size.w and abs(a.y - b.y) * 2 < a_size.h + b_size.h


@settings(deadline=None)
@given(graph=graphs())
def test_boxes_stay_apart_and_inside(graph: Graph) -> None:
    sizes, arrows = graph
    layout = lay_out(sizes, arrows)
    for (a, at), (b, bt) in combinations(layout.boxes.items(), 2):
        assert not overlaps(at, sizes[a], bt, sizes[b])
    for name, spot in layout.boxes.items():
        assert spot.x - sizes[name].w / 2 >= -0.01
        assert spot.x + sizes[name].w / 2 <= layout.size.w + 0.01
        assert spot.y - sizes[name].h / 2 >= -0.01
        assert spot.y + sizes[name].h / 2 <= layout.size.h + 0.01


@settings(deadline=None)
@given(graph=graphs())
def test_every_arrow_leads_down_and_passes_beside_the_boxes(graph: Graph) -> None:
    sizes, arrows = graph
    layout = lay_out(sizes, arrows)
    for (source, target), way in layout.ways.items():
        spots = [layout.boxes[source], *way, layout.boxes[target]]
        assert all(a.y < b.y for a, b in pairwise(spots))
        for spot in way:
            hit = [n for n, box in layout.boxes.items() if overlaps(spot, Size(GAP_X / 4, 0.1), box, sizes[n])]
            assert hit == []


def test_a_chain_stands_in_one_line() -> None:
    sizes = {name: Size(width, 40) for name, width in (("a", 100), ("b", 60), ("c", 180))}
    layout = lay_out(sizes, [("a", "b"), ("b", "c")])
    assert len({spot.x for spot in layout.boxes.values()}) == 1
