import os
import signal
import subprocess
import sys
from pathlib import Path

from crew.journal_reader import check_chain, read_records
from tests.unit.crew.test_journal import KEY, Place, not_expected

WRITER = """
import pathlib, sys
from tests.unit.crew.test_journal import Place
journal = Place(pathlib.Path(sys.argv[1])).journal()
for number in range(1000000):
    journal.append("event", number, b"x" * 50).wait(10)
    print(number + 1, flush=True)
"""


def test_what_was_acknowledged_survives_a_kill_and_the_journal_goes_on(tmp_path: Path) -> None:
    place = Place(tmp_path)
    command = [sys.executable, "-c", WRITER, str(tmp_path)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as writer:
        assert writer.stdout is not None
        for _ in range(20):
            acknowledged = int(writer.stdout.readline())
        os.kill(writer.pid, signal.SIGKILL)
    report = check_chain(place.path, KEY.public, place.head)
    assert report.problems == ()
    assert report.records >= acknowledged
    with place.journal(on_failure=not_expected) as journal:
        assert journal.append("after", 1, b"").seq == report.records + 1
    assert [record.seq for record in read_records(place.path)] == list(range(1, report.records + 2))
