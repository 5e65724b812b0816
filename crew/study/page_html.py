"""A study as one page: tables, intervals drawn, links to every run behind a figure. Nothing runs or is fetched."""

import math
from collections.abc import Sequence
from pathlib import Path

from crew.report.html import Html, tag
from crew.report.style import STYLE
from crew.study.metrics import METRICS, Fraction, Metric, Run, Spread, Table
from crew.study.page_text import (
    GROUPS,
    HEADS,
    MODEL_OF_ERRORS,
    SPREADS,
    about,
    cell,
    p_text,
    per_cent,
    remarks,
    shown_columns,
    spread,
    spread_text,
)
from crew.verify import REPORT

_POLICY = "default-src 'none'; style-src 'unsafe-inline'"
WIDTH, HEIGHT, EDGE = 150.0, 26.0, 5.0
"""Of a drawn interval, pixels; a share of 0 lies at the left edge, of 1 at the right."""
OWN_STYLE = """
main{max-width:1480px}
table.study td,table.study th{padding:6px 12px 6px 0;text-align:left;vertical-align:top}
table.study td.own,table.study th.own{background:var(--tint);padding-left:8px}
.share{font-weight:600;font-variant-numeric:tabular-nums}.frac{font-size:12px;color:var(--soft);white-space:nowrap}
.line{stroke:var(--line);stroke-width:1}.wilson{stroke:var(--blue);stroke-width:2}
.boot{stroke:var(--amber);stroke-width:5;opacity:.55}.dot{fill:var(--ink)}
td.metric{min-width:11em}td.metric .small{display:block;color:var(--soft)}
details.runs{border:0;padding:0;font-size:12px}
details.runs ul{margin:2px 0;padding-left:14px;max-height:18em;overflow:auto}
"""


def page(tables: Sequence[Table], folder: Path) -> str:
    """The whole page; `folder` is where it will lie: a link to a run's report is made where there is one."""
    testbeds = ", ".join(table.testbed for table in tables)
    first = tables[0]
    body = tag(
        "main",
        tag(
            "p", f"crew eval · version {first.version} · planner {first.planner} {first.model}".rstrip(), class_="over"
        ),
        tag("h1", f"Knowledge against enforcement: {testbeds}"),
        _warning(first),
        _legend(),
        [_section(table, folder) for table in tables],
    )
    header = tag(
        "head",
        tag("meta", charset="utf-8"),
        tag("meta", http_equiv="Content-Security-Policy", content=_POLICY),
        tag("meta", name="viewport", content="width=device-width, initial-scale=1"),
        tag("title", f"{testbeds}: crew eval"),
        Html(f"<style>{STYLE}{OWN_STYLE}</style>"),
    )
    return "<!doctype html>\n" + tag("html", header, tag("body", body), lang="en") + "\n"


def _warning(table: Table) -> Html | None:
    if not table.planner.endswith("fallible"):
        return None
    return tag("div", tag("strong", MODEL_OF_ERRORS), class_="banner note")


def _legend() -> Html:
    drawn = tag("span", _line(), " ", class_="small")
    words = (
        "Dot: the share, from 0 at the left to 100 % at the right. Thin line: Wilson's 95 % interval. Broad line: the "
        "bootstrap over scenarios. p: Fisher's exact test against RO, two-sided. ↓: less is better. A figure without "
        "observations is “none”. Who decides and what is counted: docs/study/metrics.md."
    )
    return tag("p", drawn, words, class_="small soft")


def _line() -> Html:
    return _svg(tag("line", x1=EDGE, x2=WIDTH - EDGE, y1=13, y2=13, class_="wilson"), "an interval")


def _section(table: Table, folder: Path) -> Html:
    columns = shown_columns(table)
    head = tag("tr", tag("th", ""), [tag("th", HEADS[c], class_=_own(c)) for c in columns])
    rows = [row for group in GROUPS for row in _group(group, table, columns, folder)]
    whole = tag("table", tag("thead", head), tag("tbody", rows, _spreads(table, columns, folder)), class_="study")
    return tag(
        "section",
        tag("h2", table.testbed),
        tag("p", about(table), class_="soft"),
        tag("div", whole, class_="scroll"),
        [tag("p", line, class_="small") for line in remarks(table)],
    )


def _own(column: str) -> str | None:
    return "own" if column.startswith("ro-after") or column == "ro" else None


def _group(group: str, table: Table, columns: Sequence[str], folder: Path) -> list[Html]:
    title = tag("tr", tag("td", tag("h3", GROUPS[group]), colspan=len(columns) + 1))
    return [title, *(_row(m, table, columns, folder) for m in METRICS if m.group == group)]


def _row(metric: Metric, table: Table, columns: Sequence[str], folder: Path) -> Html:
    name = tag("td", f"{metric.title}{' ↓' if metric.falling else ''}", class_="metric")
    cells = [tag("td", _figure(cell(table, metric.name, c), metric.title, folder), class_=_own(c)) for c in columns]
    return tag("tr", name, cells)


def _figure(figure: Fraction | None, title: str, folder: Path) -> list[Html | None]:
    if figure is None:
        return []
    fraction = f"{figure.hits} of {figure.trials}"
    if figure.share is None:
        return [tag("span", "none", class_="soft"), tag("span", f" ({fraction})", class_="frac")]
    words = f"{per_cent(figure.wilson)} · {fraction}" + (f" · {p_text(figure.p)}" if math.isfinite(figure.p) else "")
    return [
        tag("span", f"{100 * figure.share:.0f} % ", class_="share"),
        tag("span", words, class_="frac"),
        tag("br"),
        _interval(figure, f"{title}: {words}"),
        _runs(figure.runs, folder),
    ]


def _interval(figure: Fraction, told: str) -> Html:
    middle = HEIGHT / 2
    parts = [tag("line", x1=EDGE, x2=WIDTH - EDGE, y1=middle, y2=middle, class_="line")]
    for shown, style in ((figure.bootstrap, "boot"), (figure.wilson, "wilson")):
        if shown.known:
            ends = (_x(shown.low), max(_x(shown.high), _x(shown.low) + 1.0))
            parts.append(tag("line", x1=ends[0], x2=ends[1], y1=middle, y2=middle, class_=style))
    share = figure.share
    parts.append(tag("circle", cx=_x(0.0 if share is None else share), cy=middle, r=4, class_="dot"))
    return _svg(parts, told)


def _svg(parts: Html | list[Html], told: str) -> Html:
    box = f"0 0 {WIDTH:g} {HEIGHT:g}"
    return tag("svg", tag("title", told), parts, width=WIDTH, height=HEIGHT, role="img", viewBox=box)


def _x(share: float) -> float:
    return EDGE + share * (WIDTH - 2 * EDGE)


def _runs(runs: Sequence[Run], folder: Path) -> Html | None:
    """Every run behind a figure, those with hits first."""
    if not runs:
        return None
    ordered = sorted(runs, key=lambda run: (-run.hits, run.scenario, run.seed))
    items = [tag("li", _link(run, folder), f" {_share(run)}") for run in ordered]
    return tag("details", tag("summary", f"{len(runs)} runs"), tag("ul", items), class_="runs")


def _share(run: Run) -> str:
    return f"{run.hits}/{run.trials}" if run.value is None else f"{run.value:.3g}"


def _link(run: Run, folder: Path) -> Html:
    report = Path(run.run) / REPORT
    target = report if (folder / report).is_file() else Path(run.run)
    return tag("a", f"{run.scenario} {run.seed}", href=f"{target.as_posix()}{'' if target == report else '/'}")


def _spreads(table: Table, columns: Sequence[str], folder: Path) -> list[Html]:
    def shown(found: Spread | None) -> list[Html | None]:
        text = spread_text(found)
        return [tag("span", text, class_="frac"), _runs(() if found is None else found.runs, folder)]

    title = tag("tr", tag("td", tag("h3", "Mean ± standard deviation, largest, missions"), colspan=len(columns) + 1))
    rows = []
    for key, name in SPREADS.items():
        cells = [tag("td", shown(spread(table, key, c)), class_=_own(c)) for c in columns]
        rows.append(tag("tr", tag("td", name, class_="metric"), cells))
    return [title, *rows]
