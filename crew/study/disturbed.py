"""Missions that a slow machine has ended: somebody was not heard within a limit of wall time, and nobody was made so.

Such a mission says nothing of planner or gate, whichever arm it is in, and is carried out again.
"""

import re

from crew.study.observation import Observation
from crew.study.scenario import Scenario

LOST = frozenset({"orchestrator_lost", "robot_lost", "bus_lost", "no_answer"})
"""Codes of a dispatch that ended since somebody was not heard."""
UNHEARD = re.compile(
    r"frozen: no state|never heard of|bus (?:is )?lost|its process or its link|orchestrator lost|waiting for the orch"
)
"""What a refusal says of a robot that was not heard, or that has not heard the orchestrator."""
LINKS = ("link_loss",)
"""Faults that cut somebody off on purpose."""


def disturbance(seen: Observation, scenario: Scenario, dropped: int) -> str:
    """What was not heard in time, in a few words; empty if nothing was, or if the scenario is about that.

    `dropped`: how often somebody has left the lockstep, so that mission time went on without them.
    """
    if any(fault.partition("@")[0] in LINKS for fault in scenario.faults):
        return ""
    if dropped:
        return f"mission time went on {dropped} times without somebody who was silent"
    for dispatch in seen.dispatches:
        if dispatch.code in LOST:
            return f"{dispatch.robot}.{dispatch.skill} ended with {dispatch.code}"
    for refusal in seen.refusals:
        if refusal.code == "robot_unavailable" and UNHEARD.search(refusal.message):
            return refusal.message
    return f"no outcome: {seen.message}" if seen.outcome == "error" else ""
