"""The request templates of contracts: `(search|scan) {zone} and (send|drive) {responder} to {person}`."""

import re
from collections.abc import Iterable, Iterator
from itertools import product

_PART = re.compile(r"\(([^()]*)\)|\{(\w+)\}|([^(){}]+)")


def expansions(template: str) -> Iterator[str]:
    """Every wording that a template stands for; placeholders stay."""
    choices: list[list[str]] = []
    for group, slot, literal in _PART.findall(template):
        choices.append(group.split("|") if group else [f"{{{slot}}}" if slot else literal])
    return ("".join(parts) for parts in product(*choices))


def fixed_phrases(templates: Iterable[str]) -> Iterator[str]:
    """Wordings without a placeholder: each is a request by itself ("abort the mission")."""
    return (wording for template in templates if "{" not in template for wording in expansions(template))


def opening_phrases(templates: Iterable[str]) -> Iterator[str]:
    """The words before a template's first placeholder ("where is")."""
    for template in templates:
        if "{" in template:
            yield from (w for w in expansions(template.split("{", 1)[0].strip()) if w)


def skeleton(template: str, fill: dict[str, str]) -> str:
    """A template with its first alternatives and the given words in place of its placeholders."""
    first = next(expansions(template))
    return re.sub(r"\{(\w+)\}", lambda m: fill.get(m.group(1), m.group(1)), first)
