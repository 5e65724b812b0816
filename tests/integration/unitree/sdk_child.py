"""A process of its own for each DDS participant: the world with its robots, or one of the SDK's own clients.

`python -m tests.integration.unitree.sdk_child ROLE ...`; what a client saw is printed as one line of JSON.
"""

import asyncio
import json
import math
import sys
import time
from typing import Any

STEP_NS = 10_000_000


def world(port_g1: str, port_go2: str) -> None:
    """The apartment at real-time pace, its links leading to two bridges."""
    from crew.sim.apartment.world import Apartment
    from crew.sim.config import WorldConfig

    links = {"g1": f"udp:127.0.0.1:{port_g1}", "go2": f"udp:127.0.0.1:{port_go2}"}
    with Apartment(WorldConfig(scene="apartment", map="far", links=links)) as apartment:
        print("world is up", flush=True)
        began = time.monotonic()
        while True:
            apartment.poll()
            apartment.advance(round((time.monotonic() - began) * 1e9) // STEP_NS * STEP_NS)
            time.sleep(0.002)


def go2(domain: str) -> dict[str, Any]:
    """The unmodified SportClient: stands the robot up, walks it, stops it; watched on rt/sportmodestate."""
    from unitree_sdk2py.core.channel import ChannelFactoryInitialize, ChannelSubscriber
    from unitree_sdk2py.go2.sport.sport_client import SportClient
    from unitree_sdk2py.idl.unitree_go.msg.dds_ import SportModeState_

    ChannelFactoryInitialize(int(domain), "lo")
    newest: list[Any] = []
    states = ChannelSubscriber("rt/sportmodestate", SportModeState_)
    states.Init(lambda message: newest.__setitem__(slice(None), [message]), 4)
    leased, plain = SportClient(enableLease=True), SportClient()
    for client in (leased, plain):
        client.SetTimeout(3.0)
        client.Init()
    leased.WaitLeaseApplied()
    codes = {
        "version": leased.GetServerApiVersion()[1],
        "stand_up": leased.StandUp(),
        "balance": leased.BalanceStand(),
        "denied": plain.BalanceStand(),
        "not_implemented": leased.StaticWalk() if hasattr(leased, "StaticWalk") else leased._Call(1061, "{}")[0],
    }
    start = newest[0].position
    for _ in range(20):
        codes["move"] = leased.Move(0.4, 0.0, 0.0)
        time.sleep(0.1)
    codes["stop"] = leased.StopMove()
    time.sleep(1.5)
    before = newest[0].position
    time.sleep(0.5)
    after = newest[0].position
    return codes | {"walked_m": math.dist(start[:2], after[:2]), "drift_m": math.dist(before[:2], after[:2])}


def g1(domain: str) -> dict[str, Any]:
    """The unmodified LocoClient and G1ArmActionClient: state machine, action list, a wave seen on rt/lowstate."""
    from unitree_sdk2py.core.channel import ChannelFactoryInitialize, ChannelSubscriber
    from unitree_sdk2py.g1.arm.g1_arm_action_client import G1ArmActionClient, action_map
    from unitree_sdk2py.g1.loco.g1_loco_client import LocoClient
    from unitree_sdk2py.idl.unitree_hg.msg.dds_ import LowState_

    ChannelFactoryInitialize(int(domain), "lo")
    angles: list[float] = []
    states = ChannelSubscriber("rt/lowstate", LowState_)
    states.Init(lambda message: angles.append(message.motor_state[22].q), 4)
    loco, arm = LocoClient(), G1ArmActionClient()
    for client in (loco, arm):
        client.SetTimeout(3.0)
        client.Init()
    code, listed = arm.GetActionList()
    found = {
        "set_fsm": loco.SetFsmId(500),
        "velocity": loco.SetVelocity(0.1, 0.0, 0.0),
        "list": code,
        "actions": sorted(action["name"] for action in listed[0]),
        "wave": arm.ExecuteAction(action_map["high wave"]),
        "unknown": arm.ExecuteAction(4711),
    }
    time.sleep(2.0)
    return found | {"raised_rad": max(angles) - min(angles)}


def adapter(domain: str) -> dict[str, Any]:
    """This project's adapter with its `sdk` back end: walks the quadruped two metres over DDS."""
    from crew.adapter import AdapterConfig, Place
    from crew.adapters.unitree.adapter import UnitreeAdapter
    from crew.clock import WallClock
    from crew.contracts.kinds.quadruped import Navigate
    from crew.contracts.snapshot import Point

    config = AdapterConfig(
        robot="go2", kind="quadruped", connection=f"dds:lo:{domain}", options={"backend": "sdk"},
        area=(-1.5, 7.0, -3.0, 3.0), origin=(0.0, 0.0, 0.0),
    )  # fmt: skip

    async def walk() -> dict[str, Any]:
        robot = UnitreeAdapter(config, WallClock())
        await robot.connect()
        try:
            await robot.execute("navigate", Navigate(location="there"), {"location": Place(1.0, -1.2)})
            at = robot.fluents()["at"].value
            assert isinstance(at, Point)
            return {"away_m": math.dist((at.x, at.y), (1.0, -1.2)), "health": robot.health()}
        finally:
            await robot.close()

    return asyncio.run(walk())


def main() -> None:
    role, *arguments = sys.argv[1:]
    if role == "world":
        world(*arguments)
    else:
        print(json.dumps({"go2": go2, "g1": g1, "adapter": adapter}[role](*arguments)), flush=True)
        sys.stdout.flush()
        import os

        os._exit(0)  # the SDK's threads outlive an orderly end


if __name__ == "__main__":
    main()
