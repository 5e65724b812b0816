"""`crew confirm` and `crew approve`: a person's answer to a mission's question, signed with the operator's key."""

from msgspec.structs import replace

from crew.bus.port import Qos
from crew.cli.output import say
from crew.cli.session import home, operator, run
from crew.errors import UsageError, nearest
from crew.launch.ready import query_status
from crew.launch.table import OPERATOR
from crew.messages import ANSWER, Answer, CrewStatus, MissionStatus
from crew.signing import load_or_create_key


def signed_answer(crew: str, mission: str, token: str, *, yes: bool) -> Answer:
    """The answer of whoever owns the operator's key."""
    unsigned = Answer(token=token, yes=yes, by=OPERATOR)
    key = load_or_create_key(home().keys, OPERATOR)
    return replace(unsigned, signature=key.sign(ANSWER, unsigned.signed_part(crew, mission)))


def run_confirm(mission: str, yes: bool, crew: str) -> int:
    """0 once the answer is on its way to a mission that asks about its plan."""
    return run(_answer(mission, yes, crew, approves=False))


def run_approve(mission: str, yes: bool, crew: str) -> int:
    """0 once the answer is on its way to a mission with a step that waits for approval."""
    return run(_answer(mission, yes, crew, approves=True))


async def _answer(mission: str, yes: bool, crew: str, *, approves: bool) -> int:
    async with operator(crew) as (bus, keys, running):
        found = open_mission(await query_status(bus, keys, timeout_s=2.0), mission)
        if not found.token:
            raise UsageError(f"mission {mission} asks nothing; it is {found.phase} (crew status)")
        if bool(found.step) is not approves:
            what = f"approval of step {found.step}" if found.step else "what was not understood"
            right = "approve" if found.step else "confirm"
            raise UsageError(f"mission {mission} asks about {what}: crew {right} {mission}")
        answer = signed_answer(running.crew, found.mission, found.token, yes=yes)
        bus.put(keys.mission_confirm(found.mission), answer, qos=Qos.EVENT)
    word = "approved" if approves else "confirmed"
    say(f"{word if yes else 'declined'}: {found.question}")
    return 0


def open_mission(status: CrewStatus | None, mission: str) -> MissionStatus:
    """The mission of this name. Raises UsageError with the nearest one."""
    if status is None:
        raise UsageError("the orchestrator does not answer; see crew status")
    found = {m.mission: m for m in status.missions}
    if mission not in found:
        raise UsageError(f"no mission is called {mission!r}{nearest(mission, found)}")
    return found[mission]
