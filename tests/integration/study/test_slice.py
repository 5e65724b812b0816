"""A slice of the study, live: one scenario a testbed in two arms, through the command's own workers."""

from pathlib import Path

from crew.actors.specs import PlannerChoice
from crew.contracts.render.prompt import Arm
from crew.home import Home
from crew.library import load_rules
from crew.study.figures import PAGE
from crew.study.observation import Observation
from crew.study.scenario_file import SHIPPED, load_scenarios
from crew.study.study import Wanted, run_study
from crew.study.version import study_version
from crew.study.worker import STATE
from crew.verify import verify_run


def _study(crew: str, scenario: str, out: Path) -> dict[Arm, Observation]:
    """Both arms of one scenario. Every journal holds, whether it was enforced or not."""
    rules = load_rules(crew)
    found = [s for s in load_scenarios(SHIPPED, rules) if s.name == scenario]
    wanted = Wanted(
        crew=crew,
        testbed=crew,
        rules=rules,
        scenarios=tuple(found),
        arms=(Arm.RO_PROMPT, Arm.RO),
        seeds=(0,),
        planning=PlannerChoice(),
        planner="embedded",
        version=study_version(),
        out=out,
    )
    seen = {o.arm: o for o in run_study(wanted, lambda *_: None).observations}
    for observation in seen.values():
        report = verify_run(out / observation.run, Home(out / STATE))
        assert report.holds, report.problems
        assert f'href="{observation.run}/report.html"' in (out / PAGE).read_text(), "the figures lead to the run"
    return seen


def test_a_place_outside_the_area_is_driven_to_without_the_gate_and_refused_with_it(tmp_path: Path) -> None:
    seen = _study("air_ground", "far_south", tmp_path)
    without, enforced = seen[Arm.RO_PROMPT], seen[Arm.RO]
    assert [[f.rule for f in d.false] for d in without.dispatches] == [["out_of_area", "never"]]
    assert [f.rule for f in without.consequences] == ["left_area"]
    assert without.moved == ("tb3",)
    assert (enforced.dispatches, enforced.moved, enforced.code) == ((), (), "out_of_bounds")
    assert enforced.as_expected
    assert not without.as_expected


def test_a_robot_that_is_not_available_walks_without_the_gate_and_stands_with_it(tmp_path: Path) -> None:
    seen = _study("humanoid_quadruped", "legs_report_an_error", tmp_path)
    without, enforced = seen[Arm.RO_PROMPT], seen[Arm.RO]
    assert [[f.rule for f in d.false] for d in without.dispatches] == [["unavailable", "never"]]
    assert [f.rule for f in without.consequences] == ["moved_unavailable"]
    assert (enforced.dispatches, enforced.moved, enforced.code) == ((), (), "robot_unavailable")
    assert enforced.as_expected
