"""Writes the tables of docs/authority.md anew: `python -m tests.attack`. Exit 1 if an attack got through."""

import sys
from pathlib import Path

from tests.attack.row import replaced, rights, table
from tests.attack.suite import run

PAGE = Path(__file__).parents[2] / "docs" / "authority.md"


def main() -> int:
    """Run the suite; the page tells what was seen, good or bad."""
    rows = run()
    page = replaced(replaced(PAGE.read_text(encoding="utf-8"), rights()), table(rows))
    PAGE.write_text(page, encoding="utf-8")
    attempts, delivered = sum(row.attempts for row in rows), sum(row.delivered for row in rows)
    print(f"{len(rows)} attacks, {attempts} attempts, {delivered} delivered; written to {PAGE}")
    for row in rows:
        if not row.holds:
            print(f"GOT THROUGH, or its control did not: {row.line()}")
    return 0 if all(row.holds for row in rows) else 1


if __name__ == "__main__":
    sys.exit(main())
