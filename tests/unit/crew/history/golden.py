"""What the golden runs hold, read from their journals: they are made anew now and then, and the noise differs."""

from pathlib import Path

import msgspec

import tests.replay
from crew.journal_reader import read_records
from crew.records import IntentRecord

GOLDEN = Path(tests.replay.__file__).parent


def fix() -> str:
    """Where the completed run's rover was sent, as it is shown."""
    rows = [row for row in read_records(GOLDEN / "completed" / "journal.db") if row.kind == IntentRecord.kind]
    places = [msgspec.msgpack.decode(row.body, type=IntentRecord).dispatch.places for row in rows]
    (place,) = [found["target"] for found in places if found]
    return f"({place.x:.2f}, {place.y:.2f})"
