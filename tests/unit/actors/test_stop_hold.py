"""The stop as the orchestrator keeps it: whom it holds, who has confirmed, and that it outlives every process."""

from pathlib import Path

import pytest

from crew.actors.orchestrator import hold as hold_module
from crew.actors.orchestrator.hold import StopHold
from crew.messages import RobotState

BOTH = ("iris", "tb3")


def said(hold: StopHold, robot: str, *, stopped: bool, told: tuple[int, int] | None = None) -> None:
    """A state of a robot that was told of the newest stop, unless the test says of which."""
    told = (0, hold.number) if told is None else told
    hold.hear_state(RobotState(robot=robot, boot_id="b", at_ns=1, stopped=stopped, told=told))


def test_without_a_stop_nobody_is_held(tmp_path: Path) -> None:
    hold = StopHold(BOTH, tmp_path / "stop.json")
    assert (hold.number, hold.held, hold.unconfirmed) == (0, (), [])
    assert not (tmp_path / "stop.json").exists()


def test_a_robot_leaves_the_stop_once_it_was_seen_latched_and_then_released(tmp_path: Path) -> None:
    hold = StopHold(BOTH, tmp_path / "stop.json")
    hold.stop("operator")
    said(hold, "tb3", stopped=False, told=(0, 0))
    assert list(hold.held) == ["iris", "tb3"], "an older word of a robot that was not latched yet releases nothing"
    said(hold, "tb3", stopped=True)
    assert hold.unconfirmed == ["iris"]
    said(hold, "tb3", stopped=False)
    assert list(hold.held) == ["iris"]


def test_a_stop_outlives_the_orchestrator_and_every_stop_has_a_higher_number(tmp_path: Path) -> None:
    path = tmp_path / "stop.json"
    hold = StopHold(BOTH, path)
    hold.stop("operator", "smoke")
    said(hold, "tb3", stopped=True)
    said(hold, "tb3", stopped=False)
    again = StopHold(BOTH, path)
    assert (again.number, again.held, again.unconfirmed) == (1, ("iris",), ["iris"])
    assert again.status([]).reason == "smoke"
    again.stop("operator")
    assert StopHold(BOTH, path).number == 2


def test_a_robot_that_starts_anew_confirms_anew(tmp_path: Path) -> None:
    hold = StopHold(BOTH)
    hold.stop("operator")
    for robot in BOTH:
        said(hold, robot, stopped=True)
    hold.rebooted("tb3")
    said(hold, "tb3", stopped=False, told=(-1, -1))
    assert hold.held == BOTH
    assert hold.unconfirmed == ["tb3"]


def test_what_a_robot_says_of_an_earlier_stop_neither_confirms_nor_ends_a_newer_one(tmp_path: Path) -> None:
    """Latched and released by the word of stop 1, which was on its way when stop 2 came."""
    hold = StopHold(BOTH, tmp_path / "stop.json")
    hold.stop("operator")
    said(hold, "tb3", stopped=True)
    hold.stop("guest")
    said(hold, "tb3", stopped=True, told=(0, 1))
    assert hold.unconfirmed == ["iris", "tb3"]
    said(hold, "tb3", stopped=False, told=(0, 1))
    assert list(hold.held) == ["iris", "tb3"]
    said(hold, "tb3", stopped=True, told=(0, 2))
    said(hold, "tb3", stopped=False, told=(0, 2))
    assert list(hold.held) == ["iris"]


def test_a_number_of_an_earlier_epoch_confirms_nothing(tmp_path: Path) -> None:
    StopHold(BOTH, tmp_path / "stop.json", epoch=3).stop("operator")
    hold = StopHold(BOTH, tmp_path / "stop.json", epoch=4)
    said(hold, "tb3", stopped=False, told=(3, 1))
    assert (hold.held, hold.unconfirmed) == (BOTH, ["iris", "tb3"])
    said(hold, "tb3", stopped=False, told=(4, 1))
    assert list(hold.held) == ["iris"]


def test_the_account_names_who_has_not_confirmed_standing_still() -> None:
    hold = StopHold(BOTH)
    hold.stop("operator")
    assert hold.status(["tb3"]).treat_as_moving == BOTH, "standing still before it is latched is no confirmation"
    said(hold, "tb3", stopped=True)
    said(hold, "iris", stopped=True)
    account = hold.status(["tb3"])
    assert (account.latched, account.still, account.treat_as_moving) == (BOTH, ("tb3",), ("iris",))


@pytest.mark.parametrize("content", [b"", b"{", b"[]", b'{"number": "x"}', b"\xff"])
def test_a_record_that_cannot_be_read_holds_everybody(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "stop.json"
    path.write_bytes(content)
    hold = StopHold(BOTH, path)
    assert hold.held == BOTH
    assert "unreadable" in hold.status([]).by


def test_robots_that_left_the_crew_are_not_held(tmp_path: Path) -> None:
    path = tmp_path / "stop.json"
    StopHold((*BOTH, "old"), path).stop("operator")
    assert StopHold(BOTH, path).held == BOTH


def test_a_robot_latched_by_a_stop_that_did_not_come_here_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    hold = StopHold(BOTH)
    said(hold, "tb3", stopped=True)
    assert hold.stray() == "", "the stop's own message may be on its way"
    monkeypatch.setattr(hold_module, "ADOPT_S", -1.0)
    assert hold.stray() == "tb3"
    hold.stop("tb3")
    assert hold.stray() == ""
