"""One line of the table: who tried what how often, how much of it arrived, and what each side saw."""

from collections.abc import Iterable

import msgspec

BEGIN, END = "<!-- attacks: written by python -m tests.attack -->", "<!-- end of attacks -->"
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


def table(rows: Iterable[Row]) -> str:
    """The rows as Markdown, between the marks by which they are found in the page."""
    lines = [row.line() for row in rows]
    return "\n".join([BEGIN, "", HEAD, "|---|---|---|---|---|---|---|", *lines, "", END])


def replaced(page: str, new: str) -> str:
    """The page with its table exchanged. Raises ValueError if it has none."""
    before, begin, rest = page.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not begin or not end:
        raise ValueError(f"no table between {BEGIN!r} and {END!r}")
    return f"{before}{new}{after}"
