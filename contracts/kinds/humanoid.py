"""The humanoid: stands at its place, picks objects up and hands them over, places them or holds them."""

from typing import Annotated

from crew.contracts.skill import NOTHING, Entity, Fluent, Kind, Published, Skill, SkillArgs, entity

Object = Annotated[str, entity(Entity.OBJECT, "What to take.")]
Place = Annotated[str, entity(Entity.LOCATION, "Where to put it: a place within reach.", reach=True)]


class PickHandover(SkillArgs, frozen=True):
    object: Object


class PickPlace(SkillArgs, frozen=True):
    object: Object
    location: Place


class PickHold(SkillArgs, frozen=True):
    object: Object


class Wave(SkillArgs, frozen=True):
    pass


_WAVE = tuple(
    f"wave{how}"
    for how in ("", " hello", " to me", " at me", " to us", " at us", " your arm", " your hand", " with your arm")
)

HUMANOID = Kind(
    name="humanoid",
    about="A standing humanoid with an arm, a gripper and a camera that sees objects and the person who asks.",
    aliases=("humanoid", "humanoid robot"),
    fluents=(
        Fluent(name="standing", domain="bool", about="Upright, from the inertial sensor.", at_rest=True),
        Fluent(name="moving", domain="bool", about="Arm or hand in motion, from the joints."),
        Fluent(name="holding", domain="object", about="What the closed hand feels between its fingers."),
        Fluent(
            name="handed", domain="object", about="What the last handover passed on: felt being pulled, then let go."
        ),
        Fluent(name="waved", domain="bool", about="The last wave went through its whole course."),
        Fluent(name="battery", domain="number", about="Charge, percent.", max_age_s=5.0),
    ),
    skills=(
        Skill(
            name="pick_handover",
            about="Pick up an object and hold it out until the person has taken it from the hand.",
            args=PickHandover,
            words=("hand", "hand over", "give", "pass"),
            needs={"standing": True, "holding": NOTHING},
            effects={"handed": "$object", "holding": NOTHING},
            during={"moving": True, "handed": NOTHING},
            may=({"holding": "$object"}, {"handed": NOTHING}),
            timeout_s=60.0,
            cost=2.0,
            on_stop="hold",
            on_link_loss="hold",
        ),
        Skill(
            name="pick_place",
            about="Pick up an object and put it down at a place within reach.",
            args=PickPlace,
            words=(
                "put",
                "place",
                "put down",
                "set",
                "set down",
                "lay",
                "lay down",
                "move",
                "transfer",
                "shift",
                "bring",
                "carry",
                "take",
            ),
            needs={"standing": True, "holding": NOTHING},
            effects={"holding": NOTHING, "moving": False},
            during={"moving": True},
            may=({"holding": "$object"},),
            puts=("object", "location"),
            timeout_s=60.0,
            cost=2.0,
            on_stop="hold",
            on_link_loss="hold",
        ),
        Skill(
            name="pick_hold",
            about="Pick up an object and keep it in the hand.",
            args=PickHold,
            words=(
                "pick",
                "pick up",
                "hold",
                "hold up",
                "grab",
                "grasp",
                "lift",
                "lift up",
                "take",
                "seize",
                "keep hold of",
            ),
            needs={"standing": True, "holding": NOTHING},
            effects={"holding": "$object"},
            during={"moving": True},
            may=({"holding": "$object"},),
            timeout_s=40.0,
            on_stop="hold",
            on_link_loss="hold",
        ),
        Skill(
            name="wave",
            about="Wave with the arm.",
            args=Wave,
            words=(*_WAVE, "greet", "greet me", "give me a wave", "give us a wave", "say hello", "say hi"),
            needs={"standing": True},
            effects={"waved": True},
            during={"moving": True, "waved": False},
            may=({"waved": False},),
            timeout_s=20.0,
            on_stop="hold",
            on_link_loss="hold",
        ),
    ),
    publishes=(
        Published(
            name="requester",
            type="position",
            about="Where the person who asks is, and whether in reach of the hand.",
            max_age_s=3.0,
        ),
        Published(
            name="objects",
            type="position",
            about="Where each object lies, as seen from above; absent while it is out of sight.",
            max_age_s=3.0,
            each_object=True,
            tolerance_m=0.2,
        ),
    ),
    idle_on_stop="hold",
    idle_on_link_loss="hold",
)
