"""Arguments and options that commands share, and what every command does with them. Imports nothing heavy."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NoReturn

import typer

if TYPE_CHECKING:
    from crew.actors.specs import PlannerChoice

CrewName = Annotated[str, typer.Argument(metavar="[CREW]", help="A shipped crew's name, or the path of a crew file.")]
CrewOption = Annotated[str, typer.Option("--crew", help="The crew to speak to; may be left out if one runs.")]
AsJson = Annotated[bool, typer.Option("--json", help="Print JSON for machines.")]
Map = Annotated[str | None, typer.Option("--map", help="The simulated site's map.")]
Models = Annotated[
    str,
    typer.Option("--models", help="Folder of MuJoCo Menagerie, whose robots then take the place of the scene's own."),
]
Seed = Annotated[int | None, typer.Option(help="Seed of the simulation's noise.")]
Speed = Annotated[str, typer.Option(help="Pace of the simulation: a multiple of real time, or max.")]
Planner = Annotated[str, typer.Option(help="Who plans: embedded, anthropic, compatible, fallible, recorded or script.")]
Script = Annotated[str, typer.Option(help="JSON file with the plans of --planner script or recorded.")]
Model = Annotated[str, typer.Option(help="The language model's name at its endpoint.")]
BaseUrl = Annotated[str, typer.Option("--base-url", help="Address of a Messages API, for --planner compatible.")]
EndpointFile = Annotated[str, typer.Option("--endpoint", help="JSON file with the peculiarities of an endpoint.")]
Context = Annotated[str, typer.Option(help="What a model is told: none, registry or contracts.")]
NoFallback = Annotated[bool, typer.Option("--no-fallback", help="No stand-in for a model that is unavailable.")]
Fault = Annotated[list[str] | None, typer.Option("--fault", help="Inject a fault; may be given several times.")]
Runs = Annotated[Path, typer.Option(help="Folder that runs are written to.")]
Single = Annotated[bool, typer.Option("--single-process", help="Everything in one process, for a debugger.")]
Record = Annotated[bool, typer.Option("--record/--no-record", help="Record the run as a page for crew replay.")]


def planning_of(
    planner: str, script: str, model: str, base_url: str, endpoint: str, context: str, no_fallback: bool
) -> "PlannerChoice":
    """Who shall plan, as the options say."""
    from crew.actors.specs import PlannerChoice

    return PlannerChoice(
        name=planner,
        script=script,
        model=model,
        base_url=base_url,
        profile=endpoint,
        context=context,
        fallback=not no_fallback,
    )


def end(code: int) -> NoReturn:
    """End the command with this exit code."""
    raise typer.Exit(code)
