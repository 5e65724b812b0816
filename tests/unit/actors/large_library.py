"""A made-up crew of ten kinds with 10,000 skills, 2,000 contracts over them, and requests that mean some of them."""

from msgspec.structs import replace

from crew.contracts.contract import CallPattern, Contract, Role, Step
from crew.contracts.plan import Zone
from crew.contracts.site import Crew, RobotSpec, Rules
from crew.contracts.skill import Kind, Skill, SkillArgs

VERBS: dict[str, tuple[str, ...]] = {
    "inspect": ("inspect", "check", "examine", "look over"),
    "clean": ("clean", "wash", "wipe", "scrub"),
    "repair": ("repair", "fix", "mend"),
    "paint": ("paint", "coat", "colour"),
    "lubricate": ("lubricate", "oil", "grease"),
    "photograph": ("photograph", "picture", "shoot"),
    "measure": ("measure", "gauge", "survey"),
    "replace": ("replace", "swap", "exchange"),
    "tighten": ("tighten", "screw down", "fasten"),
    "drain": ("drain", "empty"),
    "fill": ("fill", "top up"),
    "cool": ("cool", "chill"),
    "heat": ("heat", "warm"),
    "move": ("move", "shift", "carry"),
    "open": ("open", "unlock"),
    "close": ("close", "shut", "lock"),
    "weigh": ("weigh",),
    "label": ("label", "tag", "mark"),
    "count": ("count", "tally"),
    "guard": ("guard", "watch", "patrol"),
}
PLACES = ("north", "south", "east", "west", "upper", "lower", "inner", "outer", "front", "rear")
THINGS = ("pump", "valve", "tank", "hull", "turbine", "conveyor", "panel", "boiler", "cable", "hatch")
MODES = ("plain", "at_night", "from_above", "in_rain", "with_report")
PER_KIND = len(PLACES) * len(THINGS) * len(VERBS) * len(MODES) // 10

SAME_WORDS: tuple[tuple[str, str], ...] = (
    ("could you give the north pump a wash", "clean_north_pump"),
    ("the rear valve drips, somebody has to fix it", "repair_rear_valve"),
    ("grease the outer conveyor before the shift begins", "lubricate_outer_conveyor"),
    ("I would like pictures of the upper hull", "photograph_upper_hull"),
    ("how full is it? top up the lower tank anyway", "fill_lower_tank"),
    ("get the water out: empty the inner boiler", "drain_inner_boiler"),
    ("shut the front hatch for the night", "close_front_hatch"),
    ("unlock the west hatch for the visitors", "open_west_hatch"),
    ("please examine the east cable for cracks", "inspect_east_cable"),
    ("put a tag on the upper valve", "label_upper_valve"),
    ("swap the rear turbine for the new one", "replace_rear_turbine"),
    ("screw down whatever is loose on the outer panel", "tighten_outer_panel"),
    ("gauge the thickness of the front cable", "measure_front_cable"),
    ("tally what is stacked on the north conveyor", "count_north_conveyor"),
    ("what does the south turbine weigh", "weigh_south_turbine"),
)
"""Requests that use some declared word of the verb; the contract that each of them means."""
OTHER_WORDS: tuple[tuple[str, str], ...] = (
    ("the north pump is filthy, see to it", "clean_north_pump"),
    ("get the rear valve working again", "repair_rear_valve"),
    ("the outer conveyor squeals, do something about it", "lubricate_outer_conveyor"),
    ("I need an image of the upper hull", "photograph_upper_hull"),
    ("the lower tank is nearly dry", "fill_lower_tank"),
    ("let the water out of the inner boiler", "drain_inner_boiler"),
    ("nobody must get through the front hatch tonight", "close_front_hatch"),
    ("visitors come through the west hatch, let them in", "open_west_hatch"),
    ("are there cracks in the east cable", "inspect_east_cable"),
    ("the south panel must not be left alone", "guard_south_panel"),
)
"""Requests whose verb nobody declared: only the thing and its place can be found."""


class NoArgs(SkillArgs, frozen=True, kw_only=True):
    """No arguments."""


def large_library() -> Rules:
    """Ten robots of ten kinds; each kind has a tenth of the skills."""
    names = [(verb, f"{place}_{thing}") for verb in VERBS for place in PLACES for thing in THINGS]
    skills = [_skill(verb, what, mode) for verb, what in names for mode in MODES]
    kinds = [_kind(n, tuple(skills[n * PER_KIND : (n + 1) * PER_KIND])) for n in range(10)]
    robots = tuple(RobotSpec(name=f"r{n}", kind=f"kind{n}", adapter="none") for n in range(10))
    crew = Crew(name="plant", area=Zone(0.0, 100.0, 0.0, 100.0), robots=robots)
    contracts = {f"{verb}_{what}": _contract(verb, what) for verb, what in names}
    return Rules(crew=crew, kinds={kind.name: kind for kind in kinds}, contracts=contracts)


def _skill(verb: str, what: str, mode: str) -> Skill:
    return Skill(
        name=f"{verb}_{what}_{mode}",
        about=f"{verb.capitalize()} the {what.replace('_', ' ')}, {mode.replace('_', ' ')}.",
        args=NoArgs,
        words=VERBS[verb],
        timeout_s=60.0,
        on_stop="stand still",
        on_link_loss="stand still",
    )


def _kind(number: int, skills: tuple[Skill, ...]) -> Kind:
    return Kind(
        name=f"kind{number}",
        about="A machine for a plant.",
        aliases=(),
        fluents=(),
        skills=skills,
        idle_on_stop="stand still",
        idle_on_link_loss="stand still",
    )


def _contract(verb: str, what: str) -> Contract:
    do = tuple(CallPattern(f"{verb}_{what}_{mode}") for mode in MODES)
    return Contract(
        name=f"{verb}_{what}",
        summary=f"{verb.capitalize()} the {what.replace('_', ' ')}.",
        roles=(Role(name="worker"),),
        steps=(Step(name="work", role="worker", do=do, words=VERBS[verb]),),
        asks=("work",),
    )


def small_part(rules: Rules, count: int) -> Rules:
    """The first robot with `count` of its skills, and the contracts over them."""
    kind = rules.kinds["kind0"]
    few = replace(kind, skills=kind.skills[:count])
    kept = {s.name for s in few.skills}
    contracts = {n: c for n, c in rules.contracts.items() if {p.skill for s in c.steps for p in s.do} <= kept}
    return Rules(crew=replace(rules.crew, robots=rules.crew.robots[:1]), kinds={"kind0": few}, contracts=contracts)
