"""The planner without a model: contracts' templates and words, filled from the same reading that the gate checks.

It carries unknown names verbatim, so that the gate refuses them by name, and abstains rather than guess.
"""

from collections.abc import Iterator, Mapping
from typing import NamedTuple

import msgspec
from rapidfuzz import fuzz

from crew.contracts.contract import CallPattern, Condition, Contract, Slot, SlotType, Step
from crew.contracts.language.exclusion import excluded_skills
from crew.contracts.language.lexicon import lexicon_of
from crew.contracts.language.licence import fits, licensed_values, resolved
from crew.contracts.language.mention import ROBOT_KINDS, Direction, Mention, MentionKind, Reading
from crew.contracts.language.reading import explain_reading, read_request
from crew.contracts.language.templates import skeleton
from crew.contracts.plan import ArgValue, Call, Plan, SlotValue, Spot, Zone
from crew.contracts.site import Rules
from crew.contracts.skill import FluentLiteral, Kind, Skill

DEFAULT_ALTITUDE_M = 5.0
THRESHOLD = 0.5
"""The least share of the request's actions and names that a contract must account for."""
BARRED = 0.45
"""What a failing entry guard costs a contract."""


class PlannerState(msgspec.Struct, frozen=True, kw_only=True):
    """What a planner may know of the world: typed values under known names, never text from robots."""

    airborne: Mapping[str, bool] = {}
    values: Mapping[str, str] = {}
    """Status of the run-time values, by name."""
    requester_near: bool | None = None


class Abstention(msgspec.Struct, frozen=True):
    """No proposal, and why."""

    reason: str


class Casting(NamedTuple):
    """One contract with its roles and slots filled."""

    contract: Contract
    roles: Mapping[str, str]
    slots: Mapping[str, SlotValue]


class Bid(NamedTuple):
    """How well a contract accounts for a request."""

    share: float
    likeness: float
    casting: Casting
    whole: bool
    """It has room for everything that the request names: such a bid goes before any that would drop something."""


def propose(text: str, rules: Rules, state: PlannerState) -> Plan | Abstention:
    """A plan for the request, or why there is none. Deterministic; no network, no model."""
    reading = read_request(text, lexicon_of(rules))
    if not reading.actions:
        return Abstention(f"the request asks for no action that this crew knows ({explain_reading(reading)})")
    cast = (_cast(c, reading, rules) for c in rules.contracts.values())
    bids = [_bid(c, reading, rules, state) for c in cast if c is not None]
    best = max(bids, key=lambda b: (b.whole and b.share >= THRESHOLD, round(b.share, 6), b.likeness), default=None)
    if best is None or best.share < THRESHOLD:
        return Abstention(f"no contract of this crew does that ({explain_reading(reading)})")
    calls = tuple(_calls(best.casting, reading, rules, state))
    return Plan(best.casting.contract.name, calls) if calls else Abstention("nothing is left of the plan to do")


def _bid(casting: Casting, reading: Reading, rules: Rules, state: PlannerState) -> Bid:
    """Weigh the request's words by how few contracts they could mean; take off what the contract adds or drops.

    A contract whose entry guard fails still bids, below the others: the gate says better why it does not apply.
    """
    contract = casting.contract
    gained = total = 0.0
    asked: set[str] = set()
    whole = True
    for action in reading.actions:
        weight = 1.0 / max(1, len({ref.contract for ref in action.means}))
        total += weight
        mine = {ref.step for ref in action.means if ref.contract == contract.name}
        asked |= mine
        gained += weight if mine else 0.0
    for mention in reading.wanted:
        if mention.kind is not MentionKind.ACTION:
            placed = _placed(mention, casting, rules)
            total += 0.5
            gained += 0.5 if placed else 0.0
            whole = whole and placed
    missing = sum(1 for name in contract.asks if name not in asked)
    barred = not all(_entered(c, casting.slots, state) for c in contract.needs) or not _in_place(casting, rules)
    share = (gained / total - missing if total else 0.0) - (BARRED if barred else 0.0)
    return Bid(share, _likeness(contract, casting, reading), casting, whole)


def _placed(mention: Mention, casting: Casting, rules: Rules) -> bool:
    """Whether a contract has room for a mention."""
    contract = casting.contract
    if mention.kind in ROBOT_KINDS:
        return any(v in casting.roles.values() for v in mention.values)
    if mention.kind is MentionKind.UNKNOWN:
        return mention.name in casting.slots.values()
    guards = {c.path.partition(".")[0] for c in contract.needs}
    reported = {
        value for robot in casting.roles.values() for s in _skills(robot, rules).values() for value in s.reports
    }
    named = any(v in guards | reported for v in mention.values if isinstance(v, str))
    return named or any(fits(mention, slot) and _ways_agree(mention, slot) for slot in contract.slots)


def _ways_agree(mention: Mention, slot: Slot) -> bool:
    """Whether a goal is not taken for an origin, nor an origin for a goal."""
    against = Direction.TO if slot.said_from else Direction.FROM
    return mention.direction is not against


def _likeness(contract: Contract, casting: Casting, reading: Reading) -> float:
    """How much the request looks like one of the contract's examples, with the names filled in."""
    fill = {**{k: str(v) for k, v in casting.slots.items()}, **casting.roles}
    said = " ".join(m.name for m in reading.mentions if m.positive)
    return max((fuzz.token_sort_ratio(said, skeleton(e, fill)) for e in contract.examples), default=0.0)


def _cast(contract: Contract, reading: Reading, rules: Rules) -> Casting | None:
    """Fill a contract's slots and roles; None where it cannot apply."""
    slots: dict[str, SlotValue] = {}
    for slot in contract.slots:
        value = _fill(slot, contract, reading, rules)
        if value is not None:
            slots[slot.name] = value
        elif not slot.optional:
            return None
    roles = _roles(contract, reading, rules)
    return None if roles is None else Casting(contract, roles, slots)


def _fill(slot: Slot, contract: Contract, reading: Reading, rules: Rules) -> SlotValue | None:
    licensed = licensed_values(reading, slot, rules)
    if licensed:
        return _preferred(licensed, slot, contract, rules)
    if slot.default is not None:
        return resolved(slot.default, slot, rules.crew)
    if slot.free and SlotType.ALTITUDE in slot.types:
        return DEFAULT_ALTITUDE_M
    return None


def _preferred(licensed: tuple[SlotValue, ...], slot: Slot, contract: Contract, rules: Rules) -> SlotValue | None:
    """The first value; a zone must be a zone, since its figures cannot be carried verbatim."""
    value = licensed[0]
    carried = any(f"${slot.name}." in str(a) for s in contract.steps for p in s.do for a in p.args.values())
    verbatim = isinstance(value, str) and SlotType.ZONE in slot.types and carried
    return None if verbatim and not isinstance(resolved(value, slot, rules.crew), Zone) else value


def _entered(condition: Condition, slots: Mapping[str, SlotValue], state: PlannerState) -> bool:
    """Whether an entry guard holds as far as the planner knows; it leaves what it cannot know to the gate."""
    for slot, wanted in condition.when.items():
        given = slots.get(slot)
        if given is None or (wanted != "given" and given != wanted):
            return True
    if condition.path != "requester.near":
        return True
    return state.requester_near is not None and (state.requester_near == condition.value) is not condition.negated


def _in_place(casting: Casting, rules: Rules) -> bool:
    """Whether the places that the slots name suit the robots' reach, as far as the contract limits them."""
    for slot in casting.contract.slots:
        value = casting.slots.get(slot.name)
        beyond = rules.crew.robot(casting.roles.get(slot.beyond, ""))
        if beyond is not None and value in beyond.reach:
            return False
        if isinstance(value, str) and not all(value in r for r in _reaches(slot, casting, rules)):
            return False
    return True


def _reaches(slot: Slot, casting: Casting, rules: Rules) -> Iterator[tuple[str, ...]]:
    """The reach of each robot that would have to reach what the slot names."""
    for step in casting.contract.steps:
        robot = casting.roles[step.role]
        spec, known = rules.crew.robot(robot), _skills(robot, rules)
        for pattern in step.do:
            skill = known.get(pattern.skill)
            bound = [p.name for p in skill.params if p.reach] if skill is not None else list(pattern.args)
            if spec is not None and any(pattern.args.get(name) == f"${slot.name}" for name in bound):
                yield () if skill is None else spec.reach


def _roles(contract: Contract, reading: Reading, rules: Rules) -> dict[str, str] | None:
    """A robot for each role: the one that was named for it, otherwise the first able one that is free."""
    chosen = {role.name: robot for role in contract.roles if (robot := _named_for(role.name, contract, reading, rules))}
    for role in contract.roles:
        if role.name not in chosen:
            able = [r for r in _able(role.name, contract, rules) if r not in chosen.values()]
            named = {v for m in reading.wanted if m.kind in ROBOT_KINDS for v in m.values}
            robot = next((r for r in able if r in named), able[0] if able else None)
            if robot is None:
                return None
            chosen[role.name] = robot
    return chosen


def _named_for(role: str, contract: Contract, reading: Reading, rules: Rules) -> str | None:
    """The robot that the request names for a step of this role, able or not: the gate says what it lacks."""
    steps = {s.name for s in contract.steps if s.role == role}
    able = _able(role, contract, rules)
    excluded = {v for m in reading.excluded if m.kind in ROBOT_KINDS for v in m.values}
    for action in reading.actions:
        if steps & {ref.step for ref in action.means if ref.contract == contract.name}:
            for robot in reading.robots_of(action):
                names = [str(v) for v in robot.values if v not in excluded]
                best = next((n for n in names if n in able), names[0] if names else None)
                alone = len({s.role for s in contract.steps if s.name in _steps_of(action, contract)}) == 1
                if best is not None and (best in able or alone):
                    return best
    return None


def _steps_of(action: Mention, contract: Contract) -> set[str]:
    return {ref.step for ref in action.means if ref.contract == contract.name}


def _able(role: str, contract: Contract, rules: Rules) -> list[str]:
    """Robots with every skill that a role needs; a step with alternatives needs one of them."""
    needed = [{p.skill for p in s.do} for s in contract.steps if s.role == role]
    declared = contract.role(role)
    if declared is not None and declared.safe is not None:
        needed.append({declared.safe.by})
    return [r.name for r in rules.crew.robots if all(n & set(_skills(r.name, rules)) for n in needed)]


def _skills(robot: str, rules: Rules) -> dict[str, Skill]:
    kind = rules.kind_of(robot)
    return {} if kind is None else {s.name: s for s in kind.skills}


def _calls(casting: Casting, reading: Reading, rules: Rules, state: PlannerState) -> Iterator[Call]:
    """The steps in the contract's order, each as the first alternative that the slots fill."""
    done: set[str] = set()
    waiting = list(casting.contract.steps)
    while waiting:
        step = next((s for s in waiting if all(a in done for a in s.after)), waiting[0])
        waiting.remove(step)
        done.add(step.name)
        if step.optional and not _worthwhile(step, casting, reading, rules, state):
            continue
        call = _call(step, casting, reading, rules)
        if call is not None:
            yield call


def _call(step: Step, casting: Casting, reading: Reading, rules: Rules) -> Call | None:
    robot = casting.roles[step.role]
    meant = {ref.skill for a in reading.actions for ref in a.means if ref.step == step.name}
    options = sorted(step.do, key=lambda p: p.skill not in meant)
    for pattern in options:
        args = _args(pattern, casting.slots)
        if args is not None and (pattern.skill in _skills(robot, rules) or len(step.do) == 1 or len(meant) == 1):
            return Call(robot, pattern.skill, args)
    return None


def _args(pattern: CallPattern, slots: Mapping[str, SlotValue]) -> dict[str, ArgValue] | None:
    """A pattern's arguments with the slots filled in; None where a slot has another shape."""
    found: dict[str, ArgValue] = {}
    for name, wanted in pattern.args.items():
        value = _arg(wanted, slots)
        if value is None:
            return None
        found[name] = value
    return found


def _arg(wanted: str | float, slots: Mapping[str, SlotValue]) -> ArgValue | None:
    if not isinstance(wanted, str) or not wanted.startswith("$"):
        return wanted
    slot, _, field = wanted[1:].partition(".")
    value = slots.get(slot)
    if field:
        return getattr(value, field) if isinstance(value, Zone | Spot) else None
    return None if isinstance(value, Zone | Spot) else value


def _worthwhile(step: Step, casting: Casting, reading: Reading, rules: Rules, state: PlannerState) -> bool:
    """Whether an optional step belongs in the plan: asked for, needed by a later step, or the robot's safe end."""
    robot = casting.roles[step.role]
    kind = rules.kind_of(robot)
    skill = _skills(robot, rules).get(step.do[0].skill)
    if kind is None or skill is None or _excluded(skill, kind, reading):
        return False
    if _asked_for(step, robot, casting.contract, reading):
        return True
    if not casting.contract.asks or not _startable(skill, robot, state):
        return False
    role = casting.contract.role(step.role)
    ends_safe = role is not None and role.safe is not None and role.safe.by == skill.name
    return ends_safe or _prepares(step, skill, casting, rules)


def _excluded(skill: Skill, kind: Kind, reading: Reading) -> bool:
    return any(m.bare and skill.name in excluded_skills(m, kind) for m in reading.excluded)


def _asked_for(step: Step, robot: str, contract: Contract, reading: Reading) -> bool:
    for action in reading.actions:
        if step.name in _steps_of(action, contract):
            named = {v for r in reading.robots_of(action) for v in r.values}
            if not named or robot in named:
                return True
    return False


def _startable(skill: Skill, robot: str, state: PlannerState) -> bool:
    """Whether the skill's preconditions can hold at the start, as far as is known."""
    known: dict[str, FluentLiteral] = {}
    if robot in state.airborne:
        known["airborne"] = state.airborne[robot]
    return all(known.get(fluent, wanted) == wanted for fluent, wanted in skill.all_needs.items())


def _prepares(step: Step, skill: Skill, casting: Casting, rules: Rules) -> bool:
    """Whether a later step needs what this step brings about."""
    paths = {f"{step.role}.{fluent}" for fluent in skill.effects}
    later = [s for s in casting.contract.steps if step.name in _ancestors(s, casting.contract)]
    guarded = any(c.path in paths for s in later for c in s.needs)
    own = (_skills(casting.roles[s.role], rules).get(p.skill) for s in later if s.role == step.role for p in s.do)
    return guarded or any(set(n.needs) & set(skill.effects) for n in own if n is not None)


def _ancestors(step: Step, contract: Contract) -> set[str]:
    found: set[str] = set()
    waiting: list[str] = list(step.after)
    while waiting:
        name = waiting.pop()
        if name not in found:
            found.add(name)
            declared = contract.step(name)
            waiting.extend(declared.after if declared is not None else ())
    return found
