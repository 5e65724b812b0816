"""The watch's page: what runs and how far, what is held and by what, what a person is asked and how to answer."""

import io
import os
import re
import sys
from typing import Any

import pytest
from msgspec.structs import replace

from crew.cli import screen as drawing
from crew.cli.board import Board
from crew.cli.screen import Line, Piece, Screen, columns, drawn_on, fitted, line
from crew.cli.tape import HELD, IDLE, LONGEST_S, SKILL, Tape
from crew.contracts.snapshot import Point
from crew.messages import CrewStatus, MissionEvent, MissionStatus, Progress, RobotStatus, StepStatus

IRIS = RobotStatus(
    robot="iris",
    kind="quadcopter",
    unavailable="",
    stopped=False,
    still=False,
    age_s=0.1,
    running="m1/2",
    lease="m1",
    fluents={"battery": 96.0, "at": Point(3.2, 1.1), "airborne": True, "moving": False, "altitude": 5.0},
    progress=Progress(share=0.61, left_m=23.4),
)
TB3 = replace(IRIS, robot="tb3", kind="rover", running="", fluents={"battery": 19.0}, progress=None, still=True)
STEPS = (
    StepStatus(step="takeoff", robot="iris", skill="takeoff", phase="succeeded", since_s=40.0),
    StepStatus(step="search", robot="iris", skill="search_target", phase="running", after=("takeoff",), since_s=38.2),
    StepStatus(step="report", robot="iris", skill="get_coordinates", phase="pending", after=("search",)),
    StepStatus(step="dispatch", robot="tb3", skill="navigate_to", phase="pending", after=("report",)),
)
MISSION = MissionStatus(
    mission="m1",
    request="search the area and send the rover",
    phase="executing",
    contract="search_and_dispatch",
    message="",
    steps=STEPS,
    spent_s=42.0,
    deadline_s=600.0,
)


def status(*missions: MissionStatus, at_s: float = 50.0, **changes: Any) -> CrewStatus:
    found = CrewStatus(
        crew="air_ground",
        run="r1",
        epoch=1,
        at_ns=round(at_s * 1e9),
        stopped=False,
        robots=(IRIS, TB3),
        missions=missions or (MISSION,),
    )
    return replace(found, **changes)


def text(lines: list[Line]) -> str:
    return "\n".join("".join(piece.text for piece in found) for found in lines)


def shown(*statuses: CrewStatus, width: int = 110, height: int = 40) -> str:
    board = Board("air_ground", "r1")
    for found in statuses:
        board.take(found)
    return text(board.lines(width, height))


def row(page: str, *words: str) -> str:
    return next(found for found in page.splitlines() if all(word in found for word in words))


def test_a_running_skill_shows_how_far_it_has_come() -> None:
    found = row(shown(status()), "search_target")
    assert "61%" in found
    assert "23 m to go" in found
    assert "38 s" in found


def test_a_held_robot_says_what_it_waits_for_and_a_busy_one_only_its_order() -> None:
    page = shown(status())
    assert "held: waits for report (iris)" in row(page, "navigate_to")
    assert "after search" in row(page, "get_coordinates")
    assert "held" not in row(page, "get_coordinates")


def test_a_question_stands_whole_with_the_commands_that_answer_it() -> None:
    asked = "I did not understand 'twice' and would leave it out. " * 4
    page = shown(status(replace(MISSION, phase="asking", question=asked, token="t")), width=60)
    assert asked.split()[-1] in page
    assert "yes: crew confirm m1    no: crew confirm m1 --no" in page


def test_a_step_that_waits_for_approval_says_how_to_approve_it() -> None:
    steps = (*STEPS[:3], replace(STEPS[3], phase="asking"))
    page = shown(status(replace(MISSION, steps=steps, question="tb3 drives to (5, 5). Shall I?", step="dispatch")))
    assert "waits for a person's approval" in row(page, "navigate_to")
    assert "yes: crew approve m1    no: crew approve m1 --no" in page


def test_a_mission_that_waits_names_who_holds_its_robots() -> None:
    page = shown(status(replace(MISSION, mission="m2", phase="waiting", waits_for=("m1",))))
    assert "waits for robots that m1 holds" in page
    assert "crew cancel m1" in page


def test_robots_show_battery_and_the_age_of_their_state() -> None:
    page = shown(status(robots=(IRIS, replace(TB3, age_s=4.2))))
    assert "battery 96%" in row(page, "quadcopter")
    assert "at (3.2, 1.1)" in row(page, "quadcopter")
    assert "airborne" in row(page, "quadcopter")
    assert "moving" not in row(page, "quadcopter"), "what is false goes without saying"
    assert "state 4.2 s old" in row(page, "tb3   rover")
    assert "never heard" in shown(status(robots=(replace(TB3, age_s=None),)))


def test_a_stop_is_the_first_thing_and_names_who_may_still_move() -> None:
    page = shown(status(stopped=True))
    assert "STOPPED; treat as moving: iris" in page.splitlines()[1]
    assert "crew reset" in page


def test_a_silent_orchestrator_is_said_and_states_grow_old() -> None:
    board = Board("air_ground", "r1")
    board.take(status())
    board.silent_s = 5.0
    page = text(board.lines(110, 40))
    assert "has not answered for 5 s" in page
    assert "state 5.1 s old" in page
    assert "has not answered yet" in text(Board("air_ground", "r1").lines(80, 24))


def test_an_ended_mission_says_how() -> None:
    ended = replace(MISSION, phase="halted", message="tb3.navigate_to needs a fix of victim")
    page = shown(status(ended))
    assert "halted" in row(page, "m1")
    assert "needs a fix of victim" in page
    assert "held" not in page


def test_text_from_outside_moves_no_cursor() -> None:
    wild = replace(MISSION, request="search\x1b[2J\x1b]0;x\x07 the \u202earea", question="\x1b[31m?", phase="asking")
    page = shown(status(wild, robots=(replace(IRIS, unavailable="\x1b[5mlost"),)))
    assert "\x1b" not in page
    assert "\x07" not in page
    assert "\u202e" not in page


@pytest.mark.parametrize(("width", "height"), [(20, 5), (40, 12), (80, 24), (300, 100)])
def test_it_fits_any_terminal(width: int, height: int, capsys: pytest.CaptureFixture[str]) -> None:
    board = Board("air_ground", "r1")
    board.take(status())
    for number in range(30):
        board.hear(event(number))
    rows = [Screen()._row(found, width) for found in board.lines(width, height)]
    assert all(columns(plain(found)) <= width for found in rows)
    assert height < 30 or len(board.lines(width, height)) <= height


def event(number: int) -> MissionEvent:
    return MissionEvent(mission="m1", number=number, at_s=1.0, phase="executing", what="step", text=f"step {number}")


def plain(found: str) -> str:
    return re.sub(r"\x1b\[[0-9;]*m", "", found)


# --- lanes


def test_lanes_show_what_was_seen_while_watching() -> None:
    tape = Tape()
    for at_s in range(0, 60, 2):
        running = replace(MISSION, steps=(*STEPS[:3], replace(STEPS[3], phase="running" if at_s >= 30 else "pending")))
        tape.take(status(running, at_s=float(at_s)))
    strip = tape.strip("tb3", 59, 58.0)
    assert strip[0] is HELD
    assert strip[-1] is SKILL
    assert strip[:31] == [HELD] * 30 + [SKILL] or strip[:30] == [HELD] * 30
    assert tape.strip("nobody", 5, 58.0) == [IDLE] * 5


def test_a_long_watch_keeps_a_bounded_tape() -> None:
    tape = Tape()
    for at_s in range(0, 4000, 10):
        phase = "running" if at_s % 20 else "pending"
        tape.take(status(replace(MISSION, steps=(replace(STEPS[1], phase=phase),)), at_s=float(at_s)))
    assert tape.window_s(4000.0) == LONGEST_S
    assert len(tape._samples["iris"]) <= LONGEST_S / 10 + 2


# --- the terminal


class Terminal(io.StringIO):
    """Standard output as a terminal of a given size."""

    encoding = "utf-8"

    def isatty(self) -> bool:
        return True


def terminal(monkeypatch: pytest.MonkeyPatch) -> Terminal:
    out = Terminal()
    monkeypatch.setattr(sys, "stdout", out)
    monkeypatch.setattr(Screen, "size", property(lambda _: (40, 5)))
    return out


def test_only_rows_that_changed_are_drawn_again(monkeypatch: pytest.MonkeyPatch) -> None:
    out, page = terminal(monkeypatch), Screen()
    page.draw([line("one"), line("two")])
    before = len(out.getvalue())
    page.draw([line("one"), line(Piece("three", "red"))])
    assert out.getvalue()[before:] == "\x1b[2;1H\x1b[2K\x1b[31mthree\x1b[0m"


def test_the_terminal_is_given_back_whatever_happens(monkeypatch: pytest.MonkeyPatch) -> None:
    out = terminal(monkeypatch)
    with pytest.raises(KeyboardInterrupt), drawn_on():
        raise KeyboardInterrupt
    assert out.getvalue().endswith("\x1b[?25h\x1b[?1049l")


def test_colour_is_left_out_where_nobody_wants_it(monkeypatch: pytest.MonkeyPatch) -> None:
    out = terminal(monkeypatch)
    monkeypatch.setenv("NO_COLOR", "1")
    Screen().draw([line(Piece("red", "red"))])
    assert "\x1b[31m" not in out.getvalue()


def test_a_page_is_drawn_only_where_one_can_be(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal(monkeypatch)
    monkeypatch.setenv("TERM", "xterm")
    assert drawing.can_draw()
    monkeypatch.setenv("TERM", "dumb")
    assert not drawing.can_draw()
    monkeypatch.setattr(sys, "stdout", io.StringIO())
    monkeypatch.setenv("TERM", "xterm")
    assert not drawing.can_draw()


def test_wide_characters_count_as_two_columns() -> None:
    assert columns("搜索 a\u0301") == 6
    assert fitted("搜索这个", 5) == "搜索…"
    assert fitted("ab", 4) == "ab  "
    assert os.linesep not in fitted("a", 3)
