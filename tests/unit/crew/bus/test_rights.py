import pytest

from crew.access import Identity, Way
from crew.bus.rights import Rights
from crew.errors import BusError
from crew.keys import Keys

KEYS = Keys("demo")
PLANNER = Rights(Identity.of("demo", "planner"))
IRIS = Rights(Identity.of("demo", "robot-iris"))


def test_a_role_is_told_what_it_may_not_say_and_who_may() -> None:
    with pytest.raises(BusError, match=r"planner may not put on crew/demo/iris/@act/land; .*crew doctor --authority"):
        PLANNER.to_write(Way.PUT, KEYS.act("iris", "land"))
    with pytest.raises(BusError, match="planner may not ask crew/demo/status"):
        PLANNER.to_write(Way.ASK, KEYS.status)
    with pytest.raises(BusError, match="planner may not subscribe to"):
        PLANNER.to_read(Way.PUT, KEYS.acts("iris"))
    PLANNER.to_write(Way.PUT, KEYS.planner_proposal)
    PLANNER.to_read(Way.PUT, KEYS.planner_ask)


def test_a_robot_speaks_for_itself_alone() -> None:
    IRIS.to_write(Way.PUT, KEYS.robot_state("iris"))
    IRIS.to_write(Way.ALIVE, KEYS.alive("iris"))
    IRIS.to_read(Way.PUT, KEYS.acts("iris"))
    for refused in (KEYS.robot_state("tb3"), KEYS.act("iris", "land"), "crew/other/iris/state"):
        with pytest.raises(BusError, match="robot-iris may not put on"):
            IRIS.to_write(Way.PUT, refused)
    with pytest.raises(BusError, match="robot-iris may not announce itself on"):
        IRIS.to_write(Way.ALIVE, KEYS.alive("tb3"))


def test_a_guest_is_judged_by_the_router() -> None:
    Rights(None).to_write(Way.PUT, KEYS.act("iris", "land"))
