"""`crew watch`: a calm page on a terminal, redrawn in place; one line an event where there is none."""

from pathlib import Path

from crew.bus.port import Bus
from crew.cli.board import Board
from crew.cli.follow import event_box
from crew.cli.output import say, say_event, say_json
from crew.cli.screen import can_draw, drawn_on
from crew.cli.session import home, operator, run
from crew.clock import WALL
from crew.keys import Keys
from crew.launch.ready import query_status

REDRAW_S = 0.5
SETTLE_S = 0.1
"""Events come in bursts: what belongs together is drawn together."""
ANSWER_S = 1.0


def run_watch(crew: str, as_json: bool) -> int:
    """Until Ctrl-C."""
    return run(_watch(crew, as_json))


async def _watch(crew: str, as_json: bool) -> int:
    async with operator(crew) as (bus, keys, running):
        if can_draw() and not as_json:
            await _draw(bus, keys, Board(running.crew, Path(running.run_folder).name))
            say(f"{running.crew} is down; what it did: crew report {running.run_folder}")
        else:
            await _tell(bus, keys, running.crew, as_json)
    return 0


async def _draw(bus: Bus, keys: Keys, board: Board) -> None:
    """Until Ctrl-C, or until the crew is down."""
    box = event_box(bus, keys)
    heard_ns = WALL.now_ns()
    with drawn_on() as screen:
        while True:
            status = await query_status(bus, keys, timeout_s=ANSWER_S)
            if status is not None:
                board.take(status)
                heard_ns = WALL.now_ns()
            else:
                board.silent_s = (WALL.now_ns() - heard_ns) / 1e9
                if home().running(keys.crew) is None:
                    return
            for letter in box.take():
                board.hear(letter.message)
            screen.draw(board.lines(*screen.size))
            if await WALL.race(box.changed(), REDRAW_S):
                await WALL.sleep(SETTLE_S)


async def _tell(bus: Bus, keys: Keys, crew: str, as_json: bool) -> None:
    if not as_json:
        say(f"watching {crew}; end with Ctrl-C")
    async for letter in event_box(bus, keys):
        if as_json:
            say_json(letter.message)
        else:
            say_event(letter.message, with_mission=True)
