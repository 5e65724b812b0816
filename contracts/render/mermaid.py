"""A contract as a Mermaid flowchart: steps as boxes, `after` as arrows."""

from collections.abc import Iterable, Iterator

from crew.contracts.contract import Condition, Contract, Step
from crew.contracts.render.wording import guard_words


def contract_graph(contract: Contract) -> str:
    """Optional steps are dashed, guards stand in the boxes, the completion closes the graph."""
    return "\n".join(_lines(contract)) + "\n"


def _lines(contract: Contract) -> Iterator[str]:
    yield "flowchart TD"
    if contract.needs:
        yield f'  start(["{_guards("needs", contract.needs)}"])'
    yield from (f'  {_id(step)}["{_label(step)}"]{":::optional" if step.optional else ""}' for step in contract.steps)
    if contract.complete:
        yield f'  done(["{_guards("complete when", contract.complete)}"])'
    yield from _arrows(contract)
    if any(step.optional for step in contract.steps):
        yield "  classDef optional stroke-dasharray: 5 5"


def _arrows(contract: Contract) -> Iterator[str]:
    by_name = {step.name: step for step in contract.steps}
    followed = {name for step in contract.steps for name in step.after}
    for step in contract.steps:
        if contract.needs and not step.after:
            yield f"  start --> {_id(step)}"
        for name in step.after:
            arrow = "-.->" if step.optional or by_name[name].optional else "-->"
            yield f"  {_id(by_name[name])} {arrow} {_id(step)}"
    for step in contract.steps:
        if contract.complete and step.name not in followed and not step.optional:
            yield f"  {_id(step)} --> done"


def _label(step: Step) -> str:
    skills = " or ".join(dict.fromkeys(call.skill for call in step.do))
    lines = [f"<b>{step.name}</b>", f"{step.role}: {skills}"]
    if step.needs:
        lines.append(_guards("needs", step.needs))
    if step.approval:
        lines.append("a person approves")
    return "<br/>".join(lines)


def _guards(head: str, conditions: Iterable[Condition]) -> str:
    """One guard a line."""
    return "<br/>".join([head, *(_escape(guard_words(condition)) for condition in conditions)])


def _id(step: Step) -> str:
    """Prefixed, since Mermaid keeps words such as `end` for itself."""
    return f"step_{step.name}"


def _escape(text: str) -> str:
    for char, entity in (("&", "&amp;"), ('"', "&quot;"), ("<", "&lt;"), (">", "&gt;")):
        text = text.replace(char, entity)
    return text
