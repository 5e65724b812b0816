"""What the shell makes of its own process having been frozen."""

from collections.abc import Callable
from typing import Any
from unittest.mock import Mock

import pytest
from msgspec.structs import replace

from crew.actors.orchestrator.lease import LeaseTable
from crew.actors.orchestrator.shell import MissionShell
from crew.actors.orchestrator.world import WorldFold
from crew.clock import SimClock
from crew.contracts.gate.authorize import Gate
from crew.contracts.mission_state import MissionState, Phase, StepPhase
from tests.unit.actors.stage import air_ground
from tests.unit.contracts import build as b


def shell_with(mission: MissionState) -> MissionShell:
    rules, nobody = air_ground(), Mock()
    spawn: Callable[..., Any] = nobody.spawn
    parts: Any = (LeaseTable(), nobody.ledger, Gate(), nobody.announcer, nobody.ask, spawn, nobody.end)
    shell = MissionShell(rules, SimClock(b.NOW_NS), WorldFold(rules), *parts)
    shell.dispatcher = nobody.dispatcher
    shell.missions[mission.id] = mission
    return shell


@pytest.mark.parametrize("phase", [StepPhase.RUNNING, StepPhase.CONFIRMING])
def test_a_step_under_way_or_looked_for_while_the_process_was_frozen_halts_its_mission(phase: StepPhase) -> None:
    mission = b.executing(b.SEND_TO_VICTIM, b.VICTIM_PLAN, air_ground(), confirmed=True)
    record = replace(mission.steps["dispatch"], phase=phase, sequence=1)
    mission = replace(mission, steps={"dispatch": record}, sequence=1)
    shell = shell_with(mission)
    shell.stood_still("it was frozen")
    after = shell.missions[mission.id]
    assert after.phase in (Phase.HALTING, Phase.HALTED)
    assert (after.steps["dispatch"].phase, after.steps["dispatch"].code) == (StepPhase.UNKNOWN, "orchestrator_lost")


def test_a_mission_that_waits_for_nothing_of_a_robot_goes_on() -> None:
    mission = b.executing(b.SEND_TO_VICTIM, b.VICTIM_PLAN, air_ground(), confirmed=True)
    shell = shell_with(mission)
    shell.stood_still("it was frozen")
    assert shell.missions[mission.id] == mission
