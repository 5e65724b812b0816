"""The quadruped: walks to places and people with a tray on its back."""

from typing import Annotated

from crew.contracts.skill import NOTHING, Entity, Fluent, Kind, Part, Skill, SkillArgs, entity

Goal = Annotated[
    str, entity(Entity.TARGET, "A named location, or a run-time value such as requester; resolved when dispatched.")
]


class Navigate(SkillArgs, frozen=True):
    location: Goal


class Stop(SkillArgs, frozen=True):
    pass


QUADRUPED = Kind(
    name="quadruped",
    about="A four-legged robot that walks between places and carries an object in the tray on its back.",
    aliases=("quadruped", "dog", "robot dog", "quadruped robot"),
    fluents=(
        Fluent(name="standing", domain="bool", about="On its feet, from pose and height.", at_rest=True),
        Fluent(name="moving", domain="bool", about="Ground speed above 0.1 m/s."),
        Fluent(name="at", domain="place", about="Horizontal position.", tolerance_m=0.3),
        Fluent(name="tray", domain="object", about="What lies in the tray, from the tray's sensor."),
        Fluent(name="battery", domain="number", about="Charge, percent.", max_age_s=5.0),
    ),
    skills=(
        Skill(
            name="navigate",
            about="Walk to a place around obstacles and through doorways, and stand still there.",
            args=Navigate,
            words=(
                "go",
                "walk",
                "send",
                "navigate",
                "move",
                "head",
                "run",
                "travel",
                "come",
                "return",
                "enter",
                "drive",
                "proceed",
            ),
            needs={"standing": True},
            effects={"at": "$location", "moving": False},
            during={"moving": True},
            may=({"moving": False}, {"standing": False}, {"tray": NOTHING}),
            timeout_s=180.0,
            cost=3.0,
            on_stop="stop",
            on_link_loss="stop",
        ),
        Skill(
            name="stop",
            about="Stop walking and stand still.",
            args=Stop,
            words=("stop", "halt", "freeze", "stand still"),
            effects={"moving": False},
            timeout_s=15.0,
            on_stop="stop",
            on_link_loss="stop",
            safe=True,
        ),
    ),
    parts=(Part(name="payload_tray", aliases=("tray",), holds="tray", about="The tray on its back."),),
    idle_on_stop="stop",
    idle_on_link_loss="stop",
)
