"""`crew eval fuzz`, `substitution` and `figures`: files, JSON, exit codes, and clear words for mistakes."""

import json
from pathlib import Path

import msgspec
import pytest

from crew.actors.specs import PlannerChoice
from crew.cli.study import OfflineOptions, run_offline
from crew.contracts.render.prompt import Arm
from crew.errors import UsageError
from crew.library import load_rules
from crew.study.observation import Observation, Results
from crew.study.scenario_file import SHIPPED, load_scenarios

OPTIONS = OfflineOptions(
    what="fuzz",
    crew="air_ground",
    planning=PlannerChoice(name="fallible"),
    seed=0,
    seeds=1,
    out=Path("nowhere"),
    scenarios=None,
    jobs=1,
    plans=50,
    mutants=(),
    as_json=True,
)


def asked(capsys: pytest.CaptureFixture[str], **changes: object) -> tuple[int, dict[str, object]]:
    code = run_offline(msgspec.structs.replace(OPTIONS, **changes))
    return code, json.loads(capsys.readouterr().out)


def test_substitution_leaves_a_page_and_its_data(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    code, said = asked(capsys, what="substitution", crew="humanoid_quadruped", out=tmp_path)
    assert (code, said["accepted"]) == (0, 0)
    assert (tmp_path / "substitution-humanoid_quadruped.md").read_text().startswith("# What becomes")
    assert json.loads((tmp_path / "substitution-humanoid_quadruped.json").read_text())["planner"] == "fallible"


def test_figures_are_made_anew_from_what_is_there(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    scenario = load_scenarios(SHIPPED, load_rules("air_ground"))[0]
    lone = Observation(
        version="1",
        testbed="air_ground",
        scenario=scenario.name,
        kind=scenario.kind,
        arm=Arm.RO,
        planner="embedded",
        seed=0,
        run="runs/one",
        outcome="rejected",
    )
    (tmp_path / "results.json").write_bytes(msgspec.json.encode(Results(version="1", observations=(lone,))))
    code, said = asked(capsys, what="figures", out=tmp_path)
    assert code == 0
    assert said["files"] == [
        str(tmp_path / n) for n in ("results.json", "figures.csv", "figures.md", "figures.tex", "figures.html")
    ]
    assert asked(capsys, what="figures", out=tmp_path)[0] == 0, "its own results are read again"
    mixed = Results(version="1", observations=(lone, msgspec.structs.replace(lone, version="2", seed=1)))
    (tmp_path / "results.json").write_bytes(msgspec.json.encode(mixed))
    with pytest.raises(UsageError, match="different versions"):
        run_offline(msgspec.structs.replace(OPTIONS, what="figures", out=tmp_path))


@pytest.mark.parametrize(
    ("changes", "why"),
    [
        ({"what": "figures"}, "holds no results"),
        ({"what": "substitution", "seeds": 0}, "1 to 1000"),
        ({"what": "substitution", "crew": "air_grund"}, "air_ground"),
        ({"what": "substitution", "planning": PlannerChoice(name="falible")}, "fallible"),
        ({"plans": 0}, "0 is no number"),
        ({"mutants": ("everything",)}, "no mutant"),
    ],
)
def test_a_mistake_gets_a_clear_word(changes: dict[str, object], why: str, tmp_path: Path) -> None:
    with pytest.raises(UsageError, match=why):
        run_offline(msgspec.structs.replace(OPTIONS, **{"out": tmp_path, **changes}))
