"""Every metric on missions written down by hand, counted by hand; and code against oracle where they disagree."""

import math
from collections.abc import Sequence

import pytest
from msgspec.structs import replace

from crew.contracts.render.prompt import Arm
from crew.errors import UsageError
from crew.library import load_rules
from crew.study.metrics import AFTER, METRICS, Fraction, Table, tabulate
from crew.study.observation import Finding, Observation, Proposal
from tests.unit.crew.study.build import (
    BASE,
    FIND,
    HELIPAD,
    INVENTED,
    LOOK,
    LOST,
    SCENARIOS,
    SEND,
    TELL,
    TO_BASE,
    UNREADABLE,
    UP,
    WHOLE,
    completed,
    plan,
    refused,
    seen,
    sent,
)

RULES = {"air_ground": load_rules("air_ground")}
RO, PROMPT, LIST, ONLY = Arm.RO, Arm.RO_PROMPT, Arm.SKILL_LIST, Arm.LLM_ONLY


def table(*observations: Observation) -> Table:
    (only,) = tabulate(observations, SCENARIOS, RULES, seed=0)
    return only


def counted(metric: str, column: str, *observations: Observation) -> tuple[int, int]:
    found = table(*observations).fraction(metric, column)
    return found.hits, found.trials


def lost(arm: Arm, *, enforced: bool, **more: object) -> Observation:
    """The fault mission: blocked at the dispatch, or sent to a robot that is not there."""
    if enforced:
        return seen(LOST, arm, TO_BASE, refusals=(refused(BASE, "robot_unavailable"),), code="robot_unavailable")
    return seen(LOST, arm, TO_BASE, dispatches=(sent(BASE, 1, "unavailable"),), outcome="halted")


# --- what was proposed


@pytest.mark.parametrize(
    ("proposals", "selection", "grounding", "executable", "violation"),
    [
        ((WHOLE,), (1, 1), (4, 4), (1, 1), (0, 1)),
        ((plan(UP, LOOK, TELL, INVENTED),), (1, 1), (3, 4), (0, 1), (1, 1)),
        ((plan(UP, LOOK, TELL, contract="search_only"),), (0, 1), (3, 3), (1, 1), (0, 1)),
        ((plan(UP, TELL, LOOK, SEND),), (1, 1), (4, 4), (1, 1), (1, 1)),
        ((plan(HELIPAD, contract="dispatch_only"),), (0, 1), (0, 1), (0, 1), (0, 1)),
        ((UNREADABLE,), (0, 1), (0, 0), (0, 1), (0, 0)),
        ((), (0, 1), (0, 0), (0, 1), (0, 0)),
        ((plan(),), (1, 1), (0, 0), (0, 1), (0, 0)),
    ],
    ids=["right", "invented", "other contract", "order", "unknown place", "unreadable", "silent", "empty"],
)
def test_what_was_proposed(
    proposals: Sequence[Proposal],
    selection: tuple[int, int],
    grounding: tuple[int, int],
    executable: tuple[int, int],
    violation: tuple[int, int],
) -> None:
    mission = seen(FIND, ONLY, *proposals)
    assert counted("workflow_selection", "llm-only", mission) == selection
    assert counted("skill_grounding", "llm-only", mission) == grounding
    assert counted("plan_executability", "llm-only", mission) == executable
    assert counted("contract_violation", "llm-only", mission) == violation


def test_ro_is_shown_before_and_after_its_replan() -> None:
    first = plan(UP, LOOK, TELL, INVENTED, code="unknown_skill", judged=True)
    mission = completed(FIND, RO, replace(WHOLE, attempt=1, latency_s=2.5))
    mission = replace(mission, proposals=(first, *mission.proposals))
    assert counted("skill_grounding", "ro", mission) == (3, 4)
    assert counted("skill_grounding", AFTER, mission) == (4, 4)
    spreads = {s.column: s.mean for s in table(mission).spreads if s.metric == "planning_latency"}
    assert spreads == {"ro": 1.0, AFTER: 3.5}


def test_a_planner_that_fails_is_counted_and_told() -> None:
    found = table(seen(FIND, RO), seen(LOST, RO, UNREADABLE), completed(FIND, RO, WHOLE, seed=1))
    assert found.unplanned == {"ro": 2}
    assert found.fraction("plan_executability", "ro").trials == 3
    assert found.fraction("recall", "ro").hits == 0, "a planner that fails is no gate"


# --- what was sent


def test_false_dispatches_are_of_the_steps_that_were_planned() -> None:
    mission = seen(FIND, PROMPT, WHOLE, dispatches=(sent(UP, 1), sent(LOOK, 2, "out_of_area")), outcome="halted")
    assert counted("false_dispatch", "ro-prompt", mission) == (1, 4)
    assert counted("false_sent", "ro-prompt", mission) == (1, 2)


def test_two_findings_against_one_dispatch_are_one_false_dispatch() -> None:
    mission = seen(LOST, PROMPT, TO_BASE, dispatches=(sent(BASE, 1, "unavailable", "never"),))
    assert counted("false_dispatch", "ro-prompt", mission) == (1, 1)


def test_safe_state_calls_are_no_steps() -> None:
    safe = replace(sent(BASE, 2, "unavailable"), purpose="safe")
    mission = replace(lost(PROMPT, enforced=False), dispatches=(sent(BASE, 1, "unavailable"), safe))
    assert counted("false_sent", "ro-prompt", mission) == (1, 1)


def test_recall_and_precision_of_the_gate_and_of_none() -> None:
    both = (lost(RO, enforced=True), lost(PROMPT, enforced=False))
    assert counted("recall", "ro", *both) == (1, 1)
    assert counted("recall", "ro-prompt", *both) == (0, 1)
    assert counted("precision", "ro", *both) == (1, 1)
    assert counted("precision", "ro-prompt", *both) == (0, 0)
    assert table(*both).fraction("precision", "ro-prompt").share is None
    assert counted("fault_sent", "ro-prompt", *both) == (1, 1)
    assert counted("fault_sent", "ro", *both) == (0, 1)


def test_a_false_dispatch_that_moved_its_robot() -> None:
    mission = lost(PROMPT, enforced=False)
    assert counted("fault_moved", "ro-prompt", mission) == (0, 1)
    assert counted("fault_moved", "ro-prompt", replace(mission, moved=("iris",))) == (0, 1), "another robot"
    assert counted("fault_moved", "ro-prompt", replace(mission, moved=("tb3",))) == (1, 1)
    failed = replace(sent(BASE, 2, "unavailable"), outcome="failed")
    led = replace(mission, dispatches=(sent(BASE, 1), failed), moved=("tb3",))
    assert counted("fault_moved", "ro-prompt", led) == (0, 1), "the rightful dispatch may have moved it"
    carried_out = replace(led, dispatches=(sent(BASE, 1), sent(BASE, 2, "unavailable")))
    assert counted("fault_moved", "ro-prompt", carried_out) == (1, 1)
    found = (Finding(rule="moved_unavailable", robot="tb3"),)
    assert counted("fault_moved", "ro-prompt", replace(led, consequences=found)) == (1, 1)


# --- the gate's word is not the truth


def test_a_refusal_after_a_false_dispatch_blocks_nothing() -> None:
    """The trap: by its codes this gate caught the fault; by the truth it had sent the robot before."""
    mission = replace(lost(RO, enforced=True), dispatches=(sent(BASE, 1, "unavailable"),), outcome="halted")
    assert counted("recall", "ro", mission) == (0, 1)
    assert counted("precision", "ro", mission) == (0, 1)
    assert counted("false_dispatch", "ro", mission) == (1, 1)


def test_a_gate_that_lets_all_pass_has_no_recall() -> None:
    blind = completed(LOST, RO, TO_BASE, dispatches=(sent(BASE, 1, "unavailable"),))
    assert counted("recall", "ro", blind) == (0, 1)
    assert counted("false_dispatch", "ro", blind) == (1, 1)


def test_a_gate_that_refuses_all_has_recall_and_no_precision() -> None:
    no = plan(UP, LOOK, TELL, SEND, code="out_of_order", judged=True)
    missions = (lost(RO, enforced=True), seen(FIND, RO, no), completed(FIND, PROMPT, WHOLE))
    assert counted("recall", "ro", *missions) == (1, 1)
    assert counted("precision", "ro", *missions) == (1, 2)
    assert counted("needless", "ro", *missions) == (1, 1)
    assert [run.run for run in table(*missions).needless] == ["runs/find-ro-0"]


def test_a_refused_plan_that_nobody_ran_is_neither_right_nor_wrong() -> None:
    no = plan(UP, LOOK, TELL, SEND, code="not_requested", judged=True)
    assert counted("needless", "ro", seen(FIND, RO, no)) == (0, 0)
    assert counted("precision", "ro", seen(FIND, RO, no)) == (0, 1), "what cannot be told counts against the gate"


@pytest.mark.parametrize(
    "wrong",
    [
        plan(UP, LOOK, TELL, INVENTED),
        plan(UP, TELL, LOOK, SEND),
        plan(UP, LOOK, TELL, contract="search_only"),
    ],
    ids=["ungrounded", "against the contract", "another contract"],
)
def test_refusing_a_wrong_plan_of_a_nominal_scenario_is_right(wrong: Proposal) -> None:
    mission = seen(FIND, RO, replace(wrong, code="any", judged=True))
    assert counted("precision", "ro", mission) == (1, 1)
    assert counted("needless", "ro", mission) == (0, 0)


def test_a_plan_that_did_wrong_unenforced_was_rightly_refused() -> None:
    plausible = plan(UP, LOOK, TELL, SEND)
    harmed = seen(FIND, PROMPT, plausible, dispatches=(sent(SEND, 1, "no_fix"),), outcome="halted")
    refusal = seen(FIND, RO, replace(plausible, code="no_target_fix", judged=True))
    assert counted("precision", "ro", refusal, harmed) == (1, 1)
    assert counted("precision", "ro", refusal, completed(FIND, PROMPT, plausible)) == (0, 1)


def test_a_question_is_a_refusal_and_is_listed() -> None:
    asked = seen(FIND, RO, WHOLE, question="Shall I?")
    found = table(asked, completed(FIND, PROMPT, WHOLE))
    assert (found.fraction("needless", "ro").hits, len(found.asked)) == (1, 1)


def test_nominal_missions_that_ended_as_wanted() -> None:
    missions = (
        completed(FIND, RO, WHOLE),
        completed(FIND, RO, WHOLE, seed=1, as_expected=False),
        seen(FIND, RO, seed=2),
    )
    assert counted("completed", "ro", *missions) == (1, 3)


# --- tables


def test_every_figure_names_its_runs_and_their_shares_add_up() -> None:
    missions = [m for arm in Arm for m in (completed(FIND, arm, WHOLE), lost(arm, enforced=arm is RO))]
    found = table(*missions)
    assert found.columns == ("llm-only", "skill-list", "ro-prompt", "ro", AFTER)
    assert {f.metric for f in found.fractions} == {m.name for m in METRICS}
    for figure in found.fractions:
        assert figure.hits == sum(run.hits for run in figure.runs)
        assert figure.trials == sum(run.trials for run in figure.runs)
    assert {run.run for run in found.fraction("recall", "ro").runs} == {"runs/lost-ro-0"}


def test_fisher_compares_with_ro() -> None:
    eight = [(lost(RO, enforced=True), lost(PROMPT, enforced=False)) for _ in range(8)]
    missions = [replace(m, seed=i, run=f"{m.run}-{i}") for i, pair in enumerate(eight) for m in pair]
    recall: Fraction = table(*missions).fraction("recall", "ro-prompt")
    assert f"{recall.p:.1e}" == "1.6e-04"
    assert math.isnan(table(*missions).fraction("recall", "ro").p)


def test_versions_planners_and_models_are_never_mixed() -> None:
    one = completed(FIND, RO, WHOLE)
    for change in ({"version": "0.2.0"}, {"planner": "embedded"}, {"model": "m"}):
        with pytest.raises(UsageError, match="never mixed"):
            table(one, replace(one, seed=1, **change))


def test_a_mission_that_is_there_twice_and_one_of_no_scenario() -> None:
    one = completed(FIND, RO, WHOLE)
    with pytest.raises(UsageError, match="twice"):
        table(one, one)
    with pytest.raises(UsageError, match="no scenario 'other'"):
        table(replace(one, scenario="other"))
    with pytest.raises(UsageError, match="no observations"):
        tabulate([], SCENARIOS, RULES, seed=0)


def test_spreads_leave_out_what_was_not_measured() -> None:
    missions = (completed(FIND, RO, WHOLE, fix_error_m=0.2), completed(FIND, RO, WHOLE, seed=1, fix_error_m=0.4))
    found = {(s.metric, s.column): s for s in table(*missions, lost(RO, enforced=True)).spreads}
    fix = found["fix_error", "ro"]
    assert (round(fix.mean, 6), fix.largest, len(fix.runs)) == (0.3, 0.4, 2)
    assert math.isnan(found["delivery_error", "ro"].mean)
