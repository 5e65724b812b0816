"""What a recording holds, read without a viewer: how far a broken one goes, and what its lanes show."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import msgspec
from rerun.chunk import RrdReader

from crew.actors.recorder.blueprint import LANES, LOG, PROPOSAL, TIMELINE
from crew.errors import UsageError

_TOLD = (f"/{LANES}/", f"/{LOG}", f"/{PROPOSAL}")


class Remains(msgspec.Struct, frozen=True):
    """How far a recording goes in mission time: at all, and in what missions did. -1 where there is nothing."""

    end_ns: int
    told_ns: int


NOTHING = Remains(-1, -1)


def remains(path: Path) -> Remains:
    """Read a recording that has an index; NOTHING if it holds none of a run."""
    end_ns = told_ns = -1
    for entity, times_ns, _ in _rows(path):
        end_ns = max(end_ns, *times_ns)
        if entity.startswith(_TOLD):
            told_ns = max(told_ns, *times_ns)
    return NOTHING if end_ns < 0 else Remains(end_ns, told_ns)


def lane_changes(path: Path) -> dict[str, list[tuple[int, str]]]:
    """Each lane's states with the mission time at which each began, in order."""
    found: dict[str, list[tuple[int, str]]] = {}
    for entity, times_ns, batch in _rows(path, f"/{LANES}/**"):
        states = batch.column("StateChange:state").to_pylist()
        changes = found.setdefault(entity.removeprefix(f"/{LANES}/"), [])
        changes += [(at, state[0] if state else "") for at, state in zip(times_ns, states, strict=True)]
    return {lane: sorted(changes, key=lambda change: change[0]) for lane, changes in found.items()}


def log_lines(path: Path) -> list[tuple[int, str, str]]:
    """The log: mission time, level and text of each line, in order."""
    found = []
    for _, times_ns, batch in _rows(path, f"/{LOG}"):
        levels, texts = (batch.column(f"TextLog:{name}").to_pylist() for name in ("level", "text"))
        found += [(at, level[0], text[0]) for at, level, text in zip(times_ns, levels, texts, strict=True)]
    return sorted(found, key=lambda line: line[0])


def _rows(path: Path, content: str = "/**") -> Iterator[tuple[str, list[int], Any]]:
    """Chunks that have mission time: the entity, the times, and the columns. Raises UsageError for what is none."""
    try:
        if not RrdReader(path).recordings():
            return
        for chunk in RrdReader(path).stream().filter(content=content):
            if not chunk.is_static and TIMELINE in chunk.timeline_names and chunk.num_rows:
                batch = chunk.to_record_batch()
                yield str(chunk.entity_path), batch.column(TIMELINE).cast("int64").to_pylist(), batch
    except (OSError, RuntimeError, ValueError) as error:
        raise UsageError(f"recording {path} can't be read: {error}; draw it anew with crew replay --rebuild") from error
