"""One line of the table: who tried what how often, how much of it arrived, and what each side saw."""

from collections.abc import Iterable

import msgspec

from crew.access import OWN, ROBOTS, TABLE

BEGIN, END = "<!-- attacks: written by python -m tests.attack -->", "<!-- end of attacks -->"
RIGHTS_BEGIN, RIGHTS_END = "<!-- table: crew/access.py -->", "<!-- end of table -->"
HEAD = "| attack | by | attempts | delivered | what the attacker sees | what the operator sees | positive control |"


class Row(msgspec.Struct, frozen=True, kw_only=True):
    """`control` says whose same message was sent, `controlled` how many of those arrived."""

    attack: str
    by: tuple[str, ...]
    attempts: int
    delivered: int
    attacker_sees: str
    operator_sees: str = "nothing: no robot, no counter and no mission changed"
    control: str
    controlled: int

    @property
    def holds(self) -> bool:
        """Nothing of the attack arrived, and the rightful message did."""
        return self.attempts > 0 and self.delivered == 0 and self.controlled > 0

    def line(self) -> str:
        control = f"{self.control}: {'arrives' if self.controlled else 'LOST'}"
        cells = (self.attack, ", ".join(self.by), self.attempts, self.delivered, self.attacker_sees)
        return f"| {' | '.join(str(c) for c in (*cells, self.operator_sees, control))} |"


def rights() -> str:
    """Who may do what, as the page shows it."""
    lines = [
        f"| `{row.key.replace(ROBOTS, '<robot>').replace(OWN, '<own name>')}` | {row.way} "
        f"| {', '.join(row.writers)} | {', '.join(row.readers)} |"
        for row in TABLE
    ]
    head = ["| key below `crew/<crew>/` | way | who may | who hears or answers |", "|---|---|---|---|"]
    return "\n".join([RIGHTS_BEGIN, "", *head, *lines, "", RIGHTS_END])


def table(rows: Iterable[Row]) -> str:
    """The rows as Markdown, between the marks by which they are found in the page."""
    lines = [row.line() for row in rows]
    return "\n".join([BEGIN, "", HEAD, "|---|---|---|---|---|---|---|", *lines, "", END])


def replaced(page: str, new: str) -> str:
    """The page with the table exchanged that begins and ends with the same lines. Raises ValueError if it has none."""
    first, last = new.splitlines()[0], new.splitlines()[-1]
    before, begin, rest = page.partition(first)
    _, end, after = rest.partition(last)
    if not begin or not end:
        raise ValueError(f"no table between {first!r} and {last!r}")
    return f"{before}{new}{after}"
