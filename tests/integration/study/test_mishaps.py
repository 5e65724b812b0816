"""Every mishap of the humanoid and the quadruped in a full crew: how it ends, where the cube truly lies, who stands."""

import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

import msgspec
import pytest

from crew.bus.port import Qos
from crew.clock import WALL
from crew.home import Home
from crew.launch.options import LaunchOptions
from crew.mailbox import Events, Letter, letters
from crew.messages import MissionEvent
from crew.study.launch import StudyCrew, study_crew
from crew.study.mishaps import CREW, MISHAPS, Mishap, carry_out

HEARD_S = 120.0
QUICK = ("object_dropped-near", "go2_falls-far", "g1_unavailable-near", "lease_held-far")
"""The others take a minute together: `make soak`; `tray_slip` is also tested with a process for every actor."""
Letters = Events[Letter[MissionEvent]]


@pytest.fixture(scope="module")
def home() -> Iterator[Home]:
    with tempfile.TemporaryDirectory() as folder:
        yield Home(Path(folder))


@pytest.mark.parametrize(
    "mishap", [pytest.param(m, id=m.name, marks=() if m.name in QUICK else pytest.mark.soak) for m in MISHAPS]
)
def test_a_mishap_ends_as_declared(mishap: Mishap, home: Home, tmp_path: Path) -> None:
    found = carry_out(mishap, home, tmp_path / "run")
    assert found.as_declared, found


async def test_a_second_request_during_the_walk_waits_for_the_walker_and_not_for_the_arm(
    home: Home, tmp_path: Path
) -> None:
    (tmp_path / "run").mkdir()
    options = LaunchOptions(crew=CREW, map="far", seed=0, speed=0.0, port=0, record=False)
    async with study_crew(options, home, tmp_path / "run", enforced=True) as crew:
        heard: Letters = Events(letters(MissionEvent), capacity=4096, on_lost=lambda _: None)
        crew.bus.subscribe(crew.keys.mission_events, heard)
        told = Told(heard)
        ask(crew, "first", "send the dog to room_a")
        await told.until(lambda: told.begun("first"))
        ask(crew, "second", "send the dog to the charging station")
        ask(crew, "wave", "wave")
        await told.until(lambda: all(told.ended(name) for name in ("first", "second", "wave")))
    assert [told.ended(name) for name in ("first", "second", "wave")] == ["completed"] * 3
    assert any("waiting for robots" in e.text for e in told.of("second"))
    assert not any("waiting for robots" in e.text for e in told.of("wave"))
    finals = [e.request_id for e in told.events if e.final]
    assert finals.index("first") < finals.index("second"), "one after the other"
    begun = [e.request_id for e in told.events if "has begun" in e.text]
    assert begun.index("wave") < begun.index("second"), "the arm was free"


class Told:
    """What was heard of the missions."""

    def __init__(self, box: Letters) -> None:
        self._box = box
        self.events: list[MissionEvent] = []

    def of(self, request_id: str) -> list[MissionEvent]:
        return [e for e in self.events if e.request_id == request_id]

    def begun(self, request_id: str) -> bool:
        return any("has begun" in e.text for e in self.of(request_id))

    def ended(self, request_id: str) -> str | None:
        return next((e.outcome for e in self.of(request_id) if e.final), None)

    async def until(self, done: Callable[[], bool]) -> None:
        """Listen until a condition holds; AssertionError with the last events if nothing more is heard."""
        while not done():
            heard = await WALL.race(self._box.changed(), HEARD_S)
            assert heard, f"silence after {[e.text for e in self.events[-4:]]}"
            self.events += [letter.message for letter in self._box.take()]


def ask(crew: StudyCrew, request_id: str, text: str) -> None:
    body = msgspec.json.encode({"text": text, "request_id": request_id})
    crew.bus.put(crew.keys.request, (body, "application/json"), qos=Qos.EVENT)
