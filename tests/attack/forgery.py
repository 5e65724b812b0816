"""What attackers forge: well-formed messages on other people's keys, each with a mark by which it is found again."""

import msgspec

from crew.contracts.plan import digest
from crew.contracts.snapshot import Point, ValueReading
from crew.messages import (
    Answer,
    CancelMission,
    CancelSkill,
    ClockTick,
    Dispatch,
    Heartbeat,
    Intake,
    PlannerProposal,
    Reset,
    RobotCard,
    RobotEvent,
    RobotState,
    RobotValue,
    SimFault,
)
from crew.wire import Message, encode


class Forgery(msgspec.Struct, frozen=True):
    """A message of `rightful` for `witness`. With `live` the control is the rightful one's own traffic."""

    name: str
    key: str
    rightful: str
    witness: str
    live: bool = False


ACT = "tb3/@act/navigate_to"
FORGERIES = (
    Forgery("put on an actuation key", ACT, "orchestrator", "robot-tb3"),
    Forgery("cancel on an actuation key", "tb3/@act/cancel", "orchestrator", "robot-tb3"),
    Forgery("forged state", "tb3/state", "robot-tb3", "orchestrator"),
    Forgery("forged card", "tb3/card", "robot-tb3", "orchestrator"),
    Forgery("forged robot event", "tb3/event", "robot-tb3", "orchestrator"),
    Forgery("forged value", "iris/value/victim", "robot-iris", "orchestrator"),
    Forgery("forged proposal", "planner/proposal", "planner", "orchestrator"),
    Forgery("forged intake, past the gateway", "gateway/intake", "gateway", "orchestrator"),
    Forgery("forged answer to a question", "mission/m0/confirm", "operator", "orchestrator"),
    Forgery("forged cancel of a mission", "mission/m0/cancel", "operator", "orchestrator"),
    Forgery("forged clock", "clock", "simulation", "robot-tb3", live=True),
    Forgery("forged heartbeat", "orchestrator/heartbeat", "orchestrator", "robot-tb3", live=True),
    Forgery("forged fault of the simulation", "sim/fault", "operator", "simulation"),
    Forgery("forged reset", "@reset", "operator", "robot-tb3"),
)


def forged(key: str, mark: str) -> tuple[bytes, str]:
    """A sound message for `key` but for its sender."""
    made: dict[str, Message] = {
        ACT: _dispatch(mark),
        "tb3/@act/cancel": CancelSkill(mission=mark, sequence=1, robot="tb3", epoch=1, boot_id=""),
        "tb3/state": RobotState(robot="tb3", boot_id=mark, at_ns=1),
        "tb3/card": RobotCard(
            robot="ghost", kind=mark, kind_digest="", boot_id=mark, adapter="mavlink", simulated=True
        ),
        "tb3/event": RobotEvent(robot="tb3", boot_id=mark, at_ns=1, what="succeeded", mission=mark, sequence=1),
        "iris/value/victim": RobotValue(
            robot="iris",
            boot_id=mark,
            reading=ValueReading(name="victim", status="ok", position=Point(9.0, 9.0), sigma_m=0.1, stamp_ns=1),
        ),
        "planner/proposal": PlannerProposal(mission=mark, attempt=0, planner="rogue"),
        "gateway/intake": Intake(mission=mark, text=mark),
        "mission/m0/confirm": Answer(token=mark, yes=True),
        "mission/m0/cancel": CancelMission(by=mark),
        "clock": ClockTick(slice=1, now_ns=2**62, datagrams={mark: 0}),
        "orchestrator/heartbeat": Heartbeat(name=mark, epoch=2**40, count=1),
        "sim/fault": SimFault(name=mark),
        "@reset": Reset(by="operator", epoch=1, targets={"tb3": mark}, nonce=mark, signature=b"\0" * 64),
    }
    return encode(made[key])


def _dispatch(mark: str) -> Dispatch:
    return Dispatch(
        mission=mark,
        step="go",
        purpose="mission",
        sequence=1,
        robot="tb3",
        skill="navigate_to",
        args={"x": 9.0, "y": 9.0},
        epoch=1,
        lease=mark,
        boot_id="",
        issued_ns=1,
        expires_ns=2**62,
        args_digest=digest({"x": 9.0, "y": 9.0}),
        plan_digest="0" * 64,
        contract_digest="0" * 64,
    )
