"""`crew contracts graph`: one contract as a diagram."""

from pathlib import Path

from crew.cli.output import say
from crew.contracts.render.mermaid import contract_graph
from crew.contracts.render.svg import contract_svg
from crew.errors import UsageError, nearest
from crew.library import load_rules

FORMS = {"mermaid": contract_graph, "svg": contract_svg}


def run_graph(name: str, crew: str, form: str, to: Path | None) -> int:
    """Print the diagram, or write it to a file."""
    if form not in FORMS:
        raise UsageError(f"no form is called {form!r}{nearest(form, FORMS)}")
    contracts = load_rules(crew).contracts
    if name not in contracts:
        raise UsageError(f"crew {crew} has no contract {name!r}{nearest(name, contracts)}")
    text = FORMS[form](contracts[name])
    if to is None:
        say(text.rstrip("\n"))
        return 0
    try:
        to.write_text(text, encoding="utf-8")
    except OSError as error:
        raise UsageError(f"cannot write {to}: {error.strerror}; name a file in a folder that exists") from error
    say(f"wrote {to}")
    return 0
