"""What every flavour of autopilot shares: the link, streams, parameters, commands and their answers.

A flavour decides what a command means and what a failsafe does. Must not plan paths, know the truth or read a clock:
time comes from the world.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from typing import Any, ClassVar

from pymavlink.dialects.v20 import common as mavlink

from crew.sim.autopilot.command import ACCEPTED, UNSUPPORTED, Command, Outcome, denied, flag, read_command
from crew.sim.autopilot.link import BROADCAST, Link
from crew.sim.autopilot.parameters import Parameters
from crew.sim.autopilot.streams import Streams
from crew.sim.autopilot.telemetry import ENCODERS
from crew.sim.faults import Faults, unavailable
from crew.sim.geo import GeoFrame
from crew.sim.vehicle.battery import Battery
from crew.sim.vehicle.state import State

GROUND_SYSTEM = 255
NS = 1_000_000_000
FORCE = 21196  # param2 of a disarm that is done in flight as well


class Autopilot(ABC):
    """One vehicle's autopilot. The world calls `poll` and `tick`; a flavour fills in the rest."""

    capabilities: ClassVar[int]
    unsent: ClassVar[frozenset[int]] = frozenset()
    """Messages that the real one would stream and this one never has anything to say in."""

    def __init__(
        self,
        name: str,
        link: Link,
        geo: GeoFrame,
        home: tuple[float, float],
        faults: Faults,
        parameters: Parameters,
        rates_hz: Mapping[int, float],
    ) -> None:
        self.name = name
        self.link = link
        self.geo = geo
        self.home = home
        self.home_alt_m = geo.origin.alt_m
        self.system = link.system
        self.faults = faults
        self.parameters = parameters
        self.streams = Streams(rates_hz)
        self.time_ns = 0
        self._ground_heard_ns: int | None = None
        self._texts: list[tuple[int, str]] = []
        self._commands: dict[int, Callable[[Command], Outcome]] = {
            mavlink.MAV_CMD_COMPONENT_ARM_DISARM: self._arm_disarm,
            mavlink.MAV_CMD_SET_MESSAGE_INTERVAL: self._set_interval,
            mavlink.MAV_CMD_REQUEST_MESSAGE: self._request_message,
        }
        self._handlers: dict[str, Callable[[Any], None]] = {
            "HEARTBEAT": self._on_heartbeat,
            "COMMAND_LONG": self._on_command,
            "COMMAND_INT": self._on_command,
            "PARAM_REQUEST_READ": self._on_param_read,
            "PARAM_REQUEST_LIST": self._on_param_list,
            "PARAM_SET": self._on_param_set,
        }

    # What telemetry reads.

    @property
    @abstractmethod
    def state(self) -> State:
        """The estimate."""

    @property
    @abstractmethod
    def battery(self) -> Battery: ...

    @property
    @abstractmethod
    def landed_state(self) -> int:
        """MAV_LANDED_STATE."""

    @property
    @abstractmethod
    def armed(self) -> bool: ...

    @property
    @abstractmethod
    def aim(self) -> tuple[float, float, float] | None:
        """Where it is going or holding, world frame, height above home; None if nowhere."""

    @abstractmethod
    def heartbeat(self) -> Any: ...

    @property
    def gps_ok(self) -> bool:
        return not self.faults.is_on("gps_loss")

    @property
    def faulty(self) -> bool:
        """A system fault, armed or not: the heartbeat says CRITICAL."""
        return self.faults.is_on(unavailable(self.name))

    def problems(self) -> list[str]:
        """Why arming would be refused now; empty when healthy."""
        found = []
        if self.faulty:
            found.append("system fault: vehicle unavailable")
        if not self.gps_ok:
            found.append("no valid position (GPS)")
        return found

    # What a flavour does.

    @abstractmethod
    def arm(self) -> Outcome: ...

    @abstractmethod
    def disarm(self, *, force: bool) -> Outcome: ...

    def is_ground(self, heartbeat: Any) -> bool:
        """Whether the link-loss failsafe counts this heartbeat."""
        return bool(heartbeat.get_srcSystem() == GROUND_SYSTEM)

    @abstractmethod
    def supervise(self) -> None:
        """Failsafes and completion of manoeuvres, once each tick."""

    # What the world calls.

    def poll(self) -> int:
        """Handle the datagrams that are waiting; how many messages were understood."""
        handled = 0
        self.link.cut = self.faults.is_on("link_loss")
        for message in self.link.datagrams():
            handler = self._handlers.get(message.get_type())
            if handler is not None:
                handler(message)
                self._flush(self.link.answer)
            handled += 1
        return handled

    def tick(self, time_ns: int) -> None:
        """Supervise, then send what is due at `time_ns`."""
        self.time_ns = time_ns
        self.supervise()
        self._flush(self.link.send)
        if self.link.cut:
            return
        for message_id in self.streams.due(time_ns):
            message = ENCODERS[message_id](self)
            if message is not None:
                self.link.send(message)

    # For flavours.

    def say(self, severity: int, text: str) -> None:
        """Queue a STATUSTEXT; it leaves after the acknowledgement of the command being handled."""
        self._texts.append((severity, text))

    @property
    def ground_silence_s(self) -> float:
        """Seconds since the ground's last heartbeat; infinite before the first."""
        if self._ground_heard_ns is None:
            return math.inf
        return (self.time_ns - self._ground_heard_ns) / NS

    def for_me(self, message: Any) -> bool:
        ours = (BROADCAST, mavlink.MAV_COMP_ID_AUTOPILOT1)
        return message.target_system in (BROADCAST, self.system) and message.target_component in ours

    def _flush(self, send: Callable[[Any], None]) -> None:
        for severity, text in self._texts:
            send(mavlink.MAVLink_statustext_message(severity, text.encode()[:50]))
        self._texts.clear()

    def _on_heartbeat(self, message: Any) -> None:
        if self.is_ground(message):
            self._ground_heard_ns = self.time_ns

    def _on_command(self, message: Any) -> None:
        if not self.for_me(message):
            return
        command = read_command(message)
        handler = self._commands.get(command.id)
        if handler is None:
            outcome = UNSUPPORTED
        else:
            outcome = handler(command) if command.is_finite else denied("infinite parameter")
        to = message.get_srcSystem(), message.get_srcComponent()
        self.link.answer(mavlink.MAVLink_command_ack_message(command.id, outcome.result, 0, 0, *to))
        if outcome.reason:
            self.say(mavlink.MAV_SEVERITY_WARNING, outcome.reason)

    def _arm_disarm(self, command: Command) -> Outcome:
        if command.p1 == 1.0:
            return self.arm()
        if command.p1 == 0.0:
            return self.disarm(force=command.p2 == FORCE)
        return denied("arm or disarm: param1 is neither 1 nor 0")

    def _set_interval(self, command: Command) -> Outcome:
        message_id = -1 if math.isnan(command.p1) else flag(command.p1)
        if message_id in self.unsent:
            return ACCEPTED
        if not self.streams.knows(message_id):
            return denied(f"no stream of message {message_id}")
        self.streams.set_interval(message_id, flag(command.p2), self.time_ns)
        return ACCEPTED

    def _request_message(self, command: Command) -> Outcome:
        message_id = -1 if math.isnan(command.p1) else flag(command.p1)
        message = self._version() if message_id == mavlink.MAVLINK_MSG_ID_AUTOPILOT_VERSION else None
        if message_id in ENCODERS:
            message = ENCODERS[message_id](self)
        if message is None:
            return denied(f"cannot send message {message_id}")
        self.link.answer(message)
        return ACCEPTED

    def _version(self) -> Any:
        none = (0,) * 8
        return mavlink.MAVLink_autopilot_version_message(self.capabilities, 0, 0, 0, 0, none, none, none, 0, 0, 0)

    def _on_param_read(self, message: Any) -> None:
        name = self.parameters.find(message.param_id, message.param_index) if self.for_me(message) else None
        if name is not None:
            self.link.answer(self.parameters.message(name))

    def _on_param_list(self, message: Any) -> None:
        if self.for_me(message):
            for value in self.parameters.messages():
                self.link.answer(value)

    def _on_param_set(self, message: Any) -> None:
        """Echo the value that holds afterwards, whether it was taken or not; an unknown name gets no answer."""
        if not self.for_me(message):
            return
        self.parameters.set_from_wire(message.param_id, message.param_value, message.param_type)
        if self.parameters.find(message.param_id, -1) is not None:
            self.link.answer(self.parameters.message(message.param_id))
