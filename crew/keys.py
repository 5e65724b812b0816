"""Every key of a crew, in one table. Nothing else in the project writes a key by hand."""

import re
from dataclasses import dataclass

from crew.errors import UsageError

RESERVED = frozenset(
    {"mission", "planner", "request", "status", "clock", "sim", "gateway", "orchestrator", "router"}
    | {"simulation", "recorder", "operator", "guest"}
)
"""Names that hold a place of their own beside the robots."""

CANCEL = "cancel"
"""No skill: its key ends the running one."""
LONGEST_CHUNK = 128
_CHUNK = re.compile(r"[a-z0-9_-]+", re.ASCII)


def is_chunk(value: str) -> bool:
    """Whether `value` is one plain chunk of a key, of a length that a person could read."""
    return len(value) <= LONGEST_CHUNK and _CHUNK.fullmatch(value) is not None


def checked_chunk(value: str, what: str) -> str:
    """`value` if it is one plain chunk of a key; UsageError naming the rule otherwise."""
    if _CHUNK.fullmatch(value):
        return value
    raise UsageError(
        f"invalid {what} {value!r}: a name in a key is one or more of a-z, 0-9, '_' and '-'; rename it and try again"
    )


def checked_robot(name: str) -> str:
    """`name` if a robot may have it; UsageError naming the rule otherwise."""
    if name.startswith("@"):
        raise UsageError(f"invalid robot name {name!r}: names beginning with '@' are kept for actuation; rename it")
    if name in RESERVED:
        raise UsageError(f"reserved robot name {name!r}: not one of {', '.join(sorted(RESERVED))}; rename the robot")
    return checked_chunk(name, "robot name")


@dataclass(frozen=True, slots=True)
class Keys:
    """The keys of the crew named `crew`. Every name that goes into a key is checked; errors are UsageError."""

    crew: str

    def __post_init__(self) -> None:
        checked_chunk(self.crew, "crew name")

    # A person's side.

    @property
    def request(self) -> str:
        return f"crew/{self.crew}/request"

    @property
    def status(self) -> str:
        return f"crew/{self.crew}/status"

    def mission_event(self, mission: str) -> str:
        return self._mission(mission, "event")

    def mission_progress(self, mission: str) -> str:
        """The mission machine's own events, typed, for those who draw missions."""
        return self._mission(mission, "progress")

    def mission_confirm(self, mission: str) -> str:
        return self._mission(mission, "confirm")

    def mission_cancel(self, mission: str) -> str:
        return self._mission(mission, "cancel")

    # Orchestrator, planner, gateway.

    @property
    def planner_ask(self) -> str:
        return f"crew/{self.crew}/planner/ask"

    @property
    def planner_proposal(self) -> str:
        return f"crew/{self.crew}/planner/proposal"

    @property
    def intake(self) -> str:
        """What the gateway read from people, for the orchestrator."""
        return f"crew/{self.crew}/gateway/intake"

    def heartbeat(self, name: str = "orchestrator") -> str:
        """An actor's proof that its loop turns (liveliness alone survives a frozen loop)."""
        return f"crew/{self.crew}/{checked_chunk(name, 'actor name')}/heartbeat"

    def alive(self, name: str) -> str:
        """Liveliness token of a robot or an actor."""
        return f"crew/{self.crew}/{checked_chunk(name, 'actor name')}/alive"

    # Robots.

    def robot_card(self, robot: str) -> str:
        return self._robot(robot, "card")

    def robot_state(self, robot: str) -> str:
        return self._robot(robot, "state")

    def robot_event(self, robot: str) -> str:
        return self._robot(robot, "event")

    def robot_value(self, robot: str, name: str) -> str:
        return self._robot(robot, f"value/{checked_chunk(name, 'value name')}")

    # Actuation: the orchestrator only.

    def act(self, robot: str, skill: str) -> str:
        if skill == CANCEL:
            raise UsageError(
                f"reserved skill name 'cancel' of robot {robot!r}: @act/cancel stops a skill; rename the skill"
            )
        return self._robot(robot, f"@act/{checked_chunk(skill, 'skill name')}")

    def act_cancel(self, robot: str) -> str:
        return self._robot(robot, f"@act/{CANCEL}")

    @property
    def stop(self) -> str:
        return f"crew/{self.crew}/@stop"

    @property
    def reset(self) -> str:
        return f"crew/{self.crew}/@reset"

    # Simulation only.

    @property
    def clock(self) -> str:
        return f"crew/{self.crew}/clock"

    def clock_ack(self, name: str) -> str:
        """A lockstep participant's acknowledgement of a slice."""
        return f"crew/{self.crew}/clock/ack/{checked_chunk(name, 'actor name')}"

    @property
    def sim_truth(self) -> str:
        return f"crew/{self.crew}/sim/truth"

    @property
    def sim_fault(self) -> str:
        return f"crew/{self.crew}/sim/fault"

    @property
    def sim_scene(self) -> str:
        """A query is answered with what the simulated world looks like."""
        return f"crew/{self.crew}/sim/scene"

    def sim_camera(self, robot: str) -> str:
        """What a robot's simulated camera sees: the first thing that a busy bus may drop."""
        return f"crew/{self.crew}/sim/camera/{checked_robot(robot)}"

    # Wildcards, for subscribers: `*` is one chunk and never meets one that begins with `@`.

    @property
    def mission_events(self) -> str:
        return f"crew/{self.crew}/mission/*/event"

    @property
    def mission_progresses(self) -> str:
        return f"crew/{self.crew}/mission/*/progress"

    @property
    def mission_confirms(self) -> str:
        return f"crew/{self.crew}/mission/*/confirm"

    @property
    def mission_cancels(self) -> str:
        return f"crew/{self.crew}/mission/*/cancel"

    @property
    def robot_cards(self) -> str:
        return f"crew/{self.crew}/*/card"

    @property
    def robot_states(self) -> str:
        return f"crew/{self.crew}/*/state"

    @property
    def robot_events(self) -> str:
        return f"crew/{self.crew}/*/event"

    @property
    def robot_values(self) -> str:
        return f"crew/{self.crew}/*/value/*"

    @property
    def all_alive(self) -> str:
        return f"crew/{self.crew}/*/alive"

    @property
    def sim_cameras(self) -> str:
        return f"crew/{self.crew}/sim/camera/*"

    @property
    def clock_acks(self) -> str:
        return f"crew/{self.crew}/clock/ack/*"

    def acts(self, robot: str) -> str:
        """Every actuation key of one robot, `cancel` included."""
        return self._robot(robot, "@act/**")

    @property
    def public(self) -> str:
        """Everything that is not actuation, stop or reset: a wildcard never reaches a chunk beginning with `@`."""
        return f"crew/{self.crew}/**"

    def name_in(self, key: str) -> str:
        """The chunk after the crew (a robot, an actor, a place) of a key of this crew; UsageError otherwise."""
        prefix = f"crew/{self.crew}/"
        if not key.startswith(prefix):
            raise UsageError(f"foreign key {key!r}: not under {prefix!r}; is another crew on this router?")
        return key[len(prefix) :].partition("/")[0]

    def _mission(self, mission: str, leaf: str) -> str:
        return f"crew/{self.crew}/mission/{checked_chunk(mission, 'mission id')}/{leaf}"

    def _robot(self, robot: str, leaf: str) -> str:
        return f"crew/{self.crew}/{checked_robot(robot)}/{leaf}"
