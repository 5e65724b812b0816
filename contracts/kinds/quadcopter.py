"""The quadcopter: takes off, searches an area with a downward camera, reports what it found, lands."""

from typing import Annotated

from crew.contracts.skill import Fluent, Kind, Published, Relation, Skill, SkillArgs, number

Altitude = Annotated[
    float, number(ge=2.0, le=10.0, unit="m", frame="above home", about="Height above the take-off point.")
]
X = Annotated[float, number(ge=-1000.0, le=1000.0, unit="m", frame="world ENU", axis="x", about="East coordinate.")]
Y = Annotated[float, number(ge=-1000.0, le=1000.0, unit="m", frame="world ENU", axis="y", about="North coordinate.")]


class Takeoff(SkillArgs, frozen=True):
    altitude: Altitude


class SearchTarget(SkillArgs, frozen=True):
    x_min: X
    x_max: X
    y_min: Y
    y_max: Y
    altitude: Altitude


class GetCoordinates(SkillArgs, frozen=True):
    pass


class FlyTo(SkillArgs, frozen=True):
    x: X
    y: Y
    altitude: Altitude


class Land(SkillArgs, frozen=True):
    pass


QUADCOPTER = Kind(
    name="quadcopter",
    about="A small drone with a downward camera that recognises a person.",
    aliases=("drone", "quadcopter", "quadrotor", "quad", "uav", "copter"),
    fluents=(
        Fluent(name="airborne", domain="bool", about="Off the ground, from the landed-state report."),
        Fluent(name="moving", domain="bool", about="Ground speed above 0.3 m/s."),
        Fluent(name="at", domain="place", about="Horizontal position.", tolerance_m=0.8),
        Fluent(name="altitude", domain="number", about="Height above home, metres."),
        Fluent(name="descending", domain="bool", about="In the air, and landing or sinking faster than 0.4 m/s."),
        Fluent(
            name="clear_below",
            domain="bool",
            about="No other robot of the crew is on the ground within the separation of the point below it.",
            relation=Relation.COLUMN_BELOW,
            at_rest=True,
        ),
        Fluent(name="swept", domain="bool", about="The last search covered its whole zone."),
        Fluent(name="battery", domain="number", about="Charge, percent.", max_age_s=5.0),
    ),
    skills=(
        Skill(
            name="takeoff",
            about="Arm, climb to an altitude and hover there.",
            args=Takeoff,
            words=("take off", "takeoff", "launch", "lift off"),
            needs={"airborne": False},
            effects={"airborne": True},
            during={"moving": True},
            may=({"airborne": True},),
            timeout_s=40.0,
            on_stop="hover_then_land",
            on_link_loss="hover_then_land",
        ),
        Skill(
            name="search_target",
            about="Sweep a rectangle with the downward camera and look for the person.",
            args=SearchTarget,
            ranges=(("x_min", "x_max"), ("y_min", "y_max")),
            words=(
                "search",
                "scan",
                "sweep",
                "survey",
                "look",
                "find",
                "locate",
                "explore",
                "comb",
                "inspect",
                "check",
            ),
            needs={"airborne": True},
            effects={"swept": True},
            during={"moving": True},
            may=({"swept": False},),
            reports=("victim",),
            timeout_s=240.0,
            cost=5.0,
            on_stop="hover_then_land",
            on_link_loss="hover_then_land",
        ),
        Skill(
            name="get_coordinates",
            about="Publish where the person was seen, or that nobody was.",
            args=GetCoordinates,
            words=("report", "coordinates", "position", "locate", "find", "tell", "give"),
            needs={"airborne": True},
            effects={},
            reports=("victim",),
            timeout_s=10.0,
            on_stop="hover_then_land",
            on_link_loss="hover_then_land",
        ),
        Skill(
            name="fly_to",
            about="Fly to a point at an altitude and hover there.",
            args=FlyTo,
            words=("fly", "go", "move", "hover"),
            needs={"airborne": True},
            effects={"at": "$point", "moving": False},
            during={"moving": True},
            timeout_s=60.0,
            on_stop="hover_then_land",
            on_link_loss="hover_then_land",
        ),
        Skill(
            name="land",
            about="Land where it is, or aside if somebody is below, and disarm.",
            args=Land,
            words=("land", "come down", "touch down", "descend"),
            step_needs={"clear_below": True},
            effects={"airborne": False},
            during={"moving": True},
            timeout_s=60.0,
            on_stop="land",
            on_link_loss="land",
            safe=True,
        ),
    ),
    publishes=(
        Published(
            name="victim",
            type="position",
            about="Where the person is, as seen by the downward camera.",
            max_age_s=600.0,
            by=("search_target", "get_coordinates"),
        ),
    ),
    idle_on_stop="hover_then_land",
    idle_on_link_loss="hover_then_land",
)
