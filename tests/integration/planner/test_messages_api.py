"""A real client against a real socket: whatever an endpoint does, a mission gets a plan or a reason, in its time."""

import math
import time
from typing import Any

import pytest

from crew.actors.planner.backend import (
    EmbeddedBackend,
    FallbackBackend,
    PlannerUnavailable,
    PlanUnreadable,
    answer,
)
from crew.actors.planner.endpoint import Endpoint, Profile
from crew.actors.planner.messages_api import MessagesClient
from crew.actors.planner.model import ModelBackend
from crew.contracts.codes import Code
from crew.contracts.plan import Call, Plan
from crew.contracts.refusal import Refusal
from crew.contracts.render.prompt import Context
from crew.contracts.site import Rules
from crew.library import load_rules
from crew.messages import PlannerAsk, PlannerProposal
from tests.integration.planner.endpoint import (
    DRIVE,
    SEARCH_AND_DISPATCH,
    Reply,
    ScriptedApi,
    failure,
    message,
    plan,
    scripted,
    streamed,
    tool_use,
)

KEY = "sk-test-0123456789"
REQUEST = "send the rover to (-3, -3)"


@pytest.fixture(scope="module")
def rules() -> Rules:
    return load_rules("air_ground")


def backend(api: ScriptedApi, rules: Rules, context: Context = Context.CONTRACTS, **profile: Any) -> ModelBackend:
    endpoint = Endpoint(
        name="compatible", base_url=api.url, model="m", key_variable="CREW_PLANNER_KEY", profile=Profile(**profile)
    )
    return ModelBackend(endpoint, MessagesClient(endpoint, KEY), rules, context)


def ask(budget_s: float = 20.0, **more: Any) -> PlannerAsk:
    return PlannerAsk(mission="m1", attempt=0, request=REQUEST, budget_s=budget_s, **more)


async def proposed(rules: Rules, *replies: Reply, budget_s: float = 20.0, **profile: Any) -> PlannerProposal:
    async with scripted(*replies) as api:
        return await backend(api, rules, **profile).propose(ask(budget_s))


async def test_a_tool_call_becomes_a_plan_with_its_origin(rules: Rules) -> None:
    async with scripted(Reply(message(tool_use(DRIVE)))) as api:
        found = await backend(api, rules).propose(ask())
    assert found.plan == Plan("dispatch_only", (Call("tb3", "navigate_to", {"x": -3.0, "y": -3.0}),))
    origin = found.origin
    assert origin is not None
    assert (origin.model, origin.context, origin.tries) == ("m", "contracts", 1)
    assert (origin.input_tokens, origin.cached_tokens, origin.output_tokens) == (1200, 1000, 150)
    assert all(len(d) == 64 for d in (origin.prompt_digest, origin.schema_digest, origin.registry_digest))


async def test_the_question_forces_one_call_caches_the_standing_text_and_ends_with_the_request(rules: Rules) -> None:
    async with scripted(Reply(message(tool_use(DRIVE)))) as api:
        await backend(api, rules, key_header="x-api-key", extra_body={"temperature": 0.1}).propose(ask())
    (asked,) = api.asked
    body = asked.body
    assert asked.path == "/v1/messages"
    assert asked.headers["x-api-key"] == KEY
    assert body["tool_choice"] == {"type": "tool", "name": "submit_plan", "disable_parallel_tool_use": True}
    assert [t["name"] for t in body["tools"]] == ["submit_plan"]
    assert body["system"][0]["cache_control"] == {"type": "ephemeral"}
    assert body["messages"][-1]["content"].endswith(f'"{REQUEST}"')
    assert body["temperature"] == 0.1
    assert KEY not in str(body)


async def test_a_stream_of_pieces_becomes_the_same_plan(rules: Rules) -> None:
    whole = await proposed(rules, Reply(message(tool_use(SEARCH_AND_DISPATCH))))
    pieces = await proposed(rules, streamed(SEARCH_AND_DISPATCH), stream=True)
    assert pieces.plan == whole.plan
    assert pieces.plan is not None


async def test_a_refused_plan_goes_back_with_its_code_and_what_is_allowed(rules: Rules) -> None:
    refused = Plan("dispatch_only", (Call("tb3", "navigate_to", {"target": "depot"}),))
    why = Refusal(code=Code.UNKNOWN_LOCATION, message="no depot", field="steps[0].args.target", allowed="victim, base")
    async with scripted(Reply(message(tool_use(DRIVE)))) as api:
        await backend(api, rules).propose(ask(previous=refused, feedback=why))
    first, second, third = api.asked[0].body["messages"]
    assert first["role"] == "user"
    assert second["content"][0]["input"]["steps"][0]["args"] == [{"name": "target", "value": "depot"}]
    told = third["content"][0]
    assert told["tool_use_id"] == second["content"][0]["id"]
    assert told["is_error"]
    assert "unknown_location" in told["content"]
    assert "victim, base" in told["content"]


LATER = [
    Reply(failure("rate_limit_error", "slow down"), status=429, headers={"retry-after": "0"}),
    Reply(failure("overloaded_error", "overloaded"), status=529),
    Reply(failure("api_error", "oops"), status=500),
    Reply(failure("api_error", "busy"), status=503),
    Reply(drop=True),
]


@pytest.mark.parametrize("first", LATER, ids=["429", "529", "500", "503", "dropped"])
async def test_what_may_pass_is_tried_again_within_the_budget(first: Reply, rules: Rules) -> None:
    found = await proposed(rules, first, Reply(message(tool_use(DRIVE))))
    assert found.plan is not None
    assert found.origin is not None
    assert found.origin.tries == 2


async def test_a_wait_longer_than_the_budget_is_not_waited_for(rules: Rules) -> None:
    began = time.monotonic()
    busy = Reply(failure("rate_limit_error", "slow down"), status=429, headers={"retry-after": "120"})
    with pytest.raises(PlannerUnavailable, match="too many requests"):
        await proposed(rules, busy)
    assert time.monotonic() - began < 15.0, "of a budget of 20 s, and of the two minutes asked for"


async def test_an_endpoint_that_keeps_silent_costs_no_more_than_the_budget(rules: Rules) -> None:
    with pytest.raises(PlannerUnavailable):
        await proposed(rules, Reply(message(tool_use(DRIVE)), delay_s=30.0), budget_s=1.5)


FINAL = [
    (Reply(failure("authentication_error", "invalid key"), status=401), "refuses the key.*CREW_PLANNER_KEY"),
    (Reply(failure("not_found_error", "model: m"), status=404), "no such address or model"),
    (Reply(failure("invalid_request_error", "prefill"), status=400), "refuses the question.*prefill"),
    (Reply(b"<html>hello</html>", content_type="text/html"), "Messages API"),
    (Reply(b'{"type": "message"'), "Messages API"),
    (Reply(b"[1, 2, 3]"), "Messages API"),
    (Reply(b'{"hello": "world"}'), "Messages API"),
]


@pytest.mark.parametrize(("reply", "said"), FINAL, ids=["key", "model", "bad", "html", "cut", "list", "other"])
async def test_what_will_not_pass_is_said_at_once(reply: Reply, said: str, rules: Rules) -> None:
    async with scripted(reply) as api:
        with pytest.raises(PlannerUnavailable, match=said) as caught:
            await backend(api, rules).propose(ask())
    assert len(api.asked) == 1
    assert KEY not in str(caught.value)
    assert "\n" not in str(caught.value)


DRIVE_STEP = {"robot": "tb3", "skill": "navigate_to", "args": []}
TWICE = plan("dispatch_only", ("tb3", "navigate_to", {"x": 1}))
TWICE["steps"][0]["args"] *= 2
UNREADABLE = {
    "cut": message(tool_use(DRIVE), stop_reason="max_tokens"),
    "refused": message({"type": "text", "text": "I will not."}, stop_reason="refusal"),
    "two calls": message(tool_use(DRIVE), tool_use(DRIVE, number=2)),
    "prose": message({"type": "text", "text": "The rover could drive. " * 20_000}, stop_reason="end_turn"),
    "nothing": message(stop_reason="end_turn"),
    "another tool": message(tool_use({}, name="run_shell")),
    "empty": message(tool_use({})),
    "a list": message(tool_use([1, 2])),
    "steps as text": message(tool_use({"contract": "dispatch_only", "steps": "tb3.navigate_to"})),
    "args as object": message(tool_use({"contract": "c", "steps": [{**DRIVE_STEP, "args": {"x": 1}}]})),
    "a truth value": message(tool_use(plan("c", ("tb3", "navigate_to", {"x": True})))),
    "null": message(tool_use(plan("c", ("tb3", "navigate_to", {"x": None})))),
    "more than asked": message(tool_use({**DRIVE, "code": "import os"})),
    "twice": message(tool_use(TWICE)),
    "500 steps": message(tool_use({"contract": "c", "steps": [DRIVE_STEP] * 500})),
    "200 kB": message(tool_use(plan("x" * 200_000))),
}


@pytest.mark.parametrize("name", UNREADABLE)
async def test_an_answer_without_exactly_one_plan_is_unreadable(name: str, rules: Rules) -> None:
    with pytest.raises(PlanUnreadable) as caught:
        await proposed(rules, Reply(UNREADABLE[name]))
    assert len(str(caught.value)) < 400


@pytest.mark.parametrize("value", ["NaN", "1e309", "-1e309"])
async def test_figures_beyond_all_bounds_reach_the_gate_as_they_are(value: str, rules: Rules) -> None:
    text = '{"contract": "c", "steps": [{"robot": "r", "skill": "s", "args": [{"name": "x", "value": VALUE}]}]}'
    import json

    body = json.dumps(message(tool_use("HERE"))).replace('"HERE"', text.replace("VALUE", value)).encode()
    found = await proposed(rules, Reply(body))
    assert found.plan is not None
    figure = found.plan.steps[0].args["x"]
    assert isinstance(figure, float)
    assert not math.isfinite(figure)


async def test_a_stand_in_says_that_it_is_one(rules: Rules) -> None:
    async with scripted(Reply(failure("authentication_error", "no"), status=401)) as api:
        found = await FallbackBackend(backend(api, rules), EmbeddedBackend(rules)).propose(ask())
    assert found.planner == "embedded"
    assert "refuses the key" in found.remark
    assert found.plan is not None


async def test_nobody_stands_in_for_an_unreadable_plan(rules: Rules) -> None:
    async with scripted(Reply(UNREADABLE["prose"])) as api:
        found = await answer(FallbackBackend(backend(api, rules), EmbeddedBackend(rules)), ask(), "compatible")
    assert (found.plan, found.unreadable) == (None, True)


async def test_an_address_where_nobody_listens_is_named(rules: Rules) -> None:
    endpoint = Endpoint(
        name="compatible", base_url="http://127.0.0.1:9", model="m", key_variable="K", profile=Profile()
    )
    model = ModelBackend(endpoint, MessagesClient(endpoint, KEY), rules, Context.NONE)
    with pytest.raises(PlannerUnavailable, match=r"127\.0\.0\.1:9.*can't be reached"):
        await model.propose(ask(budget_s=3.0))
