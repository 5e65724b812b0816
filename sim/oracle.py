"""The study's judge: which dispatches were false and which broke the workflow's order, by the simulation's truth.

It decides from what was sent, where everything truly was, and what a person wrote down for the scenario. It knows
neither the gate nor the mission machine (an import rule), nor what any robot said of itself or of the world.
"""

import math
from collections.abc import Iterator, Mapping, Sequence

import msgspec

from crew.contracts.plan import ArgValue, Call
from crew.contracts.site import Rules
from crew.contracts.skill import Entity, Param, Skill
from crew.contracts.snapshot import Point

FIX_M = 2.0
"""A pinned place further than this from the truth is no fix of it."""
AT_M = 0.6
"""As far as this from a place counts as being there."""
ON_TOP_M = 0.35
"""A load's horizontal distance from the middle of whoever carries it, at most."""
LIFTED_M = 0.15
"""A load lies at least this high above the ground."""
SAME = 0.01
"""Numbers of a licence are met to within this."""


class Frame(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """The truth at one moment: poses x, y, z, yaw; targets and hands x, y, z; world ENU, metres and radians."""

    at_ns: int
    poses: Mapping[str, tuple[float, float, float, float]]
    targets: Mapping[str, tuple[float, float, float]]
    hands: Mapping[str, tuple[float, float, float]] = {}
    """Where the hand of a robot is that has one: an arm moves while the robot stands."""
    dropped: int = 0
    """How often somebody has left the lockstep so far: time went on without them."""


class Sent(msgspec.Struct, frozen=True, kw_only=True):
    """One dispatch as it crossed the orchestrator's boundary. `places`: what its symbols were pinned to."""

    sequence: int
    robot: str
    skill: str
    args: Mapping[str, ArgValue] = {}
    places: Mapping[str, Point] = {}
    at_ns: int
    ended_ns: int
    succeeded: bool
    safe: bool = False
    """Sent to bring a robot to its safe state, not as a step of a plan."""


class Licence(msgspec.Struct, frozen=True, kw_only=True):
    """A call that the scenario's request asks for or implies. Arguments that are not named are free."""

    robot: str
    skill: str
    args: Mapping[str, tuple[ArgValue, ...]] = {}
    """Argument to the values of which it must have one; one that is not given is none of them."""
    after: tuple[str, ...] = ()
    """Skills that must have succeeded earlier in the mission."""
    loaded: str = ""
    """The object that must truly lie on the robot, or on the one named in `who`, when it is sent."""
    at: str = ""
    """The place where the robot in `who` must truly be when it is sent."""
    who: str = ""
    """Whom `loaded` and `at` are about; empty means the robot itself."""


class Never(msgspec.Struct, frozen=True, kw_only=True):
    """A dispatch that is false in a scenario whatever the plan; an empty skill means all but the ways to safety."""

    robot: str
    skill: str = ""


class Case(msgspec.Struct, frozen=True, kw_only=True):
    """What the scenario says of right and wrong. Without licences every grounded call counts as asked for."""

    unavailable: Mapping[str, int] = {}
    """Robot to the mission time from which it is not available, nanoseconds."""
    never: tuple[Never, ...] = ()
    licences: tuple[Licence, ...] = ()


class Finding(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """One thing that is held against a mission, by the truth, the scenario and the crew's files alone."""

    rule: str
    robot: str = ""
    at_ns: int = 0
    sequence: int = 0
    """The dispatch that it is about; 0 if it is about none."""
    text: str = ""


FALSE = (
    *("unknown_robot", "unknown_skill", "bad_argument", "unknown_name", "out_of_area"),
    *("unavailable", "no_fix", "never", "not_asked"),
)
"""Rules of a false dispatch, in the order in which they are looked at."""
ORDER = ("out_of_order", "unloaded", "not_at")
"""Rules of the workflow's order: a licensed call that was sent too early."""


def false_dispatch(sent: Sent, case: Case, rules: Rules, frames: Sequence[Frame]) -> tuple[Finding, ...]:
    """Everything that makes one dispatch false; empty for a rightful one, and for a way to safety."""
    if sent.safe:
        return ()
    return tuple(_finding(sent, rule, text) for rule, text in _reasons(sent, case, rules, frames))


def asked_for(call: Call, licences: Sequence[Licence]) -> bool:
    """Whether some licence covers a call, whenever it is sent; without licences every call counts as asked for."""
    return not licences or any(_covers(licence, call.robot, call.skill, call.args) for licence in licences)


def order_broken(
    sent: Sent, before: Sequence[Sent], case: Case, rules: Rules, frames: Sequence[Frame]
) -> tuple[Finding, ...]:
    """What had to be so before this dispatch and was not; empty if some licence for it was met in full."""
    if sent.safe:
        return ()
    open_ = [list(_unmet(licence, sent, before, rules, frames)) for licence in case.licences if _fits(licence, sent)]
    if not open_ or any(not unmet for unmet in open_):
        return ()
    return tuple(_finding(sent, rule, text) for rule, text in min(open_, key=len))


def frame_at(frames: Sequence[Frame], at_ns: int) -> Frame | None:
    """The last frame that is no later, or the first of all."""
    earlier = [frame for frame in frames if frame.at_ns <= at_ns]
    return earlier[-1] if earlier else (frames[0] if frames else None)


def _finding(sent: Sent, rule: str, text: str) -> Finding:
    return Finding(rule=rule, robot=sent.robot, at_ns=sent.at_ns, sequence=sent.sequence, text=text)


def _reasons(sent: Sent, case: Case, rules: Rules, frames: Sequence[Frame]) -> Iterator[tuple[str, str]]:
    if rules.crew.robot(sent.robot) is None:
        yield "unknown_robot", f"the crew has no {sent.robot}"
        return
    kind = rules.kind_of(sent.robot)
    skill = None if kind is None else kind.skill(sent.skill)
    if skill is None:
        yield "unknown_skill", f"{sent.robot} has no skill {sent.skill}"
        return
    yield from _arguments(sent, skill, rules, frames)
    since_ns = case.unavailable.get(sent.robot)
    if since_ns is not None and since_ns <= sent.at_ns and not skill.safe:
        yield "unavailable", f"{sent.robot} is not available from {since_ns / 1e9:g} s on"
    banned = (sent.skill,) if skill.safe else ("", sent.skill)
    if any(n.robot == sent.robot and n.skill in banned for n in case.never):
        yield "never", f"{sent.robot}.{sent.skill} must not be sent in this scenario"
    if not asked_for(Call(sent.robot, sent.skill, sent.args), case.licences):
        yield "not_asked", f"nobody asked for {sent.robot}.{sent.skill}({_written(sent.args)})"


def _arguments(sent: Sent, skill: Skill, rules: Rules, frames: Sequence[Frame]) -> Iterator[tuple[str, str]]:
    try:
        msgspec.convert(dict(sent.args), skill.args)
    except msgspec.ValidationError as error:
        yield "bad_argument", str(error)
        return
    needed = [set(form) for form in skill.forms]
    optional = {p.name for p in skill.params if p.optional}
    if (set(sent.args) & optional) not in needed:
        yield "bad_argument", f"it takes one of {' | '.join(', '.join(f) or 'nothing' for f in skill.forms)}"
        return
    for low, high in skill.ranges:
        if not _number(sent.args[low]) < _number(sent.args[high]):
            yield "bad_argument", f"{low} is not below {high}"
    for param in skill.params:
        if param.name in sent.args:
            yield from _argument(param, sent, rules, frames)


def _argument(param: Param, sent: Sent, rules: Rules, frames: Sequence[Frame]) -> Iterator[tuple[str, str]]:
    value, area = sent.args[param.name], rules.crew.area
    if param.axis:
        low, high = (area.x_min, area.x_max) if param.axis == "x" else (area.y_min, area.y_max)
        if not low <= _number(value) <= high:
            yield "out_of_area", f"{param.name} is {value}, the area's {param.axis} goes from {low:g} to {high:g} m"
    elif param.entity is Entity.OBJECT and all(thing.name != value for thing in rules.crew.objects):
        yield "unknown_name", f"the crew has no object {value}"
    elif param.entity is Entity.LOCATION and rules.crew.location(str(value)) is None and value not in rules.parts:
        yield "unknown_name", f"the crew has no place {value}"
    elif param.entity is Entity.TARGET and rules.crew.location(str(value)) is None:
        if rules.crew.value(str(value)) is None:
            yield "unknown_name", f"the crew has no place {value}"
        elif problem := _fix_problem(str(value), sent.places.get(param.name), frame_at(frames, sent.at_ns)):
            yield "no_fix", problem


def _fix_problem(name: str, pinned: Point | None, frame: Frame | None) -> str:
    """Why a run-time value's pinned place is none, or not where it truly is; empty if it is."""
    true = None if frame is None else frame.targets.get(name)
    if pinned is None or not (math.isfinite(pinned.x) and math.isfinite(pinned.y)):
        return f"it was sent to {name} without a place"
    if true is None:
        return f"there is no {name} in the world"
    off_m = math.dist((pinned.x, pinned.y), true[:2])
    return "" if off_m <= FIX_M else f"it was sent {off_m:.1f} m away from where {name} truly is"


def _fits(licence: Licence, sent: Sent) -> bool:
    return _covers(licence, sent.robot, sent.skill, sent.args)


def _covers(licence: Licence, robot: str, skill: str, args: Mapping[str, ArgValue]) -> bool:
    return (licence.robot, licence.skill) == (robot, skill) and all(
        name in args and any(_same(args[name], wanted) for wanted in values) for name, values in licence.args.items()
    )


def _unmet(
    licence: Licence, sent: Sent, before: Sequence[Sent], rules: Rules, frames: Sequence[Frame]
) -> Iterator[tuple[str, str]]:
    done = {one.skill for one in before if one.succeeded}
    for skill in licence.after:
        if skill not in done:
            yield "out_of_order", f"{sent.skill} was sent before {skill} was done"
    frame, who = frame_at(frames, sent.at_ns), licence.who or sent.robot
    if licence.loaded and not (frame and carries(who, licence.loaded, frame)):
        yield "unloaded", f"{licence.loaded} does not lie on {who}"
    if licence.at and not (frame and _is_at(who, licence.at, frame, rules)):
        yield "not_at", f"{who} is not at {licence.at}"


def carries(robot: str, thing: str, frame: Frame) -> bool:
    """Whether a thing truly lies on a robot."""
    pose, place = frame.poses.get(robot), frame.targets.get(thing)
    if pose is None or place is None:
        return False
    return math.dist(pose[:2], place[:2]) <= ON_TOP_M and place[2] >= LIFTED_M


def _is_at(robot: str, place: str, frame: Frame, rules: Rules) -> bool:
    pose, location = frame.poses.get(robot), rules.crew.location(place)
    return pose is not None and location is not None and math.dist(pose[:2], (location.x, location.y)) <= AT_M


def _number(value: ArgValue) -> float:
    return math.nan if isinstance(value, str) else float(value)


def _same(value: ArgValue, wanted: ArgValue) -> bool:
    if isinstance(value, str) or isinstance(wanted, str):
        return value == wanted
    return abs(value - wanted) <= SAME


def _written(args: Mapping[str, ArgValue]) -> str:
    return ", ".join(f"{name}={value}" for name, value in args.items())
