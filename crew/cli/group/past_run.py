"""What runs have left behind: runs, verify, replay, report, explain."""

from pathlib import Path
from typing import Annotated

import typer

from crew.cli.option import AsJson, Runs, end

app = typer.Typer()


@app.command("runs")
def list_runs(runs: Runs = Path("runs"), as_json: AsJson = False) -> None:
    """List the runs that were recorded."""
    from crew.cli.runs import run_runs

    end(run_runs(runs, as_json))


@app.command()
def verify(
    run: Annotated[Path, typer.Argument(help="A run's folder, or `last`.")],
    runs: Runs = Path("runs"),
    key: Annotated[Path | None, typer.Option(help="The orchestrator's public key, if not this machine's.")] = None,
    against: Annotated[
        list[Path] | None,
        typer.Option("--against", help="A changed contract or crew file; may be given several times."),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Check a run's chain and signatures, and decide every decision again.

    With --against: by other contracts or another crew; exit code 6 if anything would have been decided otherwise.
    """
    if against:
        from crew.cli.against import run_against

        end(run_against(run, against, runs, key, as_json))
    from crew.cli.runs import run_verify

    end(run_verify(run, runs, key, as_json))


@app.command()
def replay(
    run: Annotated[Path, typer.Argument(help="A run's folder, its name, or `last`.")],
    runs: Runs = Path("runs"),
    web: Annotated[bool, typer.Option("--web", help="Show it in a browser; prints the address.")] = False,
    port: Annotated[int, typer.Option(help="Port of the web page on loopback; 0 takes a free one.")] = 0,
    rebuild: Annotated[bool, typer.Option("--rebuild", help="Draw it anew from the journal.")] = False,
) -> None:
    """Show a run: the world, who did what, what was decided and why."""
    from crew.cli.replay import run_replay

    end(run_replay(run, runs, web, port, rebuild))


@app.command()
def report(
    run: Annotated[Path, typer.Argument(help="A run's folder, its name, or `last`.")],
    runs: Runs = Path("runs"),
    key: Annotated[Path | None, typer.Option(help="The orchestrator's public key, if not this machine's.")] = None,
    to: Annotated[
        Path | None, typer.Option(help="The file to write; by default report.html in the run's folder.")
    ] = None,
) -> None:
    """Write a run as one HTML page: what was asked, proposed, decided and why, and what happened."""
    from crew.cli.report import run_report

    end(run_report(run, runs, key, to))


@app.command()
def explain(
    run: Annotated[Path, typer.Argument(help="A run's folder, its name, or `last`.")],
    decision: Annotated[int | None, typer.Argument(help="A decision's number, as listed without one.")] = None,
    runs: Runs = Path("runs"),
    key: Annotated[Path | None, typer.Option(help="The orchestrator's public key, if not this machine's.")] = None,
    as_json: AsJson = False,
) -> None:
    """Why a run's decisions are what they are, and what would have been accepted instead."""
    from crew.cli.explain import run_explain

    end(run_explain(run, decision, runs, key, as_json))
