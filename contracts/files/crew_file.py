"""Crew files: text to a `Crew` whose names are unambiguous and whose places lie in its area."""

from crew.contracts.files.crew_check import AREA, check
from crew.contracts.files.crew_model import AreaModel, CrewModel, OriginModel, ZoneModel
from crew.contracts.files.file_model import validate
from crew.contracts.files.source import Problems, parse
from crew.contracts.plan import Zone
from crew.contracts.site import Crew, Location, NamedObject, NamedZone, RobotSpec, RuntimeValue, Separation, SimSpec


def load_crew(text: str, *, source: str) -> Crew:
    """The crew that the text holds; `source` names the file in errors. Raises SourceErrors with all mistakes."""
    return _build(_read(text, source), source)


def demo_request(text: str, *, source: str) -> str:
    """What a demonstration asks of the crew, empty if the file does not say: no rule, and so no part of a `Crew`."""
    return _read(text, source).demo


def _read(text: str, source: str) -> CrewModel:
    root = parse(text, file=source)
    problems = Problems(source, root)
    model = validate(CrewModel, root, problems)
    if model is None:
        problems.done()
        raise AssertionError("a file that has no shape has problems")
    check(model, problems)
    problems.done()
    return model


def _build(model: CrewModel, source: str) -> Crew:
    return Crew(
        name=model.crew,
        area=_zone(model.area),
        origin=_origin(model.origin),
        robots=_robots(model),
        locations=tuple(
            Location(name=name, x=place.at[0], y=place.at[1], aliases=tuple(place.aliases))
            for name, place in model.locations.items()
        ),
        zones=_zones(model),
        objects=tuple(NamedObject(name=name, aliases=tuple(o.aliases)) for name, o in model.objects.items()),
        values=tuple(
            RuntimeValue(name=name, aliases=tuple(value.aliases), standoff_m=value.standoff_m)
            for name, value in model.values.items()
        ),
        contracts=tuple(model.contracts),
        obstacles=tuple((x, y, radius) for x, y, radius in model.obstacles),
        separation=Separation(column_m=model.separation.column_m, pose_m=model.separation.pose_m),
        sim=_sim(model),
        source=source,
    )


def _zone(written: AreaModel | ZoneModel) -> Zone:
    (x_min, x_max), (y_min, y_max) = written.x or (0.0, 0.0), written.y or (0.0, 0.0)
    return Zone(x_min=x_min, x_max=x_max, y_min=y_min, y_max=y_max)


def _zones(model: CrewModel) -> tuple[NamedZone, ...]:
    """The zones as named; the operational area is the area itself, and always there."""
    written = {AREA: ZoneModel(), **model.zones}
    return tuple(
        NamedZone(name=name, zone=_zone(model.area if name == AREA else zone), aliases=tuple(zone.aliases))
        for name, zone in written.items()
    )


def _origin(written: OriginModel | None) -> tuple[float, float, float]:
    return (0.0, 0.0, 0.0) if written is None else (written.lat_deg, written.lon_deg, written.alt_m)


def _robots(model: CrewModel) -> tuple[RobotSpec, ...]:
    return tuple(
        RobotSpec(
            name=name,
            kind=robot.kind,
            adapter=robot.adapter,
            aliases=tuple(robot.aliases),
            reach=tuple(robot.reach),
            sim=robot.sim or "",
            connection=robot.connection or "",
            options=robot.options,
        )
        for name, robot in model.robots.items()
    )


def _sim(model: CrewModel) -> SimSpec | None:
    sim = model.sim
    if sim is None:
        return None
    return SimSpec(
        scene=sim.scene, map=sim.map, seed=sim.seed, faults=tuple(sim.faults), autopilots=dict(sim.autopilots)
    )
