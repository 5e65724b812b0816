"""Where a model is asked and what that endpoint wants: address, model, key, and the peculiarities of its server."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, Literal

import msgspec

from crew.actors.specs import ANTHROPIC_KEY, COMPATIBLE_KEY, PlannerChoice
from crew.errors import UsageError
from crew.library import read_text

ANTHROPIC_URL = "https://api.anthropic.com"
DEFAULT_MODEL = "claude-sonnet-5-5"


class Profile(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What an endpoint wants beside the Messages API's common part; a JSON file that a person writes."""

    max_tokens: int = 4096
    stream: bool = False
    """Ask for a stream of events; some servers time out otherwise."""
    force_tool: bool = True
    """Name the tool in `tool_choice`; some servers know `any` only."""
    cache: bool = True
    """Mark the standing text as cacheable."""
    prefill: str = ""
    """The beginning of the answer, put into the model's mouth; hosted models may reject it."""
    key_header: str = ""
    """A header that the key is sent in as well, such as `x-api-key`."""
    headers: Mapping[str, str] = {}
    extra_body: Mapping[str, Any] = {}


class Endpoint(msgspec.Struct, frozen=True, kw_only=True):
    """One endpoint. The key is not part of it: it is read from the environment and goes nowhere else."""

    name: Literal["anthropic", "compatible"]
    base_url: str
    model: str
    key_variable: str
    profile: Profile


def endpoint_of(choice: PlannerChoice) -> Endpoint:
    """The endpoint that a person chose. Raises UsageError for what is missing or contradictory."""
    profile = read_profile(Path(choice.profile)) if choice.profile else Profile()
    if choice.name == "anthropic":
        if choice.base_url:
            raise UsageError("--base-url goes with --planner compatible; --planner anthropic has an address of its own")
        return Endpoint(
            name="anthropic",
            base_url=ANTHROPIC_URL,
            model=choice.model or DEFAULT_MODEL,
            key_variable=ANTHROPIC_KEY,
            profile=profile,
        )
    if not choice.base_url.startswith(("http://", "https://")):
        raise UsageError(
            f"--planner compatible needs --base-url with the address of a Messages API, such as "
            f"http://127.0.0.1:8080; given: {choice.base_url or 'nothing'}"
        )
    return Endpoint(
        name="compatible",
        base_url=choice.base_url.rstrip("/"),
        model=choice.model or "default",
        key_variable=COMPATIBLE_KEY,
        profile=profile,
    )


def read_profile(path: Path) -> Profile:
    """A profile from a JSON file. Raises UsageError."""
    try:
        return msgspec.json.decode(read_text(path), type=Profile)
    except msgspec.MsgspecError as error:
        fields = ", ".join(Profile.__struct_fields__)
        raise UsageError(f"{path} is no endpoint's profile: {error} (fields: {fields})") from error
