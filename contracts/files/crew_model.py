"""The shape of a crew file. What its numbers and names mean together is checked in `crew_file`."""

from typing import Annotated, Any, ClassVar

from pydantic import Field

from crew.contracts.files.file_model import FileModel, Name, Text
from crew.contracts.site import Separation

Range = Annotated[list[float], Field(min_length=2, max_length=2)]
"""Lowest and highest, metres."""
Disc = Annotated[list[float], Field(min_length=3, max_length=3)]
Aliases = Annotated[list[Text], Field(description="What people call it")]


class AreaModel(FileModel):
    """The operational area: world ENU, metres."""

    called: ClassVar[str] = "the area"
    x: Range
    y: Range


class OriginModel(FileModel):
    """Where on Earth the world's (0, 0, 0) lies."""

    called: ClassVar[str] = "the origin"
    lat_deg: Annotated[float, Field(ge=-90, le=90)]
    lon_deg: Annotated[float, Field(ge=-180, le=180)]
    alt_m: Annotated[float, Field(description="Above mean sea level")] = 0.0


class RobotModel(FileModel):
    """One robot: either simulated (`sim`) or real (`connection`)."""

    called: ClassVar[str] = "a robot"
    kind: Name
    adapter: Name
    sim: Annotated[Text | None, Field(description="The simulated vehicle's name in the scene")] = None
    connection: Annotated[Text | None, Field(description="The real robot's connection")] = None
    aliases: Aliases = Field(default_factory=list)
    reach: Annotated[list[Name], Field(description="The places that it reaches, for skills that place things")] = Field(
        default_factory=list
    )
    options: dict[str, Any] = Field(default_factory=dict, description="Settings of the adapter")


class LocationModel(FileModel):
    """A named place."""

    called: ClassVar[str] = "a location"
    at: Annotated[list[float], Field(min_length=2, max_length=2, description="x and y: world ENU, metres")]
    aliases: Aliases = Field(default_factory=list)


class ZoneModel(FileModel):
    """A named part of the operational area."""

    called: ClassVar[str] = "a zone"
    x: Range | None = None
    y: Range | None = None
    aliases: Aliases = Field(default_factory=list)


class ObjectModel(FileModel):
    """An object that robots can handle."""

    called: ClassVar[str] = "an object"
    aliases: Aliases = Field(default_factory=list)


class ValueModel(FileModel):
    """A value that exists only at run time, such as a person's place."""

    called: ClassVar[str] = "a run-time value"
    aliases: Aliases = Field(default_factory=list)
    standoff_m: Annotated[float, Field(ge=0, description="How far from it a robot stops")] = 0.0


class SeparationModel(FileModel):
    """How far a drone that comes down and robots on the ground keep from each other, horizontally, metres."""

    called: ClassVar[str] = "the separation"
    column_m: Annotated[float, Field(gt=0, le=100, description="Between their true centres")] = Separation().column_m
    pose_m: Annotated[float, Field(ge=0, le=50, description="How far each one's own position may be off")] = (
        Separation().pose_m
    )


class SimModel(FileModel):
    """The simulated scene."""

    called: ClassVar[str] = "sim"
    scene: Text
    map: Text = "A"
    seed: Annotated[int, Field(ge=0)] = 0
    faults: list[Text] = Field(default_factory=list, description="Names, or name@seconds for one that begins later")
    autopilots: dict[Name, Text] = Field(
        default_factory=dict, description="Vehicle to its autopilot, such as px4 or ardupilot"
    )


class CrewModel(FileModel):
    """A crew and the site it works on."""

    called: ClassVar[str] = "a crew"
    crew: Name
    area: AreaModel
    origin: OriginModel | None = None
    robots: Annotated[dict[Name, RobotModel], Field(min_length=1)]
    locations: dict[Name, LocationModel] = Field(default_factory=dict)
    zones: dict[Name, ZoneModel] = Field(default_factory=dict)
    objects: dict[Name, ObjectModel] = Field(default_factory=dict)
    values: dict[Name, ValueModel] = Field(default_factory=dict)
    contracts: list[Name] = Field(default_factory=list, description="Shipped ones, or files beside this one")
    obstacles: list[Disc] = Field(
        default_factory=list, description="Known obstacles as discs x, y, radius: world ENU, metres"
    )
    separation: SeparationModel = Field(default_factory=SeparationModel)
    sim: SimModel | None = None
    demo: Annotated[str, Field(max_length=500, description="The request that `crew demo` makes of this crew")] = ""
