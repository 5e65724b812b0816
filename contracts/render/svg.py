"""A contract as a picture: the boxes and arrows of the Mermaid form, drawn here, so that nothing else is needed."""

from collections.abc import Iterator
from itertools import pairwise
from textwrap import wrap

from crew.contracts.contract import Contract
from crew.contracts.render.graph import Arrow, Box, graph_of
from crew.contracts.render.layers import Layout, Size, Spot, lay_out
from crew.contracts.render.wording import escaped

MARGIN, PAD, LINE, TITLE = 20.0, 12.0, 17.0, 20.0
"""Around the picture; inside a box; the height of a line and of a title."""
LETTER, BOLD = 6.6, 7.8
"""Width of a letter of a line and of a title, on the safe side."""
LONGEST = 52
"""Letters of a line before it is broken."""
TINTS = ("#dbeafe", "#dcfce7", "#fef3c7", "#fce7f3", "#ede9fe", "#e0f2fe")
"""One colour a role."""
INK, FAINT = "#1e293b", "#64748b"


def contract_svg(contract: Contract) -> str:
    """A whole SVG document; roles are told apart by colour and by name, optional steps by a dashed frame."""
    return "\n".join(_document(contract)) + "\n"


def _document(contract: Contract) -> Iterator[str]:
    graph = graph_of(contract)
    boxes = {box.name: _wrapped(box) for box in graph.boxes}
    sizes = {name: _size(box) for name, box in boxes.items()}
    layout = lay_out(sizes, [(arrow.source, arrow.target) for arrow in graph.arrows])
    width, height = layout.size.w + 2 * MARGIN, layout.size.h + 2 * MARGIN + TITLE
    tints = {role.name: TINTS[index % len(TINTS)] for index, role in enumerate(contract.roles)}
    yield (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {height:.0f}" width="{width:.0f}" '
        f'height="{height:.0f}" font-family="system-ui, sans-serif" font-size="12" fill="{INK}" role="img">'
    )
    yield f"<title>{escaped(contract.name)}: {escaped(contract.summary)}</title>"
    yield f'<rect width="{width:.0f}" height="{height:.0f}" fill="#ffffff"/>'
    yield (
        '<defs><marker id="tip" viewBox="0 0 10 10" refX="9" refY="5" markerWidth="7" markerHeight="7" '
        f'orient="auto"><path d="M0 0L10 5L0 10z" fill="{FAINT}"/></marker></defs>'
    )
    yield f'<text x="{MARGIN:.0f}" y="{MARGIN:.0f}" font-size="15" font-weight="bold">{escaped(contract.name)}</text>'
    yield f'<g transform="translate({MARGIN:.0f} {MARGIN + TITLE:.0f})">'
    yield from (_arrow(arrow, layout, sizes) for arrow in graph.arrows)
    for name, box in boxes.items():
        yield from _box(box, layout.boxes[name], sizes[name], tints.get(box.role, "#f8fafc"))
    yield "</g>"
    yield "</svg>"


def _wrapped(box: Box) -> Box:
    return box._replace(lines=tuple(part for line in box.lines for part in wrap(line, LONGEST) or [""]))


def _size(box: Box) -> Size:
    widest = max([len(box.title) * BOLD, *(len(line) * LETTER for line in box.lines)])
    return Size(widest + 2 * PAD, TITLE + LINE * len(box.lines) + 2 * PAD - 6)


def _box(box: Box, at: Spot, size: Size, tint: str) -> Iterator[str]:
    x, y = at.x - size.w / 2, at.y - size.h / 2
    round_ = 6 if box.role else 16
    dash = ' stroke-dasharray="5 4"' if box.optional else ""
    yield (
        f'<rect x="{x:.1f}" y="{y:.1f}" width="{size.w:.1f}" height="{size.h:.1f}" rx="{round_}" '
        f'fill="{tint}" stroke="{FAINT}"{dash}/>'
    )
    y += PAD + 10
    weight = ' font-weight="bold"' if box.role else f' fill="{FAINT}"'
    yield f'<text x="{at.x:.1f}" y="{y:.1f}" font-size="13" text-anchor="middle"{weight}>{escaped(box.title)}</text>'
    for number, line in enumerate(box.lines, start=1):
        faint = f' fill="{FAINT}"' if box.role and line == "needs" else ""
        yield f'<text x="{at.x:.1f}" y="{y + number * LINE + 2:.1f}" text-anchor="middle"{faint}>{escaped(line)}</text>'


def _arrow(arrow: Arrow, layout: Layout, sizes: dict[str, Size]) -> str:
    """A curve from the lower edge of one box to the upper edge of the other, by the free passages in between."""
    start, end = layout.boxes[arrow.source], layout.boxes[arrow.target]
    way = [
        Spot(start.x, start.y + sizes[arrow.source].h / 2),
        *layout.ways[arrow.source, arrow.target],
        Spot(end.x, end.y - sizes[arrow.target].h / 2),
    ]
    path = f"M{way[0].x:.1f} {way[0].y:.1f}"
    for a, b in pairwise(way):
        middle = (a.y + b.y) / 2
        path += f" C{a.x:.1f} {middle:.1f} {b.x:.1f} {middle:.1f} {b.x:.1f} {b.y:.1f}"
    dash = ' stroke-dasharray="5 4"' if arrow.dashed else ""
    return f'<path d="{path}" fill="none" stroke="{FAINT}" stroke-width="1.3" marker-end="url(#tip)"{dash}/>'
