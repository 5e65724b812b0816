"""The gate's third group of checks: is this call the next authorised transition of the mission's workflow?"""

from crew.contracts.codes import Code
from crew.contracts.mission_state import CONSUMED, MissionState, Phase, Purpose, StepPhase, enabled
from crew.contracts.plan import Call
from crew.contracts.refusal import Refusal
from crew.contracts.site import Rules


def step_for(call: Call, mission: MissionState, purpose: Purpose) -> str:
    """The step that a call would fill: an enabled one first, then any with the same call."""
    if mission.instance is None:
        return ""
    if purpose is Purpose.SAFE:
        role = next((role for role, robot in mission.instance.roles.items() if robot == call.robot), "")
        return f"safe:{role}" if role else ""
    same = [s.step for s in mission.instance.steps if s.call == call]
    if len(same) < 2:
        return same[0] if same else ""
    ready = {name for name in same if mission.steps[name].phase is StepPhase.DECIDING} | set(enabled(mission))
    return next((name for name in same if name in ready), same[0])


def check_workflow(call: Call, step: str, mission: MissionState, rules: Rules, purpose: Purpose) -> Refusal | None:
    if mission.instance is None:
        return Refusal(code=Code.MALFORMED_PLAN, message="the mission has no validated plan", field="plan")
    contract = rules.contracts.get(mission.instance.contract)
    if contract is None:
        message = f"the crew has no contract {mission.instance.contract!r}"
        return Refusal(code=Code.UNKNOWN_CONTRACT, message=message, field="contract")
    if purpose is Purpose.SAFE:
        role = contract.role(step.removeprefix("safe:"))
        if role is None or role.safe is None or role.safe.by != call.skill or call.args:
            message = f"{call} is no declared safe state of {contract.name}"
            return Refusal(code=Code.NOT_IN_PLAN, message=message, field="skill", observed=str(call))
        return None
    if mission.phase is not Phase.EXECUTING:
        message = f"the mission is {mission.phase}; its steps are sent only while it is executing"
        return Refusal(
            code=Code.OUT_OF_ORDER, message=message, field="mission", observed=str(mission.phase), allowed="executing"
        )
    if not step:
        message = f"{call} is no step of the validated plan"
        allowed = ", ".join(str(s.call) for s in mission.instance.steps)
        return Refusal(code=Code.NOT_IN_PLAN, message=message, field="call", observed=str(call), allowed=allowed)
    return _check_transition(step, mission)


def _check_transition(step: str, mission: MissionState) -> Refusal | None:
    assert mission.instance is not None
    record = mission.steps[step]
    if record.phase in CONSUMED:
        message = f"step {step} was authorised before ({record.phase}); a step is never sent twice"
        return Refusal(code=Code.ALREADY_CONSUMED, message=message, field=step, observed=str(record.phase))
    declared = mission.instance.step(step)
    assert declared is not None
    waiting = [name for name in declared.after if mission.steps[name].phase is not StepPhase.SUCCEEDED]
    if waiting:
        phases = ", ".join(f"{name} is {mission.steps[name].phase}" for name in waiting)
        message = f"step {step} comes after {', '.join(waiting)}: {phases}"
        return Refusal(code=Code.OUT_OF_ORDER, message=message, field=step, observed=phases, allowed="succeeded")
    return None
