"""Who the simulation waits for between two slices, and how long: lockstep membership and wall-clock pacing."""

from collections.abc import Collection

import msgspec

from crew.clock import WALL, seconds_ns
from crew.mailbox import Events, Letter
from crew.messages import ClockAck

SILENT_S = 1.0
"""A participant that says nothing for so long of wall time drops out; its next word brings it back."""
LOOKS = 4
"""Its silence is heard out in as many looks: a pause of the whole machine is nobody's silence."""


class Member(msgspec.Struct):
    """One participant as last heard."""

    slice: int
    datagrams: int
    idle: bool
    holding: bool
    silent_s: float = 0.0
    """Wall time that was spent waiting for its word."""


class Lockstep:
    """Waits until every participant has acknowledged a slice, or has dropped out."""

    def __init__(self, acks: Events[Letter[ClockAck]]) -> None:
        self.members: dict[str, Member] = {}
        self.dropped = 0
        self._acks = acks

    async def gather(self, names: Collection[str], limit_s: float) -> None:
        """Return when all of these take part, or after `limit_s` of wall time without some of them."""
        deadline_ns = WALL.now_ns() + seconds_ns(limit_s)
        while not self.members.keys() >= set(names) and (left_ns := deadline_ns - WALL.now_ns()) > 0:
            await WALL.race(self._acks.changed(), left_ns / 1e9)
            self._hear(0)

    async def wait(self, number: int, *, for_holders: bool) -> None:
        """Return when nobody is still working on slice `number`; `for_holders` minds those who withhold it as well."""
        self._hear(number)
        while waiting := [m for m in self.members.values() if m.slice < number and (for_holders or not m.holding)]:
            look_s, began_ns = SILENT_S / LOOKS, WALL.now_ns()
            await WALL.race(self._acks.changed(), look_s)
            looked_s = min(look_s, (WALL.now_ns() - began_ns) / 1e9)
            for member in waiting:
                member.silent_s += looked_s
            self._hear(number)
            self._drop_silent(number)

    @property
    def idle(self) -> bool:
        """Nobody has anything to do: the simulation need not run ahead of the wall's clock."""
        return all(m.idle for m in self.members.values())

    def _hear(self, number: int) -> None:
        while letters := self._acks.take():
            for letter in letters:
                self._note(letter.message, number)

    def _note(self, ack: ClockAck, number: int) -> None:
        """Whoever has seen no tick yet takes part from the next one: the current one went out before it listened."""
        known = self.members.get(ack.name)
        if ack.slice < 0:
            done = number
        elif ack.holding:
            done = known.slice if known else ack.slice - 1
        else:
            done = ack.slice
        self.members[ack.name] = Member(done, ack.datagrams, ack.idle, ack.holding)

    def _drop_silent(self, number: int) -> None:
        for name, member in list(self.members.items()):
            if member.slice < number and member.silent_s >= SILENT_S:
                del self.members[name]
                self.dropped += 1


class Pace:
    """Holds the simulation to a multiple of real time; restarts its count after a stretch that was not paced."""

    def __init__(self) -> None:
        self._due_ns = 0

    async def wait(self, slice_s: float, speed: float) -> None:
        """Sleep until the next slice is due at `speed` times real time."""
        now_ns = WALL.now_ns()
        step_ns = round(seconds_ns(slice_s) / speed)
        if not now_ns - 4 * step_ns <= self._due_ns <= now_ns + step_ns:
            self._due_ns = now_ns
        self._due_ns += step_ns
        if self._due_ns > now_ns:
            await WALL.sleep((self._due_ns - now_ns) / 1e9)
