"""`crew skills`, `crew contracts show`, `crew contracts schema`: what the files say, rendered."""

import msgspec

from crew.cli.output import say, say_json
from crew.contracts.render.card import robot_card
from crew.contracts.render.mermaid import contract_graph
from crew.contracts.render.prose import contract_prose
from crew.contracts.render.schema import contract_file_schema, robot_schemas
from crew.errors import UsageError, nearest
from crew.library import load_rules

FORMS = ("prose", "mermaid", "json")


def run_skills(crew: str, as_json: bool) -> int:
    """Each robot's card."""
    rules = load_rules(crew)
    if as_json:
        say_json({robot.name: robot_schemas(robot.name, rules) for robot in rules.crew.robots})
        return 0
    for robot in rules.crew.robots:
        say(robot_card(robot.name, rules))
    return 0


def run_show(name: str, crew: str, form: str) -> int:
    """One contract of a crew, or all of them."""
    if form not in FORMS:
        raise UsageError(f"no form is called {form!r}{nearest(form, FORMS)}")
    contracts = load_rules(crew).contracts
    if name and name not in contracts:
        raise UsageError(f"crew {crew} has no contract {name!r}{nearest(name, contracts)}")
    for contract in [contracts[name]] if name else contracts.values():
        if form == "prose":
            say(contract_prose(contract))
        elif form == "mermaid":
            say(contract_graph(contract))
        else:
            say_json(msgspec.to_builtins(contract))
    return 0


def run_schema() -> int:
    """The JSON Schema of a contract file."""
    say_json(contract_file_schema())
    return 0
