"""Speaking to a crew that is up: request, status, watch, cancel, confirm, approve, stop, reset."""

from typing import Annotated

import typer

from crew.cli.option import AsJson, CrewOption, end

app = typer.Typer()


@app.command()
def request(
    text: Annotated[str, typer.Argument(help="What the crew shall do, in plain words.")],
    crew: CrewOption = "",
    as_json: AsJson = False,
) -> None:
    """Ask a running crew for something, and follow it to its end."""
    from crew.cli.talk import run_request

    end(run_request(text, crew, as_json))


@app.command()
def status(crew: CrewOption = "", as_json: AsJson = False) -> None:
    """What a running crew is doing, and who of it is alive."""
    from crew.cli.status import run_status

    end(run_status(crew, as_json))


@app.command()
def watch(crew: CrewOption = "", as_json: AsJson = False) -> None:
    """Follow every mission of a running crew until Ctrl-C: a page on a terminal, else one line an event."""
    from crew.cli.watch import run_watch

    end(run_watch(crew, as_json))


@app.command()
def cancel(
    mission: Annotated[str, typer.Argument(help="The mission's id (crew status).")], crew: CrewOption = ""
) -> None:
    """End a mission; its robots reach their safe states."""
    from crew.cli.talk import run_cancel

    end(run_cancel(mission, crew))


@app.command()
def confirm(
    mission: Annotated[str, typer.Argument(help="The mission that asks (crew status).")],
    no: Annotated[bool, typer.Option("--no", help="Decline instead.")] = False,
    crew: CrewOption = "",
) -> None:
    """Answer a mission's question about what it did not understand."""
    from crew.cli.answering import run_confirm

    end(run_confirm(mission, not no, crew))


@app.command()
def approve(
    mission: Annotated[str, typer.Argument(help="The mission whose step waits for approval (crew status).")],
    no: Annotated[bool, typer.Option("--no", help="Decline instead: the mission ends.")] = False,
    crew: CrewOption = "",
) -> None:
    """Approve the exact call that a mission waits with. Signed with the operator's key, good once, for 10 s."""
    from crew.cli.answering import run_approve

    end(run_approve(mission, not no, crew))


@app.command()
def stop(
    crew: CrewOption = "",
    reason: Annotated[str, typer.Option(help="Why, for the journal.")] = "",
    as_json: AsJson = False,
) -> None:
    """Stop every robot now, and keep it stopped until a reset."""
    from crew.cli.stopping import run_stop

    end(run_stop(crew, reason, as_json))


@app.command()
def reset(
    robot: Annotated[list[str] | None, typer.Argument(help="Robots to release; all of them if none is named.")] = None,
    crew: CrewOption = "",
) -> None:
    """Release stopped robots. Signed with the operator's key."""
    from crew.cli.stopping import run_reset

    end(run_reset(tuple(robot or ()), crew))
