"""One vehicle on one link: finding it, its streams, its state. Sends nothing that moves it by itself."""

import asyncio
from collections.abc import Callable
from typing import Any, TypeVar

from pymavlink.dialects.v20 import common as mavlink

from crew.adapter import AdapterConfig, StopLatch
from crew.adapters.mavlink.command import Command, Commander, Position
from crew.adapters.mavlink.endpoint import parse_endpoint
from crew.adapters.mavlink.flavours.flavour import Flavour
from crew.adapters.mavlink.flavours.registry import choose_flavour, find_flavour
from crew.adapters.mavlink.frame import WorldFrame
from crew.adapters.mavlink.link import LinkCounts, UdpLink
from crew.adapters.mavlink.options import VehicleOptions
from crew.adapters.mavlink.parameter import Parameters
from crew.adapters.mavlink.preflight import HOME_MAX_AGE_S, fitness_fault, link_fault
from crew.adapters.mavlink.signing import SigningState, read_key
from crew.adapters.mavlink.telemetry import Home, Telemetry
from crew.adapters.settling import Settling
from crew.clock import SECOND_NS, Clock, seconds_ns
from crew.errors import AdapterError

T = TypeVar("T")

POLL_S = 0.05
HEARTBEAT_PERIOD_S = 1.0
ON_BOARD = frozenset({"LANDING_TARGET", "OBSTACLE_DISTANCE"})
"""Messages that a computer on board sends under the vehicle's system id; all else must come from the autopilot."""
FIT_S = 2.0
"""A vehicle's health follows its first contact with the ground by up to this long."""


class Vehicle:
    """Everything that skills need of a vehicle: `flavour`, `commander` and `parameters` exist once it was found."""

    def __init__(
        self,
        config: AdapterConfig,
        options: VehicleOptions,
        clock: Clock,
        latch: StopLatch,
        counts: LinkCounts,
        settling: Settling,
    ) -> None:
        self.config = config
        self.clock = clock
        self.frame = WorldFrame(config.origin)
        self.telemetry = Telemetry(clock, self.frame)
        key = read_key(config.robot, options.signing_key) if options.signing_key else None
        signing = None if key is None else SigningState(key)
        self.link = UdpLink(
            parse_endpoint(config.connection), settling, latch, self._wanted, self._take, counts, signing
        )
        self._options = options
        self._found: Any = None
        self._flavour: Flavour | None = None
        self._commander: Commander | None = None
        self._parameters: Parameters | None = None
        self._beating: asyncio.Task[None] | None = None

    @property
    def found(self) -> bool:
        return self._flavour is not None

    @property
    def system(self) -> int:
        """The vehicle's MAVLink system id."""
        return int(_known(self._found).get_srcSystem())

    @property
    def flavour(self) -> Flavour:
        return _known(self._flavour)

    @property
    def commander(self) -> Commander:
        return _known(self._commander)

    @property
    def parameters(self) -> Parameters:
        return _known(self._parameters)

    async def connect(self) -> None:
        """Find the vehicle and its telemetry. Raises AdapterError naming what is missing."""
        self.link.open()
        self._beating = asyncio.create_task(self._beat())
        end_ns = self.clock.now_ns() + seconds_ns(self._options.connect_timeout_s)
        await self._until(lambda: self._found is not None, end_ns, self._nobody)
        heartbeat = self._found
        system = heartbeat.get_srcSystem()
        self._flavour = choose_flavour(self.config.kind, heartbeat.autopilot, heartbeat.type)
        self._commander = Commander(self.clock, self.link.writer, self.telemetry.texts, system)
        self._parameters = Parameters(self.clock, self.link.writer, system)
        for message_id, rate_hz in self._flavour.streams.items():
            params = (float(message_id), round(1e6 / rate_hz))
            await self._commander.send(Command(id=mavlink.MAV_CMD_SET_MESSAGE_INTERVAL, params=params))
        await self._until(lambda: not self._missing(), end_ns, self._silent)
        await self._grow_fit()

    async def close(self) -> None:
        """Stop speaking and let the socket go."""
        if self._beating is not None:
            self._beating.cancel()
            await asyncio.gather(self._beating, return_exceptions=True)
        self.link.close()

    def send_stop(self) -> None:
        """Send the flavour's stops once, from any thread, without waiting; nothing if no vehicle was found yet."""
        if self._flavour is not None:
            for command in self._flavour.stops:
                self.link.writer.send_stop(command.message(self._found.get_srcSystem(), 0))

    def link_fault(self) -> str:
        """Why the vehicle cannot be followed; empty if it can."""
        return link_fault(self.telemetry) if self.found else "not connected"

    def fault(self) -> str:
        """Why the vehicle may not be set in motion; empty if it may."""
        return self.link_fault() or fitness_fault(self.telemetry, self.flavour, self._options.min_battery_percent)

    async def fresh_home(self) -> Home:
        """The home position, asked for again if it is old. Raises AdapterError `no_home`."""
        if self.telemetry.age_s(self.telemetry.home) > HOME_MAX_AGE_S:
            params = (float(mavlink.MAVLINK_MSG_ID_HOME_POSITION),)
            await self.commander.send(Command(id=mavlink.MAV_CMD_REQUEST_MESSAGE, params=params))
            await self.clock.sleep(2 * POLL_S)
        home = self.telemetry.home
        if home is None or self.telemetry.age_s(home) > HOME_MAX_AGE_S:
            raise AdapterError(
                f"{self.config.robot}: no home position within {HOME_MAX_AGE_S:g} s; heights would mean nothing",
                code="no_home",
            )
        return home.value

    def place(self, x_m: float, y_m: float, height_m: float) -> Position:
        """World east and north with a height above home, as commands take it."""
        return Position(*self.frame.to_geo(x_m, y_m), height_m)

    def mode(self) -> str:
        heartbeat = self.telemetry.heartbeat
        return self.flavour.mode(heartbeat.value.custom_mode) if heartbeat else "unknown"

    def _wanted(self, heartbeat: Any) -> bool:
        if heartbeat.get_srcComponent() != mavlink.MAV_COMP_ID_AUTOPILOT1:
            return False
        system = self._options.system_id
        if system is not None:
            return bool(heartbeat.get_srcSystem() == system)
        return find_flavour(self.config.kind, heartbeat.autopilot, heartbeat.type) is not None

    def _take(self, message: Any) -> None:
        kind = message.get_type()
        if message.get_srcComponent() != mavlink.MAV_COMP_ID_AUTOPILOT1 and kind not in ON_BOARD:
            return
        if kind == "HEARTBEAT" and self._found is None:
            self._found = message
        elif kind == "COMMAND_ACK" and self._commander is not None:
            self._commander.acknowledge(message)
        elif kind == "PARAM_VALUE" and self._parameters is not None:
            self._parameters.take(message)
        self.telemetry.take(message)

    async def _beat(self) -> None:
        """The ground's heartbeat: vehicles act when it falls silent."""
        message = mavlink.MAVLink_heartbeat_message(
            mavlink.MAV_TYPE_GCS, mavlink.MAV_AUTOPILOT_INVALID, 0, 0, mavlink.MAV_STATE_ACTIVE, 3
        )
        while True:
            if self.link.reachable:
                self.link.writer.send(message)
                await self.clock.sleep(HEARTBEAT_PERIOD_S)
            else:
                await self.clock.sleep(POLL_S)

    async def _until(self, ready: Callable[[], bool], end_ns: int, error: Callable[[], AdapterError]) -> None:
        while not ready():
            if self.clock.now_ns() >= end_ns:
                raise error()
            await self.clock.sleep(POLL_S)

    async def _grow_fit(self) -> None:
        """Give the vehicle time to take note of the ground's heartbeat; `fault` tells if it stays unfit."""
        start_ns = self.clock.now_ns()
        while self.fault() and seconds_since(self.clock, start_ns) < FIT_S:
            await self.clock.sleep(POLL_S)

    def _missing(self) -> list[str]:
        told = self.telemetry
        parts = {
            "position (GLOBAL_POSITION_INT)": told.motion,
            "attitude (ATTITUDE)": told.heading,
            "home (HOME_POSITION)": told.home,
            "health (SYS_STATUS)": told.sensors_bad,
            "battery (SYS_STATUS, BATTERY_STATUS)": told.battery_percent,
            "landed state (EXTENDED_SYS_STATE)": told.landed_state,
        }
        return [name for name, sample in parts.items() if sample is None]

    def _nobody(self) -> AdapterError:
        who = f"system {self._options.system_id}" if self._options.system_id else f"a {self.config.kind}"
        counts = self.link.counts
        return AdapterError(
            f"{self.config.robot}: no heartbeat of {who} on {self.config.connection} within "
            f"{self._options.connect_timeout_s:g} s ({counts.received} datagrams came, {counts.ignored} of others, "
            f"{counts.malformed} damaged{self.link.unsigned_text()}); is the vehicle sending there?",
            code="no_vehicle",
        )

    def _silent(self) -> AdapterError:
        return AdapterError(
            f"{self.config.robot}: the vehicle does not send {', '.join(self._missing())}", code="no_telemetry"
        )


def _known(part: T | None) -> T:
    if part is None:
        raise AdapterError("the vehicle was not found yet: connect first", code="not_connected")
    return part


def seconds_since(clock: Clock, start_ns: int) -> float:
    """Mission time that passed, seconds."""
    return (clock.now_ns() - start_ns) / SECOND_NS
