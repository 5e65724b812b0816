"""The mission planner: try, prompt."""

from typing import Annotated

import typer

from crew.cli.option import AsJson, BaseUrl, Context, EndpointFile, Model, NoFallback, Planner, Script, end, planning_of

app = typer.Typer(help="The mission planner.", no_args_is_help=True, rich_markup_mode=None)


@app.command("try")
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

    planning = planning_of(planner, script, model, base_url, endpoint, context, no_fallback)
    end(run_try(text, crew, planning, tuple(state or ()), as_json))


@app.command("prompt")
def planner_prompt(
    text: Annotated[str, typer.Argument(help="The request; if left out, the crew file's own.")] = "",
    crew: Annotated[str, typer.Option("--crew", help="Crew to plan for.")] = "air_ground",
    context: Context = "contracts",
    as_json: AsJson = False,
) -> None:
    """Print exactly what a language model would be shown."""
    from crew.cli.planner import run_prompt

    end(run_prompt(text, crew, context, as_json))
