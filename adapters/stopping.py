"""The stop's repetition: a short-lived thread on wall time that works while the event loop is blocked."""

import threading
from collections.abc import Callable

TRIES = 20
PERIOD_S = 0.1


class StopRepeater:
    """Sends the stop again every 100 ms until the vehicle stands still, 20 tries are over, or `finish` is called."""

    def __init__(self, send: Callable[[], None], still: Callable[[], bool], lock: threading.RLock) -> None:
        self._send = send
        self._still = still
        self._lock = lock
        self._over = threading.Event()
        self._thread: threading.Thread | None = None

    @property
    def active(self) -> bool:
        """Whether it is still repeating."""
        return self._thread is not None and self._thread.is_alive() and not self._over.is_set()

    def start(self) -> None:
        """Begin, or begin again; returns at once."""
        self.finish()
        self._over = over = threading.Event()
        self._thread = threading.Thread(target=self._repeat, args=(over,), name="stop", daemon=True)
        self._thread.start()

    def finish(self) -> None:
        """No stop leaves after this returns."""
        with self._lock:
            self._over.set()

    def _repeat(self, over: threading.Event) -> None:
        for _ in range(TRIES):
            if over.wait(PERIOD_S) or self._still():
                return
            with self._lock:
                if over.is_set():
                    return
                self._send()
