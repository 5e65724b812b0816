"""Sends a few requests to the endpoint in CREW_PLANNER_URL and prints what came back and what the gate said of it.

Plumbing, not quality: it fails if no answer could be read as a plan, whatever the plans are worth.
"""

import asyncio
import os
import sys

from crew.actors.planner.backend import answer
from crew.actors.planner.process import make_backend
from crew.actors.specs import PlannerChoice
from crew.cli.planner import assumed
from crew.contracts.gate.authorize import Gate
from crew.contracts.language.lexicon import build_lexicon
from crew.contracts.language.reading import read_request
from crew.contracts.mission.validation import validate
from crew.contracts.mission_state import MissionState
from crew.errors import CrewError
from crew.library import load_rules
from crew.messages import PlannerAsk

REQUESTS = {
    "air_ground": ("search the area and send the rover to the victim", "send the rover to base", "land now"),
    "humanoid_quadruped": ("bring me the red cube", "put the bottle on table_b"),
}


async def smoke(url: str) -> int:
    """0 if some answer was a plan."""
    profile = os.environ.get("CREW_PLANNER_ENDPOINT", "")
    choice = PlannerChoice(name="compatible", base_url=url, profile=profile, fallback=False)
    readable = 0
    for crew, requests in REQUESTS.items():
        rules = load_rules(crew)
        backend = make_backend(choice, rules, os.environ)
        for text in requests:
            found = await answer(
                backend, PlannerAsk(mission="m", attempt=0, request=text, budget_s=180.0), "compatible"
            )
            readable += found.plan is not None
            verdict = found.reason
            if found.plan is not None:
                mission = MissionState(id="m", request=text, reading=read_request(text, build_lexicon(rules)))
                refusal = validate(found.plan, mission, assumed((), rules), rules, 1_000_000_000, Gate()).refusal
                verdict = "accepted" if refusal is None else str(refusal)
            print(f"{crew}: {text}\n  {found.plan}\n  {verdict}")
    print(f"{readable} of {sum(map(len, REQUESTS.values()))} answers were plans")
    return 0 if readable else 1


if __name__ == "__main__":
    address = os.environ.get("CREW_PLANNER_URL", "")
    if not address:
        sys.exit("set CREW_PLANNER_URL to the address of a Messages API, such as http://127.0.0.1:8080")
    try:
        sys.exit(asyncio.run(smoke(address)))
    except CrewError as error:
        sys.exit(str(error))
