"""Stop and reset of one robot. The stop acts in the bus's own thread, past the event loop; release is signed.

The orchestrator's heartbeat holds the stop up: it latches a robot that missed the message, or was not there yet.
"""

import asyncio
import threading
from collections import Counter
from typing import TYPE_CHECKING

from crew.adapter import Adapter
from crew.bus.port import Bus, Sample
from crew.keys import Keys
from crew.mailbox import Events, Letter, letters
from crew.messages import RESET, Heartbeat, Reset
from crew.signing import verify
from crew.wire import Refusal

if TYPE_CHECKING:
    from crew.actors.robot.actor import RobotActor


class StopSwitch:
    """Any sample on the stop key stops and latches, readable or not."""

    def __init__(self, bus: Bus, keys: Keys, actor: "RobotActor", adapter: Adapter, operator_key: bytes) -> None:
        self._actor, self._adapter, self._keys = actor, adapter, keys
        self._operator_key = operator_key
        self._loop = asyncio.get_running_loop()
        self._stopped = asyncio.Event()
        self._nonces: set[str] = set()
        self._order = threading.Lock()
        self._count = 0
        self.told = (-1, -1)
        """Epoch and number of the newest stop that a heartbeat has told of."""
        self._resets: Events[Letter[Reset]] = Events(letters(Reset), capacity=16, on_lost=lambda _: None)
        self._declared = [bus.on_sample(keys.stop, self._on_stop), bus.subscribe(keys.reset, self._resets)]
        self.acting = False
        """The declared behaviour of a stop is under way."""

    @property
    def latch(self) -> str:
        """Names the newest stop that this boot has heard: what a reset must have seen to release it."""
        return f"{self._actor.boot_id}/{self._count}"

    @property
    def refusals(self) -> Counter[Refusal]:
        """Unreadable resets, by reason."""
        return self._resets.refusals

    async def run(self) -> None:
        """Carry out declared behaviours after a stop, and judge resets, until cancelled."""
        try:
            async with asyncio.TaskGroup() as group:
                group.create_task(self._behave())
                async for letter in self._resets:
                    self._judge(letter.message)
        finally:
            for declaration in self._declared:
                declaration.close()

    def hear(self, beat: Heartbeat) -> None:
        """The orchestrator's word: a stop that is newer than the last it told of latches whom it names.

        The number tells a stop that this robot missed from one that it was released from since.
        """
        newest = (beat.epoch, beat.stop)
        if newest <= self.told:
            return
        if self._actor.name in beat.stopped:
            if not self._adapter.latched:
                self._stopped.set()
            self._halt()
        self.told = newest
        self._actor.report.state()

    def again(self) -> None:
        """The vehicle has only now been found: what was latched before is carried out on it."""
        if self._adapter.latched:
            self._adapter.halt()
            self._stopped.set()

    def _on_stop(self, sample: Sample) -> None:
        """In the bus's thread: latch and halt first, tell the loop afterwards."""
        self._halt()
        if not self._loop.is_closed():
            self._loop.call_soon_threadsafe(self._stopped.set)

    def _halt(self) -> None:
        """One more stop: nothing that was signed before it releases it."""
        with self._order:
            self._adapter.halt()
            self._count += 1

    async def _behave(self) -> None:
        while True:
            await self._stopped.wait()
            self._stopped.clear()
            self.acting = True
            behaviour = self._actor.behaviour("on_stop")
            self._actor.report.event("stopped", code="stopped", detail=f"latched; {behaviour}")
            self._actor.report.state()
            await self._actor.interrupt("stopped")
            await self._actor.make_safe(behaviour)
            self.acting = False
            self._actor.report.state()

    def _judge(self, reset: Reset) -> None:
        with self._order:
            problem = self._problem(reset)
            if not problem:
                self._nonces.add(reset.nonce)
                self._adapter.release()
        if problem:
            self._actor.report.event("reset_refused", code="reset_refused", detail=problem)
            return
        self._actor.report.event("released", detail=f"by {reset.by}")
        self._actor.report.state()

    def _problem(self, reset: Reset) -> str:
        if self._actor.name not in reset.targets:
            return f"not among the targets {', '.join(reset.targets)}"
        if not verify(self._operator_key, RESET, reset.signed_part(self._keys.crew), reset.signature):
            return "the signature is not the operator's"
        if reset.epoch != self._actor.admission.epoch:
            return f"for epoch {reset.epoch}, the crew's epoch is {self._actor.admission.epoch}"
        if reset.nonce in self._nonces:
            return "this reset was used before"
        if reset.targets[self._actor.name] != self.latch:
            return "it was signed before the newest stop; see who stopped and why (crew status), then reset again"
        if self.acting:
            return "the robot is still carrying out its stop; wait until it stands still"
        return ""
