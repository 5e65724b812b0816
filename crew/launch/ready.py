"""Ready is a round trip: the orchestrator answers with a state of every robot, heard through the real keys."""

from collections.abc import Callable, Sequence

from crew.bus.port import Bus
from crew.clock import WALL
from crew.errors import BusError, CrewError
from crew.keys import Keys
from crew.messages import CrewStatus
from crew.wire import decode

ASK_EVERY_S = 0.02
NOT_YET = ("connecting", "never heard of", "waiting for the orchestrator")
CONNECT_S = 8.0
"""After this long a robot that still has no vehicle is reported as it is; the crew is up without it."""


async def query_status(bus: Bus, keys: Keys, *, timeout_s: float) -> CrewStatus | None:
    """The orchestrator's answer, or None."""
    for reply in await bus.query(keys.status, (b"", "text/plain"), timeout_s=timeout_s):
        if reply.ok:
            return decode(CrewStatus, reply.payload, reply.encoding)
    return None


async def await_ready(
    bus: Bus, keys: Keys, robots: Sequence[str], *, timeout_s: float, died: Callable[[], str]
) -> CrewStatus:
    """The first status in which every robot is there, or says why it is not.

    Raises BusError after `timeout_s`, and CrewError at once when `died` names a process that is gone.
    """
    began_ns = WALL.now_ns()
    status: CrewStatus | None = None
    while (spent_s := (WALL.now_ns() - began_ns) / 1e9) < timeout_s:
        status = await query_status(bus, keys, timeout_s=1.0) or status
        if loss := died():
            raise CrewError(loss)
        if status is not None:
            known = {r.robot: r.unavailable for r in status.robots}
            waiting = [r for r in robots if known.get(r, NOT_YET[1]).startswith(NOT_YET)]
            if not waiting or (spent_s > CONNECT_S and all(known[r].startswith(NOT_YET[0]) for r in waiting)):
                return status
        await WALL.sleep(ASK_EVERY_S)
    heard = (
        "no answer" if status is None else ", ".join(f"{r.robot}: {r.unavailable or 'there'}" for r in status.robots)
    )
    raise BusError(f"the crew is not ready after {timeout_s:g} s: {heard}; see the logs in its run folder")
