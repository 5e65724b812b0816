"""`crew contracts graph`: one contract as a diagram."""

from collections.abc import Callable, Mapping
from pathlib import Path

from crew.cli.output import say
from crew.contracts.contract import Contract
from crew.contracts.render.mermaid import contract_graph
from crew.contracts.render.svg import contract_svg
from crew.errors import UsageError, nearest
from crew.library import crew_names, load_rules

FORMS: Mapping[str, Callable[[Contract], str]] = {"mermaid": contract_graph, "svg": contract_svg}


def run_graph(name: str, crew: str, form: str, to: Path | None) -> int:
    """Print the diagram, or write it to a file."""
    if form not in FORMS:
        raise UsageError(f"no form is called {form!r}{nearest(form, FORMS)}")
    text = FORMS[form](_find(name, crew))
    if to is None:
        say(text.rstrip("\n"))
        return 0
    try:
        to.write_text(text, encoding="utf-8")
    except OSError as error:
        raise UsageError(f"cannot write {to}: {error.strerror}; name a file in a folder that exists") from error
    say(f"wrote {to}")
    return 0


def _find(name: str, crew: str) -> Contract:
    """The contract in this crew, or in the first shipped crew that has it."""
    crews = [crew] if crew else crew_names()
    known: dict[str, Contract] = {}
    for each in crews:
        known = {**load_rules(each).contracts, **known}
    if name not in known:
        raise UsageError(f"no contract of {' or '.join(crews)} is called {name!r}{nearest(name, known)}")
    return known[name]
