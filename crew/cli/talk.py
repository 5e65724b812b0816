"""`crew request`, `watch`, `cancel`: speaking with a running crew."""

from crew.bus.port import Qos
from crew.cli.answering import open_mission
from crew.cli.follow import ask_person, follow_request
from crew.cli.output import say, say_event, say_json
from crew.cli.session import EXIT_CODES, operator, run
from crew.errors import UsageError
from crew.launch.ready import query_status
from crew.messages import CancelMission, MissionEvent

UNREADABLE = "unreadable_request"


def run_request(text: str, crew: str, as_json: bool) -> int:
    """Exit code by the outcome."""
    return run(_request(text, crew, as_json))


async def _request(text: str, crew: str, as_json: bool) -> int:
    def listen(event: MissionEvent) -> None:
        if as_json:
            say_json(event)
        else:
            say_event(event)

    async with operator(crew) as (bus, keys, _):
        last = await follow_request(bus, keys, text, listen, answer=lambda e: None if as_json else ask_person(e))
    if last.what == "question":
        if not as_json:
            command = "approve" if last.step else "confirm"
            say(f"answer it with: crew {command} {last.mission}, or crew {command} {last.mission} --no")
        return EXIT_CODES["rejected"]
    if last.code == UNREADABLE:
        return UsageError.exit_code
    return EXIT_CODES[last.outcome or "rejected"]


def run_cancel(mission: str, crew: str) -> int:
    """0 once the cancel is on its way to a mission that is open."""
    return run(_cancel(mission, crew))


async def _cancel(mission: str, crew: str) -> int:
    async with operator(crew) as (bus, keys, _):
        found = open_mission(await query_status(bus, keys, timeout_s=2.0), mission)
        bus.put(keys.mission_cancel(found.mission), CancelMission(by="operator"), qos=Qos.EVENT)
    say(f"asked {found.mission} to end; its robots reach their safe states (crew status)")
    return 0
