"""A second crew, of which the reader knows nothing but data: an arm that loads, two dogs that carry, a person."""

from typing import Annotated

from crew.contracts.files.contract_file import load_contract
from crew.contracts.files.crew_file import load_crew
from crew.contracts.site import Rules
from crew.contracts.skill import Entity, Fluent, Kind, Part, Skill, SkillArgs, entity

Thing = Annotated[str, entity(Entity.OBJECT, "What to take.")]
Place = Annotated[str, entity(Entity.LOCATION, "Where to put it.")]
Goal = Annotated[str, entity(Entity.TARGET, "Where to go.")]


class Hand(SkillArgs, frozen=True):
    object: Thing


class PickPlace(SkillArgs, frozen=True):
    object: Thing
    location: Place


class Navigate(SkillArgs, frozen=True):
    location: Goal


class NoArgs(SkillArgs, frozen=True):
    pass


def _skill(name: str, args: type[SkillArgs], *words: str, **more: object) -> Skill:
    declared = {"about": f"{name}.", "words": words, "timeout_s": 10.0, "on_stop": "stop", "on_link_loss": "stop"}
    return Skill(name=name, args=args, **{**declared, **more})  # type: ignore[arg-type]


ARM = Kind(
    name="humanoid",
    about="Two arms at a table.",
    aliases=("humanoid",),
    fluents=(Fluent(name="holding", domain="object", about="What the hand holds."),),
    skills=(
        _skill("pick_handover", Hand, "hand", "give", "pass", effects={"holding": "none"}),
        _skill("pick_place", PickPlace, "pick", "put", "place"),
        _skill("wave", NoArgs, "wave"),
    ),
    idle_on_stop="stop",
    idle_on_link_loss="stop",
)
DOG = Kind(
    name="quadruped",
    about="Four legs and a tray.",
    aliases=("quadruped", "dog"),
    fluents=(
        Fluent(name="at", domain="place", about="Where it stands."),
        Fluent(name="moving", domain="bool", about="Whether it walks."),
        Fluent(name="tray", domain="object", about="What lies on the tray."),
    ),
    skills=(
        _skill(
            "navigate", Navigate, "go", "walk", "send", "navigate", effects={"at": "$location"}, during={"moving": True}
        ),
        _skill("stop", NoArgs, "stop", effects={"moving": False}, safe=True),
    ),
    parts=(Part(name="payload_tray", aliases=("tray",), holds="tray", about="On its back."),),
    idle_on_stop="stop",
    idle_on_link_loss="stop",
)

CREW = """\
crew: lab
area: {x: [-5, 5], y: [-5, 5]}
robots:
  g1: {kind: humanoid, adapter: unitree, connection: eth0}
  rex: {kind: quadruped, adapter: unitree, connection: eth1}
  fido: {kind: quadruped, adapter: unitree, connection: eth2}
locations:
  pickup: {at: [0, 0]}
  room_a: {at: [4, 4]}
  room_b: {at: [4, -4]}
  room_b2: {at: [2, -4]}
  table_a: {at: [1, 1]}
objects:
  red_cube: {aliases: [block, cube, red block]}
  bottle: {}
values:
  requester: {aliases: [user]}
"""

CARRY = """\
contract: carry
summary: Take an object to a place, or to a person out of reach.
examples:
  - (bring|carry) {object} to {destination}
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
    words: [pick, pick up, load, put, place, grab]
    needs: [{carrier.at: pickup}, {carrier.moving: false}]
    do: {pick_place: {object: $object, location: payload_tray}}
  deliver:
    role: carrier
    after: [load]
    words: [carry, bring, take, deliver, transport, haul, move, fetch, get, drop, put, place, need, want]
    needs: [{carrier.tray: $object}]
    do: {navigate: {location: $destination}}
complete: [{carrier.at: $destination}, {carrier.tray: $object}]
deadline_s: 300
"""

HANDOVER = """\
contract: handover
summary: Hand an object to the person within reach.
examples:
  - (hand|give|bring) me {object}
slots:
  object: {type: object}
roles:
  giver: {safe: stay}
asks: [hand]
needs: [{requester.near: true}]
steps:
  hand:
    role: giver
    words: [bring, get, fetch, need, want, take, pick up]
    do: {pick_handover: {object: $object}}
complete: [{giver.holding: none}]
deadline_s: 60
"""

GO = """\
contract: navigation_only
summary: Send a carrier to a place.
examples:
  - (send|walk) {walker} to {destination}
slots:
  destination: {type: [location, requester]}
roles:
  walker: {safe: {by: stop, reach: {moving: false}}}
asks: [go]
steps:
  go:
    role: walker
    do: {navigate: {location: $destination}}
complete: [{walker.at: $destination}]
deadline_s: 60
"""


def lab_rules() -> Rules:
    crew = load_crew(CREW, source="lab.yaml")
    kinds = {kind.name: kind for kind in (ARM, DOG)}
    texts = {"carry": CARRY, "handover": HANDOVER, "navigation_only": GO}
    contracts = {n: load_contract(t, source=f"{n}.yaml", crew=crew, kinds=kinds) for n, t in texts.items()}
    return Rules(crew=crew, kinds=kinds, contracts=contracts)
