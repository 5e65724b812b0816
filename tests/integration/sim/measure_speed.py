"""Prints how many times faster than real time the whole scene runs: `python -m tests.integration.sim.measure_speed`.

Counts this process's CPU time, ground stations included, and gives the best and the mean of several windows: on a
shared machine the best is nearest to what a core of one's own would do.
"""

import statistics
import time

from tests.integration.sim.ground import Ground


def ratios(ground: Ground, windows: int = 8, seconds: float = 4.0) -> str:
    found = []
    for _ in range(windows):
        started = time.process_time()
        ground.run(seconds)
        found.append(seconds / (time.process_time() - started))
    return f"best {max(found):.0f}x, mean {statistics.fmean(found):.0f}x"


def main() -> None:
    for every_frame in (False, True):
        with Ground(seed=1, every_frame=every_frame) as ground:
            ground.take_off()
            ground.command(2, 176, 1, 15)
            ground.command(2, 400, 1)
            ground.drive(-4.0, 8.0)
            label = "every ray cast" if every_frame else "only rays near the victim cast"
            print(f"both moving, {label}: {ratios(ground)}")
            ground.go(5.0, 5.0, 5.0)
            ground.run(9.0)
            print(f"over the victim, {label}: {ratios(ground)}")


if __name__ == "__main__":
    main()
