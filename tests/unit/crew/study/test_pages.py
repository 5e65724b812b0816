"""What a study leaves on disk: figures with numerator and denominator everywhere, labelled, safe to open."""

import csv
import io
import json
from pathlib import Path

import pytest
from msgspec.structs import replace

from crew.contracts.render.prompt import Arm
from crew.library import load_rules
from crew.study.figures import NAMES, write_reports
from crew.study.metrics import Table, tabulate
from crew.study.observation import Observation, Results, read_results
from crew.study.page_html import page
from crew.study.page_text import MODEL_OF_ERRORS, csv_text, latex, markdown
from crew.study.publish import publish_all
from tests.unit.crew.study.build import BASE, FIND, LOST, SCENARIOS, TO_BASE, WHOLE, completed, refused, seen, sent

RULES = {"air_ground": load_rules("air_ground")}


def observations() -> tuple[Observation, ...]:
    found: list[Observation] = []
    for seed in (0, 1):
        for arm in Arm:
            found.append(completed(FIND, arm, WHOLE, seed=seed, fix_error_m=0.2))
            if arm.enforced:
                found.append(seen(LOST, arm, TO_BASE, seed=seed, refusals=(refused(BASE, "robot_unavailable"),)))
            else:
                false = (sent(BASE, 1, "unavailable"),)
                found.append(seen(LOST, arm, TO_BASE, seed=seed, dispatches=false, outcome="halted"))
    return tuple(found)


@pytest.fixture(scope="module")
def tables() -> tuple[Table, ...]:
    return tabulate(observations(), SCENARIOS, RULES, seed=0)


def test_all_files_are_written_and_the_missions_stay_readable(tmp_path: Path) -> None:
    results = Results(version="0.1.0", observations=observations())
    paths = publish_all(results, SCENARIOS, RULES, tmp_path)
    assert tuple(path.name for path in paths) == ("results.json", *NAMES)
    assert read_results(paths[0]).observations == results.observations, "the study can be resumed from it"
    data = json.loads(paths[0].read_text())
    recall = next(f for f in data["tables"][0]["fractions"] if (f["metric"], f["column"]) == ("recall", "ro"))
    assert (recall["hits"], recall["trials"], recall["p"]) == (2, 2, None)
    assert [run["run"] for run in recall["runs"]] == ["runs/lost-ro-0", "runs/lost-ro-1"]


def test_the_csv_has_a_row_for_each_seed_that_adds_up(tables: tuple[Table, ...]) -> None:
    rows = [r for r in csv.DictReader(io.StringIO(csv_text(tables))) if r["metric"] == "false_dispatch"]
    mine = {r["seed"]: (int(r["hits"]), int(r["trials"])) for r in rows if r["column"] == "ro-prompt"}
    assert mine == {"all": (2, 10), "0": (1, 5), "1": (1, 5)}
    assert {(r["version"], r["planner"]) for r in rows} == {("0.1.0", "fallible")}


def test_markdown_and_latex_print_share_interval_and_fraction(tables: tuple[Table, ...]) -> None:
    text = markdown(tables)
    assert "| False dispatch ↓ |" in text
    assert "20 [6, 51]<br>2/10 {" in text
    assert "none<br>0/0" in text, "a gate that is not there has no precision"
    assert "0 [0, 28]<br>0/10" in text
    tex = latex(tables)
    assert r"False dispatch $\downarrow$ & 20 [6, 51] (2/10) &" in tex
    assert r"air\_ground" in tex
    assert tex.count(r"\begin{tabular}") == tex.count(r"\end{tabular}") == 1


def test_the_model_of_errors_is_named_where_it_planned(tables: tuple[Table, ...], tmp_path: Path) -> None:
    for text in (markdown(tables), latex(tables), page(tables, tmp_path)):
        assert MODEL_OF_ERRORS in text
    embedded = tuple(replace(o, planner="embedded") for o in observations())
    other = tabulate(embedded, SCENARIOS, RULES, seed=0)
    assert MODEL_OF_ERRORS not in markdown(other) + page(other, tmp_path)


def test_the_page_runs_nothing_fetches_nothing_and_escapes(tables: tuple[Table, ...], tmp_path: Path) -> None:
    odd = replace(tables[0], model="<script>alert(1)</script>", planner="x")
    text = page((odd,), tmp_path)
    assert "<script" not in text
    assert "default-src &#x27;none&#x27;" in text
    assert "http://" not in text
    assert "https://" not in text


def test_a_figure_links_to_the_reports_of_its_runs(tables: tuple[Table, ...], tmp_path: Path) -> None:
    report = tmp_path / "runs" / "lost-ro-0" / "report.html"
    report.parent.mkdir(parents=True)
    report.write_text("a report")
    text = page(tables, tmp_path)
    assert 'href="runs/lost-ro-0/report.html"' in text
    assert 'href="runs/lost-ro-1/"' in text, "no report was made of that one"


def test_reports_are_made_of_runs_that_are_there_and_of_no_others(tmp_path: Path) -> None:
    damaged, gone, told = tmp_path / "damaged", tmp_path / "gone", tmp_path / "told"
    for folder in (damaged, told):
        folder.mkdir()
        (folder / "journal.db").write_bytes(b"no journal")
    (told / "report.html").write_text("before")
    assert write_reports([damaged.name, gone.name, told.name], tmp_path) == 0
    assert (told / "report.html").read_text() == "before"


def test_intervals_are_drawn_where_they_lie(tables: tuple[Table, ...], tmp_path: Path) -> None:
    text = page(tables, tmp_path)
    assert text.count('class="dot"') == sum(f.share is not None for t in tables for f in t.fractions)
    assert '<circle cx="145" cy="13" r="4" class="dot"/>' in text
    assert '<circle cx="5" cy="13" r="4" class="dot"/>' in text
