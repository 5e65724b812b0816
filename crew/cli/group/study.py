"""A study in simulation: eval."""

from pathlib import Path
from typing import Annotated

import typer

from crew.cli.option import AsJson, BaseUrl, EndpointFile, Model, Planner, Script, end, planning_of

app = typer.Typer()


@app.command(name="eval")
def evaluate(
    words: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[CREW | ablate CREW | substitution CREW | figures CREW | fuzz]",
            help="A crew's name or file: a study; after ablate: its plans held over arms. Without robots: "
            "substitution of names that do not exist, figures of --out made anew, fuzz of the gate.",
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
        "runs/eval"
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
    from crew.cli.evaluate import ABLATE, EvalOptions, run_eval, what_of

    what, crew = what_of(words or [])
    planning = planning_of(planner, script, model, base_url, endpoint, "contracts", True)
    if what not in ("", ABLATE):
        from crew.cli.study import OfflineOptions, run_offline

        offline = OfflineOptions(
            what=what,
            crew=crew,
            planning=planning,
            seed=seed,
            seeds=seeds,
            out=out,
            scenarios=scenarios,
            jobs=jobs,
            plans=plans,
            mutants=tuple(mutant or ()),
            as_json=as_json,
        )
        end(run_offline(offline))
    options = EvalOptions(
        crew=crew,
        arms=arms,
        planning=planning,
        seed=seed,
        seeds=seeds,
        out=out,
        scenarios=scenarios,
        only=tuple(only or ()),
        jobs=jobs,
        held=what == ABLATE,
        as_json=as_json,
    )
    end(run_eval(options))
