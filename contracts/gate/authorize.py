"""The gate: one pure function that every dispatch passes at the moment it happens. It performs nothing.

Checks run in the order of the codes: capability, arguments, workflow, containment, state, run-time values.
"""

from collections.abc import Mapping

from crew.contracts.codes import Code
from crew.contracts.decision import Decision
from crew.contracts.gate.approval import subject_of, wants_approval
from crew.contracts.gate.arguments import check_call
from crew.contracts.gate.state import check_state
from crew.contracts.gate.value import check_values
from crew.contracts.gate.workflow import check_workflow, step_for
from crew.contracts.language.containment import Finding, check_containment
from crew.contracts.language.mention import Reading
from crew.contracts.mission_state import MissionState, Purpose
from crew.contracts.plan import Call, Instance
from crew.contracts.refusal import Refusal
from crew.contracts.site import Rules
from crew.contracts.snapshot import Point, Snapshot


class Gate:
    """The enforcing authorizer. Containment findings are remembered by identity: request, instance, rules never change.

    What it remembers it also holds on to, so that an identity is never another object's.
    """

    enforces = True

    def __init__(self) -> None:
        self._findings: dict[tuple[int, int, int, bool], tuple[Reading, Instance, Rules, Finding | None]] = {}

    def authorize(
        self, call: Call, mission: MissionState, world: Snapshot, rules: Rules, now_ns: int, purpose: Purpose
    ) -> Decision:
        """Judge one call against everything that is known now."""
        step = step_for(call, mission, purpose)
        refusal = (
            check_call(call, rules)
            or check_workflow(call, step, mission, rules, purpose)
            or (self._check_containment(mission, rules) if purpose is Purpose.EXECUTE else None)
            or check_state(call, step, mission, world, rules, now_ns, purpose)
        )
        places: Mapping[str, Point] = {}
        subject = ""
        if refusal is None or refusal.code is Code.APPROVAL_MISSING:
            outcome = check_values(call, step, mission, world, rules, now_ns)
            if isinstance(outcome, Refusal):
                refusal = refusal or outcome
            else:
                places = outcome
            if purpose is Purpose.EXECUTE and wants_approval(step, mission, rules):
                subject = subject_of(call, step, mission, world, rules, now_ns)
        return Decision(
            mission=mission.id,
            step=step,
            call=call,
            purpose=purpose,
            at_ns=now_ns,
            refusal=refusal,
            places=places,
            subject=subject,
        )

    def _check_containment(self, mission: MissionState, rules: Rules) -> Refusal | None:
        assert mission.instance is not None
        key = (id(mission.reading), id(mission.instance), id(rules), mission.confirmed)
        known = self._findings.get(key)
        if known is None:
            finding = check_containment(mission.reading, mission.instance, rules, confirmed=mission.confirmed)
            if len(self._findings) > 64:
                self._findings.clear()
            known = self._findings[key] = (mission.reading, mission.instance, rules, finding)
        return None if known[3] is None else finding_refusal(known[3])


def finding_refusal(finding: Finding) -> Refusal:
    """A containment finding as a refusal."""
    return Refusal(code=finding.code, message=finding.message, field=finding.field, allowed=", ".join(finding.allowed))
