"""One robot on one link: its topics, its calls, its lease, its state. Sends nothing that moves it by itself."""

import asyncio
from collections.abc import Callable

from crew.adapter import AdapterConfig, StopLatch
from crew.adapters.settling import Settling
from crew.adapters.unitree.calls import LEASE_EXISTS, CallError, Calls
from crew.adapters.unitree.datagrams import Datagrams, parse_address
from crew.adapters.unitree.options import RobotOptions
from crew.adapters.unitree.telemetry import Sample, Telemetry
from crew.adapters.unitree.transport import Body, Counts, Transport
from crew.adapters.unitree.writer import Writer
from crew.clock import Clock, seconds_ns
from crew.errors import AdapterError

POLL_S = 0.05
FALLEN_RAD = 0.6
API_VERSION, LEASE_APPLY, LEASE_RENEW = 1, 101, 102
RENEW_SHARE = 0.3
"""A lease is renewed after this share of its term."""

Needed = Callable[[Telemetry], dict[str, Sample[object] | None]]


class Robot:
    """Everything that skills need of a robot. `needs`: the telemetry that must be there, by what to call it."""

    def __init__(
        self, config: AdapterConfig, options: RobotOptions, clock: Clock, latch: StopLatch, counts: Counts,
        settling: Settling, needs: Needed,
    ) -> None:  # fmt: skip
        self.config, self.options, self.clock = config, options, clock
        self.telemetry = Telemetry(clock)
        self._transport = open_transport(config, options, settling, counts)
        self.writer = Writer(latch, self._transport, first=clock.now_ns())
        self.calls = Calls(config.robot, clock, self.writer, self._transport, options.call_timeout_s)
        self._needs = needs
        self._leasing: asyncio.Task[None] | None = None
        self._lease_fault = ""
        self.connected = False

    async def connect(self, service: str, *, lease: bool) -> None:
        """Find the robot, its telemetry, its service and, if asked for, the service's lease. Raises AdapterError."""
        self._transport.open(self._take)
        end_ns = self.clock.now_ns() + seconds_ns(self.options.connect_timeout_s)
        while missing := self.missing():
            if self.clock.now_ns() >= end_ns:
                raise AdapterError(
                    f"{self.config.robot}: no {', '.join(missing)} on {self.config.connection} within "
                    f"{self.options.connect_timeout_s:g} s; is the robot sending there?",
                    code="no_telemetry" if self._transport.reachable else "no_vehicle",
                )
            await self.clock.sleep(POLL_S)
        await self.calls.call(service, API_VERSION, {})
        if lease:
            term_s = await self._apply(f"{service}_lease")
            self._leasing = asyncio.create_task(self._keep_lease(f"{service}_lease", term_s))
        self.connected = True

    async def close(self) -> None:
        """Stop speaking and let the link go; a lease runs out by itself."""
        self.connected = False
        if self._leasing is not None:
            self._leasing.cancel()
            await asyncio.gather(self._leasing, return_exceptions=True)
            self._leasing = None
        self._transport.close()

    def missing(self) -> list[str]:
        """The telemetry that was never heard, or not lately."""
        silent_s = self.options.silent_s
        return [name for name, sample in self._needs(self.telemetry).items() if self.telemetry.age_s(sample) > silent_s]

    def link_fault(self) -> str:
        """Why the robot cannot be followed; empty if it can."""
        if not self.connected:
            return "not connected"
        missing = self.missing()
        return f"link lost: no {', '.join(missing)} for {self.options.silent_s:g} s" if missing else ""

    def fault(self) -> str:
        """Why it may not be set in motion, as far as every kind of robot goes."""
        battery = self.telemetry.battery
        if battery is not None and battery.value < self.options.min_battery_percent:
            return f"battery at {battery.value:.0f}%, at least {self.options.min_battery_percent:g}% needed"
        return self.link_fault() or self._lease_fault

    def _take(self, topic: str, body: Body) -> None:
        if not self.calls.take(topic, body):
            self.telemetry.take(topic, body)

    async def _apply(self, service: str) -> float:
        """The lease's term. Raises CallError: another client holds it, or there is no such service."""
        granted = await self.calls.call(service, LEASE_APPLY, {"name": f"crew/{self.config.robot}"})
        match granted:
            case {"id": int(number), "term": int(term_us)} if term_us > 0:
                self.writer.lease = number
                return term_us / 1e6
        raise AdapterError(f"{self.config.robot}: {service} granted no lease: {granted!r}", code="no_lease")

    async def _keep_lease(self, service: str, term_s: float) -> None:
        """Renew it for as long as the link is up; a lease that was lost is applied for again."""
        while True:
            await self.clock.sleep(RENEW_SHARE * term_s)
            try:
                if self._lease_fault:
                    term_s = await self._apply(service)
                else:
                    await self.calls.call(service, LEASE_RENEW, {})
                self._lease_fault = ""
            except CallError as error:
                lost = "held by another client" if error.number == LEASE_EXISTS else "lost"
                self._lease_fault = f"lease {lost} ({error.number})"


def open_transport(config: AdapterConfig, options: RobotOptions, settling: Settling, counts: Counts) -> Transport:
    """The back end that the options name. Raises AdapterError if it is not installed."""
    if options.backend == "mock":
        return Datagrams(parse_address(config.connection), settling, counts)
    from crew.adapters.unitree.sdk import SdkTopics

    side = Datagrams(parse_address(options.side), settling, counts) if options.side else None
    return SdkTopics(config.connection, config.kind, side, settling, counts)
