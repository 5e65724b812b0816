"""The main job, done once for all tests that look at how it ended."""

from collections.abc import Iterator

import pytest

from tests.integration.crew.harness import Demo, Desk


@pytest.fixture(scope="session")
def demo_desk(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Desk]:
    """The folder in which it was done."""
    desk = Desk(tmp_path_factory.mktemp("demo"))
    yield desk
    desk.end_all()


@pytest.fixture(scope="session")
def completed(demo_desk: Desk) -> Demo:
    """`crew demo` as a user begins it: the drone finds the person, and the rover drives there."""
    return demo_desk.demo()
