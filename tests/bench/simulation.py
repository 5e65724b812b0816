"""How much faster than real time the simulation runs headless, with both robots moving and a plain ground station."""

import time

from tests.integration.sim.ground import Ground


def measure(seconds: float) -> float:
    """Simulated seconds for each second of wall time."""
    with Ground(seed=1) as ground:
        ground.take_off()
        ground.command(2, 176, 1, 15)
        ground.command(2, 400, 1)
        ground.drive(-4.0, 8.0)
        began = time.perf_counter()
        ground.run(seconds)
        return seconds / (time.perf_counter() - began)
