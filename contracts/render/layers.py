"""A layered layout for small graphs: each box below all that lead to it, long arrows led around the boxes between."""

from collections.abc import Mapping
from itertools import pairwise
from typing import NamedTuple

GAP_X, GAP_Y = 28.0, 44.0
"""Free space between the boxes of one layer, and between layers."""
PASS = 14.0
"""The width that a long arrow takes in each layer that it passes."""
SWEEPS = 8


class Size(NamedTuple):
    """Width and height."""

    w: float
    h: float


class Spot(NamedTuple):
    """The middle of a box, or of an arrow's passage through a layer."""

    x: float
    y: float


class Layout(NamedTuple):
    """Where every box lies, the spots that every arrow passes on its way, and the size of the whole."""

    boxes: Mapping[str, Spot]
    ways: Mapping[tuple[str, str], tuple[Spot, ...]]
    size: Size


def lay_out(sizes: Mapping[str, Size], arrows: list[tuple[str, str]]) -> Layout:
    """Boxes by name and arrows between them; the arrows must not run in circles."""
    ranks = _ranks(list(sizes), arrows)
    names, links, ways = dict(sizes), list[tuple[str, str]](), dict[tuple[str, str], list[str]]()
    for source, target in arrows:
        between = [f"{source}>{target}@{rank}" for rank in range(ranks[source] + 1, ranks[target])]
        for rank, name in enumerate(between, start=ranks[source] + 1):
            names[name], ranks[name] = Size(PASS, 0.0), rank
        chain = [source, *between, target]
        links += pairwise(chain)
        ways[source, target] = between
    layers = _ordered(names, ranks, links)
    spots, size = _placed(layers, names, links)
    passed = {arrow: tuple(spots[name] for name in between) for arrow, between in ways.items()}
    return Layout({name: spots[name] for name in sizes}, passed, size)


def _ranks(names: list[str], arrows: list[tuple[str, str]]) -> dict[str, int]:
    """The longest way to each box from a box that nothing leads to."""
    ranks = dict.fromkeys(names, 0)
    for _ in names:
        for source, target in arrows:
            ranks[target] = max(ranks[target], ranks[source] + 1)
    return ranks


def _ordered(names: Mapping[str, Size], ranks: dict[str, int], links: list[tuple[str, str]]) -> list[list[str]]:
    """Each layer from left to right, so that boxes stand near what they are linked to."""
    layers: list[list[str]] = [[] for _ in range(max(ranks.values(), default=0) + 1)]
    for name in names:
        layers[ranks[name]].append(name)
    for sweep in range(SWEEPS):
        down = sweep % 2 == 0
        order = range(1, len(layers)) if down else range(len(layers) - 2, -1, -1)
        for rank in order:
            near = layers[rank - 1] if down else layers[rank + 1]
            layers[rank].sort(key=lambda name, near=near, down=down: _middle(name, near, links, down))  # type: ignore[misc]
    return layers


def _middle(name: str, near: list[str], links: list[tuple[str, str]], down: bool) -> float:
    """The mean position of a box's neighbours in the layer beside it, as a share of that layer."""
    found = [
        near.index(a if down else b) for a, b in links if (b if down else a) == name and (a if down else b) in near
    ]
    return (sum(found) / len(found) + 0.5) / len(near) if found else 0.5


def _placed(
    layers: list[list[str]], sizes: Mapping[str, Size], links: list[tuple[str, str]]
) -> tuple[dict[str, Spot], Size]:
    """Every layer packed from left to right and centred; then boxes are drawn towards their neighbours where free."""
    widths = [sum(sizes[name].w for name in layer) + GAP_X * (len(layer) - 1) for layer in layers]
    total = max(widths, default=0.0)
    spots: dict[str, Spot] = {}
    y = 0.0
    for layer, width in zip(layers, widths, strict=True):
        height = max((sizes[name].h for name in layer), default=0.0)
        x = (total - width) / 2
        for name in layer:
            spots[name] = Spot(x + sizes[name].w / 2, y + height / 2)
            x += sizes[name].w + GAP_X
        y += height + GAP_Y
    for _ in range(SWEEPS):
        for layer in layers:
            _drawn(layer, spots, sizes, links, total)
    return spots, Size(total, max(y - GAP_Y, 0.0))


def _drawn(
    layer: list[str], spots: dict[str, Spot], sizes: Mapping[str, Size], links: list[tuple[str, str]], total: float
) -> None:
    """Move each box of a layer towards the mean of its neighbours, as far as the boxes beside it allow."""
    for index, name in enumerate(layer):
        near = [spots[b if a == name else a].x for a, b in links if name in (a, b)]
        if not near:
            continue
        half = sizes[name].w / 2
        low, high = half, total - half
        if index:
            left = layer[index - 1]
            low = spots[left].x + sizes[left].w / 2 + GAP_X + half
        if index + 1 < len(layer):
            right = layer[index + 1]
            high = spots[right].x - sizes[right].w / 2 - GAP_X - half
        spots[name] = Spot(min(max(sum(near) / len(near), low), high), spots[name].y)
