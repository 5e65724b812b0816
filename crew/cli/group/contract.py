"""Workflow contracts: show, graph, new, check, coverage, schema."""

from pathlib import Path
from typing import Annotated

import typer

from crew.cli.option import AsJson, end

app = typer.Typer(help="Workflow contracts.", no_args_is_help=True, rich_markup_mode=None)


@app.command("show")
def contracts_show(
    name: Annotated[str, typer.Argument(help="A contract of the crew; all of them if left out.")] = "",
    crew: Annotated[str, typer.Option("--crew", help="Crew whose contracts are shown.")] = "air_ground",
    form: Annotated[str, typer.Option("--as", help="prose, mermaid or json.")] = "prose",
) -> None:
    """Show contracts as a planner reads them, as a diagram, or as data."""
    from crew.cli.contracts import run_show

    end(run_show(name, crew, form))


@app.command("graph")
def contracts_graph(
    name: Annotated[str, typer.Argument(help="A contract of the crew.")],
    crew: Annotated[
        str, typer.Option("--crew", help="Crew whose contract is drawn; any shipped one if left out.")
    ] = "",
    form: Annotated[str, typer.Option("--as", help="mermaid or svg.")] = "mermaid",
    to: Annotated[Path | None, typer.Option(help="File to write instead of printing.")] = None,
) -> None:
    """Draw a contract: its steps, their order, their guards."""
    from crew.cli.contract_graph import run_graph

    end(run_graph(name, crew, form, to))


@app.command("new")
def contracts_new(
    name: Annotated[str, typer.Argument(help="The contract's name.")],
    do: Annotated[
        list[str],
        typer.Option(help="A step: role.skill, or role.skill(argument=value); give it once for each step, in order."),
    ],
    crew: Annotated[str, typer.Option("--crew", help="Crew whose skills are used.")] = "air_ground",
    to: Annotated[Path | None, typer.Option(help="Folder to write into.")] = None,
    as_json: AsJson = False,
) -> None:
    """Draft a contract from the skills that it shall use; it is checked and proved before it is written."""
    from crew.cli.contract_new import run_new

    end(run_new(name, crew, do, to, as_json))


@app.command("check")
def contracts_check(
    files: Annotated[list[Path] | None, typer.Argument(metavar="[FILE]...", help="Contract files.")] = None,
    crew: Annotated[str, typer.Option("--crew", help="Crew to prove for; all that are shipped if left out.")] = "",
    limit: Annotated[int, typer.Option(min=1, help="States of one contract, beyond which it counts as not proved.")] = (
        200_000
    ),
    watch: Annotated[bool, typer.Option("--watch", help="Check again whenever a file changes, until Ctrl-C.")] = False,
    as_json: AsJson = False,
) -> None:
    """Prove contracts: every plan, every world, every failure. Exit 0 only if all are proved."""
    from crew.cli.contract_check import run_check

    if watch:
        from crew.cli.contract_watch import run_watch

        end(run_watch(files or (), crew, as_json, limit))
    end(run_check(files or (), crew, as_json, limit))


@app.command("coverage")
def contracts_coverage(
    runs: Annotated[list[Path], typer.Argument(metavar="RUNS...", help="Runs, or folders that hold runs.")],
    crew: Annotated[str, typer.Option("--crew", help="Count this crew's contracts too, used or not.")] = "",
    as_json: AsJson = False,
) -> None:
    """Which transitions, guards and codes recorded runs have exercised, and which none has."""
    from crew.cli.coverage import run_coverage

    end(run_coverage(runs, crew, as_json))


@app.command("schema")
def contracts_schema() -> None:
    """Print the JSON Schema of a contract file, for editors."""
    from crew.cli.contracts import run_schema

    end(run_schema())
