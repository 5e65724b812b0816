"""A study is kept mission by mission: it can be interrupted, and nothing is mixed that must not be."""

from collections.abc import Callable, Sequence
from pathlib import Path

import msgspec
import pytest
from msgspec.structs import replace

from crew.actors.specs import PlannerChoice
from crew.cli.evaluate import parse_arms, what_of
from crew.contracts.plan import Call, Plan
from crew.contracts.render.prompt import Arm
from crew.errors import CrewError, UsageError
from crew.library import load_rules
from crew.study import study
from crew.study.ablate import run_ablation
from crew.study.observation import Observation, Results
from crew.study.publish import RESULTS
from crew.study.study import Wanted, run_study, tasks
from crew.study.worker import SEEN, Task
from tests.unit.crew.study.build import FIND, LOST, TO_BASE, WHOLE


class Interrupted(Exception):  # noqa: N818 - an outcome
    """Ctrl-C, as it were."""


class Carrier:
    """Stands in for the workers: writes what a mission leaves behind, and fails after a while if told to."""

    def __init__(self, fails_after: int = 10_000) -> None:
        self.ran: list[Task] = []
        self._left = fails_after

    def __call__(self, missing: Sequence[Task], jobs: int, told: Callable[[Observation], None]) -> None:
        for task in missing:
            if self._left == 0:
                raise Interrupted
            self._left -= 1
            folder = Path(task.out) / task.run
            assert not folder.exists(), "an unfinished mission is begun anew"
            folder.mkdir(parents=True)
            seen = _seen(task)
            (folder / SEEN).write_bytes(msgspec.json.encode(seen))
            self.ran.append(task)
            told(seen)


def _seen(task: Task) -> Observation:
    return Observation(
        version=task.version,
        testbed="air_ground",
        scenario=task.scenario.name,
        scenario_digest=task.scenario.digest,
        kind=task.scenario.kind,
        arm=task.arm,
        planner=task.planner,
        seed=task.seed,
        run=task.run,
        proposals=(WHOLE if task.scenario is FIND else TO_BASE,),
        outcome="completed",
    )


@pytest.fixture
def wanted(tmp_path: Path) -> Wanted:
    return Wanted(
        crew="air_ground",
        testbed="air_ground",
        rules=load_rules("air_ground"),
        scenarios=(FIND, LOST),
        arms=tuple(Arm),
        seeds=(0, 1),
        planning=PlannerChoice(),
        planner="embedded",
        version="1",
        out=tmp_path / "out",
    )


@pytest.fixture(autouse=True)
def _plainly_published(monkeypatch: pytest.MonkeyPatch) -> None:
    """Tables take a bootstrap, and are not what is tested here."""

    def publish(results: Results, scenarios: object, rules: object, out: Path) -> None:
        (out / RESULTS).write_bytes(msgspec.json.encode(results))

    monkeypatch.setattr(study, "publish", publish)


def _nothing(seen: Observation, done: int, total: int) -> None:
    pass


def test_an_interrupted_study_goes_on_and_gives_the_same_results(
    wanted: Wanted, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(study, "carry_out_all", Carrier())
    run_study(wanted, _nothing)
    first, again = Carrier(fails_after=7), Carrier()
    other = replace(wanted, out=tmp_path / "other")
    monkeypatch.setattr(study, "carry_out_all", first)
    with pytest.raises(Interrupted):
        run_study(other, _nothing)
    (other.out / tasks(other)[7].run).mkdir(parents=True)
    monkeypatch.setattr(study, "carry_out_all", again)
    heard: list[tuple[int, int]] = []
    run_study(other, lambda _, done, total: heard.append((done, total)))
    assert len(first.ran) + len(again.ran) == 16
    assert heard == [(done, 16) for done in range(8, 17)]
    assert (other.out / RESULTS).read_bytes() == (wanted.out / RESULTS).read_bytes()


@pytest.mark.parametrize(
    ("change", "words"),
    [({"version": "2"}, "of version '1', this is '2'"), ({"planner": "fallible"}, "of planner 'embedded'")],
)
def test_versions_and_planners_are_never_mixed(
    wanted: Wanted, monkeypatch: pytest.MonkeyPatch, change: dict[str, str], words: str
) -> None:
    monkeypatch.setattr(study, "carry_out_all", Carrier())
    run_study(wanted, _nothing)
    with pytest.raises(UsageError, match=words):
        run_study(replace(wanted, **change), _nothing)


def test_a_scenario_that_was_changed_is_not_mixed_with_what_it_was(
    wanted: Wanted, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(study, "carry_out_all", Carrier())
    run_study(wanted, _nothing)
    changed = replace(FIND, request="search the north half")
    with pytest.raises(UsageError, match="of scenario find"):
        run_study(replace(wanted, scenarios=(changed, LOST)), _nothing)


def test_a_damaged_mission_is_named(wanted: Wanted, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(study, "carry_out_all", Carrier())
    run_study(wanted, _nothing)
    (wanted.out / tasks(wanted)[0].run / SEEN).write_text("{")
    with pytest.raises(UsageError, match=r"air_ground-find-llm-only-0/observation\.json is no mission"):
        run_study(wanted, _nothing)


def test_held_plans_are_the_sampled_ones(wanted: Wanted, monkeypatch: pytest.MonkeyPatch) -> None:
    carrier = Carrier()
    monkeypatch.setattr(study, "carry_out_all", carrier)
    results = run_ablation(replace(wanted, seeds=(0,)), _nothing)
    assert {o.planner for o in results.observations} == {"held:embedded"}
    assert [t.arm for t in carrier.ran[:2]] == [Arm.RO_PROMPT, Arm.RO_PROMPT]
    for task in carrier.ran[2:]:
        assert task.planning.name == "script"
        step = (WHOLE if task.scenario is FIND else TO_BASE).steps[-1]
        plans = msgspec.json.decode(Path(task.planning.script).read_bytes(), type=list[Plan])
        assert plans[0].steps[-1] == Call(step.robot, step.skill, step.args)


def test_words_of_the_command() -> None:
    assert what_of([]) == ("", "air_ground")
    assert what_of(["ablate", "humanoid_quadruped"]) == ("ablate", "humanoid_quadruped")
    assert what_of(["fuzz"]) == ("fuzz", "air_ground")
    assert parse_arms("ro,llm-only") == (Arm.LLM_ONLY, Arm.RO)
    with pytest.raises(UsageError, match="did you mean 'ro-prompt'"):
        parse_arms("ro_prompt")
    with pytest.raises(UsageError, match="be told 'a b'"):
        what_of(["a", "b"])


def test_a_worker_with_other_code_carries_nothing_out(wanted: Wanted) -> None:
    from crew.study.worker import carry_out

    with pytest.raises(CrewError, match="the code has changed under the study: it began with 1"):
        carry_out(tasks(wanted)[0])
