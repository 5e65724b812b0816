"""What a world is made from. Must not open or load anything."""

import msgspec


class WorldConfig(msgspec.Struct, frozen=True, kw_only=True):
    """links: robot to `udp:HOST:PORT`, where its ground side listens.

    noise off gives perfect estimates and pixels. every_frame casts all of the camera's rays, those that cannot meet the
    victim as well.
    """

    map: str = "A"
    scene: str = "air_ground"
    seed: int = 0
    faults: tuple[str, ...] = ()
    noise: bool = True
    every_frame: bool = False
    links: dict[str, str]
