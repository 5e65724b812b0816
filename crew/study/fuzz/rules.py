"""What must be true of everything that is sent, judged by declarations, request and world; never with the gate.

It imports neither gate, matcher, machine nor reader: a rule of import-linter. Ages are whole nanoseconds.
"""

import math
from collections.abc import Iterator, Mapping

import msgspec

from crew.contracts.contract import Condition, Contract
from crew.contracts.plan import ArgValue, Call, Plan, Zone
from crew.contracts.site import Rules
from crew.contracts.skill import Entity, FluentLiteral, Kind, Skill
from crew.contracts.snapshot import FluentValue, Point, RobotState, Snapshot, StampedValue
from crew.study.fuzz.wish import Wish
from crew.study.soundness import inadmissible, ungrounded

APPROVAL_NS = 10_000_000_000
"""For how long a person's yes holds."""
AHEAD_NS = 500_000_000
"""How far ahead of the orchestrator's clock a source's stamp may lie."""


class Approved(msgspec.Struct, frozen=True):
    """A person's yes: when it was given, and what was shown: the call, what the robot told in words, the places."""

    at_ns: int
    call: Call
    words: Mapping[str, FluentValue]
    places: Mapping[str, Point]


class Moment(msgspec.Struct, frozen=True, kw_only=True):
    """One call that is about to be sent, and all that bears on it. Book is kept by the driver, not by the machine."""

    call: Call
    step: str
    safe: bool = False
    mission: str
    plan: Plan
    wish: Wish
    rules: Rules
    world: Snapshot
    now_ns: int
    started_ns: int
    steps: Mapping[str, Call]
    """The contract's steps that the plan fills."""
    sent: Mapping[str, int]
    """Steps sent so far, with when; nanoseconds of mission time."""
    done: frozenset[str]
    """Steps whose effect truly took place after they were sent."""
    busy: frozenset[str]
    """Robots with a call in flight."""
    over: str
    """Why nothing of the plan may be sent any more; empty if it may."""
    places: Mapping[str, Point]
    approved: Approved | None = None
    """The last yes to this step."""
    faults: tuple[str, ...] = ()
    """What `wrong_plan` says of the plan: the same at each of its steps."""

    @property
    def contract(self) -> Contract | None:
        return self.rules.contracts.get(self.plan.contract)

    @property
    def roles(self) -> dict[str, str]:
        """Role to robot, read off the contract's steps."""
        contract = self.contract
        declared = {} if contract is None else {s.name: s.role for s in contract.steps}
        return {declared[name]: call.robot for name, call in self.steps.items() if name in declared}

    @property
    def slots(self) -> dict[str, ArgValue]:
        """The contract's variables as the plan's calls bind them, and the origin that the person named."""
        bound: dict[str, ArgValue] = {"origin": self.wish.origin} if self.wish.origin else {}
        contract = self.contract
        for step in () if contract is None else contract.steps:
            call = self.steps.get(step.name)
            for pattern in step.do:
                if call is not None and pattern.skill == call.skill and set(pattern.args) == set(call.args):
                    marked = {n: w for n, w in pattern.args.items() if isinstance(w, str) and w.startswith("$")}
                    bound |= {wanted[1:]: call.args[name] for name, wanted in marked.items()}
        return bound


def broken(m: Moment) -> Iterator[str]:
    """Every rule that sending this call now would break, as `rule: what`. None means that it may be sent."""
    if m.safe:
        yield from _safe(m)
    else:
        yield from m.faults
        yield from _sequence(m)
    why = ungrounded(m.call, m.rules)
    if why:
        yield f"grounded: {why}"
        return
    yield from _robot(m)
    if not m.safe:
        yield from _conditions(m)
        yield from _approval(m)
        yield from _never(m)
    yield from _places(m)


def wrong_plan(plan: Plan, wish: Wish, rules: Rules) -> Iterator[str]:
    """Why a plan is not what the person means, or not what its contract admits."""
    strange = next((call for call in plan.steps if not wish.means(call)), None)
    if strange is not None:
        yield f"asked: nobody asked for {strange}"
    if plan.contract != wish.contract:
        yield f"asked: it is {wish.contract or 'nothing'}, not {plan.contract}, that was asked for"
    if dropped := wish.dropped(plan.steps):
        yield f"asked: {dropped} was asked for, and is not planned"
    if why := inadmissible(plan.contract, plan.steps, rules):
        yield f"admissible: {why}"


def _sequence(m: Moment) -> Iterator[str]:
    if m.over:
        yield f"over: {m.over}"
    if m.step in m.sent:
        yield f"once: {m.step} was sent before"
    if m.steps.get(m.step) != m.call or sorted(map(str, m.steps.values())) != sorted(map(str, m.plan.steps)):
        yield f"planned: {m.call} is not what the plan says for {m.step}"
    waiting = [name for name in earlier(m.contract, m.step) if name in m.steps and name not in m.done]
    if waiting:
        yield f"order: {', '.join(sorted(waiting))} has not been done"
    limit_ns = 0 if m.contract is None else round(m.contract.deadline_s * 1e9)
    if m.now_ns - m.started_ns > limit_ns:
        yield "deadline: the mission's time is over"


def earlier(contract: Contract | None, step: str) -> set[str]:
    """Every step that must come before one."""
    after = {} if contract is None else {s.name: s.after for s in contract.steps}
    found: set[str] = set()
    waiting = list(after.get(step, ()))
    while waiting:
        name = waiting.pop()
        found.add(name)
        waiting += [n for n in after.get(name, ()) if n not in found]
    return found


def _safe(m: Moment) -> Iterator[str]:
    role = m.step.removeprefix("safe:")
    declared = None if m.contract is None else next((r for r in m.contract.roles if r.name == role), None)
    wanted = None if declared is None or declared.safe is None else declared.safe.by
    if m.call.skill != wanted or m.call.args or m.roles.get(role) != m.call.robot:
        yield f"safe: {m.call} is no declared way to safety of {role}"


def _robot(m: Moment) -> Iterator[str]:
    name, state = m.call.robot, m.world.robots.get(m.call.robot)
    if m.world.stopped or (state is not None and state.stopped):
        yield "stopped: a stop is in force"
    if state is None:
        yield f"available: {name} was never heard of"
        return
    kind = _kind(name, m.rules)
    if state.unavailable or state.kind_digest != kind.digest:
        yield f"available: {name} is {state.unavailable or 'of another kind than declared'}"
    if state.lease != m.mission:
        yield f"lease: {name} belongs to {state.lease or 'nobody'}"
    if name in m.busy or state.running:
        yield f"busy: {name} is at work"
    skill = _skill(m.call, m.rules)
    watched = set(skill.effects) if m.safe else set(state.fluents)
    own = [fluent for fluent in kind.fluents if fluent.relation is None]
    for fluent in own:
        stamped = state.fluents.get(fluent.name)
        if fluent.name in watched and stamped is not None and not _fresh(stamped.source_ns, fluent.max_age_s, m.now_ns):
            yield f"fresh: {name}.{fluent.name} is {(m.now_ns - stamped.source_ns) / 1e9:.9f} s old"
    if not any(f.name in state.fluents and f.name in watched for f in own):
        yield f"fresh: nothing was heard of {name}"
    for fluent_name, wanted in {**skill.needs, **({} if m.safe else skill.step_needs)}.items():
        if _seen(state, fluent_name, kind, m.now_ns) != wanted:
            yield f"needs: {name}.{fluent_name} is not seen to be {wanted}"


def _conditions(m: Moment) -> Iterator[str]:
    contract = m.contract
    if contract is None:
        return
    step = next((s for s in contract.steps if s.name == m.step), None)
    for condition in (*(() if m.sent else contract.needs), *(() if step is None else step.needs)):
        if not holds(condition, m):
            yield f"guard: {condition} does not hold"
    if not m.sent and m.wish.near is not None:
        near = _value(m.world, "requester", m)
        if near is None or near.reading.near is not m.wish.near:
            yield "guard: the person is not where the request means"


def _approval(m: Moment) -> Iterator[str]:
    step = None if m.contract is None else next((s for s in m.contract.steps if s.name == m.step), None)
    if step is None or not step.approval:
        return
    if m.approved is None:
        yield "approval: nobody has approved it"
    elif not 0 <= m.now_ns - m.approved.at_ns <= APPROVAL_NS:
        yield f"approval: it was given {(m.now_ns - m.approved.at_ns) / 1e9:.9f} s ago"
    elif (m.approved.call, m.approved.places) != (m.call, m.places):
        yield "approval: it was given for another call or another place"
    elif m.approved.words != words_of(m.world.robots.get(m.call.robot)):
        yield "approval: the robot is not as it was when it was approved"


def words_of(state: RobotState | None) -> dict[str, FluentValue]:
    """What a robot tells that is no figure: an approval is bound to it."""
    fluents = {} if state is None else state.fluents
    return {name: told.value for name, told in fluents.items() if not isinstance(told.value, float | Point)}


def _never(m: Moment) -> Iterator[str]:
    for contract in m.rules.contracts.values():
        for rule in contract.never:
            role, _, skill = rule.starts.partition(".")
            if skill != m.call.skill or contract.name != m.plan.contract or m.roles.get(role) != m.call.robot:
                continue
            same = all(m.call.args.get(name) == value for name, value in rule.with_args.items())
            other = all(m.call.args.get(name) != value for name, value in rule.without_args.items())
            if same and other and all(holds(c, m) for c in rule.when):
                yield f"never: {rule.why}"


def _places(m: Moment) -> Iterator[str]:
    for param in _skill(m.call, m.rules).params:
        name = m.call.args.get(param.name)
        if param.entity is not Entity.TARGET or not isinstance(name, str):
            continue
        pinned = m.places.get(param.name)
        location = next((p for p in m.rules.crew.locations if p.name == name), None)
        if location is not None:
            if pinned != Point(location.x, location.y):
                yield f"pinned: {name} is pinned to another place"
        else:
            yield from _fix(name, pinned, m)


def _fix(name: str, pinned: Point | None, m: Moment) -> Iterator[str]:
    stamped = _value(m.world, name, m)
    position = None if stamped is None else stamped.reading.position
    if stamped is None or stamped.reading.status != "ok" or position is None:
        yield f"fix: there is no usable {name}"
        return
    if not all(map(math.isfinite, (position.x, position.y, position.z))) or not _within(position, m.rules.crew.area):
        yield f"fix: {name} is at ({position.x}, {position.y}), which is no place within the area"
    makers = [s for s, call in m.steps.items() if s != m.step and name in _skill(call, m.rules).reports and s in m.sent]
    if makers and stamped.reading.stamp_ns < min(m.sent[s] for s in makers):
        yield f"fix: {name} is older than the search for it"
    if m.wish.avoid is not None and _within(position, m.wish.avoid):
        yield f"avoid: {name} is where nobody may be sent"
    if pinned != position:
        yield f"pinned: {name} is pinned to another place"


def holds(condition: Condition, m: Moment) -> bool:
    """Whether a condition of a contract is true in fresh state; what is unknown is not."""
    for slot, wanted in condition.when.items():
        given = m.slots.get(slot)
        if given is None or (wanted != "given" and given != wanted):
            return True
    value: ArgValue | FluentLiteral | None = condition.value
    if isinstance(value, str) and value.startswith("$"):
        value = m.slots.get(value[1:])
    head, _, attribute = condition.path.partition(".")
    robot = m.roles.get(head)
    if robot is not None and attribute:
        seen, tolerance_m = _robot_sees(robot, attribute, m)
    else:
        bound = m.slots.get(head, head)
        seen, tolerance_m = _value_shows(str(bound), attribute, m)
    if seen is None or value is None:
        return False
    return _same(seen, value, tolerance_m, m) is not condition.negated


def incomplete(m: Moment, pinned: Mapping[str, Point]) -> Iterator[str]:
    """What a contract wants at its end and is not so; `pinned` is where values were when a robot was sent there."""
    contract = m.contract
    for condition in () if contract is None else contract.complete:
        role = condition.path.partition(".")[0]
        if role in m.roles and not holds(condition, m) and not _arrived(condition, m, pinned):
            yield f"complete: {condition} does not hold"


def _arrived(condition: Condition, m: Moment, pinned: Mapping[str, Point]) -> bool:
    """Whether a robot is where a run-time value, or a point in figures, was when the robot was sent there."""
    role, _, fluent = condition.path.partition(".")
    seen, tolerance_m = _robot_sees(m.roles[role], fluent, m)
    if not isinstance(seen, Point):
        return False
    bound = m.slots.get(str(condition.value)[1:])
    goal = pinned.get(str(bound))
    standoff_m = next((v.standoff_m for v in m.rules.crew.values if v.name == bound), 0.0)
    if goal is None:
        figures = next((c.args for c in m.steps.values() if c.robot == m.roles[role] and "x" in c.args), None)
        goal = None if figures is None else Point(float(figures["x"]), float(figures["y"]))
    return goal is not None and math.dist((seen.x, seen.y), (goal.x, goal.y)) <= tolerance_m + standoff_m


def _robot_sees(robot: str, fluent: str, m: Moment) -> tuple[FluentValue | None, float]:
    state, kind = m.world.robots.get(robot), _kind(robot, m.rules)
    declared = next((f for f in kind.fluents if f.name == fluent), None)
    if state is None or declared is None:
        return None, 0.0
    return _seen(state, fluent, kind, m.now_ns), declared.tolerance_m


def _value_shows(name: str, attribute: str, m: Moment) -> tuple[FluentValue | None, float]:
    stamped = _value(m.world, name, m)
    if stamped is None:
        return None, 0.0
    reading = stamped.reading
    shown: dict[str, FluentValue | None] = {"": reading.status, "near": reading.near, "at": reading.position}
    ok = reading.status == "ok" or not attribute
    return shown[attribute] if ok else None, _tolerance_m(name, stamped.source, m.rules)


def _seen(state: RobotState, fluent: str, kind: Kind, now_ns: int) -> FluentValue | None:
    stamped = state.fluents.get(fluent)
    declared = next(f for f in kind.fluents if f.name == fluent)
    return stamped.value if stamped is not None and _fresh(stamped.source_ns, declared.max_age_s, now_ns) else None


def _value(world: Snapshot, name: str, m: Moment) -> StampedValue | None:
    """A run-time value, if a robot of this crew that may publish it did, not too long ago."""
    stamped = world.values.get(name)
    if stamped is None:
        return None
    limit_s = _max_age_s(name, stamped.source, m.rules)
    return stamped if limit_s is not None and _fresh(stamped.reading.stamp_ns, limit_s, m.now_ns) else None


def _max_age_s(name: str, source: str, rules: Rules) -> float | None:
    things = {thing.name for thing in rules.crew.objects}
    kind = next((rules.kinds[r.kind] for r in rules.crew.robots if r.name == source), None)
    published = () if kind is None else kind.publishes
    return next((p.max_age_s for p in published if (name in things if p.each_object else p.name == name)), None)


def _tolerance_m(name: str, source: str, rules: Rules) -> float:
    things = {thing.name for thing in rules.crew.objects}
    kind = next((rules.kinds[r.kind] for r in rules.crew.robots if r.name == source), None)
    published = () if kind is None else kind.publishes
    return next((p.tolerance_m for p in published if (name in things if p.each_object else p.name == name)), 0.0)


def _same(seen: FluentValue, wanted: FluentValue, tolerance_m: float, m: Moment) -> bool:
    if not isinstance(seen, Point):
        return seen == wanted
    place = next((p for p in m.rules.crew.locations if p.name == wanted), None)
    return place is not None and math.dist((seen.x, seen.y), (place.x, place.y)) <= tolerance_m


def _fresh(source_ns: int, max_age_s: float, now_ns: int) -> bool:
    return -AHEAD_NS <= now_ns - source_ns <= round(max_age_s * 1e9)


def _within(point: Point, zone: Zone) -> bool:
    return zone.x_min <= point.x <= zone.x_max and zone.y_min <= point.y <= zone.y_max


def _kind(robot: str, rules: Rules) -> Kind:
    return next(rules.kinds[r.kind] for r in rules.crew.robots if r.name == robot)


def _skill(call: Call, rules: Rules) -> Skill:
    return next(s for s in _kind(call.robot, rules).skills if s.name == call.skill)
