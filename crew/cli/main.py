"""The command line. Each command imports what it needs when it runs, so that `--help` stays quick."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from crew.actors.specs import PlannerChoice
    from crew.launch.options import LaunchOptions

app = typer.Typer(
    name="crew",
    help="Command a crew of robots in plain language. No language model ever moves one.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    context_settings={"help_option_names": ["-h", "--help"]},
)
contracts_app = typer.Typer(help="Workflow contracts.", no_args_is_help=True, rich_markup_mode=None)
planner_app = typer.Typer(help="The mission planner.", no_args_is_help=True, rich_markup_mode=None)
app.add_typer(contracts_app, name="contracts")
app.add_typer(planner_app, name="planner")
certs_app = typer.Typer(help="The crew's own certificates.", no_args_is_help=True, rich_markup_mode=None)
app.add_typer(certs_app, name="certs")

CrewName = Annotated[str, typer.Argument(metavar="[CREW]", help="A shipped crew's name, or the path of a crew file.")]
CrewOption = Annotated[str, typer.Option("--crew", help="The crew to speak to; may be left out if one runs.")]
AsJson = Annotated[bool, typer.Option("--json", help="Print JSON for machines.")]
Map = Annotated[str | None, typer.Option("--map", help="The simulated site's map.")]
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


@app.command()
def up(
    crew: CrewName = "air_ground",
    map_: Map = None,
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

    planning = _planning(planner, script, model, base_url, endpoint, context, no_fallback)
    _end(run_up(_options(crew, map_, seed, speed, planning, fault, port, runs, single_process, record), view))


@app.command()
def demo(
    crew: CrewName = "air_ground",
    map_: Map = None,
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

    planning = _planning(planner, script, model, base_url, endpoint, context, no_fallback)
    options = _options(crew, map_, seed, speed, planning, fault, 0, runs, single_process, record)
    _end(run_demo(options, request, as_json))


@app.command(name="eval")
def evaluate(
    words: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[CREW | ablate CREW | fuzz]",
            help="A crew's name or file: a study; after ablate: its plans held over arms; fuzz: the gate alone.",
        ),
    ] = None,
    arms: Annotated[str, typer.Option(help="all, or some of llm-only,skill-list,ro-prompt,ro.")] = "all",
    planner: Planner = "embedded",
    script: Script = "",
    model: Model = "",
    base_url: BaseUrl = "",
    endpoint: EndpointFile = "",
    seed: Annotated[int, typer.Option(help="First seed of the simulation's noise, and of the fallible planner.")] = 0,
    seeds: Annotated[int, typer.Option(help="How many seeds, counted up from --seed.")] = 1,
    out: Annotated[Path, typer.Option(help="Folder of the study; what it holds already is not run again.")] = Path(
        "runs/study"
    ),
    scenarios: Annotated[
        Path | None, typer.Option(help="Folder of scenario files; the shipped ones if left out.")
    ] = None,
    only: Annotated[list[str] | None, typer.Option(help="Only this scenario; may be given several times.")] = None,
    jobs: Annotated[int, typer.Option(help="Missions, or processes of the fuzz, side by side.")] = 2,
    plans: Annotated[int, typer.Option(help="How many plans the fuzz makes.")] = 100_000,
    mutant: Annotated[list[str] | None, typer.Option(help="A mutant that the fuzz must kill, or all.")] = None,
    as_json: AsJson = False,
) -> None:
    """Carry out a study in simulation: scenarios in four arms, live, judged by the simulation's truth."""
    from crew.cli.evaluate import ABLATE, FUZZ, EvalOptions, run_eval, run_fuzz, what_of

    what, crew = what_of(words or [])
    if what == FUZZ:
        _end(run_fuzz(seed, plans, mutant or (), jobs, out))
    options = EvalOptions(
        crew=crew,
        arms=arms,
        planning=_planning(planner, script, model, base_url, endpoint, "contracts", True),
        seed=seed,
        seeds=seeds,
        out=out,
        scenarios=scenarios,
        only=tuple(only or ()),
        jobs=jobs,
        held=what == ABLATE,
        as_json=as_json,
    )
    _end(run_eval(options))


@app.command()
def request(
    text: Annotated[str, typer.Argument(help="What the crew shall do, in plain words.")],
    crew: CrewOption = "",
    as_json: AsJson = False,
) -> None:
    """Ask a running crew for something, and follow it to its end."""
    from crew.cli.talk import run_request

    _end(run_request(text, crew, as_json))


@app.command()
def status(crew: CrewOption = "", as_json: AsJson = False) -> None:
    """What a running crew is doing, and who of it is alive."""
    from crew.cli.status import run_status

    _end(run_status(crew, as_json))


@app.command()
def watch(crew: CrewOption = "", as_json: AsJson = False) -> None:
    """Follow every mission of a running crew until Ctrl-C: a page on a terminal, else one line an event."""
    from crew.cli.watch import run_watch

    _end(run_watch(crew, as_json))


@app.command()
def cancel(
    mission: Annotated[str, typer.Argument(help="The mission's id (crew status).")], crew: CrewOption = ""
) -> None:
    """End a mission; its robots reach their safe states."""
    from crew.cli.talk import run_cancel

    _end(run_cancel(mission, crew))


@app.command()
def confirm(
    mission: Annotated[str, typer.Argument(help="The mission that asks (crew status).")],
    no: Annotated[bool, typer.Option("--no", help="Decline instead.")] = False,
    crew: CrewOption = "",
) -> None:
    """Answer a mission's question about what it did not understand."""
    from crew.cli.answering import run_confirm

    _end(run_confirm(mission, not no, crew))


@app.command()
def approve(
    mission: Annotated[str, typer.Argument(help="The mission whose step waits for approval (crew status).")],
    no: Annotated[bool, typer.Option("--no", help="Decline instead: the mission ends.")] = False,
    crew: CrewOption = "",
) -> None:
    """Approve the exact call that a mission waits with. Signed with the operator's key, good once, for 10 s."""
    from crew.cli.answering import run_approve

    _end(run_approve(mission, not no, crew))


@app.command()
def stop(
    crew: CrewOption = "",
    reason: Annotated[str, typer.Option(help="Why, for the journal.")] = "",
    as_json: AsJson = False,
) -> None:
    """Stop every robot now, and keep it stopped until a reset."""
    from crew.cli.stopping import run_stop

    _end(run_stop(crew, reason, as_json))


@app.command()
def reset(
    robot: Annotated[list[str] | None, typer.Argument(help="Robots to release; all of them if none is named.")] = None,
    crew: CrewOption = "",
) -> None:
    """Release stopped robots. Signed with the operator's key."""
    from crew.cli.stopping import run_reset

    _end(run_reset(tuple(robot or ()), crew))


@app.command()
def checklist(crew: Annotated[str, typer.Argument(help="Crew, or the path of a crew file, with real robots.")]) -> None:
    """Ask each real robot what a person would check before it may move; moves nothing."""
    from crew.cli.checklist import run_checklist

    _end(run_checklist(crew))


@app.command("runs")
def list_runs(runs: Runs = Path("runs"), as_json: AsJson = False) -> None:
    """List the runs that were recorded."""
    from crew.cli.runs import run_runs

    _end(run_runs(runs, as_json))


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

        _end(run_against(run, against, runs, key, as_json))
    from crew.cli.runs import run_verify

    _end(run_verify(run, runs, key, as_json))


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

    _end(run_replay(run, runs, web, port, rebuild))


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

    _end(run_report(run, runs, key, to))


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

    _end(run_explain(run, decision, runs, key, as_json))


@app.command()
def skills(crew: CrewName = "air_ground", as_json: AsJson = False) -> None:
    """What each robot of a crew can do."""
    from crew.cli.contracts import run_skills

    _end(run_skills(crew, as_json))


@contracts_app.command("show")
def contracts_show(
    name: Annotated[str, typer.Argument(help="A contract of the crew; all of them if left out.")] = "",
    crew: Annotated[str, typer.Option("--crew", help="Crew whose contracts are shown.")] = "air_ground",
    form: Annotated[str, typer.Option("--as", help="prose, mermaid or json.")] = "prose",
) -> None:
    """Show contracts as a planner reads them, as a diagram, or as data."""
    from crew.cli.contracts import run_show

    _end(run_show(name, crew, form))


@contracts_app.command("graph")
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

    _end(run_graph(name, crew, form, to))


@contracts_app.command("new")
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

    _end(run_new(name, crew, do, to, as_json))


@contracts_app.command("check")
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

        _end(run_watch(files or (), crew, as_json, limit))
    _end(run_check(files or (), crew, as_json, limit))


@contracts_app.command("coverage")
def contracts_coverage(
    runs: Annotated[list[Path], typer.Argument(metavar="RUNS...", help="Runs, or folders that hold runs.")],
    crew: Annotated[str, typer.Option("--crew", help="Count this crew's contracts too, used or not.")] = "",
    as_json: AsJson = False,
) -> None:
    """Which transitions, guards and codes recorded runs have exercised, and which none has."""
    from crew.cli.coverage import run_coverage

    _end(run_coverage(runs, crew, as_json))


@contracts_app.command("schema")
def contracts_schema() -> None:
    """Print the JSON Schema of a contract file, for editors."""
    from crew.cli.contracts import run_schema

    _end(run_schema())


@planner_app.command("try")
def planner_try(
    text: Annotated[str, typer.Argument(help="The request.")],
    crew: Annotated[str, typer.Option("--crew", help="Crew to plan for.")] = "air_ground",
    planner: Planner = "embedded",
    script: Script = "",
    model: Model = "",
    base_url: BaseUrl = "",
    endpoint: EndpointFile = "",
    context: Context = "contracts",
    no_fallback: NoFallback = False,
    state: Annotated[
        list[str] | None, typer.Option("--state", help="Assumed state, such as iris.airborne=true.")
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Plan a request and judge the plan, without any robot and without any network."""
    from crew.cli.planner import run_try

    planning = _planning(planner, script, model, base_url, endpoint, context, no_fallback)
    _end(run_try(text, crew, planning, tuple(state or ()), as_json))


@planner_app.command("prompt")
def planner_prompt(
    text: Annotated[str, typer.Argument(help="The request; if left out, the crew file's own.")] = "",
    crew: Annotated[str, typer.Option("--crew", help="Crew to plan for.")] = "air_ground",
    context: Context = "contracts",
    as_json: AsJson = False,
) -> None:
    """Print exactly what a language model would be shown."""
    from crew.cli.planner import run_prompt

    _end(run_prompt(text, crew, context, as_json))


Hosts = Annotated[
    list[str] | None, typer.Option("--host", help="A further name or address of the router's machine; may be repeated.")
]


@certs_app.command("init")
def certs_init(crew: CrewName = "air_ground", host: Hosts = None) -> None:
    """Make the crew's authority and certificates, as far as they are missing."""
    from crew.cli.certs import run_init

    _end(run_init(crew, tuple(host or ())))


@certs_app.command("show")
def certs_show(crew: CrewName = "air_ground", as_json: AsJson = False) -> None:
    """Show every certificate of a crew, and until when it is valid."""
    from crew.cli.certs import run_show

    _end(run_show(crew, as_json))


@certs_app.command("rotate")
def certs_rotate(crew: CrewName = "air_ground", host: Hosts = None) -> None:
    """Replace the authority and all certificates; the earlier ones are worthless from then on."""
    from crew.cli.certs import run_rotate

    _end(run_rotate(crew, tuple(host or ())))


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

    _end(run_role(role, LaunchOptions(crew=crew, runs=runs, planning=PlannerChoice(name=planner)), router, guests))


@app.command()
def deploy(
    crew: CrewName = "air_ground",
    out: Annotated[Path, typer.Option(help="Folder to write to.")] = Path("deploy"),
) -> None:
    """Write the router's configuration and the systemd units of a deployment."""
    from crew.cli.deploy import run_deploy

    _end(run_deploy(crew, out))


@app.command()
def doctor(
    crew: CrewName = "air_ground",
    authority: Annotated[bool, typer.Option("--authority", help="Who may do what, and try what is forbidden.")] = False,
    as_json: AsJson = False,
) -> None:
    """Look for what would keep a crew from running, and say what to do about it."""
    from crew.cli.doctor import run_doctor

    _end(run_doctor(crew, authority, as_json))


def _options(
    crew: str,
    map_: str | None,
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
        seed=seed,
        faults=tuple(fault or ()),
        speed=parse_speed(speed),
        planning=planning,
        port=port,
        runs=runs,
        single_process=single_process,
        record=record,
    )


def _planning(
    planner: str, script: str, model: str, base_url: str, endpoint: str, context: str, no_fallback: bool
) -> "PlannerChoice":
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


def _end(code: int) -> None:
    raise typer.Exit(code)


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
