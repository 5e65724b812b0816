"""The rover: drives to a point, a named location or a person that another robot found."""

from typing import Annotated

from crew.contracts.skill import Entity, Fluent, Kind, Relation, Skill, SkillArgs, entity, number

X = Annotated[float, number(ge=-1000.0, le=1000.0, unit="m", frame="world ENU", axis="x", about="East coordinate.")]
Y = Annotated[float, number(ge=-1000.0, le=1000.0, unit="m", frame="world ENU", axis="y", about="North coordinate.")]
Target = Annotated[
    str, entity(Entity.TARGET, "A run-time value such as victim, or a named location; resolved when dispatched.")
]


class NavigateTo(SkillArgs, frozen=True):
    target: Target | None = None
    x: X | None = None
    y: Y | None = None


class Stop(SkillArgs, frozen=True):
    pass


ROVER = Kind(
    name="rover",
    about="A small wheeled robot that drives around known obstacles.",
    aliases=("rover", "ugv", "ground robot", "turtlebot", "car"),
    fluents=(
        Fluent(name="moving", domain="bool", about="Ground speed above 0.1 m/s."),
        Fluent(name="at", domain="place", about="Horizontal position.", tolerance_m=0.6),
        Fluent(
            name="clear_above",
            domain="bool",
            about="No drone of the crew comes down within the separation of it.",
            relation=Relation.COLUMN_ABOVE,
            at_rest=True,
        ),
        Fluent(name="battery", domain="number", about="Charge, percent.", max_age_s=5.0),
    ),
    skills=(
        Skill(
            name="navigate_to",
            about="Drive to a target or a point around the known obstacles, and stop beside it.",
            args=NavigateTo,
            forms=(("target",), ("x", "y")),
            words=("send", "drive", "dispatch", "navigate", "go", "move", "head", "travel", "bring", "direct", "route"),
            needs={"clear_above": True},
            effects={"at": "$place", "moving": False},
            during={"moving": True},
            timeout_s=180.0,
            cost=3.0,
            on_stop="stop",
            on_link_loss="stop",
        ),
        Skill(
            name="stop",
            about="Go to zero speed and hold.",
            args=Stop,
            words=("stop", "halt", "hold", "freeze"),
            effects={"moving": False},
            timeout_s=15.0,
            on_stop="stop",
            on_link_loss="stop",
            safe=True,
        ),
    ),
    idle_on_stop="stop",
    idle_on_link_loss="stop",
)
