"""Guards with three values: holds, does not hold, unknown (absent or stale). Unknown never holds."""

import math
from collections.abc import Mapping
from enum import StrEnum

import msgspec

from crew.contracts.contract import Condition
from crew.contracts.plan import SlotValue, Spot
from crew.contracts.refusal import show
from crew.contracts.site import Rules
from crew.contracts.snapshot import FluentValue, Point, Snapshot, ValueReading

SECOND_NS = 1_000_000_000
FUTURE_NS = SECOND_NS // 2
"""How far a source's stamp may lie ahead of the orchestrator's clock."""


class Truth(StrEnum):
    """The three values of a guard; unknown says why."""

    HOLDS = "holds"
    FAILS = "fails"
    ABSENT = "absent"
    STALE = "stale"


class Verdict(msgspec.Struct, frozen=True):
    """A guard's value, with what was seen and how old it was."""

    truth: Truth
    seen: FluentValue = "nothing"
    age_s: float | None = None
    max_age_s: float | None = None

    @property
    def observed(self) -> str:
        """What was seen, as people write it."""
        return f"({self.seen.x:.2f}, {self.seen.y:.2f})" if isinstance(self.seen, Point) else show(self.seen)


class Scope(msgspec.Struct, frozen=True, kw_only=True):
    """What a guard's names mean: roles, slots, pinned places, and the world at one moment."""

    rules: Rules
    world: Snapshot
    now_ns: int
    roles: Mapping[str, str] = {}
    slots: Mapping[str, SlotValue] = {}
    pins: Mapping[str, Point] = {}
    """Run-time values as they were when a step that used them was dispatched."""


def applies(condition: Condition, scope: Scope) -> bool:
    """Whether the `if` in front of a guard is met by the slots' binding."""
    return all(_slot_is(scope.slots.get(slot), wanted) for slot, wanted in condition.when.items())


def _slot_is(value: SlotValue | None, wanted: str) -> bool:
    return value is not None if wanted == "given" else value == wanted


def evaluate(condition: Condition, scope: Scope) -> Verdict:
    """A guard's value in this scope. A guard whose `if` is not met holds."""
    if not applies(condition, scope):
        return Verdict(Truth.HOLDS, "not asked for")
    wanted = condition.value
    if isinstance(wanted, str) and wanted.startswith("$"):
        bound = scope.slots.get(wanted[1:])
        if bound is None:
            return Verdict(Truth.ABSENT)
        return _compare(condition.path, _as_fluent(bound), condition.negated, scope)
    return _compare(condition.path, wanted, condition.negated, scope)


def _as_fluent(value: SlotValue) -> FluentValue:
    if isinstance(value, Spot):
        return Point(value.x, value.y)
    return value if isinstance(value, str | float) else str(value)


def _compare(path: str, wanted: FluentValue, negated: bool, scope: Scope) -> Verdict:
    head, _, attribute = path.partition(".")
    if head in scope.roles and attribute:
        verdict = robot_fluent_is(scope.roles[head], attribute, wanted, scope)
    else:
        verdict = value_is(value_name(path, scope), attribute, wanted, scope)
    if not negated or verdict.truth in (Truth.ABSENT, Truth.STALE):
        return verdict
    flipped = Truth.FAILS if verdict.truth is Truth.HOLDS else Truth.HOLDS
    return msgspec.structs.replace(verdict, truth=flipped)


def value_name(path: str, scope: Scope) -> str:
    """The run-time value that a path speaks of: by its own name, or as a slot is bound."""
    head = path.partition(".")[0]
    bound = scope.slots.get(head)
    return bound if isinstance(bound, str) else head


def robot_fluent_is(robot: str, name: str, wanted: FluentValue, scope: Scope) -> Verdict:
    """Whether one robot's fluent has a value."""
    declared = scope.rules.fluent_of(robot, name)
    state = scope.world.robots.get(robot)
    stamped = None if state is None else state.fluents.get(name)
    if declared is None or stamped is None or not _finite(stamped.value):
        return Verdict(Truth.ABSENT, "nothing" if stamped is None else stamped.value)
    age_s = age(stamped.source_ns, scope.now_ns)
    if not 0.0 <= age_s <= declared.max_age_s:
        return Verdict(Truth.STALE, stamped.value, age_s, declared.max_age_s)
    same = stamped.value == wanted  # two objects at one place are still two
    held = _equal(stamped.value, wanted, declared.tolerance_m, scope) if declared.domain == "place" else same
    return Verdict(Truth.HOLDS if held else Truth.FAILS, stamped.value, age_s, declared.max_age_s)


def value_is(name: str, attribute: str, wanted: FluentValue, scope: Scope) -> Verdict:
    """Whether a run-time value's status (no attribute), nearness (`near`) or place (`at`) is as wanted."""
    stamped = scope.world.values.get(name)
    if stamped is None:
        return Verdict(Truth.ABSENT)
    seen = _attribute(stamped.reading, attribute)
    declared = scope.rules.publication(stamped.source, name)
    if declared is None or seen is None or not _finite(seen):
        return Verdict(Truth.ABSENT, stamped.reading.status if seen is None else seen)
    age_s = age(stamped.reading.stamp_ns, scope.now_ns)
    if not 0.0 <= age_s <= declared.max_age_s:
        return Verdict(Truth.STALE, seen, age_s, declared.max_age_s)
    held = _equal(seen, wanted, declared.tolerance_m, scope)
    return Verdict(Truth.HOLDS if held else Truth.FAILS, seen, age_s, declared.max_age_s)


def _attribute(reading: ValueReading, name: str) -> FluentValue | None:
    """What a reading says of an attribute; where a value is, and how near, is known only while it is seen."""
    if name in ("", "status"):
        return reading.status
    if reading.status != "ok":
        return None
    return reading.near if name == "near" else reading.position if name == "at" else None


def age(source_ns: int, now_ns: int) -> float:
    """Seconds since the source's stamp; a stamp slightly ahead counts as fresh, one far ahead as negative."""
    behind_ns = now_ns - source_ns
    return 0.0 if -FUTURE_NS <= behind_ns < 0 else behind_ns / SECOND_NS


def _finite(value: FluentValue) -> bool:
    if isinstance(value, Point):
        return all(map(math.isfinite, (value.x, value.y, value.z)))
    return not isinstance(value, float) or math.isfinite(value)


def _equal(observed: FluentValue, wanted: FluentValue, tolerance_m: float, scope: Scope) -> bool:
    if observed == wanted:
        return True
    a, b = _point(observed, scope), _point(wanted, scope)
    if a is None or b is None:
        return False
    return math.hypot(a.x - b.x, a.y - b.y) <= tolerance_m + _standoff(wanted, scope)


def _point(value: FluentValue, scope: Scope) -> Point | None:
    if isinstance(value, Point):
        return value
    return place(value, scope) if isinstance(value, str) else None


def _standoff(value: FluentValue, scope: Scope) -> float:
    declared = scope.rules.crew.value(value) if isinstance(value, str) else None
    return 0.0 if declared is None else declared.standoff_m


def place(name: str, scope: Scope) -> Point | None:
    """The place that a name means: as it was pinned at dispatch, a location's, or a run-time value's."""
    if name in scope.pins:
        return scope.pins[name]
    location = scope.rules.crew.location(name)
    if location is not None:
        return Point(location.x, location.y)
    stamped = scope.world.values.get(name)
    position = None if stamped is None else stamped.reading.position
    return position if position is not None and _finite(position) else None
