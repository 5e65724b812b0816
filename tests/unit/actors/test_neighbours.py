"""Robots hear each other's states: an adapter that keeps clear is told where the others are, and nothing else."""

from collections.abc import AsyncIterator
from typing import Any

import pytest

from crew.adapter import Neighbour
from crew.bus.port import Qos
from crew.contracts.snapshot import FluentValue, Point
from crew.messages import RobotState
from tests.unit.actors.stage import RobotStage, robot_stage

FLYING: dict[str, FluentValue] = {"at": Point(1.0, 2.0, 5.0), "airborne": True, "descending": False}


@pytest.fixture
async def stage() -> AsyncIterator[RobotStage]:
    async with robot_stage() as stage:
        yield stage


def tell(stage: RobotStage, robot: str = "iris", *, key_robot: str = "iris", **told: Any) -> None:
    fluents = {**FLYING, **told}
    state = RobotState(robot=robot, boot_id="b", at_ns=1, fluents={n: v for n, v in fluents.items() if v is not None})
    stage.bus.put(stage.keys.robot_state(key_robot), state, qos=Qos.STATE)


async def test_an_adapter_is_told_where_another_robot_is_and_whether_it_comes_down(stage: RobotStage) -> None:
    tell(stage)
    await stage.until(lambda: len(stage.adapter.met) == 1, "the drone is met")
    assert stage.adapter.met == [Neighbour(robot="iris", x=1.0, y=2.0, standing=False, coming_down=False)]
    tell(stage, descending=True)
    await stage.until(lambda: stage.adapter.met[-1].coming_down, "it comes down")
    tell(stage, airborne=False)
    await stage.until(lambda: stage.adapter.met[-1].standing, "it stands")


async def test_a_word_that_is_missing_is_taken_for_the_worse(stage: RobotStage) -> None:
    tell(stage, airborne=None, descending=None)
    await stage.until(lambda: len(stage.adapter.met) == 1, "the drone is met")
    assert stage.adapter.met[0].standing
    assert stage.adapter.met[0].coming_down


async def test_only_a_robots_own_word_about_its_own_place_counts(stage: RobotStage) -> None:
    tell(stage, robot="iris", key_robot="iris2")
    tell(stage, robot="tb3", key_robot="tb3")
    tell(stage, robot="nobody", key_robot="nobody")
    tell(stage, at=None)
    await stage.settle()
    assert stage.adapter.met == []
