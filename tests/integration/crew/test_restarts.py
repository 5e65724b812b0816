"""A stop outlives everything: the robot, the orchestrator, the whole crew. Only the signed reset ends it."""

import asyncio
from collections.abc import AsyncIterator, Iterator

import pytest

from crew.bus.port import Qos
from crew.launch.table import OPERATOR
from crew.messages import Stop, StopStatus
from crew.records import NoteRecord
from crew.release import signed_reset
from crew.signing import load_or_create_key
from tests.integration.crew.harness import NAME, SHORT_DRIVE, Desk, Watch, journal, latches, watching
from tests.integration.crew.threads import ThreadedCrew, crew_with_threads

BOTH = ("iris", "tb3")


@pytest.fixture
async def stopped(desk: Desk) -> AsyncIterator[ThreadedCrew]:
    """A crew that was stopped, and whose robots have said so."""
    async with crew_with_threads(desk) as crew:
        crew.watch.put(crew.watch.keys.stop, Stop(by="operator", reason="smoke"), qos=Qos.STOP)
        await latched(crew.watch)
        yield crew
    desk.home.stop(NAME).unlink(missing_ok=True)


async def latched(watch: Watch) -> None:
    await watch.until(lambda: set(BOTH) <= watch.states.keys(), why="states")
    await watch.until(lambda: all(watch.states[r].stopped and watch.states[r].still for r in BOTH), why="latched")


async def confirmed(watch: Watch) -> StopStatus:
    """The orchestrator's account of the stop, once every robot has confirmed it."""
    for _ in range(200):
        status = await watch.status()
        assert status.stopped
        assert status.stop is not None
        if not status.stop.treat_as_moving:
            return status.stop
        await asyncio.sleep(0.1)
    raise AssertionError(f"not confirmed: {status.stop}")


async def boot_after(watch: Watch, robot: str, boot: str) -> None:
    await watch.until(lambda: watch.states[robot].boot_id != boot, why=f"{robot} is back")


async def released(watch: Watch, desk: Desk) -> None:
    """The operator's signed reset releases both, and the crew works again."""
    status = await watch.status()
    key = load_or_create_key(desk.home.keys, OPERATOR)
    signed = signed_reset(NAME, latches(status), key, by=OPERATOR, epoch=status.epoch)
    watch.put(watch.keys.reset, signed, qos=Qos.STOP)
    await watch.until(lambda: not any(watch.states[r].stopped for r in BOTH), why="released")
    await watch.drives()


async def test_a_robot_restarted_while_the_crew_is_stopped_comes_up_latched(stopped: ThreadedCrew, desk: Desk) -> None:
    watch = stopped.watch
    boot = watch.states["tb3"].boot_id
    await stopped.restart("tb3")
    await boot_after(watch, "tb3", boot)
    assert watch.states["tb3"].stopped or watch.states["tb3"].unavailable, "it takes nothing before it knows"
    await latched(watch)
    account = await confirmed(watch)
    assert (account.by, account.reason, account.latched) == ("operator", "smoke", BOTH)
    assert (await watch.mission(SHORT_DRIVE)).code == "stopped"
    await released(watch, desk)
    boot = watch.states["tb3"].boot_id
    await stopped.restart("tb3")
    await boot_after(watch, "tb3", boot)
    await watch.until(lambda: not watch.states["tb3"].unavailable, why="it serves")
    assert not watch.states["tb3"].stopped, "once released, a restart does not bring the stop back"


async def test_a_stop_outlives_the_orchestrator_and_every_robot_at_once(stopped: ThreadedCrew, desk: Desk) -> None:
    watch = stopped.watch
    boots = {robot: watch.states[robot].boot_id for robot in BOTH}
    await stopped.restart("orchestrator", epoch=desk.home.next_epoch(NAME))
    for robot in BOTH:
        await stopped.restart(robot)
    for robot in BOTH:
        await boot_after(watch, robot, boots[robot])
    await latched(watch)
    account = await confirmed(watch)
    assert (account.reason, account.latched) == ("smoke", BOTH)
    assert (await watch.mission(SHORT_DRIVE)).code == "stopped"
    await released(watch, desk)


@pytest.fixture
def kept(desk: Desk) -> Iterator[Desk]:
    """A crew was stopped on the command line and brought down."""
    with desk.up():
        _stop(desk, "end of the shift")
    yield desk
    desk.home.stop(NAME).unlink(missing_ok=True)


def _stop(desk: Desk, reason: str) -> None:
    stop = desk.crew("stop", "--reason", reason)
    assert stop.returncode == 0, stop.stdout + stop.stderr


async def test_a_stop_outlives_the_whole_crew_until_it_is_released_or_lifted_by_its_owner(kept: Desk) -> None:
    demo = kept.demo("--request", SHORT_DRIVE)
    assert (demo.result["outcome"], demo.result["code"]) == ("rejected", "stopped")
    with kept.up() as up:
        assert "STOPPED by operator: end of the shift" in up.said
        async with watching(up.running) as watch:
            await latched(watch)
            refused = await watch.mission(SHORT_DRIVE)
            assert (refused.outcome, refused.code) == ("rejected", "stopped")
            reset = kept.crew("reset")
            assert reset.returncode == 0, reset.stdout
            assert "stop 1 by operator: end of the shift" in reset.stdout
            await watch.drives()
        notes = [r.text for _, r in journal(up.run) if isinstance(r, NoteRecord) and r.what == "stop"]
        assert notes == ["stop 1 is still in force for iris, tb3"]
        _stop(kept, "once more")
    lifted = kept.crew("reset", "--crew", NAME)
    assert lifted.returncode == 0
    assert "lifted" in lifted.stdout
    assert kept.demo("--request", SHORT_DRIVE).result["outcome"] == "completed"
