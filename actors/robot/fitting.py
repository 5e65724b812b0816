"""A robot's adapter, found by the name in the crew file among those that are installed."""

from pkgutil import resolve_name

from crew.adapter import Adapter, AdapterConfig
from crew.clock import Clock
from crew.contracts.site import RobotSpec, Rules
from crew.errors import UsageError, nearest

ADAPTERS = "crew.adapters"
SHIPPED = {
    "mavlink": "crew.adapters.mavlink.adapter:MavlinkAdapter",
    "unitree": "crew.adapters.unitree.adapter:UnitreeAdapter",
}
"""Adapters of this distribution: found without reading what else is installed."""


def make_adapter(
    robot: RobotSpec, rules: Rules, connection: str, clock: Clock, *, models: str = "", enforced: bool = True
) -> Adapter:
    """The adapter that the crew file names. Raises UsageError with the installed names for an unknown one."""
    place = SHIPPED.get(robot.adapter) or _installed(robot.adapter)
    crew = rules.crew
    config = AdapterConfig(
        robot=robot.name,
        kind=robot.kind,
        connection=connection,
        options=dict(robot.options),
        area=(crew.area.x_min, crew.area.x_max, crew.area.y_min, crew.area.y_max),
        origin=crew.origin,
        obstacles=crew.obstacles,
        separation_m=crew.separation.told_m,
        locations={place.name: (place.x, place.y) for place in crew.locations},
        models=models,
        geofence=enforced,
        fitness=enforced,
    )
    try:
        adapter: Adapter = resolve_name(place)(config, clock)
    except ImportError as error:
        raise UsageError(f"adapter {robot.adapter!r} can't be imported: {error}; install robot-crew[all]") from error
    return adapter


def _installed(name: str) -> str:
    """Where an adapter of another distribution is. Raises UsageError."""
    from importlib.metadata import entry_points

    installed = {entry.name: entry.value for entry in entry_points(group=ADAPTERS)}
    if name not in installed:
        raise UsageError(f"no adapter is called {name!r}{nearest(name, {*SHIPPED, *installed})}")
    return installed[name]
