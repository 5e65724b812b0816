"""Makes the golden journals anew: `python -m tests.replay.make`. The private key that signs them is thrown away."""

import shutil
import sqlite3
import tempfile
from contextlib import closing
from pathlib import Path

from crew.chain import Signer
from crew.history.contract_text import FOLDER as CONTRACTS
from crew.home import Home
from crew.journal import Journal
from crew.journal_reader import read_records
from crew.signing import load_or_create_key
from tests.integration.crew.harness import Demo, Desk

HERE = Path(__file__).parent
GOLDEN: dict[str, tuple[str, ...]] = {"completed": (), "halted": ("--fault", "missed_detection")}
KEY = HERE / "orchestrator.pub"


def main() -> None:
    """Run each, and keep its records under a name of its own."""
    with tempfile.TemporaryDirectory() as folder:
        desk = Desk(Path(folder))
        home = Home(Path(folder) / "golden")
        key = load_or_create_key(home.keys, "orchestrator")
        for name, options in GOLDEN.items():
            keep(name, desk.demo(*options), key)
        shutil.copy(home.keys / "orchestrator.pub", KEY)


def keep(name: str, demo: Demo, key: Signer) -> None:
    """Copy a run's records into a journal called `name`, signed with a key that nobody keeps."""
    print(f"{name}: {demo.result['outcome']} {demo.result['code'] or ''}")
    folder = HERE / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    shutil.copytree(demo.run / CONTRACTS, folder / CONTRACTS)
    path = folder / "journal.db"
    head = HERE / f"{name}.json"
    with Journal(path, run_id=name, key=key, outside_head=head, on_failure=print) as journal:
        for row in read_records(demo.run / "journal.db"):
            journal.append(row.kind, row.at_ns, row.body)
    with closing(sqlite3.connect(path)) as connection:
        connection.execute("PRAGMA journal_mode = DELETE")


if __name__ == "__main__":
    main()
