"""Bringing a crew up, and what that needs: up, demo, skills, checklist, doctor, deploy, run."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from crew.cli.option import (
    AsJson,
    BaseUrl,
    Context,
    CrewName,
    EndpointFile,
    Fault,
    Map,
    Model,
    Models,
    NoFallback,
    Planner,
    Record,
    Runs,
    Script,
    Seed,
    Single,
    Speed,
    end,
    planning_of,
)

if TYPE_CHECKING:
    from crew.actors.specs import PlannerChoice
    from crew.launch.options import LaunchOptions

app = typer.Typer()


@app.command()
def up(
    crew: CrewName = "air_ground",
    map_: Map = None,
    models: Models = "",
    seed: Seed = None,
    speed: Speed = "1",
    planner: Planner = "embedded",
    script: Script = "",
    model: Model = "",
    base_url: BaseUrl = "",
    endpoint: EndpointFile = "",
    context: Context = "contracts",
    no_fallback: NoFallback = False,
    fault: Fault = None,
    port: Annotated[int, typer.Option(help="The router's TCP port on loopback; 0 takes a free one.")] = 7447,
    runs: Runs = Path("runs"),
    single_process: Single = False,
    record: Record = True,
    view: Annotated[bool, typer.Option("--view", help="Show the run in a browser as it happens.")] = False,
) -> None:
    """Bring a crew up and keep it up until Ctrl-C."""
    from crew.cli.up import run_up

    planning = planning_of(planner, script, model, base_url, endpoint, context, no_fallback)
    end(run_up(_options(crew, map_, models, seed, speed, planning, fault, port, runs, single_process, record), view))


@app.command()
def demo(
    crew: CrewName = "air_ground",
    map_: Map = None,
    models: Models = "",
    seed: Seed = None,
    request: Annotated[
        str | None, typer.Option(help="What to ask of the crew; if left out, its crew file says.")
    ] = None,
    speed: Speed = "max",
    planner: Planner = "embedded",
    script: Script = "",
    model: Model = "",
    base_url: BaseUrl = "",
    endpoint: EndpointFile = "",
    context: Context = "contracts",
    no_fallback: NoFallback = False,
    fault: Fault = None,
    runs: Runs = Path("runs"),
    single_process: Single = False,
    record: Record = True,
    as_json: AsJson = False,
) -> None:
    """Bring a crew up, carry out one request, bring it down. Never waits for a person."""
    from crew.cli.demo import run_demo

    planning = planning_of(planner, script, model, base_url, endpoint, context, no_fallback)
    options = _options(crew, map_, models, seed, speed, planning, fault, 0, runs, single_process, record)
    end(run_demo(options, request, as_json))


@app.command()
def skills(crew: CrewName = "air_ground", as_json: AsJson = False) -> None:
    """What each robot of a crew can do."""
    from crew.cli.contracts import run_skills

    end(run_skills(crew, as_json))


@app.command()
def checklist(crew: Annotated[str, typer.Argument(help="Crew, or the path of a crew file, with real robots.")]) -> None:
    """Ask each real robot what a person would check before it may move; moves nothing."""
    from crew.cli.checklist import run_checklist

    end(run_checklist(crew))


@app.command()
def doctor(
    crew: CrewName = "air_ground",
    authority: Annotated[bool, typer.Option("--authority", help="Who may do what, and try what is forbidden.")] = False,
    as_json: AsJson = False,
) -> None:
    """Look for what would keep a crew from running, and say what to do about it."""
    from crew.cli.doctor import run_doctor

    end(run_doctor(crew, authority, as_json))


@app.command()
def deploy(
    crew: CrewName = "air_ground",
    out: Annotated[Path, typer.Option(help="Folder to write to.")] = Path("deploy"),
) -> None:
    """Write the router's configuration and the systemd units of a deployment."""
    from crew.cli.deploy import run_deploy

    end(run_deploy(crew, out))


@app.command("run")
def run_one(
    role: Annotated[str, typer.Argument(help="router, orchestrator, planner, gateway, recorder or robot-NAME.")],
    crew: CrewName = "air_ground",
    router: Annotated[str, typer.Option(help="Where the router listens.")] = "tls/127.0.0.1:7448",
    guests: Annotated[str, typer.Option(help="Where the router takes guests in.")] = "tcp/127.0.0.1:7447",
    runs: Runs = Path("runs"),
    planner: Planner = "embedded",
) -> None:
    """Run one role of a crew of real robots by itself: for a service manager (crew deploy)."""
    from crew.actors.specs import PlannerChoice
    from crew.cli.alone import run_role
    from crew.launch.options import LaunchOptions

    end(run_role(role, LaunchOptions(crew=crew, runs=runs, planning=PlannerChoice(name=planner)), router, guests))


def _options(
    crew: str,
    map_: str | None,
    models: str,
    seed: int | None,
    speed: str,
    planning: "PlannerChoice",
    fault: list[str] | None,
    port: int,
    runs: Path,
    single_process: bool,
    record: bool,
) -> "LaunchOptions":
    from crew.launch.options import LaunchOptions, parse_speed

    return LaunchOptions(
        crew=crew,
        map=map_,
        models=str(Path(models).expanduser().absolute()) if models else "",
        seed=seed,
        faults=tuple(fault or ()),
        speed=parse_speed(speed),
        planning=planning,
        port=port,
        runs=runs,
        single_process=single_process,
        record=record,
    )
