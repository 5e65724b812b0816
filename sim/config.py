"""What a world is made from. Must not open or load anything."""

import msgspec


class WorldConfig(msgspec.Struct, frozen=True, kw_only=True):
    """links: robot to `udp:HOST:PORT`, where its ground side listens.

    autopilots: vehicle to `px4` or `ardupilot`; one left out has the scene's own. noise off gives perfect estimates
    and pixels. every_frame casts all of the camera's rays, those that cannot meet a target as well. signing_keys:
    vehicle to the 32 bytes that its link is signed with; an unsigned link is the default. models: the folder of MuJoCo
    Menagerie, if its robots shall take the place of the scene's own.
    """

    map: str = "A"
    scene: str = "air_ground"
    seed: int = 0
    faults: tuple[str, ...] = ()
    noise: bool = True
    every_frame: bool = False
    links: dict[str, str]
    autopilots: dict[str, str] = {}
    signing_keys: dict[str, bytes] = {}
    models: str = ""
