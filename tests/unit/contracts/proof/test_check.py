"""What a check finds in kinds and contracts that are wrong in ways of their own, and how it bears what is too big."""

from collections.abc import Callable

import pytest
from msgspec.structs import replace

from crew.contracts.codes import Code
from crew.contracts.contract import CallPattern
from crew.contracts.decision import Decision
from crew.contracts.gate.approval import approved
from crew.contracts.gate.authorize import Gate
from crew.contracts.mission_state import Approval, MissionState, Purpose
from crew.contracts.plan import Call
from crew.contracts.proof.checker import check, check_all
from crew.contracts.proof.report import Finding, Report, Stage
from crew.contracts.proof.world import NOW_NS
from crew.contracts.site import Rules
from crew.contracts.snapshot import Snapshot
from tests.unit.contracts.build import air_ground, with_approval
from tests.unit.contracts.proof.lab import STOP, chain, kind, rules, skill

WORK = """\
contract: job
summary: Work.
roles:
  w: {safe: {by: halt, reach: {moving: false}}}
asks: [work]
steps:
  work:
    role: w
    do: {work: {}}
complete: [{w.ready: true}]
deadline_s: 60
"""


def found(report: Report, rule: str) -> Finding:
    return next(finding for finding in report.findings if finding.rule == rule)


def test_a_skill_without_effects_is_done_on_the_robots_word_alone() -> None:
    report = check(rules(WORK, kind(skill("work"), STOP)), "job")
    assert report.proved, "ready may hold from the start"
    empty = rules(WORK.replace("complete: [{w.ready: true}]\n", ""), kind(skill("work"), STOP))
    assert check(empty, "job").proved


def test_an_effect_that_no_telemetry_can_confirm_is_named() -> None:
    report = check(rules(WORK, kind(skill("work", effects={"glowing": True}), STOP)), "job")
    finding = found(report, "unseen_effect")
    assert "step work can never be seen done: r0.glowing" in finding.message
    assert finding.where == ("lab.yaml:7",)


def test_a_safe_skill_that_may_be_refused_makes_no_safe_state() -> None:
    fussy = skill("halt", needs={"ready": True}, effects={"moving": False}, safe=True)
    report = check(rules(WORK, kind(skill("work", effects={"ready": True}, during={"moving": True}), fussy)), "job")
    finding = found(report, "unsafe_end")
    assert "r0.halt() is refused: needs that r0.ready is true, observed false" in finding.message
    assert finding.where == ("lab.yaml:4",)


def test_a_leftover_of_a_failure_is_seen() -> None:
    tilts = skill("work", effects={"ready": True}, may=({"tilted": True},))
    rights = skill("halt", effects={"moving": False, "tilted": False}, safe=True)
    text = WORK.replace("reach: {moving: false}", "reach: {tilted: false}")
    fine = kind(tilts, rights, fluents=("ready", "moving", "tilted"))
    assert check(rules(text, fine), "job").proved
    bad = kind(tilts, STOP, fluents=("ready", "moving", "tilted"))
    assert "r0.tilted may be true, not false" in found(check(rules(text, bad), "job"), "unsafe_end").message


def test_a_state_space_beyond_the_bound_is_not_proved_and_says_so() -> None:
    wide = rules(chain(12, 3), kind(skill("work", effects={"ready": True}), STOP), 3)
    report = check(wide, "chains", limit=300)
    assert report.bound_reached
    assert not report.proved
    assert report.states >= 300
    assert report.limit == 300


def test_too_many_plans_are_a_bound_too(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("crew.contracts.proof.checker.MAX_PLANS", 2)
    report = check(air_ground(), "search_and_dispatch")
    assert (report.proved, report.bound_reached) == (False, True)


def test_robots_that_nothing_tells_apart_are_not_tried_in_every_order() -> None:
    work = kind(skill("work", effects={"ready": True}), STOP)
    three, six = (check(rules(chain(3, 3), work, robots), "chains") for robots in (3, 6))
    assert three.plans == six.plans == 1
    assert three.states == six.states


def test_steps_of_one_robot_without_an_order_are_tried_in_every_order() -> None:
    report = check(rules(chain(3, ordered=False), kind(skill("work", effects={"ready": True}), STOP)), "chains")
    assert report.plans == 6


class Rash(Gate):
    """A gate that counts a step as approved although something about its approval is wrong."""

    def __init__(self, forgives: Callable[[tuple[Approval, ...]], bool]) -> None:
        super().__init__()
        self._forgives = forgives

    def authorize(
        self, call: Call, mission: MissionState, world: Snapshot, rules: Rules, now_ns: int, purpose: Purpose
    ) -> Decision:
        decision = super().authorize(call, mission, world, rules, now_ns, purpose)
        missing = decision.refusal is not None and decision.refusal.code is Code.APPROVAL_MISSING
        if not missing or not self._forgives(mission.approvals):
            return decision
        given = approved(call, decision.step, mission, world, rules, now_ns)
        return super().authorize(call, replace(mission, approvals=given), world, rules, now_ns, purpose)


RASH: dict[str, Callable[[tuple[Approval, ...]], bool]] = {
    "nobody approved the step": lambda given: not given,
    "another call was approved": lambda given: any(a.subject == "another" for a in given),
    "the approval is old": lambda given: any(a.at_ns < NOW_NS for a in given),
}


def test_a_step_that_wants_approval_is_proved_with_it() -> None:
    assert check(with_approval(air_ground(), "dispatch_only", "dispatch"), "dispatch_only").proved


@pytest.mark.parametrize("mishap", RASH)
def test_a_gate_that_is_rash_about_approvals_is_found(mishap: str) -> None:
    strict = with_approval(air_ground(), "dispatch_only", "dispatch")
    report = check(strict, "dispatch_only", gate=Rash(RASH[mishap]), repair=False)
    assert not report.proved
    assert any(mishap in finding.message for finding in report.findings)


def test_progress_is_told() -> None:
    stages: list[Stage] = []
    check(air_ground(), "abort", progress=stages.append)
    assert stages[-1].plan == stages[-1].plans - 1
    assert [s.states for s in stages] == sorted(s.states for s in stages)


def test_a_robot_out_of_command_is_left_to_its_declared_behaviour() -> None:
    report = check(air_ground(), "search_and_dispatch")
    behaviours = {(f.robot, f.why, f.behaviour) for f in report.fallbacks}
    assert ("iris", "stopped", "on_stop: hover_then_land") in behaviours
    assert ("tb3", "robot_unavailable", "on_link_loss: stop") in behaviours


def test_verdicts_are_the_same_every_time() -> None:
    few = replace(air_ground(), contracts={n: air_ground().contracts[n] for n in ("abort", "search_only")})
    assert check_all(few) == check_all(few)


def test_an_unknown_contract_is_named() -> None:
    with pytest.raises(ValueError, match="no contract 'carry' among search_and_dispatch"):
        check(air_ground(), "carry")


def test_a_contract_that_no_plan_fits_says_why() -> None:
    known = air_ground()
    dispatch = known.contracts["dispatch_only"]
    nowhere = replace(dispatch.steps[0], do=(CallPattern("navigate_to", {"target": "nowhere"}),))
    contract = replace(dispatch, steps=(nowhere,), source="dispatch_only.yaml")
    report = check(replace(known, contracts={"dispatch_only": contract}), "dispatch_only")
    finding = found(report, "no_plan")
    assert "no plan of dispatch_only gets through: the crew knows no target 'nowhere'" in finding.message
    assert finding.where == (f"dispatch_only.yaml:{nowhere.line}",)


def test_a_long_chain_is_one_plan_and_a_heap_of_steps_is_a_bound(monkeypatch: pytest.MonkeyPatch) -> None:
    work = kind(skill("work", effects={"ready": True}), STOP)
    assert check(rules(chain(12), work), "chains").plans == 1
    monkeypatch.setattr("crew.contracts.proof.checker.MAX_PLANS", 10)
    report = check(rules(chain(12, ordered=False), work), "chains", limit=200)
    assert (report.proved, report.bound_reached) == (False, True)
