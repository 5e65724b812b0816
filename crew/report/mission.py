"""One mission on the page: asked, read, proposed, decided and why, when, and how it ended."""

from collections.abc import Iterator, Mapping

from crew.contracts.explain.checks import Check
from crew.contracts.language.reading import noted_lines
from crew.contracts.mission.event import Answered
from crew.contracts.mission.provenance import sources
from crew.contracts.mission_state import ENDS, StepPhase, StepRecord
from crew.contracts.plan import Call
from crew.contracts.refusal import show
from crew.contracts.site import Rules
from crew.history.explanation import ALLOWED, ASKED, REFUSED, Explainer, Explanation
from crew.history.history import MissionHistory, Verdict
from crew.history.lanes import Lanes, lanes_of
from crew.records import DecisionRecord
from crew.report.html import Child, Html, join, tag
from crew.report.request import marked_request, meaning
from crew.report.timeline import timeline
from crew.visible import one_line

MAX_MENTIONS = 40


def mission_section(mission: MissionHistory, explainer: Explainer, rules: Rules, last_ns: int, number: str) -> Html:
    """Everything about one mission."""
    explained = [explainer.explain(v, search=_decisive(v, mission)) for v in mission.verdicts]
    return tag(
        "section",
        tag("h2", f"{number}Mission ", tag("span", mission.id, class_="mono"), " ", _pill(mission)),
        _ending(mission),
        tag("h3", "What was asked, and how it was read"),
        marked_request(mission.state.request, mission.state.reading),
        _reading(mission),
        _why(mission, explained),
        _plan(mission, rules),
        tag("h3", "What happened, seconds of mission time since the request"),
        _timeline(lanes_of(mission, last_ns)),
        _decisions(explained, mission.verdicts),
        _judgements(mission),
        id=f"mission-{mission.id}",
    )


def outcome_of(mission: MissionHistory) -> str:
    """How it ended, or `open` where the journal ends before."""
    return str(mission.state.phase) if mission.state.phase in ENDS else "open"


def _pill(mission: MissionHistory) -> Html:
    outcome = outcome_of(mission)
    refusal = mission.state.refusal
    code = f" · {refusal.code}" if refusal is not None and outcome in ("rejected", "halted") else ""
    words = f"not ended, {mission.state.phase}" if outcome == "open" else outcome
    return tag("span", f"{words}{code}", class_=f"pill {outcome}")


def _decisive(verdict: Verdict, mission: MissionHistory) -> bool:
    """Whether this is the last refusal of its mission."""
    refused = [v.number for v in mission.verdicts if v.refusal is not None]
    return bool(refused) and refused[-1] == verdict.number


def _reading(mission: MissionHistory) -> Html:
    reading = mission.state.reading
    items = [tag("li", tag("b", m.text), f" {meaning(m)}") for m in reading.mentions[:MAX_MENTIONS]]
    items += [tag("li", tag("b", u.word), " not understood", class_="asked") for u in reading.unread[:MAX_MENTIONS]]
    items += [tag("li", line) for line in noted_lines(reading)]
    items += [tag("li", f"ambiguous: {d.why}", class_="refused") for d in reading.ambiguous[:MAX_MENTIONS]]
    return tag("ul", items or tag("li", "nothing in it was understood"), class_="read")


def _ending(mission: MissionHistory) -> Html | None:
    """How it ended, where no panel below says so."""
    if outcome_of(mission) in ("rejected", "halted"):
        return None
    return tag("p", mission.state.message or "the journal ends before it did", class_="soft")


def _timeline(lanes: Lanes) -> Html:
    if not lanes.spans:
        return tag("p", "Nothing was sent to any robot.", class_="soft")
    return timeline(lanes)


# --- why it ended


def _why(mission: MissionHistory, explained: list[Explanation]) -> Html | None:
    """The refusal that the mission ended with, or the question that it asked."""
    ended = mission.state.refusal
    refused = [e for e in explained if e.outcome == REFUSED and ended is not None and e.code == ended.code]
    if refused and mission.state.phase not in ("completed",):
        return _panel(refused[-1])
    asked = [e for e in explained if e.outcome == ASKED]
    if asked:
        answers = [h.event.yes for h in mission.happenings if isinstance(h.event, Answered)]
        said = ("The answer was yes." if answers[-1] else "The answer was no.") if answers else "Nobody answered."
        return tag("div", tag("p", f"A person was asked: {asked[-1].sentence} {said}"), class_="why asked")
    if outcome_of(mission) in ("rejected", "halted"):
        facts = () if ended is None else (("code", str(ended.code)), ("where", ended.field))
        return tag("div", tag("p", mission.state.message), tag("dl", *_facts(facts)), class_="why")
    return None


def _panel(explained: Explanation) -> Html:
    line = explained.line
    words = ", ".join(f'"{w.text}" ({w.why})' for w in explained.words)
    facts = (
        ("decision", f"{explained.number}, {explained.subject}"),
        ("check", f"{explained.group}: {explained.code}"),
        ("where", explained.field),
        ("observed", explained.observed),
        ("allowed", explained.allowed),
        ("words of the request", words),
    )
    return tag(
        "div",
        tag("p", explained.sentence),
        tag("dl", *_facts(facts), *_line_fact(explained)),
        None if line is None or not line.text else tag("pre", line.text),
        _would(explained),
        class_="why",
    )


def _line_fact(explained: Explanation) -> Iterator[Html]:
    if explained.line is not None:
        missing = "" if explained.line.text else " (the file as it was then is not here)"
        yield from _facts((("contract's line", f"{explained.line}{missing}"),))


def _would(explained: Explanation) -> Html:
    if explained.change is None:
        return tag("p", "No small change was found that would have been accepted.", class_="would small soft")
    after = f" A person would still be asked: {explained.change.question}" if explained.change.question else ""
    return tag(
        "p",
        tag("b", "It would have been accepted "),
        f"with: {explained.change}.{after} ",
        tag("span", f"(decided by the gate; {explained.change.tried} cases tried)", class_="soft small"),
        class_="would",
    )


def _facts(facts: tuple[tuple[str, str], ...]) -> Iterator[Html]:
    for name, value in facts:
        if value:
            yield tag("dt", name)
            yield tag("dd", value)


# --- the plan


def _plan(mission: MissionHistory, rules: Rules) -> Html | None:
    """The last plan: matched to its contract with the source of each argument, or as it was proposed."""
    state = mission.state
    if state.plan is None:
        return None
    count = len(mission.proposals)
    again = f", after {count - 1} that was refused" if count > 1 else ""
    head = tag("h3", f"What was proposed by {state.planner or 'the planner'}: {state.plan.contract}{again}")
    instance = state.instance
    if instance is None or state.contract not in rules.contracts:
        rows = [_row(n, "", c, {}, None) for n, c in enumerate(state.plan.steps, start=1)]
    else:
        rows = [
            _row(
                n,
                s.step,
                s.call,
                sources(s, instance, state.reading, rules) if rules.kinds else {},
                state.steps[s.step],
            )
            for n, s in enumerate(instance.steps, start=1)
        ]
    rows += [_row(0, f"safe state of the {role}", r.call, {}, r) for role, r in state.safe.items()]
    columns = tag("tr", [tag("th", name, class_=c) for name, c in _COLUMNS])
    return join([head, tag("table", tag("thead", columns), tag("tbody", rows))])


_COLUMNS = (("", "n"), ("step", ""), ("call", ""), ("arguments, and where each came from", ""), ("outcome", ""))


def _row(number: int, step: str, call: Call, found: Mapping[str, str], record: StepRecord | None) -> Html:
    args = [
        tag("li", tag("b", name), f" = {show(value)} ", _source(found.get(name))) for name, value in call.args.items()
    ]
    return tag(
        "tr",
        tag("td", str(number) if number else "", class_="n"),
        tag("td", step, class_="fit"),
        tag("td", tag("b", call.robot), f".{call.skill}", class_="fit"),
        tag("td", tag("ul", args, class_="args") if args else tag("span", "none", class_="soft")),
        tag("td", _outcome(record), class_="out"),
    )


def _source(source: str | None) -> Html | None:
    return None if source is None else tag("span", source, class_="soft small")


def _outcome(record: StepRecord | None) -> Child:
    if record is None:
        return tag("span", "not decided", class_="pending")
    words = _SAID.get(record.phase, str(record.phase))
    places = "; ".join(f"{name} pinned to ({p.x:.2f}, {p.y:.2f})" for name, p in record.places.items())
    detail = one_line(" ".join(part for part in (record.code, record.detail) if part), 300)
    small = "; ".join(part for part in (detail, places) if part)
    kind = str(record.phase) if record.phase in _ENDED else "pending"
    return [tag("b", words, class_=kind), tag("div", small, class_="soft small") if small else None]


_ENDED = frozenset({StepPhase.SUCCEEDED, StepPhase.REFUSED, StepPhase.FAILED, StepPhase.CANCELLED, StepPhase.UNKNOWN})
_SAID = {
    StepPhase.PENDING: "never sent",
    StepPhase.DECIDING: "being decided",
    StepPhase.ASKING: "waiting for approval",
    StepPhase.SUCCEEDED: "done, effect observed",
    StepPhase.SENT: "sent, no answer recorded",
    StepPhase.RUNNING: "running when the journal ends",
    StepPhase.CONFIRMING: "said to be done, effect not yet observed",
}


# --- decisions


def _decisions(explained: list[Explanation], verdicts: list[Verdict]) -> Html | None:
    if not explained:
        return None
    entries = [_decision(e, v) for e, v in zip(explained, verdicts, strict=True)]
    return join([tag("h3", "What was decided, and why"), entries])


def _decision(explained: Explanation, verdict: Verdict) -> Html:
    code = "" if explained.code is None else f" {explained.code}"
    summary = tag(
        "summary",
        tag("span", str(explained.number), class_="n"),
        tag("span", f"{explained.at_s:.2f} s", class_="t"),
        tag("b", f"{explained.outcome}{code}", class_=explained.outcome),
        f"  {explained.subject}",
        " (never sent: the mission was ending)" if explained.never_sent else None,
    )
    body = _passed(explained.checks) if explained.outcome == ALLOWED else _refused(explained, verdict)
    return tag("details", summary, body, open=None if explained.outcome == ALLOWED else "")


def _passed(checks: tuple[Check, ...]) -> Html:
    """One row a check, its group named once."""
    rows, last = [], ""
    for check in checks:
        group = "" if check.group == last else str(check.group)
        last = str(check.group)
        facts = [check.observed, f"allowed: {check.allowed}" if check.allowed else ""]
        line = tag("span", f" {check.line}", class_="soft") if check.line else None
        cells = tag("td", group, class_="group"), tag("td", check.what, line), tag("td", "; ".join(filter(None, facts)))
        rows.append(tag("tr", cells))
    empty = tag("tr", tag("td", "its checks can't be made again by this version"))
    return tag("table", tag("tbody", rows or empty))


def _refused(explained: Explanation, verdict: Verdict) -> Html:
    """The sentence and its facts; of a plan also its calls, for the plan that is shown above may be a later one."""
    observed = f"Observed {explained.observed}" if explained.observed else ""
    allowed = f"allowed {explained.allowed}" if explained.allowed else ""
    line = f"line {explained.line}" if explained.line is not None else ""
    facts = "; ".join(filter(None, (observed, allowed, line)))
    calls = () if isinstance(verdict.record, DecisionRecord) else verdict.record.plan.steps
    lines = tag("pre", "\n".join(f"{n}. {one_line(str(c), 300)}" for n, c in enumerate(calls, start=1)))
    words = tag("p", explained.sentence, tag("br"), tag("span", facts, class_="soft"), class_="small")
    return join([words, lines if calls else None])


def _judgements(mission: MissionHistory) -> Html | None:
    """What telemetry was found to show at the end."""
    last = next((j.record for j in reversed(mission.judgements) if j.record.what == "complete"), None)
    if last is None:
        return None
    words = last.missing or "the contract's completion conditions were observed"
    return tag("p", tag("b", "Completion: "), words, class_="small")
