"""The command line. Each command imports what it needs when it runs, so that `--help` stays quick."""

import sys
from typing import Annotated

import typer

from crew.cli.group import certificate, contract, crew_life, operating, past_run, planner, study

app = typer.Typer(
    name="crew",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    context_settings={"help_option_names": ["-h", "--help"]},
)
for group in (crew_life, operating, past_run, study):
    app.add_typer(group.app)
app.add_typer(contract.app, name="contracts")
app.add_typer(planner.app, name="planner")
app.add_typer(certificate.app, name="certs")


def _print_version(wanted: bool) -> None:
    if wanted:
        from importlib.metadata import version

        print(f"crew {version('robot-crew')}")
        raise typer.Exit


@app.callback()
def root(
    version: Annotated[
        bool, typer.Option("--version", callback=_print_version, is_eager=True, help="Print the version and exit.")
    ] = False,
) -> None:
    """Command a crew of robots in plain language. No language model ever moves one."""


def main() -> None:
    """Run the command line. A person's mistake gets a sentence and exit code 2, never a traceback."""
    from crew.errors import CrewError

    try:
        app()
    except CrewError as error:
        print(f"crew: {error}", file=sys.stderr)
        sys.exit(error.exit_code)
    except KeyboardInterrupt:
        sys.exit(130)
