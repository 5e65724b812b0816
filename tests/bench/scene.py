"""A mission in mid-flight, for measuring single decisions."""

import msgspec

from crew.actors.planner.embedded import PlannerState, propose
from crew.contracts.gate.authorize import Gate
from crew.contracts.language.lexicon import build_lexicon
from crew.contracts.language.reading import read_request
from crew.contracts.mission.validation import pending_steps, validate
from crew.contracts.mission_state import MissionState, Phase
from crew.contracts.plan import Call, Plan
from crew.contracts.site import Rules
from crew.contracts.snapshot import RobotState, Snapshot, Stamped
from crew.library import load_rules

REQUEST = "Search the area and send the rover to the victim"
NOW_NS = 10_000_000_000


def mission_in_flight() -> tuple[Rules, MissionState, Snapshot, Call]:
    """The air-ground mission with its takeoff about to be authorised, and the world that it is authorised in."""
    rules = load_rules("air_ground")
    reading = read_request(REQUEST, build_lexicon(rules))
    world = Snapshot(robots={r.name: _robot(r.name, rules) for r in rules.crew.robots})
    mission = MissionState(id="bench", request=REQUEST, reading=reading)
    state = PlannerState(airborne={"iris": False}, values={}, requester_near=None)
    plan = propose(REQUEST, rules, state)
    assert isinstance(plan, Plan)
    verdict = validate(plan, mission, world, rules, NOW_NS, Gate())
    assert verdict.instance is not None, verdict.refusal
    executing = msgspec.structs.replace(
        mission,
        phase=Phase.EXECUTING,
        plan=plan,
        contract=plan.contract,
        instance=verdict.instance,
        steps=pending_steps(verdict.instance),
        started_ns=NOW_NS,
    )
    return rules, executing, world, verdict.instance.steps[0].call


def _robot(name: str, rules: Rules) -> RobotState:
    kind = rules.kind_of(name)
    assert kind is not None
    fluents = {f.name: Stamped(False, NOW_NS, NOW_NS) for f in kind.fluents}
    return RobotState(name=name, kind_digest=kind.digest, boot_id="b" * 16, lease="bench", fluents=fluents)
