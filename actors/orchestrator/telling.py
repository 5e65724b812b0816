"""One mission in the crew's status: its phase, its steps, what it waits for."""

from collections.abc import Iterator

from crew.actors.orchestrator.lease import LeaseTable
from crew.contracts.mission.record import SAFE
from crew.contracts.mission_state import ENDS, MissionState, Phase, StepRecord
from crew.contracts.site import Rules
from crew.messages import MissionStatus, StepStatus


def mission_status(mission: MissionState, rules: Rules, leases: LeaseTable, now_ns: int) -> MissionStatus:
    """The mission as it is now. An ended one keeps its steps and no clock."""
    question = mission.question
    contract = rules.contracts.get(mission.contract)
    running = mission.started_ns >= 0 and mission.phase not in ENDS
    return MissionStatus(
        mission=mission.id,
        request=mission.request[:200],
        phase=mission.phase,
        contract=mission.contract,
        message=mission.message,
        question="" if question is None else question.text,
        token="" if question is None else question.token,
        step="" if question is None else question.step,
        steps=tuple(_steps(mission, now_ns)),
        waits_for=_holders(mission, leases),
        spent_s=round((now_ns - mission.started_ns) / 1e9, 2) if running else 0.0,
        deadline_s=0.0 if contract is None else contract.deadline_s,
    )


def _holders(mission: MissionState, leases: LeaseTable) -> tuple[str, ...]:
    if mission.phase is not Phase.WAITING or mission.instance is None:
        return ()
    return tuple(leases.holders(tuple(mission.instance.roles.values())))


def _steps(mission: MissionState, now_ns: int) -> Iterator[StepStatus]:
    for step in mission.instance.steps if mission.instance is not None else ():
        yield _step(step.step, mission.steps[step.step], step.after, now_ns)
    for role, record in mission.safe.items():
        yield _step(SAFE + role, record, (), now_ns)


def _step(name: str, record: StepRecord, after: tuple[str, ...], now_ns: int) -> StepStatus:
    return StepStatus(
        step=name,
        robot=record.call.robot,
        skill=record.call.skill,
        phase=record.phase,
        after=after,
        since_s=round((now_ns - record.dispatched_ns) / 1e9, 2) if record.sequence else None,
        code=record.code,
    )
