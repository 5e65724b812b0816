"""Prints how many times faster than real time the whole scene runs: `python -m tests.integration.sim.measure_speed`."""

import time

from tests.integration.sim.ground import IRIS, Ground


def ratio(ground: Ground, seconds: float = 20.0) -> float:
    started = time.perf_counter()
    ground.run(seconds)
    return seconds / (time.perf_counter() - started)


def main() -> None:
    for every_frame in (False, True):
        with Ground(seed=1, every_frame=every_frame) as ground:
            ground.take_off()
            ground.command(2, 176, 1, 15)
            ground.command(2, 400, 1)
            ground.drive(-4.0, 8.0)
            label = "every frame cast" if every_frame else "frames skipped"
            print(f"both moving, {label}: {ratio(ground):.0f}x")
            ground.go(5.0, 5.0, 5.0)
            ground.run(9.0)
            print(f"over the victim, {len(ground.all(IRIS, 'LANDING_TARGET'))} seen: {ratio(ground):.0f}x")


if __name__ == "__main__":
    main()
