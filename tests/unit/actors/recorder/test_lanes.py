"""Which state a robot's lane shows when several things are true of it."""

from typing import Any

from crew.actors.recorder.entry import LaneChange
from crew.actors.recorder.lane import RobotLanes
from crew.contracts.language.mention import Reading
from crew.contracts.mission_state import MissionState, Phase, StepPhase, StepRecord
from crew.contracts.plan import Call, Instance, InstanceStep

GO = Call("tb3", "navigate_to", {"x": 1.0, "y": 2.0})


def mission(name: str, phase: Phase, step: StepPhase, **more: Any) -> MissionState:
    instance = Instance(
        contract="dispatch_only",
        roles={"responder": "tb3"},
        slots={},
        steps=(InstanceStep(step="go", role="responder", call=GO, after=()),),
    )
    steps = {"go": StepRecord(call=GO, phase=step)}
    return MissionState(
        id=name, request="go", reading=Reading(text="go"), phase=phase, instance=instance, steps=steps, **more
    )


def shown(changes: list[LaneChange]) -> list[str]:
    return [change.state for change in changes if change.lane == "robot/tb3"]


def test_a_mission_that_waits_for_a_lease_does_not_hide_what_the_robot_does() -> None:
    lanes = RobotLanes(["iris", "tb3"])
    assert shown(lanes.mission(mission("a", Phase.EXECUTING, StepPhase.RUNNING))) == ["navigate_to"]
    assert shown(lanes.mission(mission("b", Phase.WAITING, StepPhase.PENDING))) == []
    assert shown(lanes.mission(mission("a", Phase.COMPLETED, StepPhase.SUCCEEDED))) == ["waits for its lease"]
    assert shown(lanes.mission(mission("b", Phase.EXECUTING, StepPhase.PENDING))) == ["held at the gate"]


def test_a_refusal_stays_on_show_until_the_next_mission() -> None:
    lanes = RobotLanes(["tb3"])
    assert shown(lanes.mission(mission("a", Phase.HALTING, StepPhase.REFUSED))) == ["refused"]
    assert shown(lanes.mission(mission("a", Phase.HALTED, StepPhase.REFUSED))) == []
    assert shown(lanes.mission(mission("b", Phase.EXECUTING, StepPhase.RUNNING))) == ["navigate_to"]
    assert shown(lanes.mission(mission("b", Phase.COMPLETED, StepPhase.SUCCEEDED))) == [""]


def test_a_stop_and_a_lost_robot_outrank_every_mission() -> None:
    lanes = RobotLanes(["tb3"])
    lanes.mission(mission("a", Phase.EXECUTING, StepPhase.RUNNING))
    assert shown(lanes.itself("tb3", unavailable=False, stopped=True)) == ["stopped"]
    assert shown(lanes.itself("tb3", unavailable=True, stopped=True)) == ["not available"]
    assert shown(lanes.itself("tb3", unavailable=False, stopped=False)) == ["navigate_to"]
