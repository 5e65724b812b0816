"""A study's tables as CSV, Markdown and LaTeX, from the figures alone."""

import csv
import io
import math
from collections.abc import Iterator, Sequence

from crew.study.metrics import AFTER, METRICS, Fraction, Run, Spread, Table
from crew.study.statistics import Interval, wilson

HEADS = {
    "llm-only": "LLM-only",
    "skill-list": "Skill-list",
    "ro-prompt": "RO-prompt",
    "ro": "RO",
    AFTER: "RO after its replan",
}
SPREADS = {"planning_latency": "Planning latency", "fix_error": "Fix error", "delivery_error": "Delivery error"}
GROUPS = {"proposed": "Planner behaviour: what was proposed", "sent": "Execution outcomes: what reached the robots"}
MODEL_OF_ERRORS = "The planner is a model of errors, not a language model: its rates are chosen (docs/planner.md)."
FIELDS = (
    *("testbed", "version", "planner", "model", "metric", "column", "seed", "hits", "trials", "share"),
    *("wilson_low", "wilson_high", "bootstrap_low", "bootstrap_high", "fisher_p"),
)


def csv_text(tables: Sequence[Table]) -> str:
    """One row a figure over all seeds (`seed` is `all`), then one for each seed; empty where nothing is known."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(FIELDS)
    for table in tables:
        for figure in table.fractions:
            writer.writerows(_rows(table, figure))
    return out.getvalue()


def _rows(table: Table, figure: Fraction) -> Iterator[list[str]]:
    about = [table.testbed, table.version, table.planner, table.model, figure.metric, figure.column]
    ends = (figure.wilson.low, figure.wilson.high, figure.bootstrap.low, figure.bootstrap.high, figure.p)
    yield [*about, "all", str(figure.hits), str(figure.trials), _plain(figure.share), *map(_plain, ends)]
    for seed in table.seeds:
        mine = [run for run in figure.runs if run.seed == seed]
        hits, trials = sum(r.hits for r in mine), sum(r.trials for r in mine)
        own = wilson(hits, trials)
        share = hits / trials if trials else None
        yield [*about, str(seed), str(hits), str(trials), _plain(share), _plain(own.low), _plain(own.high), "", "", ""]


def _plain(value: float | None) -> str:
    return "" if value is None or not math.isfinite(value) else f"{value:.6g}"


def markdown(tables: Sequence[Table]) -> str:
    """Every table, with the numerator and denominator of each figure."""
    return "\n".join(("# The study", "", *(line for table in tables for line in _markdown(table)))) + "\n"


def _markdown(table: Table) -> Iterator[str]:
    columns = shown_columns(table)
    yield f"## {table.testbed}"
    yield ""
    yield about(table)
    yield ""
    if table.planner.endswith("fallible"):
        yield f"**{MODEL_OF_ERRORS}**"
        yield ""
    yield "Per cent, Wilson's 95 % interval, numerator of denominator; in braces the bootstrap over scenarios. p is"
    yield "that of Fisher's exact test against RO, two-sided. ↓: less is better. Definitions: docs/study/metrics.md."
    yield ""
    yield f"| | {' | '.join(HEADS[c] for c in columns)} |"
    yield f"|---|{'---|' * len(columns)}"
    for group, title in GROUPS.items():
        yield f"| *{title}* |{' |' * len(columns)}"
        for metric in METRICS:
            if metric.group == group:
                cells = [_markdown_cell(cell(table, metric.name, column)) for column in columns]
                yield f"| {metric.title}{' ↓' if metric.falling else ''} | {' | '.join(cells)} |"
    for name, title in SPREADS.items():
        yield f"| {title} | {' | '.join(spread_text(spread(table, name, c)) for c in columns)} |"
    yield ""
    yield from (f"{line}" for line in remarks(table))
    yield ""


def about(table: Table) -> str:
    """What the table was made from, in one sentence."""
    model = f", model {table.model}" if table.model else ""
    seeds = ", ".join(map(str, table.seeds))
    return f"{table.scenarios} scenarios; seeds {seeds}; planner {table.planner}{model}; version {table.version}."


def remarks(table: Table) -> Iterator[str]:
    """What a reader should know beside the figures."""
    unplanned = ", ".join(f"{HEADS[arm]} {count}" for arm, count in table.unplanned.items() if count)
    yield f"Missions without a readable first proposal: {unplanned or 'none'}."
    yield f"Nominal missions refused needlessly: {_named(table.needless)}. Asked back: {_named(table.asked)}."


def _named(runs: Sequence[Run]) -> str:
    return ", ".join(f"{run.scenario} ({run.run})" for run in runs) or "none"


def shown_columns(table: Table) -> tuple[str, ...]:
    """The table's arms, and RO after its replan."""
    return table.columns


def cell(table: Table, metric: str, column: str) -> Fraction | None:
    """A figure; None where the column has none (what was sent has no `after`)."""
    return next((f for f in table.fractions if (f.metric, f.column) == (metric, column)), None)


def spread(table: Table, metric: str, column: str) -> Spread | None:
    return next((s for s in table.spreads if (s.metric, s.column) == (metric, column)), None)


def per_cent(interval: Interval) -> str:
    """`[37, 65]`, or nothing."""
    return f"[{100 * interval.low:.0f}, {100 * interval.high:.0f}]" if interval.known else ""


def share_text(figure: Fraction) -> str:
    """`51 [37, 65]`, or `none`."""
    return "none" if figure.share is None else f"{100 * figure.share:.0f} {per_cent(figure.wilson)}"


def p_text(p: float) -> str:
    return "" if not math.isfinite(p) else f"p={p:.1e}" if p < 0.01 else f"p={p:.2f}"


def spread_text(found: Spread | None) -> str:
    """`0.21 ± 0.04, ≤ 0.31 m (12)`: mean, standard deviation, largest, number of missions."""
    if found is None or not found.runs:
        return "" if found is None else "none"
    spread_, largest = f"{found.mean:.3g} ± {found.deviation:.2g}", f"≤ {found.largest:.3g} {found.unit}"
    return f"{spread_}, {largest} ({len(found.runs)})"


def _markdown_cell(figure: Fraction | None) -> str:
    if figure is None:
        return ""
    braces = f" {{{per_cent(figure.bootstrap)[1:-1]}}}" if figure.bootstrap.known else ""
    told = ", ".join(part for part in (f"{figure.hits}/{figure.trials}{braces}", p_text(figure.p)) if part)
    return f"{share_text(figure)}<br>{told}"


def latex(tables: Sequence[Table]) -> str:
    """One `table*` a testbed, in the layout of the paper's; needs booktabs."""
    return "\n".join(line for table in tables for line in _latex(table)) + "\n"


def _latex(table: Table) -> Iterator[str]:
    columns = shown_columns(table)
    label = f" {MODEL_OF_ERRORS}" if table.planner.endswith("fallible") else ""
    yield r"\begin{table*}[t]"
    yield r"\centering"
    yield rf"\caption{{{_tex(table.testbed)}: {_tex(about(table))}{_tex(label)} Brackets: 95\% Wilson intervals.}}"
    yield rf"\begin{{tabular}}{{l{'l' * len(columns)}}}"
    yield r"\toprule"
    yield rf"Metric (\%) & {' & '.join(_tex(HEADS[c]) for c in columns)}\\"
    for group, title in GROUPS.items():
        yield r"\midrule"
        yield rf"\multicolumn{{{len(columns) + 1}}}{{l}}{{\textit{{{_tex(title)}}}}}\\"
        for metric in METRICS:
            if metric.group == group:
                cells = [_latex_cell(cell(table, metric.name, column)) for column in columns]
                arrow = r" $\downarrow$" if metric.falling else ""
                yield rf"{_tex(metric.title)}{arrow} & {' & '.join(cells)}\\"
    yield r"\midrule"
    for name, title in SPREADS.items():
        yield rf"{title} & {' & '.join(_tex(spread_text(spread(table, name, c))) for c in columns)}\\"
    yield r"\bottomrule"
    yield r"\end{tabular}"
    yield r"\end{table*}"


def _latex_cell(figure: Fraction | None) -> str:
    if figure is None:
        return "--"
    return _tex(f"{share_text(figure)} ({figure.hits}/{figure.trials})")


def _tex(text: str) -> str:
    for sign in "&%_#$":
        text = text.replace(sign, f"\\{sign}")
    return text.replace("±", r"$\pm$").replace("≤", r"$\le$")
