"""Who plans: what a person chose, checked before anything is started. Cheap to import."""

from collections.abc import Mapping
from pathlib import Path

import msgspec

from crew.actors.planner.endpoint import Endpoint, endpoint_of
from crew.actors.specs import PlannerChoice
from crew.contracts.plan import Plan
from crew.contracts.render.prompt import Context
from crew.errors import UsageError, nearest
from crew.library import read_text

PLANNERS = ("anthropic", "compatible", "embedded", "fallible", "recorded", "script")
MODELS = ("anthropic", "compatible")


def check_choice(choice: PlannerChoice, environment: Mapping[str, str]) -> None:
    """Raise UsageError for an unknown planner or context, contradictory options, a bad file or a missing key."""
    if choice.name not in PLANNERS:
        raise UsageError(f"no planner is called {choice.name!r}{nearest(choice.name, PLANNERS)}")
    if choice.context not in list(Context):
        raise UsageError(f"no context is called {choice.context!r}{nearest(choice.context, list(Context))}")
    if choice.name in ("script", "recorded") and not choice.script:
        raise UsageError(f"--planner {choice.name} needs --script with a JSON file of plans")
    if choice.name == "script":
        read_script(Path(choice.script))
    if choice.name == "recorded":
        read_recorded(Path(choice.script))
    if choice.name in MODELS:
        key_of(endpoint_of(choice), environment)
    elif choice.model or choice.base_url or choice.profile:
        raise UsageError(f"--model, --base-url and --endpoint go with a language model, not --planner {choice.name}")


def key_of(endpoint: Endpoint, environment: Mapping[str, str]) -> str:
    """The endpoint's key. Raises UsageError if a hosted one has none; a local server needs none."""
    key = environment.get(endpoint.key_variable, "")
    if not key and endpoint.name == "anthropic":
        raise UsageError(f"--planner anthropic needs a key in {endpoint.key_variable}; set it, or plan with embedded")
    return key or "none"


def read_script(path: Path) -> list[Plan]:
    """Plans from a JSON file. Raises UsageError."""
    try:
        return msgspec.json.decode(read_text(path), type=list[Plan])
    except msgspec.MsgspecError as error:
        raise UsageError(f"{path} is no list of plans: {error}") from error


def read_recorded(path: Path) -> dict[str, list[Plan]]:
    """Request to plans from a JSON file. Raises UsageError."""
    try:
        return msgspec.json.decode(read_text(path), type=dict[str, list[Plan]])
    except msgspec.MsgspecError as error:
        raise UsageError(f"{path} does not map requests to lists of plans: {error}") from error
