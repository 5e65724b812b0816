"""What was asked, proposed and decided, as markdown."""

from collections.abc import Iterator, Mapping

from crew.actors.recorder.text import quoted
from crew.contracts.mission.provenance import sources
from crew.contracts.mission_state import MissionState, StepPhase
from crew.contracts.plan import Call, Plan
from crew.contracts.refusal import Refusal
from crew.contracts.site import Rules

MAX_STEPS = 40
_WORDS = {
    StepPhase.PENDING: "not yet",
    StepPhase.DECIDING: "at the gate",
    StepPhase.ASKING: "**waits for approval**",
    StepPhase.SENT: "sent",
    StepPhase.RUNNING: "**running**",
    StepPhase.CONFIRMING: "looking for its effect",
    StepPhase.SUCCEEDED: "done",
    StepPhase.REFUSED: "**refused**",
    StepPhase.FAILED: "**failed**",
    StepPhase.CANCELLED: "cancelled",
    StepPhase.UNKNOWN: "**outcome unknown**",
}
Refused = tuple[Plan, str, Refusal]
"""A plan that was refused, who proposed it, and why."""


def proposal(mission: MissionState, refused: tuple[Refused, ...], rules: Rules) -> str:
    """One mission: its request, the plans that were refused, the plan that stands, and how it goes."""
    return "\n".join(_lines(mission, refused, rules))


def _lines(mission: MissionState, refused: tuple[Refused, ...], rules: Rules) -> Iterator[str]:
    yield f'### "{quoted(mission.request)}"\n'
    for plan, planner, why in refused:
        yield f"**Refused** {quoted(plan.contract, 60)}, proposed by {quoted(planner, 60)}\n"
        yield from _refusal(why)
        yield from _plan_table(plan)
    if mission.instance is not None:
        yield f"**Accepted** {quoted(mission.contract, 60)}, proposed by {quoted(mission.planner, 60)}\n"
        yield from _instance_table(mission, rules)
    elif mission.plan is None and mission.message:
        yield f"No plan: {quoted(mission.message)}\n"
    if mission.question is not None:
        yield f"**Asked:** {quoted(mission.question.text, 600)}\n"
    yield f"**{mission.phase}** {quoted(mission.message, 600)}\n"
    if mission.refusal is not None and mission.instance is not None:
        yield from _refusal(mission.refusal)


def _refusal(why: Refusal) -> Iterator[str]:
    yield f"`{why.code}` {quoted(why.message, 600)}\n"
    facts = {"where": why.field, "observed": why.observed, "allowed": why.allowed, "contract": why.line}
    for name, fact in facts.items():
        if fact:
            yield f"- {name}: {quoted(fact)}"
    yield ""


def _plan_table(plan: Plan) -> Iterator[str]:
    for number, call in enumerate(plan.steps[:MAX_STEPS], start=1):
        yield f"{number}. {quoted(str(call))}"
    if len(plan.steps) > MAX_STEPS:
        yield f"\n... and {len(plan.steps) - MAX_STEPS} more steps"
    yield ""


def _instance_table(mission: MissionState, rules: Rules) -> Iterator[str]:
    assert mission.instance is not None
    yield "| step | call | now |"
    yield "|---|---|---|"
    for step in mission.instance.steps:
        record = mission.steps[step.step]
        code = f" {quoted(record.code, 60)}" if record.code else ""
        call = quoted(f"{step.call.robot}.{step.call.skill}")
        yield f"| {quoted(step.step, 60)} | {call} | {_WORDS[record.phase]}{code} |"
    yield ""
    for step in mission.instance.steps:
        yield from _arguments(step.call, sources(step, mission.instance, mission.reading, rules))
    yield ""


def _arguments(call: Call, origin: Mapping[str, str]) -> Iterator[str]:
    """One line for all arguments of a call that come from the same place."""
    grouped: dict[str, list[str]] = {}
    for name, value in call.args.items():
        shown = value if isinstance(value, str) else f"{value:g}"
        grouped.setdefault(origin.get(name, ""), []).append(f"{quoted(name, 60)} = **{quoted(shown, 60)}**")
    for source, names in grouped.items():
        yield f"- {quoted(call.skill, 60)} {', '.join(names)}: {quoted(source)}"
