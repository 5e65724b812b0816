"""The smoke test's own script: to its end against a scripted endpoint, and a clear word where there is none."""

import pytest

from tests.integration.planner.endpoint import DRIVE, SEARCH_AND_DISPATCH, Reply, message, plan, scripted, tool_use
from tests.smoke.local_model import REQUESTS, main, smoke

CUBE = plan("handover", ("g1", "pick_handover", {"object": "red_cube"}))
WORDS = Reply(message({"type": "text", "text": "I would rather not."}, stop_reason="end_turn"))


async def test_the_script_runs_to_its_end(capsys: pytest.CaptureFixture[str]) -> None:
    plans = [Reply(message(tool_use(one))) for one in (SEARCH_AND_DISPATCH, DRIVE)]
    async with scripted(*plans, WORDS, Reply(message(tool_use(CUBE)))) as api:
        code = await smoke(api.url, {})
    said = capsys.readouterr().out
    assert code == 0
    assert len(api.asked) == sum(map(len, REQUESTS.values()))
    assert said.count("  accepted") == 2
    assert "not_requested: the plan's destination is (-3, -3); the request names base" in said
    assert "no plan, but words" in said
    assert said.endswith("4 of 5 answers were plans\n")


async def test_an_endpoint_that_only_talks_fails(capsys: pytest.CaptureFixture[str]) -> None:
    async with scripted(WORDS) as api:
        assert await smoke(api.url, {}) == 1
    assert capsys.readouterr().out.endswith("0 of 5 answers were plans\n")


@pytest.mark.parametrize(
    ("environ", "said"),
    [
        ({}, "CREW_PLANNER_URL is not set"),
        ({"CREW_PLANNER_URL": "http://127.0.0.1:1"}, "no Messages API at CREW_PLANNER_URL=http://127.0.0.1:1"),
        ({"CREW_PLANNER_URL": "nonsense"}, "CREW_PLANNER_URL=nonsense"),
    ],
)
def test_without_an_endpoint_it_says_what_to_set(
    environ: dict[str, str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(environ) == 2
    told = capsys.readouterr().err
    assert said in told
    assert "docs/planner.md" in told
