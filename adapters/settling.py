"""Holds simulated time while received messages are handled, and tells once their tasks have had their turns."""

import asyncio
from collections.abc import Callable
from contextlib import AbstractContextManager

from crew.clock import Clock

TURNS = 6
"""Turns of the loop that a task woken by a message is given before the traffic counts as handled."""


class Settling:
    """`note()` after each batch, on the loop."""

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        self._hold: AbstractContextManager[None] | None = None
        self._turns = 0
        self._callbacks: list[Callable[[], None]] = []

    def on_settled(self, callback: Callable[[], None]) -> None:
        """Call back, on the loop, once a batch was handled."""
        self._callbacks.append(callback)

    def note(self) -> None:
        """A batch was handed on; what it woke gets its turns from now."""
        self._turns = TURNS
        if self._hold is None:
            self._hold = self._clock.busy()
            self._hold.__enter__()
            asyncio.get_running_loop().call_soon(self._turn)

    def close(self) -> None:
        """Hold time no longer."""
        if self._hold is not None:
            hold, self._hold = self._hold, None
            hold.__exit__(None, None, None)

    def _turn(self) -> None:
        if self._hold is None:
            return
        self._turns -= 1
        if self._turns > 0:
            asyncio.get_running_loop().call_soon(self._turn)
            return
        self.close()
        for callback in self._callbacks:
            callback()
