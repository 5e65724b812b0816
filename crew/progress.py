"""What those who watch a mission are told: each event of its machine, as it was journalled."""

from typing import ClassVar

from crew.contracts.mission.event import AnyEvent
from crew.contracts.mission_state import MissionState
from crew.wire import Message


class MissionProgress(Message, frozen=True, kw_only=True):
    """One event of one mission. Stepping `began` through the events in order gives the mission's state at each."""

    schema: ClassVar[str] = "crew.mission_progress"
    version: ClassVar[int] = 1
    mission: str
    number: int
    """From 1 for each mission, without gaps."""
    at_ns: int
    wall_ns: int
    """Since 1970."""
    began: MissionState | None = None
    """The mission before its first event; with the first event only."""
    event: AnyEvent
