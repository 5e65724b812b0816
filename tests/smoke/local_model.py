"""Sends a few requests to the endpoint in CREW_PLANNER_URL and prints what came back and what the gate said of it.

Plumbing, not quality: it fails if no answer could be read as a plan, whatever the plans are worth.
"""

import asyncio
import os
import sys
from collections.abc import Mapping
from urllib.parse import urlsplit

from crew.actors.planner.backend import answer
from crew.actors.planner.process import make_backend
from crew.actors.specs import PlannerChoice
from crew.cli.planner import assumed
from crew.contracts.gate.authorize import Gate
from crew.contracts.language.lexicon import build_lexicon
from crew.contracts.language.reading import read_request
from crew.contracts.mission.validation import validate
from crew.contracts.mission_state import MissionState
from crew.errors import CrewError, UsageError
from crew.library import load_rules
from crew.messages import PlannerAsk

NEXT = "start one (docs/planner.md, A local model), or set CREW_PLANNER_URL to where it listens"
ANSWERS_S = 5.0
"""How long the endpoint may take to accept a connection, seconds."""
STATE = {"air_ground": (), "humanoid_quadruped": ("requester.near=true",)}
REQUESTS = {
    "air_ground": ("search the area and send the rover to the victim", "send the rover to base", "land now"),
    "humanoid_quadruped": ("bring me the red cube", "put the bottle on table_b"),
}


async def reach(url: str) -> None:
    """Raises UsageError where nothing listens at an address."""
    try:
        where = urlsplit(url)
        host, port = where.hostname, where.port or (443 if where.scheme == "https" else 80)
        async with asyncio.timeout(ANSWERS_S):
            _, writer = await asyncio.open_connection(host, port)
    except (OSError, ValueError) as error:
        why = str(error) or f"no connection within {ANSWERS_S:g} s"
        raise UsageError(f"no Messages API at CREW_PLANNER_URL={url}: {why}; {NEXT}") from error
    writer.close()


async def smoke(url: str, environ: Mapping[str, str]) -> int:
    """0 if some answer was a plan, 1 if none was. Raises UsageError for an address or a file that cannot be used."""
    profile = environ.get("CREW_PLANNER_ENDPOINT", "")
    choice = PlannerChoice(name="compatible", base_url=url, profile=profile, fallback=False)
    readable = 0
    for crew, requests in REQUESTS.items():
        rules = load_rules(crew)
        backend = make_backend(choice, rules, environ)
        for text in requests:
            found = await answer(
                backend, PlannerAsk(mission="m", attempt=0, request=text, budget_s=180.0), "compatible"
            )
            readable += found.plan is not None
            verdict = found.reason
            if found.plan is not None:
                mission = MissionState(id="m", request=text, reading=read_request(text, build_lexicon(rules)))
                refusal = validate(
                    found.plan, mission, assumed(STATE[crew], rules), rules, 1_000_000_000, Gate()
                ).refusal
                verdict = "accepted" if refusal is None else str(refusal)
            print(f"{crew}: {text}\n  {found.plan}\n  {verdict}")
    print(f"{readable} of {sum(map(len, REQUESTS.values()))} answers were plans")
    return 0 if readable else 1


def main(environ: Mapping[str, str]) -> int:
    """The exit code: 0 some answer was a plan, 1 none was, 2 nothing to ask."""
    address = environ.get("CREW_PLANNER_URL", "")
    try:
        if not address:
            raise UsageError(f"CREW_PLANNER_URL is not set: no Messages API to ask; {NEXT}, http://127.0.0.1:8080 say")
        return asyncio.run(_reached(address, environ))
    except CrewError as error:
        print(error, file=sys.stderr)
        return 2


async def _reached(address: str, environ: Mapping[str, str]) -> int:
    await reach(address)
    return await smoke(address, environ)


if __name__ == "__main__":
    sys.exit(main(os.environ))
