"""The back end over DDS: the vendor's own channels and message types (`make sdk` installs them). Decides nothing.

The SDK keeps one DDS participant for a process, so one robot's adapter takes one process, as a crew gives it. Its
threads only put what they hear into a box; the loop empties it. States come at up to 500 Hz: the newest one counts.
"""

import asyncio
import threading
from collections import deque
from collections.abc import Callable
from typing import Any

from crew.adapters.settling import Settling
from crew.adapters.unitree.datagrams import Datagrams
from crew.adapters.unitree.transport import Body, Counts, Take
from crew.errors import AdapterError

SERVICES = {"quadruped": ("sport", "sport_lease"), "humanoid": ("sport", "arm")}
BOX = 256
NEWEST_EVERY_S = 0.02
"""States are handed on this often at most, of wall time."""

Plain = Callable[[Any], dict[str, Any]]


class SdkTopics:
    """One robot's topics on a DDS domain. `connection`: `dds:INTERFACE:DOMAIN`, such as `dds:eth0:0`."""

    def __init__(self, connection: str, kind: str, side: Datagrams | None, settling: Settling, counts: Counts) -> None:
        self._interface, self._domain = parse_dds(connection)
        self._kind, self._side, self._settling, self._counts = kind, side, settling, counts
        self._take: Take = lambda topic, body: None
        self._lock = threading.Lock()
        self._answers: deque[tuple[str, Body]] = deque(maxlen=BOX)
        self._newest: dict[str, Any] = {}
        self._woken = False
        self._loop: asyncio.AbstractEventLoop | None = None
        self._writers: dict[str, Any] = {}
        self._readers: list[Any] = []
        self._plain: dict[str, Plain] = {}

    @property
    def reachable(self) -> bool:
        """Whether anything was heard."""
        return self._counts.received > 0

    def open(self, take: Take) -> None:
        """Join the domain and declare the topics. Raises AdapterError if the SDK is missing or the interface is."""
        try:
            from unitree_sdk2py.core.channel import ChannelFactoryInitialize, ChannelPublisher, ChannelSubscriber
        except ImportError as error:
            raise AdapterError(f"the SDK is not installed ({error.name}); run make sdk", code="no_sdk") from error
        self._take, self._loop = take, asyncio.get_running_loop()
        try:
            ChannelFactoryInitialize(self._domain, self._interface)
        except Exception as error:
            raise AdapterError(
                f"no DDS on interface {self._interface}, domain {self._domain}: {error}; does the interface exist?",
                code="bad_connection",
            ) from error
        for topic, kind in _sent_types(self._kind).items():
            self._writers[topic] = ChannelPublisher(topic, kind)
            self._writers[topic].Init()
        for topic, (kind, plain) in _heard_types(self._kind).items():
            self._plain[topic] = plain
            reader = ChannelSubscriber(topic, kind)
            reader.Init(self._heard(topic), BOX if topic.endswith("/response") else 1)
            self._readers.append(reader)
        if self._side is not None:
            self._side.open(take)

    def close(self) -> None:
        self._loop = None
        for channel in (*self._readers, *self._writers.values()):
            channel.Close()
        self._readers, self._writers = [], {}
        if self._side is not None:
            self._side.close()

    def publish(self, topic: str, body: Body) -> None:
        """Send one message; what has no writer, or fails, is counted."""
        writer = self._writers.get(topic)
        if writer is None or not writer.Write(_message(topic, body)):
            self._counts.unsent += 1
        else:
            self._counts.sent += 1

    def _heard(self, topic: str) -> Callable[[Any], None]:
        """What the SDK's thread does with a message: keep it, and wake the loop once for many."""
        answers = topic.endswith("/response")

        def hear(message: Any) -> None:
            loop = self._loop
            with self._lock:
                self._counts.received += 1
                if answers:
                    self._answers.append((topic, self._plain[topic](message)))
                else:
                    self._newest[topic] = message
                woken, self._woken = self._woken, True
            if not woken and loop is not None and not loop.is_closed():
                delay_s = 0.0 if answers else NEWEST_EVERY_S
                loop.call_soon_threadsafe(loop.call_later, delay_s, self._empty)

        return hear

    def _empty(self) -> None:
        with self._lock:
            answers, newest, self._woken = list(self._answers), dict(self._newest), False
            self._answers.clear()
            self._newest.clear()
        for topic, message in newest.items():
            self._take(topic, self._plain[topic](message))
        for topic, body in answers:
            self._take(topic, body)
        self._settling.note()


def parse_dds(text: str) -> tuple[str, int]:
    """`dds:INTERFACE:DOMAIN`. Raises AdapterError `bad_connection`."""
    scheme, _, rest = text.partition(":")
    interface, _, domain = rest.rpartition(":")
    if scheme != "dds" or not interface or not domain.isdecimal() or not 0 <= int(domain) <= 232:
        raise AdapterError(
            f"connection {text!r} is not understood; write dds:INTERFACE:DOMAIN, such as dds:eth0:0",
            code="bad_connection",
        )
    return interface, int(domain)


def _sent_types(kind: str) -> dict[str, Any]:
    from unitree_sdk2py.idl.unitree_api.msg.dds_ import Request_
    from unitree_sdk2py.idl.unitree_go.msg.dds_ import MotorCmds_
    from unitree_sdk2py.idl.unitree_hg.msg.dds_ import LowCmd_

    found: dict[str, Any] = {f"rt/api/{service}/request": Request_ for service in SERVICES[kind]}
    return found | ({"rt/arm_sdk": LowCmd_, "rt/dex1/right/cmd": MotorCmds_} if kind == "humanoid" else {})


def _heard_types(kind: str) -> dict[str, tuple[Any, Plain]]:
    from unitree_sdk2py.idl.unitree_api.msg.dds_ import Response_
    from unitree_sdk2py.idl.unitree_go.msg.dds_ import LowState_ as GoLowState
    from unitree_sdk2py.idl.unitree_go.msg.dds_ import MotorStates_, SportModeState_
    from unitree_sdk2py.idl.unitree_hg.msg.dds_ import BmsState_
    from unitree_sdk2py.idl.unitree_hg.msg.dds_ import LowState_ as HgLowState

    found: dict[str, tuple[Any, Plain]] = {f"rt/api/{s}/response": (Response_, _response) for s in SERVICES[kind]}
    if kind == "quadruped":
        return found | {"rt/sportmodestate": (SportModeState_, _sport), "rt/lowstate": (GoLowState, _go_low)}
    return found | {
        "rt/lowstate": (HgLowState, _hg_low),
        "rt/dex1/right/state": (MotorStates_, lambda m: {"states": [_motor(s) for s in m.states]}),
        "rt/lf/bmsstate": (BmsState_, lambda m: {"soc": m.soc}),
    }


def _response(message: Any) -> dict[str, Any]:
    identity = message.header.identity
    header = {
        "identity": {"id": identity.id, "api_id": identity.api_id},
        "status": {"code": message.header.status.code},
    }
    return {"header": header, "data": message.data, "binary": []}


def _sport(message: Any) -> dict[str, Any]:
    names = ("error_code", "mode", "position", "velocity", "yaw_speed", "range_obstacle")
    return {name: getattr(message, name) for name in names} | {"imu_state": _imu(message)}


def _go_low(message: Any) -> dict[str, Any]:
    motors = [_motor(motor) for motor in message.motor_state]
    return {"motor_state": motors, "imu_state": _imu(message), "bms_state": {"soc": message.bms_state.soc}}


def _hg_low(message: Any) -> dict[str, Any]:
    return {"motor_state": [_motor(motor) for motor in message.motor_state], "imu_state": _imu(message)}


def _imu(message: Any) -> dict[str, Any]:
    return {"rpy": message.imu_state.rpy}


def _motor(motor: Any) -> dict[str, Any]:
    return {"mode": motor.mode, "q": motor.q, "dq": motor.dq, "tau_est": motor.tau_est}


def _message(topic: str, body: Body) -> Any:
    """A body as the SDK's own type."""
    if topic.endswith("/request"):
        return _request(body)
    if topic == "rt/arm_sdk":
        return _arm_command(body)
    from unitree_sdk2py.idl.unitree_go.msg.dds_ import MotorCmd_, MotorCmds_

    commands = [MotorCmd_(c["mode"], c["q"], c["dq"], c["tau"], c["kp"], c["kd"], [0] * 3) for c in body["cmds"]]
    return MotorCmds_(commands)


def _request(body: Body) -> Any:
    from unitree_sdk2py.idl.unitree_api.msg.dds_ import (
        Request_,
        RequestHeader_,
        RequestIdentity_,
        RequestLease_,
        RequestPolicy_,
    )

    header = body["header"]
    identity, policy = header["identity"], header["policy"]
    return Request_(
        RequestHeader_(
            RequestIdentity_(identity["id"], identity["api_id"]),
            RequestLease_(header["lease"]["id"]),
            RequestPolicy_(policy["priority"], policy["noreply"]),
        ),
        body["parameter"],
        [],
    )


def _arm_command(body: Body) -> Any:
    """`LowCmd_` with its check sum, as the robot wants it."""
    from unitree_sdk2py.idl.default import unitree_hg_msg_dds__LowCmd_
    from unitree_sdk2py.utils.crc import CRC

    command = unitree_hg_msg_dds__LowCmd_()
    for number, wanted in body["motor_cmd"].items():
        motor = command.motor_cmd[number]
        motor.mode = 1
        for name, value in wanted.items():
            setattr(motor, name, value)
    command.crc = CRC().Crc(command)
    return command
