"""A decision's inputs as one value that can be judged again: a whole plan, or one call. The gate gives the verdict."""

import msgspec

from crew.contracts.decision import Decision
from crew.contracts.gate.authorize import Gate
from crew.contracts.gate.workflow import step_for
from crew.contracts.language.containment import Finding, check_containment, check_reading
from crew.contracts.matching import match
from crew.contracts.mission.validation import Validation, validate
from crew.contracts.mission_state import MissionState, Purpose
from crew.contracts.plan import Call, Instance, Plan
from crew.contracts.site import Rules
from crew.contracts.snapshot import Snapshot


class PlanCase(msgspec.Struct, frozen=True, kw_only=True):
    """A plan before anything moves."""

    plan: Plan
    mission: MissionState
    world: Snapshot
    rules: Rules
    now_ns: int

    def judge(self) -> Validation:
        """The verdict, made by a gate of its own."""
        return validate(self.plan, self.mission, self.world, self.rules, self.now_ns, Gate())

    @property
    def instance(self) -> Instance | None:
        found = match(self.plan, self.rules)
        return found if isinstance(found, Instance) else None


class CallCase(msgspec.Struct, frozen=True, kw_only=True):
    """One call at the moment when it would be sent."""

    call: Call
    purpose: Purpose
    mission: MissionState
    world: Snapshot
    rules: Rules
    now_ns: int

    def judge(self) -> Decision:
        """The decision, made by a gate of its own."""
        return Gate().authorize(self.call, self.mission, self.world, self.rules, self.now_ns, self.purpose)

    @property
    def instance(self) -> Instance | None:
        return self.mission.instance

    @property
    def step(self) -> str:
        return step_for(self.call, self.mission, self.purpose)


Case = PlanCase | CallCase


def finding_of(case: Case) -> Finding | None:
    """What containment says of the case, with the place in the request that it speaks of."""
    mission, instance = case.mission, case.instance
    if instance is None or instance.contract not in case.rules.contracts:
        return check_reading(mission.reading)
    return check_containment(mission.reading, instance, case.rules, confirmed=mission.confirmed)
