"""A second crew for the tests of files: a humanoid that loads, a quadruped that carries."""

from collections.abc import Callable
from typing import Annotated

from crew.contracts.contract import Contract
from crew.contracts.files.contract_file import load_contract
from crew.contracts.files.crew_file import load_crew
from crew.contracts.files.source import SourceError, SourceErrors
from crew.contracts.site import Crew
from crew.contracts.skill import Entity, Fluent, Kind, Part, Skill, SkillArgs, entity, number


class PickPlace(SkillArgs, frozen=True):
    object: Annotated[str, entity(Entity.OBJECT, "What to pick.")]
    location: Annotated[str, entity(Entity.LOCATION, "Where to place it.")]


class Wait(SkillArgs, frozen=True):
    seconds: Annotated[float, number(ge=1.0, le=60.0, unit="s", about="How long.")]


class Navigate(SkillArgs, frozen=True):
    location: Annotated[str, entity(Entity.TARGET, "Where to go.")]


class Patrol(SkillArgs, frozen=True):
    location: Annotated[str, entity(Entity.TARGET, "What to walk around.")] | None = None
    x: Annotated[float, number(ge=-100.0, le=100.0, unit="m", axis="x", about="East.")] | None = None
    y: Annotated[float, number(ge=-100.0, le=100.0, unit="m", axis="y", about="North.")] | None = None


class NoArgs(SkillArgs, frozen=True):
    pass


def _skill(name: str, args: type[SkillArgs], **more: object) -> Skill:
    declared = {"about": f"{name}.", "words": (name,), "timeout_s": 10.0, "on_stop": "stop", "on_link_loss": "stop"}
    return Skill(name=name, args=args, **{**declared, **more})  # type: ignore[arg-type]


HUMANOID = Kind(
    name="humanoid",
    about="Two arms at a table.",
    aliases=("humanoid",),
    fluents=(Fluent(name="holding", domain="object", about="What the hand holds."),),
    skills=(_skill("pick_place", PickPlace), _skill("wait", Wait)),
    idle_on_stop="stop",
    idle_on_link_loss="stop",
)
QUADRUPED = Kind(
    name="quadruped",
    about="Four legs and a tray.",
    aliases=("quadruped", "dog"),
    fluents=(
        Fluent(name="at", domain="place", about="Where it stands."),
        Fluent(name="moving", domain="bool", about="Whether it walks."),
        Fluent(name="tray", domain="object", about="What lies on the tray."),
        Fluent(name="battery", domain="number", about="Charge, percent."),
    ),
    skills=(
        _skill("navigate", Navigate),
        _skill("patrol", Patrol, forms=(("location",), ("x", "y"))),
        _skill("stop", NoArgs, safe=True),
    ),
    parts=(Part(name="payload_tray", holds="tray", about="On its back."),),
    idle_on_stop="stop",
    idle_on_link_loss="stop",
)
KINDS = {"humanoid": HUMANOID, "quadruped": QUADRUPED}

CREW_TEXT = """\
crew: lab
area: {x: [-5, 5], y: [-5, 5]}
robots:
  g1: {kind: humanoid, adapter: unitree, connection: eth0}
  go2: {kind: quadruped, adapter: unitree, connection: eth1, aliases: [dog]}
locations:
  pickup: {at: [0, 0]}
  room_a: {at: [4, 4], aliases: [the kitchen]}
  dropoff: {at: [-4, 4]}
objects:
  red_cube: {aliases: [block, cube]}
  bottle: {}
values:
  requester: {aliases: [me, here]}
"""

CARRY_TEXT = """\
contract: carry
summary: Take an object to a place, or to a person out of reach; one robot loads, another carries.
slots:
  object:      {type: object}
  destination: {type: [location, requester]}
  origin:      {type: location, said: from, optional: true}
roles:
  loader:  {safe: stay}
  carrier: {safe: {by: stop, reach: {moving: false}}}
asks: [deliver]
needs:
  - {if: {destination: requester}, requester.near: false}
  - {if: {origin: given}, object.at: $origin}
steps:
  approach:
    role: carrier
    optional: true
    do: {navigate: {location: pickup}}
  load:
    role: loader
    after: [approach]
    words: [pick, load]
    needs: [{carrier.at: pickup}, {carrier.moving: false}]
    do: {pick_place: {object: $object, location: payload_tray}}
  deliver:
    role: carrier
    after: [load]
    words: [carry, bring]
    needs: [{carrier.tray: $object}]
    do: {navigate: {location: $destination}}
never:
  - {starts: loader.pick_place, with: {location: payload_tray}, while: {carrier.at: {not: pickup}}, why: it would fall}
  - {starts: carrier.navigate, with: {location: {not: pickup}}, while: {carrier.tray: {not: $object}}, why: it is empty}
complete: [{carrier.at: $destination}, {carrier.tray: $object}]
deadline_s: 300
"""


def crew_of(text: str = CREW_TEXT) -> Crew:
    return load_crew(text, source="lab.yaml")


LAB = crew_of()


def carry(text: str = CARRY_TEXT) -> Contract:
    return load_contract(text, source="carry.yaml", crew=LAB, kinds=KINDS)


def mistakes(load: Callable[[str], object], text: str) -> tuple[SourceError, ...]:
    """What a loader refuses in a text; any other exception is passed on."""
    try:
        load(text)
    except SourceErrors as errors:
        return errors.errors
    return ()


def errors_of(text: str) -> tuple[SourceError, ...]:
    """The mistakes of a contract file."""
    return mistakes(carry, text)


def edited(text: str, old: str, new: str) -> str:
    """The text with one passage exchanged, which it must hold exactly once."""
    assert text.count(old) == 1, old
    return text.replace(old, new)


def mark(text: str, needle: str) -> tuple[int, int]:
    """Line and column, from 1, where the needle stands in the text; it must stand there once."""
    assert text.count(needle) == 1, needle
    before = text[: text.index(needle)]
    return before.count("\n") + 1, len(before) - before.rfind("\n")
