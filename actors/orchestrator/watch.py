"""What the orchestrator watches and holds up on wall time: the heartbeat, lost robots, a lost bus, and the stop."""

import asyncio

from crew.actors.orchestrator.ledger import Ledger
from crew.actors.orchestrator.shell import MissionShell
from crew.actors.orchestrator.world import WorldFold
from crew.bus.port import Bus, Qos, Sample
from crew.clock import WALL
from crew.contracts.site import Rules
from crew.errors import CrewError
from crew.keys import Keys
from crew.messages import Heartbeat, Stop
from crew.permit import permit
from crew.signing import SigningKey
from crew.wire import decode

HEARTBEAT_EVERY_S = 0.2
WATCH_EVERY_S = 0.2
SAME_STOP_NS = 500_000_000
"""A stop so soon after another that nobody was released from is that one repeated."""
STOOD_STILL_NS = 2_000_000_000
"""Between two looks: for so long no heartbeat went out, and robots that miss it for 2 s end what they do."""
UNHEARD = "not heard yet"


class CrewWatch:
    """Runs beside the missions and feeds them what is lost or stopped."""

    def __init__(
        self,
        bus: Bus,
        keys: Keys,
        rules: Rules,
        world: WorldFold,
        ledger: Ledger,
        shell: MissionShell,
        epoch: int,
        key: SigningKey,
    ) -> None:
        self._bus, self._keys, self._rules, self._world = bus, keys, rules, world
        self._ledger, self._shell, self._epoch, self._key = ledger, shell, epoch, key
        self._lost: dict[str, str] = {}
        self._orphans: dict[str, str] = {}
        self._told_still: set[str] = set()
        self._beat_now = asyncio.Event()
        self._stopped_ns = -SAME_STOP_NS
        self._stops: asyncio.Queue[Stop] = asyncio.Queue()

    async def run(self) -> None:
        """Until cancelled."""
        loop = asyncio.get_running_loop()
        self._bus.on_sample(self._keys.stop, lambda sample: _hand_over(loop, self._stops, sample), remote_only=True)
        if held := self._world.hold.held:
            self._ledger.note("stop", f"stop {self._world.hold.number} is still in force for {', '.join(held)}")
        async with asyncio.TaskGroup() as group:
            group.create_task(self._hear_stops())
            group.create_task(self._watch_robots())
            group.create_task(self._beat())

    def lift_stop(self) -> None:
        """The stop is over once every robot that is heard was released from it."""
        if self._world.stopped and self._world.all_released():
            self._world.stopped = False
            self._ledger.note("released", "no robot is stopped any more")

    async def _hear_stops(self) -> None:
        while True:
            stop = await self._stops.get()
            self._take_stop(stop.by[:80], stop.reason[:200])

    def _take_stop(self, by: str, reason: str) -> None:
        """Hold every robot from now on, on disk and in the next heartbeat, and halt the missions."""
        now_ns, hold = WALL.now_ns(), self._world.hold
        if not hold.holds_all or now_ns - self._stopped_ns > SAME_STOP_NS:
            self._stopped_ns = now_ns
            self._world.stop(by, reason)
            self._beat_now.set()
            self._ledger.note("stop", f"stop {hold.number} by {by}{f': {reason}' if reason else ''}")
        self._shell.stop(by)

    async def _beat(self) -> None:
        count = 0
        token = self._bus.token(self._keys.alive("orchestrator"))
        publisher = self._bus.publisher(self._keys.heartbeat(), qos=Qos.EVENT)
        try:
            while True:
                count += 1
                publisher.put(permit(self._heartbeat(count), self._keys.crew, self._key))
                await WALL.race(self._beat_now.wait(), HEARTBEAT_EVERY_S)
                self._beat_now.clear()
        finally:
            token.close()

    def _heartbeat(self, count: int) -> Heartbeat:
        hold = self._world.hold
        return Heartbeat(name="orchestrator", epoch=self._epoch, count=count, stop=hold.number, stopped=hold.held)

    async def _watch_robots(self) -> None:
        """Notice robots that are lost, a bus that is lost, and whom a stop has not reached or has left."""
        looked_ns = WALL.now_ns()
        while True:
            looked_ns, before_ns = WALL.now_ns(), looked_ns
            if looked_ns - before_ns > STOOD_STILL_NS:
                self._stood_still((looked_ns - before_ns) / 1e9)
            self._world.bus_lost = not self._bus.connected
            for spec in self._rules.crew.robots:
                self._watch_robot(spec.name)
            self._hold_stop()
            self.lift_stop()
            await WALL.sleep(WATCH_EVERY_S)

    def _stood_still(self, seconds: float) -> None:
        """The orchestrator itself was frozen: every robot has given it up, and what it said meanwhile may be lost."""
        why = f"the orchestrator stood still for {seconds:.1f} s: robots have done what they declare for its loss"
        self._ledger.note("stood_still", why)
        for spec in self._rules.crew.robots:
            self._shell.dispatcher.lose(spec.name, why, "orchestrator_lost")
        self._shell.stood_still(why)

    def _watch_robot(self, name: str) -> None:
        why, before = self._world.lost(name), self._lost.get(name, UNHEARD)
        if why and not before:
            self._ledger.note("lost", f"{name}: {why}")
            self._shell.dispatcher.lose(name, why, "bus_lost" if self._world.bus_lost else "robot_lost")
        elif before and not why:
            self._ledger.note("found", f"{name} is heard")
        self._lost[name] = why
        if not why:
            self._end_orphan(name, self._world.running(name))

    def _end_orphan(self, name: str, running: str) -> None:
        """A robot that was away may come back with what it was doing, for a mission that has ended meanwhile."""
        mission = running.rpartition("/")[0]
        if not running or self._orphans.get(name) == running or any(m.id == mission for m in self._shell.open):
            return
        self._orphans[name] = running
        self._ledger.note("orphan", f"{name} still carries out {running}, of a mission that is over: cancelled")
        self._shell.dispatcher.end_orphan(name, running)

    def _hold_stop(self) -> None:
        """Repeat a stop until every robot that is there has confirmed it; adopt one that did not come here."""
        if stray := self._world.hold.stray():
            self._take_stop(f"{stray}, which is latched by a stop that did not come here", "")
        if silent := self._world.silent_on_stop():
            reason = f"repeated: {', '.join(silent)} has not confirmed"
            self._bus.put(self._keys.stop, Stop(by="orchestrator", reason=reason), qos=Qos.STOP)
        still = set(self._world.hold.status(self._world.still()).still)
        for name in sorted(still - self._told_still):
            self._ledger.note("still", f"{name} has confirmed standing still")
        self._told_still = still


def _hand_over(loop: asyncio.AbstractEventLoop, stops: asyncio.Queue[Stop], sample: Sample) -> None:
    """From the bus's thread to the loop."""
    if not loop.is_closed():
        loop.call_soon_threadsafe(stops.put_nowait, _read_stop(sample))


def _read_stop(sample: Sample) -> Stop:
    try:
        return decode(Stop, sample.payload, sample.encoding)
    except CrewError:
        return Stop(by="an unreadable stop message")
