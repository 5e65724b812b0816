"""The world of a proof: what each fluent may be, and the snapshot that the real gate and judgements are shown."""

from collections.abc import Iterator, Mapping
from math import hypot

from msgspec.structs import replace

from crew.contracts.contract import Contract
from crew.contracts.gate.guard import SECOND_NS
from crew.contracts.mission.effect import effect_values
from crew.contracts.plan import Call, Instance
from crew.contracts.proof.never import Watch
from crew.contracts.proof.subject import STATUS, Names, Slots, Var, subject, wanted
from crew.contracts.site import Rules
from crew.contracts.skill import Fluent, FluentLiteral, Skill
from crew.contracts.snapshot import FluentValue, Point, RobotState, Snapshot, Stamped, StampedValue, ValueReading

MISSION = "m1"
NOW_NS = 10_000 * SECOND_NS
DISPATCHED_NS = NOW_NS - 2 * SECOND_NS
"""When everything that was sent so far was sent: only before and after count."""
SEEN_NS = NOW_NS - SECOND_NS // 5
STARTED_NS = NOW_NS - 9 * SECOND_NS // 4
EARLIER_NS = NOW_NS - 5 * SECOND_NS // 2

ELSEWHERE = "elsewhere"
NOTHING = "none"
OTHER_THING = "something else"
CALM: Mapping[str, FluentValue] = {"bool": False, "place": ELSEWHERE, "object": NOTHING, "number": 50.0}
"""What a fluent is that nobody asks for."""

OK, ABSENT, AMBIGUOUS, NEVER, NOT_FINITE, OUTSIDE, STALE, EARLIER = (
    "ok",
    "absent",
    "ambiguous",
    "never published",
    "not finite",
    "outside the area",
    "stale",
    "of an earlier mission",
)
CONDITIONS = (OK, ABSENT, AMBIGUOUS, NEVER, NOT_FINITE, OUTSIDE, STALE, EARLIER)
"""What can be the matter with a run-time value when somebody wants it."""

READABLE = frozenset((OK, EARLIER))
"""Conditions in which a value's attributes can be read."""

Possible = frozenset[FluentValue]
Values = Mapping[Var, FluentValue]


class Ground:
    """The variables of one instance that anything asks for, with all that they may be."""

    def __init__(
        self, contract: Contract, instance: Instance, slots: Slots, watches: tuple[Watch, ...], rules: Rules
    ) -> None:
        self.rules, self.instance, self.slots = rules, instance, slots
        """`slots` as the plan binds them, and those that only the request binds."""
        self._asked: dict[Var, set[FluentValue]] = {}
        for path, bound, roles, value in _questions(contract, instance, slots, watches):
            self._ask(subject(path, roles, bound), value)
        for item in instance.steps:
            self._ask_skill(item.call)
        for name, robot in instance.roles.items():
            role = contract.role(name)
            if role is not None and role.safe is not None:
                self._ask_skill(Call(robot, role.safe.by))
                for fluent, wished in role.safe.reach.items():
                    self._ask(Var(robot, fluent), wished)
        self.domains: dict[Var, Possible] = {var: self._domain(var, found) for var, found in self._asked.items()}
        self.fluents = tuple(sorted(var for var in self.domains if not self.is_value(var)))
        self.index = {var: k for k, var in enumerate(self.fluents)}
        self._calm = {spec.name: self._calm_robot(spec.name) for spec in rules.crew.robots}
        self.free_spot = free_spot(rules)

    def is_value(self, var: Var) -> bool:
        """Whether a variable belongs to a run-time value: an input of each decision, never remembered."""
        return self.rules.kind_of(var.owner) is None

    def is_relation(self, var: Var) -> bool:
        """Whether a variable is a fact between robots: any other robot's motion may change it at any moment."""
        fluent = self.rules.fluent_of(var.owner, var.name)
        return fluent is not None and fluent.relation is not None

    @staticmethod
    def calm(domain: str) -> FluentValue:
        """What a fluent of this domain is that nobody asks for."""
        return CALM[domain]

    def domain(self, var: Var) -> Possible:
        """All that a variable may be."""
        return self.domains[var] if var in self.domains else self._domain(var, set())

    def _ask(self, var: Var | None, value: FluentValue | None) -> None:
        if var is not None:
            self._asked.setdefault(var, set()).update(() if value is None else (value,))

    def _ask_skill(self, call: Call) -> None:
        skill = skill_of(call, self.rules)
        for fluent, literal in (*skill.needs.items(), *skill.step_needs.items(), *skill.during.items()):
            self._ask(Var(call.robot, fluent), literal)
        for var, value in outcome(call, self).items():
            self._ask(var, value)
        for left in skill.may:
            for fluent, written in left.items():
                self._ask(Var(call.robot, fluent), resolved(written, call))

    def _domain(self, var: Var, asked: set[FluentValue]) -> Possible:
        if self.is_value(var):
            usual: Mapping[str, tuple[FluentValue, ...]] = {STATUS: CONDITIONS, "near": (False, True)}
            return frozenset(usual.get(var.name, (*asked, ELSEWHERE)))
        fluent = self.rules.fluent_of(var.owner, var.name)
        others: Mapping[str, tuple[FluentValue, ...]] = {
            "bool": (False, True),
            "place": (ELSEWHERE,),
            "object": (NOTHING, OTHER_THING),
            "number": (-1.0,),
        }
        return frozenset(asked) | frozenset(() if fluent is None else others[fluent.domain])

    def snapshot(self, values: Values) -> Snapshot:
        """The world as the orchestrator would know it: fresh, everybody available, idle and leased to the mission."""
        changed: dict[str, dict[str, Stamped]] = {}
        told: dict[str, dict[str, FluentValue]] = {}
        for var, value in values.items():
            if self.is_value(var):
                told.setdefault(var.owner, {})[var.name] = value
            else:
                changed.setdefault(var.owner, {})[var.name] = Stamped(value, SEEN_NS, SEEN_NS)
        published = {name: self._value(name, attributes) for name, attributes in told.items()}
        robots = dict(self._calm)
        for name, fluents in changed.items():
            robots[name] = replace(robots[name], fluents={**robots[name].fluents, **fluents})
        return Snapshot(robots=robots, values={n: v for n, v in published.items() if v is not None})

    def _value(self, name: str, told: Mapping[str, FluentValue]) -> StampedValue | None:
        """A run-time value in one of the conditions that it can be in, or None if nobody ever published it."""
        condition = str(told.get(STATUS, OK))
        if condition == NEVER:
            return None
        source = min(self.rules.publishers_of(name), default="nobody")
        declared = self.rules.publication(source, name)
        limit_s = 0.0 if declared is None else declared.max_age_s
        stamps = {STALE: NOW_NS - int((limit_s + 1) * SECOND_NS), EARLIER: EARLIER_NS}
        stamp_ns = stamps.get(condition, SEEN_NS)
        if condition in (ABSENT, AMBIGUOUS):
            return StampedValue(ValueReading(name=name, status=condition, stamp_ns=stamp_ns), source, stamp_ns)
        area, spot = self.rules.crew.area, self._spot(told.get("at"))
        places = {NOT_FINITE: Point(float("nan"), spot.y), OUTSIDE: Point(area.x_max + 1, spot.y)}
        near = told.get("near")
        reading = ValueReading(
            name=name,
            status="ok",
            position=places.get(condition, spot),
            near=near if isinstance(near, bool) else None,
            stamp_ns=stamp_ns,
        )
        return StampedValue(reading, source, stamp_ns)

    def _spot(self, place: FluentValue | None) -> Point:
        location = self.rules.crew.location(place) if isinstance(place, str) else None
        return self.free_spot if location is None else Point(location.x, location.y)

    def _calm_robot(self, name: str) -> RobotState:
        kind = self.rules.kind_of(name)
        assert kind is not None, "a crew's robots have kinds"
        fluents = {f.name: Stamped(CALM[f.domain], SEEN_NS, SEEN_NS) for f in kind.fluents}
        return RobotState(name=name, kind_digest=kind.digest, boot_id="boot", lease=MISSION, fluents=fluents)


def _questions(
    contract: Contract, instance: Instance, bound: Slots, watches: tuple[Watch, ...]
) -> Iterator[tuple[str, Slots, Names, FluentValue | None]]:
    """Every condition that may be asked: path, slots, roles, and the value it asks for."""
    steps = (c for step in contract.steps if instance.step(step.name) is not None for c in step.needs)
    for c in (*contract.needs, *steps, *contract.complete):
        head = c.path.partition(".")[0]
        if contract.role(head) is None or head in instance.roles:
            yield c.path, bound, instance.roles, wanted(c, bound)
    for watch in watches:
        for c in watch.never.when:
            yield c.path, watch.slots, watch.roles, wanted(c, watch.slots)


def free_spot(rules: Rules) -> Point:
    """A place in the area that is as far from every named one as a coarse grid allows."""
    area = rules.crew.area
    grid = [
        Point(area.x_min + (area.x_max - area.x_min) * i / 16, area.y_min + (area.y_max - area.y_min) * j / 16)
        for i in range(1, 16)
        for j in range(1, 16)
    ]
    return max(grid, key=lambda p: min((hypot(p.x - q.x, p.y - q.y) for q in rules.crew.locations), default=0.0))


def skill_of(call: Call, rules: Rules) -> Skill:
    kind = rules.kind_of(call.robot)
    skill = None if kind is None else kind.skill(call.skill)
    assert skill is not None, f"{call} passed the capability check"
    return skill


def resolved(value: FluentLiteral, call: Call) -> FluentValue:
    """A leftover as written: `$argument` is the argument's value."""
    return call.args.get(value[1:], ELSEWHERE) if isinstance(value, str) and value.startswith("$") else value


def outcome(call: Call, ground: Ground) -> dict[Var, FluentValue]:
    """What a call changes when it succeeds: its own robot, and where an object lies that it puts somewhere."""
    skill = skill_of(call, ground.rules)
    found = {Var(call.robot, fluent): value for fluent, value in effect_values(skill, call).items()}
    if skill.puts is not None:
        thing, place = (str(call.args[name]) for name in skill.puts)
        part = ground.rules.parts.get(place)
        host = ground.rules.host_of(place, ground.instance.roles.values())
        if part is None:
            found[Var(thing, "at")] = place
        elif host:
            found[Var(host, part.holds)] = thing
    return found


def meanwhile(call: Call, ground: Ground) -> dict[Var, Possible]:
    """What else each fluent may be while a call runs, and after it failed. A place may be anywhere by then."""
    skill = skill_of(call, ground.rules)
    on_the_way = [(Var(call.robot, fluent), value) for fluent, value in skill.during.items()]
    left = [(Var(call.robot, f), resolved(v, call)) for may in skill.may for f, v in may.items()]
    found: dict[Var, Possible] = {}
    for var, value in (*outcome(call, ground).items(), *on_the_way, *left):
        if not ground.is_value(var):
            found[var] = found.get(var, frozenset()) | _around(var, value, ground)
    return found


def _around(var: Var, value: FluentValue, ground: Ground) -> Possible:
    fluent: Fluent | None = ground.rules.fluent_of(var.owner, var.name)
    return ground.domains[var] if fluent is not None and fluent.domain == "place" else frozenset((value,))
