"""An orchestrator that has just come is told at once who a robot is: nobody waits for the next second's card."""

from crew.contracts.snapshot import Point, ValueReading
from crew.mailbox import Events, Letter, letters
from crew.messages import RobotCard, RobotValue
from tests.unit.actors.stage import RobotStage, robot_stage


def hear_cards(stage: RobotStage) -> Events[Letter[RobotCard]]:
    cards: Events[Letter[RobotCard]] = Events(letters(RobotCard), capacity=64, on_lost=lambda _: None)
    stage.bus.subscribe(stage.keys.robot_cards, cards)
    return cards


async def test_an_orchestrator_that_comes_hears_card_and_state_while_mission_time_stands() -> None:
    async with robot_stage(alone=True) as stage:
        await stage.settle()
        cards = hear_cards(stage)
        stage.states.clear()
        stage.bus.token(stage.keys.alive("orchestrator"))
        await stage.settle()
        assert [letter.message.boot_id for letter in cards.take()] == [stage.actor.boot_id]
        assert [state.at_ns for state in stage.states] == [stage.clock.now_ns()]


async def test_one_that_dies_and_comes_back_hears_them_again() -> None:
    async with robot_stage(alone=True) as stage:
        first = stage.bus.token(stage.keys.alive("orchestrator"))
        await stage.settle()
        cards = hear_cards(stage)
        first.close()
        await stage.settle()
        assert not cards.take()
        stage.bus.token(stage.keys.alive("orchestrator"))
        await stage.settle()
        assert len(cards.take()) == 1


async def test_the_first_heartbeat_is_answered_with_a_state_that_takes_commands() -> None:
    async with robot_stage(alone=True) as stage:
        await stage.settle()
        stage.states.clear()
        at_ns = stage.clock.now_ns()
        stage.beat()
        for _ in range(200):
            await stage.settle()
            if any(not state.unavailable for state in stage.states):
                break
        assert [(state.unavailable, state.at_ns) for state in stage.states] == [("", at_ns)]


async def test_what_a_robot_sees_is_told_before_it_counts_as_there() -> None:
    """A request that comes at once may need it, and mission time stands still until then."""
    async with robot_stage(stop_first=True) as stage:
        values: Events[Letter[RobotValue]] = Events(letters(RobotValue), capacity=64, on_lost=lambda _: None)
        stage.bus.subscribe(stage.keys.robot_values, values)
        stage.adapter.sees["victim"] = ValueReading(name="victim", status="ok", position=Point(1.0, 2.0), stamp_ns=0)
        await stage.settle()
        assert "ready" in stage.whats
        assert [letter.message.reading.name for letter in values.take()] == ["victim"]
