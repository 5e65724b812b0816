"""Everything that travels on the bus, as versioned msgspec structs. Times are mission time unless a name says wall."""

from collections.abc import Mapping
from typing import ClassVar

import msgspec

from crew.contracts.plan import ArgValue, Plan
from crew.contracts.refusal import Refusal
from crew.contracts.snapshot import FluentValue, Point, ValueReading
from crew.wire import Message

# --- robots


class RobotCard(Message, frozen=True, kw_only=True):
    """Who a robot is: its kind, the digest of the kind's declaration, and a random id of this boot."""

    schema: ClassVar[str] = "crew.robot_card"
    version: ClassVar[int] = 1
    robot: str
    kind: str
    kind_digest: str
    boot_id: str
    adapter: str
    simulated: bool


class Progress(Message, frozen=True, kw_only=True):
    """How far a running skill has come, for people: no decision depends on it."""

    schema: ClassVar[str] = "crew.progress"
    version: ClassVar[int] = 1
    share: float | None = None
    """From 0 to 1; None where the end is not known."""
    left_m: float | None = None
    """What is left of the way, metres."""


class RobotState(Message, frozen=True, kw_only=True):
    """A robot's state, published at a fixed rate. `stamps_ns` holds each fluent's time at its source."""

    schema: ClassVar[str] = "crew.robot_state"
    version: ClassVar[int] = 1
    robot: str
    boot_id: str
    at_ns: int
    unavailable: str = ""
    stopped: bool = False
    still: bool = False
    """Telemetry shows the robot standing still (or landed)."""
    running: str = ""
    """`<mission>/<sequence>` of the dispatch that it carries out."""
    epoch: int = 0
    """The newest orchestrator's epoch that it has heard."""
    latch: str = ""
    """Names the newest stop that it has heard in this boot: a reset releases this one, and no later one."""
    told: tuple[int, int] = (-1, -1)
    """Epoch and number of the newest stop that a heartbeat has told it of."""
    dropped: int = 0
    """Messages to it that it dropped: unreadable, too late, or too many at once."""
    refused_permits: int = 0
    """Commands that it refused because their permit is not the orchestrator's, or is spent."""
    fluents: Mapping[str, FluentValue] = {}
    stamps_ns: Mapping[str, int] = {}
    progress: Progress | None = None
    """Of the skill that it carries out, if its adapter tells."""


class RobotEvent(Message, frozen=True, kw_only=True):
    """Something that happened to a dispatch, or to the robot itself (then `mission` is empty)."""

    schema: ClassVar[str] = "crew.robot_event"
    version: ClassVar[int] = 1
    robot: str
    boot_id: str
    at_ns: int
    what: str
    """`accepted`, `refused`, `succeeded`, `failed`, `cancelled`; or of the robot: `stopped`, `released`, `ready`...

    `permit_refused` is of the robot: a command that nobody may have sent says nothing about a mission.
    """
    mission: str = ""
    sequence: int = 0
    code: str = ""
    detail: str = ""
    certificate: str = ""
    """Of a refused permit: with whose certificate it was sent, by the router's rules; empty if that is not known."""


class RobotValue(Message, frozen=True, kw_only=True):
    """A run-time value that a robot publishes."""

    schema: ClassVar[str] = "crew.robot_value"
    version: ClassVar[int] = 1
    robot: str
    boot_id: str
    reading: ValueReading


class Dispatch(Message, frozen=True, kw_only=True):
    """One authorised skill. The orchestrator alone may put it on an actuation key."""

    schema: ClassVar[str] = "crew.dispatch"
    version: ClassVar[int] = 1
    mission: str
    step: str
    purpose: str
    sequence: int
    robot: str
    skill: str
    args: Mapping[str, ArgValue] = {}
    places: Mapping[str, Point] = {}
    epoch: int
    lease: str
    fence: int = 0
    """The lease's number. It grows with every grant, so that a command of an earlier holder is known as old."""
    boot_id: str
    issued_ns: int
    expires_ns: int
    args_digest: str
    plan_digest: str
    contract_digest: str
    request_id: str = ""
    approval: str = ""
    """What a person approved, if the step wants it: the digest that the answer was bound to."""
    permit: bytes = b""
    """The orchestrator's signature over the rest (`crew.permit`)."""


class CancelSkill(Message, frozen=True, kw_only=True):
    """End a running dispatch. It stops motion and never starts any."""

    schema: ClassVar[str] = "crew.cancel_skill"
    version: ClassVar[int] = 1
    mission: str
    sequence: int
    robot: str
    epoch: int
    boot_id: str
    permit: bytes = b""


# --- stop and reset

RESET = "crew.reset"
"""The purpose that a reset's signature is bound to."""


class Stop(Message, frozen=True, kw_only=True):
    """Stop and latch. Robots stop for any sample on the stop key, readable or not."""

    schema: ClassVar[str] = "crew.stop"
    version: ClassVar[int] = 1
    by: str
    reason: str = ""


class Reset(Message, frozen=True, kw_only=True):
    """Release the named latches: signed by the operator, bound to epoch, robots, the stops they heard, and a nonce."""

    schema: ClassVar[str] = "crew.reset"
    version: ClassVar[int] = 2
    by: str
    epoch: int
    targets: Mapping[str, str]
    """Robot to the latch that is released, as its state showed it: a stop that came later stays."""
    nonce: str
    signature: bytes

    def signed_part(self, crew: str) -> bytes:
        """What the signature covers, canonical: a robot's own words in it can't be read as another robot's."""
        whole = (crew, self.by, self.epoch, dict(self.targets), self.nonce)
        return msgspec.msgpack.encode(whole, order="deterministic")


# --- orchestrator, planner, gateway


class Heartbeat(Message, frozen=True, kw_only=True):
    """Proof that the orchestrator's loop turns and its journal commits. Sent on wall time, with a permit.

    It also holds the stop up: `stop` numbers the newest one, `stopped` names who is to be latched by it.
    """

    schema: ClassVar[str] = "crew.heartbeat"
    version: ClassVar[int] = 2
    name: str
    epoch: int
    count: int
    stop: int = 0
    stopped: tuple[str, ...] = ()
    permit: bytes = b""


class Intake(Message, frozen=True, kw_only=True):
    """A request as the gateway read it, with the id that its mission shall have."""

    schema: ClassVar[str] = "crew.intake"
    version: ClassVar[int] = 1
    mission: str
    request_id: str = ""
    text: str


class PlannerAsk(Message, frozen=True, kw_only=True):
    """Ask for a plan. State is typed and whitelisted: no text from robots reaches a planner."""

    schema: ClassVar[str] = "crew.planner_ask"
    version: ClassVar[int] = 1
    mission: str
    attempt: int
    request: str
    budget_s: float = 60.0
    """Wall time that is left for planning this mission."""
    previous: Plan | None = None
    """The plan that `feedback` refuses."""
    feedback: Refusal | None = None
    airborne: Mapping[str, bool] = {}
    values: Mapping[str, str] = {}
    requester_near: bool | None = None


class ProposalOrigin(Message, frozen=True, kw_only=True):
    """What a model's plan was made from, and what it cost."""

    schema: ClassVar[str] = "crew.proposal_origin"
    version: ClassVar[int] = 1
    model: str
    context: str
    prompt_digest: str
    schema_digest: str
    registry_digest: str
    tries: int
    latency_s: float
    input_tokens: int
    cached_tokens: int
    output_tokens: int


class PlannerProposal(Message, frozen=True, kw_only=True):
    """A plan, or the reason why there is none."""

    schema: ClassVar[str] = "crew.planner_proposal"
    version: ClassVar[int] = 1
    mission: str
    attempt: int
    planner: str
    plan: Plan | None = None
    reason: str = ""
    unreadable: bool = False
    """The planner answered, but not with a plan: this spends the replan."""
    remark: str = ""
    """What a person should know about the proposal, such as who stands in for whom."""
    origin: ProposalOrigin | None = None


ANSWER = "crew.answer"
"""The purpose that an answer's signature is bound to."""


class Answer(Message, frozen=True, kw_only=True):
    """A person's answer to a mission's question; `token` comes from the question. An approval needs the signature."""

    schema: ClassVar[str] = "crew.answer"
    version: ClassVar[int] = 1
    token: str
    yes: bool
    by: str = ""
    signature: bytes = b""

    def signed_part(self, crew: str, mission: str) -> bytes:
        """What the operator's signature covers."""
        return "\n".join((crew, mission, self.token, "yes" if self.yes else "no", self.by)).encode()


class CancelMission(Message, frozen=True, kw_only=True):
    """End a mission; its robots reach their safe states."""

    schema: ClassVar[str] = "crew.cancel_mission"
    version: ClassVar[int] = 1
    by: str = ""


class PlannedStep(Message, frozen=True, kw_only=True):
    """One step of the accepted plan, with where each argument came from."""

    schema: ClassVar[str] = "crew.planned_step"
    version: ClassVar[int] = 1
    step: str
    robot: str
    skill: str
    args: Mapping[str, ArgValue] = {}
    sources: Mapping[str, str] = {}
    outcome: str = "pending"
    code: str | None = None


class MissionEvent(Message, frozen=True, kw_only=True):
    """What people follow a mission by: published as JSON on its event key."""

    schema: ClassVar[str] = "crew.mission_event"
    version: ClassVar[int] = 1
    mission: str
    request_id: str = ""
    number: int
    at_s: float
    phase: str
    what: str
    """`phase`, `plan`, `decision`, `dispatch`, `step`, `value`, `question`, `end`."""
    text: str
    step: str = ""
    robot: str = ""
    code: str | None = None
    question: str | None = None
    token: str | None = None
    contract: str | None = None
    steps: tuple[PlannedStep, ...] | None = None
    outcome: str | None = None
    final: bool = False


class RobotStatus(Message, frozen=True, kw_only=True):
    """One robot in the crew's status."""

    schema: ClassVar[str] = "crew.robot_status"
    version: ClassVar[int] = 1
    robot: str
    kind: str
    unavailable: str
    stopped: bool
    still: bool
    latch: str = ""
    """The newest stop that it has heard, for a reset."""
    age_s: float | None
    running: str
    lease: str
    fluents: Mapping[str, FluentValue] = {}
    progress: Progress | None = None


class StepStatus(Message, frozen=True, kw_only=True):
    """One step, or `safe:<role>`, as the mission machine has it; `after` are the steps that it waits for."""

    schema: ClassVar[str] = "crew.step_status"
    version: ClassVar[int] = 1
    step: str
    robot: str
    skill: str
    phase: str
    after: tuple[str, ...] = ()
    since_s: float | None = None
    """Seconds of mission time since it was dispatched."""
    code: str = ""


class MissionStatus(Message, frozen=True, kw_only=True):
    """One mission in the crew's status."""

    schema: ClassVar[str] = "crew.mission_status"
    version: ClassVar[int] = 1
    mission: str
    request: str
    phase: str
    contract: str
    message: str
    question: str = ""
    token: str = ""
    step: str = ""
    """The step that waits for approval; empty if the question is about the plan."""
    steps: tuple[StepStatus, ...] = ()
    waits_for: tuple[str, ...] = ()
    """Missions that hold the robots that it waits for."""
    spent_s: float = 0.0
    """Mission time since it began to execute."""
    deadline_s: float = 0.0


class StopStatus(Message, frozen=True, kw_only=True):
    """The newest stop, by whom, and what its robots have confirmed since. Who is not `still` may be moving."""

    schema: ClassVar[str] = "crew.stop_status"
    version: ClassVar[int] = 1
    number: int
    by: str
    reason: str
    at_wall_ns: int
    latched: tuple[str, ...]
    still: tuple[str, ...]
    treat_as_moving: tuple[str, ...]


class CrewStatus(Message, frozen=True, kw_only=True):
    """The answer to a query on the status key."""

    schema: ClassVar[str] = "crew.status"
    version: ClassVar[int] = 1
    crew: str
    run: str
    epoch: int
    at_ns: int
    stopped: bool
    robots: tuple[RobotStatus, ...]
    missions: tuple[MissionStatus, ...]
    dropped: Mapping[str, int] = {}
    """Messages that were refused: as unreadable by reason, and commands that robots refused for their permit."""
    stop: StopStatus | None = None
    """The stop that is in force, if one is."""


# --- simulation

Pose = tuple[float, float, float, float, float, float, float]
"""x, y, z in metres (world: ENU), and a quaternion x, y, z, w."""


class ClockTick(Message, frozen=True, kw_only=True):
    """Mission time in simulation. `datagrams` is how many the simulation has sent to each robot's adapter.

    A `paced` world goes on at the wall's pace, whatever its participants are working on.
    """

    schema: ClassVar[str] = "crew.clock_tick"
    version: ClassVar[int] = 1
    slice: int
    now_ns: int
    paced: bool = False
    datagrams: Mapping[str, int] = {}


class ClockAck(Message, frozen=True, kw_only=True):
    """A participant is done with a slice, or is holding it while work of its own is in flight."""

    schema: ClassVar[str] = "crew.clock_ack"
    version: ClassVar[int] = 1
    name: str
    slice: int
    datagrams: int = 0
    holding: bool = False
    idle: bool = False
    """Nothing is going on here: the simulation need not hurry."""


class SimTruth(Message, frozen=True, kw_only=True):
    """The simulation's truth, for the recorder and the study only. Poses are x, y, z, yaw: ENU, metres, radians."""

    schema: ClassVar[str] = "crew.sim_truth"
    version: ClassVar[int] = 1
    at_ns: int
    poses: Mapping[str, tuple[float, float, float, float]]
    targets: Mapping[str, tuple[float, float, float]]
    bodies: Mapping[str, Pose] = {}
    """Every body of the scene that can move."""
    dropped: int = 0
    """How often somebody has left the lockstep so far, for having been silent on the wall's clock."""


class SimShape(msgspec.Struct, frozen=True, kw_only=True):
    """One solid part of a body. `pose` is relative to the body; `half` are half sizes along its own axes."""

    body: str
    kind: str
    """`box`, `sphere`, `ellipsoid`, `cylinder`, `capsule` (its `half[2]` is that of the middle part), or `mesh`."""
    half: tuple[float, float, float]
    pose: Pose
    rgba: tuple[float, float, float, float]
    vertices: bytes = b""
    """Of a mesh: x, y, z as 32-bit floats, little-endian."""
    triangles: bytes = b""
    """Of a mesh: three indices each, 32 bits, little-endian."""


class SimScene(Message, frozen=True, kw_only=True):
    """What the simulated world looks like: its shapes, and where the bodies are that never move."""

    schema: ClassVar[str] = "crew.sim_scene"
    version: ClassVar[int] = 1
    shapes: tuple[SimShape, ...]
    fixed: Mapping[str, Pose]
    bodies: tuple[str, ...]
    """Every body by its number, which is what a camera's pixels hold."""
    cameras: tuple[str, ...] = ()
    """Robots that carry a camera."""


class SimImage(Message, frozen=True, kw_only=True):
    """One frame of a robot's simulated camera: for each pixel the number of the body that it shows, plus one."""

    schema: ClassVar[str] = "crew.sim_image"
    version: ClassVar[int] = 1
    robot: str
    at_ns: int
    width: int
    height: int
    pixels: bytes
    """Row by row, one byte each; 0 where nothing but ground or sky is, 255 for every body beyond 253."""


class SimFault(Message, frozen=True, kw_only=True):
    """Switch a fault of the simulation on or off."""

    schema: ClassVar[str] = "crew.sim_fault"
    version: ClassVar[int] = 1
    name: str
    on: bool = True
