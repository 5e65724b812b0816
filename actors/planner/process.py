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
)
from crew.actors.planner.choice import check_choice, key_of, read_recorded, read_script
from crew.actors.planner.endpoint import Endpoint, endpoint_of
from crew.actors.specs import PlannerChoice, PlannerSpec
from crew.bus.port import Bus, Qos
from crew.bus.zenoh import ZenohBus
from crew.contracts.render.prompt import Context
from crew.contracts.site import Rules
from crew.errors import UsageError
from crew.keys import Keys
from crew.mailbox import Events, Letter, letters
from crew.messages import PlannerAsk
from crew.packed import unpack
from crew.process import ChildContext, run_child


def make_backend(choice: PlannerChoice, rules: Rules, environment: Mapping[str, str]) -> Backend:
    """The backend that was chosen. Raises UsageError for an unknown one, an unreadable file or a missing key."""
    check_choice(choice, environment)
    match choice.name:
        case "embedded":
            return EmbeddedBackend(rules)
        case "fallible":
            return _fallible_backend(rules, Context(choice.context))
        case "script":
            return ScriptBackend(read_script(Path(choice.script)))
        case "recorded":
            return RecordedBackend(read_recorded(Path(choice.script)))
    endpoint = endpoint_of(choice)
    model = _model_backend(endpoint, key_of(endpoint, environment), rules, Context(choice.context))
    return FallbackBackend(model, EmbeddedBackend(rules)) if choice.fallback else model


def _fallible_backend(rules: Rules, context: Context) -> Backend:
    from crew.actors.planner.fallible import FallibleBackend

    if rules.crew.sim is None:
        raise UsageError("--planner fallible errs on purpose; it plans for simulated robots only")
    return FallibleBackend(rules, context, rules.crew.sim.seed)


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
