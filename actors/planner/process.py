"""The planner's process: it hears questions and proposes plans. It holds no key that moves anything."""

import asyncio
import os
from collections.abc import Mapping
from pathlib import Path

from crew.actors.planner.backend import (
    Backend,
    EmbeddedBackend,
    FallbackBackend,
    RecordedBackend,
    ScriptBackend,
    answer,
    read_recorded,
    read_script,
)
from crew.actors.planner.endpoint import Endpoint, endpoint_of
from crew.actors.specs import PlannerChoice, PlannerSpec
from crew.bus.port import Bus, Qos
from crew.bus.zenoh import ZenohBus
from crew.contracts.render.prompt import Context
from crew.contracts.site import Rules
from crew.errors import UsageError, nearest
from crew.keys import Keys
from crew.mailbox import Events, Letter, letters
from crew.messages import PlannerAsk
from crew.packed import unpack
from crew.process import ChildContext, run_child

PLANNERS = ("anthropic", "compatible", "embedded", "recorded", "script")
MODELS = ("anthropic", "compatible")


def make_backend(choice: PlannerChoice, rules: Rules, environment: Mapping[str, str]) -> Backend:
    """The backend that was chosen. Raises UsageError for an unknown one, an unreadable file or a missing key."""
    check_choice(choice)
    match choice.name:
        case "embedded":
            return EmbeddedBackend(rules)
        case "script":
            return ScriptBackend(read_script(Path(choice.script)))
        case "recorded":
            return RecordedBackend(read_recorded(Path(choice.script)))
    endpoint = endpoint_of(choice)
    model = _model_backend(endpoint, key_of(endpoint, environment), rules, Context(choice.context))
    return FallbackBackend(model, EmbeddedBackend(rules)) if choice.fallback else model


def check_choice(choice: PlannerChoice) -> None:
    """Raise UsageError for an unknown planner or context, or options that contradict each other."""
    if choice.name not in PLANNERS:
        raise UsageError(f"no planner is called {choice.name!r}{nearest(choice.name, PLANNERS)}")
    if choice.context not in list(Context):
        raise UsageError(f"no context is called {choice.context!r}{nearest(choice.context, list(Context))}")
    if choice.name in ("script", "recorded") and not choice.script:
        raise UsageError(f"--planner {choice.name} needs --script with a JSON file of plans")
    if choice.name in MODELS:
        endpoint_of(choice)
    elif choice.model or choice.base_url or choice.profile:
        raise UsageError(f"--model, --base-url and --endpoint go with a language model, not --planner {choice.name}")


def key_of(endpoint: Endpoint, environment: Mapping[str, str]) -> str:
    """The endpoint's key. Raises UsageError if a hosted one has none; a local server needs none."""
    key = environment.get(endpoint.key_variable, "")
    if not key and endpoint.name == "anthropic":
        raise UsageError(f"--planner anthropic needs a key in {endpoint.key_variable}; set it, or plan with embedded")
    return key or "none"


def _model_backend(endpoint: Endpoint, key: str, rules: Rules, context: Context) -> Backend:
    from crew.actors.planner.model import ModelBackend

    try:
        from crew.actors.planner.messages_api import MessagesClient

        client = MessagesClient(endpoint, key)
    except ImportError as error:
        raise UsageError(f"--planner {endpoint.name} can't be imported: {error}; install robot-crew[llm]") from error
    return ModelBackend(endpoint, client, rules, context)


async def main(context: ChildContext) -> None:
    """Serve until asked to stop."""
    spec = context.spec(PlannerSpec)
    rules = unpack(spec.rules)
    backend = make_backend(spec.choice, rules, os.environ)
    async with ZenohBus(spec.link) as bus:
        await serve(rules, backend, spec.choice.name, bus, context)


async def serve(rules: Rules, backend: Backend, name: str, bus: Bus, context: ChildContext) -> None:
    """Answer questions, several at a time, on a bus that is already there."""
    keys = Keys(rules.crew.name)
    asks: Events[Letter[PlannerAsk]] = Events(letters(PlannerAsk), capacity=64, on_lost=lambda _: None)
    bus.subscribe(keys.planner_ask, asks)
    token = bus.token(keys.alive("planner"))
    context.ready()

    async def reply(ask: PlannerAsk) -> None:
        bus.put(keys.planner_proposal, await answer(backend, ask, name), qos=Qos.EVENT)

    try:
        async with asyncio.TaskGroup() as group:
            async for letter in asks:
                group.create_task(reply(letter.message))
    finally:
        token.close()


if __name__ == "__main__":
    run_child(main)
