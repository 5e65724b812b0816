"""A participant of the simulation's clock: it advances this process's mission time and acknowledges each slice.

The acknowledgement is withheld while work is in flight here: a busy clock, or datagrams still on the vendor's link.
A paced world does not wait for work, so a busy clock goes on with it: one that stood still would find every state to
come from the future.
"""

import asyncio
from collections.abc import Callable

from crew.bus.port import Bus, Qos
from crew.clock import WALL, SimClock, turn
from crew.keys import Keys
from crew.mailbox import KeepLatest, Letter, letters
from crew.messages import ClockAck, ClockTick

HOLD_EVERY_S = 0.25
"""Wall time between two signs of life while a slice is withheld; the simulation drops a participant silent for 1 s."""
LOST_AFTER_S = 0.5
"""Wall time after which a datagram of the vendor's link counts as lost."""
BACK_S = 0.02
"""The same in the slice in which a link is back, the first of whose datagrams went nowhere."""
COUNT_AFTER = 20
"""Slices after which what counts as lost is counted anew, for it may only have been late; each time twice as many."""
COUNT_S = 0.02
"""Wall time that such a count waits for the simulation, and then for what may still come."""
TURNS = 3
"""Turns of the loop that timers and mailboxes get before a slice counts as done."""


class Losses:
    """How many datagrams of a link will never come, as far as counts tell."""

    def __init__(self) -> None:
        self.lost = 0
        self._slices = 0
        self._count_after = COUNT_AFTER

    def complete(self, expected: int, received: int) -> bool:
        """Whether everything that will ever come of `expected` datagrams has come."""
        return received + self.lost >= expected

    def give_up(self, expected: int, received: int) -> None:
        """What has not come yet counts as lost, until it is counted anew."""
        self.lost = max(0, expected - received)
        self._slices, self._count_after = 0, COUNT_AFTER

    def is_due(self) -> bool:
        """Asked once a slice: whether to count anew."""
        self._slices += 1
        return self.lost > 0 and self._slices >= self._count_after

    def count(self, sent: int, received: int) -> None:
        """What was sent and what has come, at a moment at which nothing was on its way."""
        self.lost = max(0, sent - received)
        self._slices, self._count_after = 0, 2 * self._count_after


class Participant:
    """Run `run()` for as long as the actor lives. `counts` gives datagrams sent and received on the vendor's link."""

    def __init__(
        self,
        bus: Bus,
        keys: Keys,
        name: str,
        clock: SimClock,
        *,
        counts: Callable[[], tuple[int, int]] = lambda: (0, 0),
        idle: Callable[[], bool] = lambda: True,
    ) -> None:
        self._clock = clock
        self._name = name
        self._counts = counts
        self._idle = idle
        self._traffic = asyncio.Event()
        self._ticks: KeepLatest[Letter[ClockTick]] = KeepLatest(letters(ClockTick))
        self._subscription = bus.subscribe(keys.clock, self._ticks)
        self._acks = bus.publisher(keys.clock_ack(name), qos=Qos.EVENT)
        self._losses = Losses()
        self._down_at = -1
        """Datagrams received when one was last given up: until another comes, the link counts as down."""

    def notice_traffic(self) -> None:
        """Told by the adapter that datagrams were handled."""
        self._traffic.set()

    async def run(self) -> None:
        """Join, then follow the clock until cancelled."""
        await self._say_until_first_tick()
        async for letter in self._ticks:
            await self._take_slice(letter.message)

    async def _say_until_first_tick(self) -> None:
        while True:
            self._ack(-1)
            if await WALL.race(self._ticks.changed(), HOLD_EVERY_S):
                return

    async def _take_slice(self, tick: ClockTick) -> None:
        await self._await_datagrams(tick)
        if self._losses.is_due():
            tick = await self._count_anew(tick)
        self._clock.advance(tick.now_ns)
        for _ in range(TURNS):
            await turn()
        while self._clock.is_busy and not tick.paced:
            await self._hold(tick.slice, lambda: not self._clock.is_busy, self._clock.idle_event)
            await turn()
        self._ack(tick.slice)

    async def _await_datagrams(self, tick: ClockTick) -> None:
        """Wait for what the simulation sent to this link; what has not come after a while counts as lost."""
        expected = tick.datagrams.get(self._name, 0)
        was_down = self._down_at >= 0
        if await self._is_down():
            self._losses.give_up(expected, self._received)
            return
        arrived = self._hold(tick.slice, lambda: self._losses.complete(expected, self._received), self._traffic)
        if not await WALL.race(arrived, BACK_S if was_down else LOST_AFTER_S):
            self._losses.give_up(expected, self._received)
            self._down_at = -1 if was_down else self._received

    async def _count_anew(self, tick: ClockTick) -> ClockTick:
        """The tick to go on with. The simulation is a slice ahead and waits: its next tick tells all that it has sent.

        Without it, what comes early from that slice could not be told from what came late.
        """
        await WALL.race(self._ticks.changed(), COUNT_S)
        for letter in self._ticks.take():
            tick = letter.message
        sent = tick.datagrams.get(self._name, 0)
        await WALL.race(self._hold(tick.slice, lambda: self._received >= sent, self._traffic), COUNT_S)
        self._losses.count(sent, self._received)
        return tick

    async def _is_down(self) -> bool:
        """Whether nothing has come since datagrams were given up; what waits in the socket is read first."""
        for _ in range(TURNS):
            if self._received != self._down_at:
                self._down_at = -1
                return False
            await turn()
        return True

    @property
    def _received(self) -> int:
        return self._counts()[1]

    async def _hold(self, number: int, done: Callable[[], bool], event: asyncio.Event) -> None:
        """Wait until `done`, showing a sign of life now and then."""
        while not done():
            event.clear()
            if not await WALL.race(event.wait(), HOLD_EVERY_S):
                self._ack(number, holding=True)

    def _ack(self, number: int, *, holding: bool = False) -> None:
        sent = self._counts()[0]
        idle = self._idle() and not holding
        self._acks.put(ClockAck(name=self._name, slice=number, datagrams=sent, holding=holding, idle=idle))
