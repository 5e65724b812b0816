"""Recordings on disk: drawn from a journal, mended after a kill, read back without a viewer."""

import shutil
from pathlib import Path

import pytest

from crew.actors.recorder.disk import MAX_BYTES, RESERVE_BYTES, DiskGuard
from crew.actors.recorder.prepare import prepare
from crew.actors.recorder.rebuild import rebuild
from crew.actors.recorder.remains import lane_changes, log_lines, remains
from crew.actors.recorder.rrd import FILE, is_whole, unfinished
from crew.errors import UsageError
from tests.replay.make import HERE


@pytest.fixture(scope="module")
def drawn(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The halted golden run with a recording that was drawn from its journal."""
    folder = tmp_path_factory.mktemp("drawn") / "halted"
    shutil.copytree(HERE / "halted", folder)
    assert "from the journal" in prepare(folder).note
    return folder


def copy(folder: Path, to: Path) -> Path:
    shutil.copytree(folder, to / folder.name)
    return to / folder.name


def test_a_missing_recording_is_drawn_from_the_journal(drawn: Path) -> None:
    assert is_whole(drawn / FILE)
    assert [state for _, state in lane_changes(drawn / FILE)["mission"]][-3:] == ["halting", "halted", ""]
    assert "no_target_fix" in {level for _, level, _ in log_lines(drawn / FILE)}


def test_a_whole_recording_is_taken_as_it_is(drawn: Path) -> None:
    before = (drawn / FILE).stat().st_mtime_ns
    assert prepare(drawn).note == ""
    assert (drawn / FILE).stat().st_mtime_ns == before


def test_a_recording_that_was_not_made_small_in_time_is_when_it_is_shown(drawn: Path, tmp_path: Path) -> None:
    folder = copy(drawn, tmp_path)
    rebuild(folder / "journal.db", folder / FILE)
    large = (folder / FILE).stat().st_size
    unfinished(folder / FILE).write_bytes(b"half")
    assert prepare(folder).note == ""
    assert is_whole(folder / FILE)
    assert (folder / FILE).stat().st_size < large
    assert not unfinished(folder / FILE).exists()


@pytest.mark.parametrize("part", [0.5, 0.9, 0.999])
def test_a_recording_that_was_cut_off_is_mended(drawn: Path, tmp_path: Path, part: float) -> None:
    folder = copy(drawn, tmp_path)
    content = (folder / FILE).read_bytes()
    (folder / FILE).write_bytes(content[: int(len(content) * part)])
    assert not is_whole(folder / FILE)
    prepare(folder)
    assert is_whole(folder / FILE)
    assert log_lines(folder / FILE) == log_lines(drawn / FILE)
    assert remains(folder / FILE).end_ns >= remains(drawn / FILE).told_ns


@pytest.mark.parametrize("rubbish", [b"", b"not a recording", b"RRF2" + b"\0" * 4000])
def test_rubbish_in_place_of_a_recording_is_replaced(drawn: Path, tmp_path: Path, rubbish: bytes) -> None:
    folder = copy(drawn, tmp_path)
    (folder / FILE).write_bytes(rubbish)
    prepare(folder)
    assert log_lines(folder / FILE) == log_lines(drawn / FILE)


def test_what_is_no_recording_can_not_be_read_back(tmp_path: Path) -> None:
    (tmp_path / FILE).write_bytes(b"nothing")
    with pytest.raises(UsageError, match="can't be read"):
        remains(tmp_path / FILE)


def test_a_recording_ends_before_the_disk_is_full(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / FILE
    path.write_bytes(b"x")
    free = RESERVE_BYTES
    monkeypatch.setattr(shutil, "disk_usage", lambda _: shutil._ntuple_diskusage(1 << 40, 0, free))
    assert DiskGuard(path).problem() == ""
    free -= 1
    assert "kept for the journal" in DiskGuard(path).problem()
    free = 1 << 39
    monkeypatch.setattr("crew.actors.recorder.disk.MAX_BYTES", 0)
    assert MAX_BYTES > 0
    assert "> 0 MB" in DiskGuard(path).problem()
    path.unlink()
    assert "recording of" in DiskGuard(path).problem()
