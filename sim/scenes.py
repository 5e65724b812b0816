"""The scenes that the simulation can host, by the name in a crew file. A scene is imported only once it is opened."""

import importlib
from collections.abc import Iterable, Mapping
from pkgutil import resolve_name
from types import TracebackType
from typing import TYPE_CHECKING, Any, Protocol, Self

import msgspec

from crew.errors import nearest
from crew.sim.config import WorldConfig
from crew.sim.faults import unavailable
from crew.sim.map import MAPS, MapError
from crew.sim.truth import SceneTruth

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from crew.sim.appearance import Appearance

SCENES = {
    "air_ground": ("crew.sim.world:World", "crew.sim.map:survey", "crew.sim.faults:SHARED"),
    "apartment": (
        "crew.sim.apartment.world:Apartment",
        "crew.sim.apartment.site:survey",
        "crew.sim.apartment.mishap:NAMES",
    ),
}
"""Each scene's world, the surveyor of its maps, and the names of its faults beside those of its vehicles."""

MODELS = {"apartment": "crew.sim.unitree.menagerie:check"}
"""What checks a folder of other models of the robots, for the scenes that take any."""


class Survey(msgspec.Struct, frozen=True):
    """What a surveyor would write down of a site: its origin, and its obstacles as discs x, y, radius (ENU, metres)."""

    origin: tuple[float, float, float]
    obstacles: tuple[tuple[float, float, float], ...]


class Eye(Protocol):
    """A camera as it is watched."""

    def image(self) -> "NDArray[np.int32]":
        """The body seen by each pixel, row by row; -1 where nothing but ground or sky is."""
        ...


class SceneWorld(Protocol):
    """What the simulation's process asks of a world: it steps, answers its robots' links, and tells the truth."""

    @property
    def time_ns(self) -> int: ...

    def advance(self, until_ns: int) -> None: ...

    def poll(self) -> int: ...

    def sent(self) -> dict[str, int]:
        """Datagrams sent to each robot's adapter since the start."""
        ...

    def scene_truth(self) -> SceneTruth: ...

    def appearance(self) -> "Appearance":
        """What the world looks like, for whoever draws it."""
        ...

    def cameras(self) -> Mapping[str, Eye]:
        """The cameras by the vehicle that carries each; vehicles without one are left out."""
        ...

    def set_fault(self, name: str, on: bool) -> None: ...

    def __enter__(self) -> Self: ...

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None: ...


def open_world(config: WorldConfig) -> SceneWorld:
    """The world of the scene that the configuration names. Raises ValueError for an unknown one, with those known."""
    world: SceneWorld = _load(config.scene, 0)(config)
    return world


def survey(scene: str, map_name: str) -> Survey:
    """The site of a scene's map. Raises MapError."""
    origin, obstacles = _load(scene, 1)(scene, map_name)
    return Survey(origin, obstacles)


def map_names(scene: str) -> tuple[str, ...]:
    """The scene's maps as a crew file may name them, in small letters."""
    return tuple(sorted(path.stem.removeprefix(f"{scene}_") for path in MAPS.glob(f"{scene}_*.yaml")))


def fault_names(scene: str, vehicles: Iterable[str]) -> tuple[str, ...]:
    """The faults that `--fault` takes for a scene with these vehicles. Raises MapError for an unknown scene."""
    return (*_load(scene, 2), *(unavailable(vehicle) for vehicle in vehicles))


def check_models(scene: str, folder: str) -> None:
    """Whether a scene can be built with the models of a folder; an empty one is the scene's own. Raises ValueError."""
    if not folder:
        return
    if scene not in MODELS:
        raise ValueError(f"the scene {scene} has robots of its own alone; {', '.join(sorted(MODELS))} takes others")
    resolve_name(MODELS[scene])(folder)


def _load(scene: str, part: int) -> Any:
    if scene not in SCENES:
        raise MapError(f"no scene is called {scene!r}{nearest(scene, SCENES)}")
    module, _, name = SCENES[scene][part].partition(":")
    return getattr(importlib.import_module(module), name)
