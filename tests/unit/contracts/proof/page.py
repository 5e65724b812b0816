"""Writes the table of shipped contracts in docs/proof.md anew, after a crew, a kind or a contract has changed.

`python -m tests.unit.contracts.proof.page`; the count by hand below the table is a person's to correct.
"""

from tests.unit.contracts.proof.test_shipped import SHIPPED, report_of
from tests.unit.project.tree import ROOT

PAGE = ROOT / "docs" / "proof.md"
HEADER = "| crew | contract | plans | states | transitions | decisions of the gate |\n|---|---|---|---|---|---|\n"


def rows() -> str:
    """One row for each contract."""
    lines = []
    for crew, name in SHIPPED:
        found = report_of(crew, name)
        counts = " | ".join(f"{n:,}" for n in (found.plans, found.states, found.transitions, found.decisions))
        lines.append(f"| {crew} | `{name}` | {counts} |\n")
    return "".join(lines)


def main() -> None:
    """Exchange the table."""
    text = PAGE.read_text(encoding="utf-8")
    before, _, rest = text.partition(HEADER)
    after = rest[rest.index("\n\n") + 1 :]
    PAGE.write_text(before + HEADER + rows() + after, encoding="utf-8")


if __name__ == "__main__":
    main()
