"""A contract as a Mermaid flowchart: steps as boxes, `after` as arrows."""

from collections.abc import Iterator

from crew.contracts.contract import Contract
from crew.contracts.render.graph import Box, graph_of
from crew.contracts.render.wording import escaped


def contract_graph(contract: Contract) -> str:
    """Optional steps are dashed, guards stand in the boxes, the completion closes the graph."""
    return "\n".join(_lines(contract)) + "\n"


def _lines(contract: Contract) -> Iterator[str]:
    graph = graph_of(contract)
    ids = {box.name: _id(box) for box in graph.boxes}
    yield "flowchart TD"
    yield from (f"  {ids[box.name]}{_box(box)}" for box in graph.boxes)
    for arrow in graph.arrows:
        yield f"  {ids[arrow.source]} {'-.->' if arrow.dashed else '-->'} {ids[arrow.target]}"
    if any(box.optional for box in graph.boxes):
        yield "  classDef optional stroke-dasharray: 5 5"


def _box(box: Box) -> str:
    if not box.role:
        return f'(["{"<br/>".join([box.title, *map(escaped, box.lines)])}"])'
    label = "<br/>".join([f"<b>{box.title}</b>", *map(escaped, box.lines)])
    return f'["{label}"]{":::optional" if box.optional else ""}'


def _id(box: Box) -> str:
    """Prefixed, since Mermaid keeps words such as `end` for itself."""
    return f"step_{box.name}" if box.role else box.name
