"""One simulated robot on DDS: the SDK's topics, as its own clients speak them, to the robot's loopback socket and back.

`python -m crew.sim.unitree.bridge --kind quadruped --domain 1 --port 47001` listens on that port as an adapter would,
so a simulation whose link leads there has its robot on the domain. The SDK keeps one domain a process, and both robots
call their service `sport`: one domain and one such process for each robot. Needs the SDK (`make sdk`).
"""

import argparse
import socket
import threading
from collections.abc import Callable
from typing import Any

import msgspec

Body = dict[str, Any]
SERVICES = {"quadruped": ("sport", "sport_lease"), "humanoid": ("sport", "arm")}
ARM_COMMANDS = 30
"""Entries of `LowCmd_.motor_cmd` that `rt/arm_sdk` uses: 29 motors and the weight."""
FIRST_WORD_S = 30.0


class Bridge:
    """Forwards until the socket closes. `peer`: the robot's address, learnt from its first datagram."""

    def __init__(self, kind: str, sock: socket.socket) -> None:
        from unitree_sdk2py.core.channel import ChannelPublisher, ChannelSubscriber
        from unitree_sdk2py.idl.unitree_api.msg.dds_ import Request_

        self._socket, self._peer = sock, None
        self._lock = threading.Lock()
        self._fillers = _fillers(kind)
        self._writers: dict[str, Any] = {}
        for topic, (message, _) in self._fillers.items():
            self._writers[topic] = ChannelPublisher(topic, message)
            self._writers[topic].Init()
        heard: dict[str, tuple[Any, Callable[[Any], Body]]] = {
            f"rt/api/{service}/request": (Request_, _request) for service in SERVICES[kind]
        }
        heard |= _setpoints() if kind == "humanoid" else {}
        for topic, (message, plain) in heard.items():
            ChannelSubscriber(topic, message).Init(self._forwarder(topic, plain), 64)

    def run(self) -> None:
        """Robot to clients, until the socket closes or nothing was ever heard."""
        decoder = msgspec.msgpack.Decoder()
        while True:
            data, self._peer = self._socket.recvfrom(65536)
            topic, body = decoder.decode(data)
            if topic in self._writers:
                self._writers[topic].Write(self._fillers[topic][1](body))

    def _forwarder(self, topic: str, plain: Callable[[Any], Body]) -> Callable[[Any], None]:
        def forward(message: Any) -> None:
            with self._lock:
                if self._peer is not None:
                    self._socket.sendto(msgspec.msgpack.encode((topic, plain(message))), self._peer)

        return forward


def _request(message: Any) -> Body:
    header = message.header
    return {
        "header": {
            "identity": {"id": header.identity.id, "api_id": header.identity.api_id},
            "lease": {"id": header.lease.id},
            "policy": {"priority": header.policy.priority, "noreply": bool(header.policy.noreply)},
        },
        "parameter": message.parameter,
        "binary": [],
    }


def _response(body: Body) -> Any:
    """The SDK's own default of this type can't be made; its parts can."""
    from unitree_sdk2py.idl.unitree_api.msg.dds_ import RequestIdentity_, Response_, ResponseHeader_, ResponseStatus_

    identity, status = body["header"]["identity"], body["header"]["status"]
    header = ResponseHeader_(RequestIdentity_(identity["id"], identity["api_id"]), ResponseStatus_(status["code"]))
    return Response_(header, body["data"], [])


def _setpoints() -> dict[str, tuple[Any, Callable[[Any], Body]]]:
    from unitree_sdk2py.idl.unitree_go.msg.dds_ import MotorCmds_
    from unitree_sdk2py.idl.unitree_hg.msg.dds_ import LowCmd_

    def arm(message: Any) -> Body:
        return {"motor_cmd": {i: {"q": message.motor_cmd[i].q} for i in range(ARM_COMMANDS)}}

    def hand(message: Any) -> Body:
        return {"cmds": [{"q": command.q} for command in message.cmds]}

    return {"rt/arm_sdk": (LowCmd_, arm), "rt/dex1/right/cmd": (MotorCmds_, hand)}


def _fillers(kind: str) -> dict[str, tuple[Any, Callable[[Body], Any]]]:
    """The robot's own topics: their types, and how a body becomes one."""
    from unitree_sdk2py.idl import default
    from unitree_sdk2py.idl.unitree_api.msg.dds_ import Response_
    from unitree_sdk2py.idl.unitree_go.msg.dds_ import LowState_, MotorStates_, SportModeState_
    from unitree_sdk2py.idl.unitree_hg.msg.dds_ import BmsState_
    from unitree_sdk2py.idl.unitree_hg.msg.dds_ import LowState_ as HgLowState

    def filled(make: Callable[[], Any]) -> Callable[[Body], Any]:
        return lambda body: fill(make(), body)

    def gripper(body: Body) -> Any:
        return MotorStates_([fill(default.unitree_go_msg_dds__MotorState_(), state) for state in body["states"]])

    found: dict[str, tuple[Any, Callable[[Body], Any]]] = {
        f"rt/api/{service}/response": (Response_, _response) for service in SERVICES[kind]
    }
    if kind == "quadruped":
        return found | {
            "rt/sportmodestate": (SportModeState_, filled(default.unitree_go_msg_dds__SportModeState_)),
            "rt/lowstate": (LowState_, filled(default.unitree_go_msg_dds__LowState_)),
        }
    return found | {
        "rt/lowstate": (HgLowState, filled(default.unitree_hg_msg_dds__LowState_)),
        "rt/lf/bmsstate": (BmsState_, filled(default.unitree_hg_msg_dds__BmsState_)),
        "rt/dex1/right/state": (MotorStates_, gripper),
    }


def fill(message: Any, body: Body) -> Any:
    """The message with every field that the body gives; lists are written over from their beginning."""
    for name, value in body.items():
        current = getattr(message, name)
        if isinstance(value, dict):
            fill(current, value)
        elif isinstance(value, list) and value and isinstance(value[0], dict):
            for item, given in zip(current, value, strict=False):
                fill(item, given)
        else:
            setattr(message, name, value)
    return message


def main() -> None:
    """Join the domain and forward until the process is ended."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--kind", choices=sorted(SERVICES), required=True)
    parser.add_argument("--domain", type=int, required=True)
    parser.add_argument("--interface", default="lo")
    parser.add_argument("--port", type=int, required=True, help="the loopback port that the simulated robot sends to")
    chosen = parser.parse_args()
    from unitree_sdk2py.core.channel import ChannelFactoryInitialize

    ChannelFactoryInitialize(chosen.domain, chosen.interface)
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sock:
        sock.bind(("127.0.0.1", chosen.port))
        bridge = Bridge(chosen.kind, sock)
        print("bridge is up", flush=True)
        bridge.run()


if __name__ == "__main__":
    main()
