"""What the crew's other robots tell of themselves, for an adapter that keeps clear of them. Commands nothing."""

from collections.abc import Mapping

from crew.adapter import Adapter, KeepsClear, Neighbour
from crew.bus.port import Bus
from crew.contracts.separation import may_come_down, may_stand
from crew.contracts.site import Rules
from crew.contracts.skill import Kind
from crew.contracts.snapshot import FluentValue, Point
from crew.keys import Keys
from crew.mailbox import KeepLatest, Letter, letters
from crew.messages import RobotState


class Neighbours:
    """Listens for one robot. Without the bus the last word counts on."""

    def __init__(self, bus: Bus, keys: Keys, robot: str, rules: Rules, adapter: Adapter) -> None:
        self._bus, self._keys, self._robot, self._rules, self._adapter = bus, keys, robot, rules, adapter

    async def run(self) -> None:
        """Until cancelled; at once over for an adapter that keeps clear of nobody."""
        if not isinstance(self._adapter, KeepsClear):
            return
        states: KeepLatest[Letter[RobotState]] = KeepLatest(letters(RobotState))
        declaration = self._bus.subscribe(self._keys.robot_states, states, remote_only=True)
        try:
            async for letter in states:
                neighbour = self._read(letter)
                if neighbour is not None:
                    self._adapter.meet(neighbour)
        finally:
            declaration.close()

    def _read(self, letter: Letter[RobotState]) -> Neighbour | None:
        """A robot's word about itself, on its own key; None for anything else, and while it tells no place."""
        state = letter.message
        kind = self._rules.kind_of(state.robot)
        if kind is None or state.robot == self._robot or letter.key != self._keys.robot_state(state.robot):
            return None
        return neighbour_of(state.robot, kind, state.fluents)


def neighbour_of(robot: str, kind: Kind, told: Mapping[str, FluentValue]) -> Neighbour | None:
    """A robot as its neighbours see it, by what it told last; None while it tells no place."""
    at = told.get("at")
    if not isinstance(at, Point):
        return None
    stands, comes_down = may_stand(told), may_come_down(kind, told)
    return Neighbour(robot=robot, x=at.x, y=at.y, standing=stands, coming_down=comes_down)
