"""A desk for each file of tests, and a crew that is up on it for those that ask for one."""

from collections.abc import Iterator

import pytest

from tests.integration.crew.harness import Desk, Up


@pytest.fixture(scope="module")
def desk(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Desk]:
    """A folder of one's own; whatever a failed test left running in it is killed."""
    desk = Desk(tmp_path_factory.mktemp(request.module.__name__.rpartition("test_")[2]))
    yield desk
    desk.end_all()


@pytest.fixture(scope="module")
def up(desk: Desk) -> Iterator[Up]:
    """The shipped crew, as fast as it goes, ended after the file's last test."""
    with desk.up() as up:
        yield up
