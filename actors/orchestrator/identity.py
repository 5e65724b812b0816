"""Whether a robot's name is one robot's: cards that change without a restart, or two robots with one name."""

from crew.clock import WALL, seconds_ns
from crew.messages import RobotCard

DOUBT_S = 5.0
"""Wall time without another conflicting card after which a name is believed again; cards come every second."""


class Identities:
    """Remembers the boots of each name. The first card of a boot counts; another card of it is a conflict."""

    def __init__(self) -> None:
        self._past: dict[str, set[str]] = {}
        self._conflicts: dict[str, tuple[str, int]] = {}

    def conflicting(self, known: RobotCard | None, card: RobotCard) -> bool:
        """Whether a card may not follow the known one. What is wrong with it is remembered."""
        if known is None or known == card:
            return False
        past = self._past.setdefault(card.robot, set())
        if card.boot_id == known.boot_id:
            changed = [n for n in RobotCard.__struct_fields__ if getattr(known, n) != getattr(card, n)]
            return self._note(card.robot, f"its card changed while it ran ({', '.join(changed)}); restart the robot")
        if card.boot_id in past:
            boots = f"{known.boot_id} and {card.boot_id}"
            return self._note(card.robot, f"two robots announce the name {card.robot} (boots {boots}); end one of them")
        past.add(known.boot_id)
        return False

    def conflict(self, robot: str) -> str:
        """What is wrong with a name now, or empty."""
        what, noted_ns = self._conflicts.get(robot, ("", 0))
        return what if what and WALL.now_ns() - noted_ns < seconds_ns(DOUBT_S) else ""

    def _note(self, robot: str, what: str) -> bool:
        self._conflicts[robot] = (what, WALL.now_ns())
        return True
