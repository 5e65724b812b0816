"""A simulated world that runs by itself, at a multiple of real time, for clients that keep their own time."""

import threading
import time
from types import TracebackType
from typing import Any, Self

from crew.sim.config import WorldConfig
from crew.sim.world import World
from tests.integration.paced import free_port

SLICE_NS = 20_000_000


class PacedWorld:
    """Steps in a thread of its own until the block ends. `ports`: vehicle to where it sends."""

    def __init__(self, speed: float, **config: Any) -> None:
        self.ports = {name: free_port() for name in ("iris", "tb3")}
        links = {name: f"udp:127.0.0.1:{port}" for name, port in self.ports.items()}
        self.world = World(WorldConfig(links=links, **config))
        self._speed = speed
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._lock = threading.Lock()

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._over.set()
        self._thread.join()
        self.world.close()

    def truth(self) -> Any:
        """What really is, between two slices."""
        with self._lock:
            return self.world.truth()

    def _run(self) -> None:
        due_s = time.monotonic()
        while not self._over.is_set():
            with self._lock:
                self.world.advance(self.world.time_ns + SLICE_NS)
            due_s = max(due_s + SLICE_NS / 1e9 / self._speed, time.monotonic() - 0.5)
            time.sleep(max(0.0, due_s - time.monotonic()))
