"""A robot's adapter, found by the name in the crew file among those that are installed."""

from importlib.metadata import entry_points

from crew.adapter import Adapter, AdapterConfig
from crew.clock import Clock
from crew.contracts.site import RobotSpec, Rules
from crew.errors import UsageError, nearest

ADAPTERS = "crew.adapters"


def make_adapter(robot: RobotSpec, rules: Rules, connection: str, clock: Clock, *, enforced: bool = True) -> Adapter:
    """The adapter that the crew file names. Raises UsageError with the installed names for an unknown one."""
    installed = {entry.name: entry for entry in entry_points(group=ADAPTERS)}
    entry = installed.get(robot.adapter)
    if entry is None:
        raise UsageError(f"no adapter is called {robot.adapter!r}{nearest(robot.adapter, installed)}")
    crew = rules.crew
    config = AdapterConfig(
        robot=robot.name,
        kind=robot.kind,
        connection=connection,
        options=dict(robot.options),
        area=(crew.area.x_min, crew.area.x_max, crew.area.y_min, crew.area.y_max),
        origin=crew.origin,
        obstacles=crew.obstacles,
        locations={place.name: (place.x, place.y) for place in crew.locations},
        geofence=enforced,
        fitness=enforced,
    )
    try:
        adapter: Adapter = entry.load()(config, clock)
    except ImportError as error:
        raise UsageError(f"adapter {robot.adapter!r} can't be imported: {error}; install robot-crew[all]") from error
    return adapter
