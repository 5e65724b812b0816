import os
import re
import threading
from pathlib import Path

import pytest

from crew.errors import UsageError
from crew.home import Home, replace_file

ENDPOINT = "tcp/127.0.0.1:7447"


@pytest.fixture
def home(tmp_path: Path) -> Home:
    return Home(tmp_path / "home")


@pytest.mark.parametrize(
    ("environment", "path"),
    [
        ({"CREW_HOME": "/a", "XDG_STATE_HOME": "/b"}, Path("/a")),
        ({"XDG_STATE_HOME": "/b"}, Path("/b/crew")),
        ({"CREW_HOME": ""}, Path.home() / ".local/state/crew"),
    ],
)
def test_home_is_found_in_order(environment: dict[str, str], path: Path) -> None:
    assert Home.of(environment).path == path


def test_epochs_only_grow_and_each_crew_has_its_own(home: Home) -> None:
    assert home.epoch("demo") == 0
    assert [home.next_epoch("demo") for _ in range(3)] == [1, 2, 3]
    assert home.next_epoch("other") == 1
    assert Home(home.path).epoch("demo") == 3


def test_no_two_callers_share_an_epoch(home: Home) -> None:
    got: list[int] = []

    def take() -> None:
        got.extend(home.next_epoch("demo") for _ in range(5))

    threads = [threading.Thread(target=take) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert sorted(got) == list(range(1, 21))


def test_a_broken_epoch_is_not_taken_for_zero(home: Home) -> None:
    home.next_epoch("demo")
    (home.path / "epochs" / "demo").write_text("x")
    with pytest.raises(UsageError, match="broken epoch"):
        home.next_epoch("demo")


def test_two_crews_of_one_name_are_refused_by_pid_and_run(home: Home, tmp_path: Path) -> None:
    with home.claim("demo", tmp_path / "run", ENDPOINT) as running:
        assert home.running("demo") == running
        expected = f"crew 'demo' already runs: process {os.getpid()}, run {tmp_path / 'run'}"
        with pytest.raises(UsageError, match=re.escape(expected)), home.claim("demo", tmp_path / "other", ENDPOINT):
            pass
        assert home.running("demo") == running
        with home.claim("second", tmp_path / "second", ENDPOINT):
            assert [each.crew for each in home.all_running()] == ["demo", "second"]
    assert home.running("demo") is None
    with home.claim("demo", tmp_path / "again", ENDPOINT):
        pass


def test_a_crew_that_never_ran_is_not_running(home: Home) -> None:
    assert home.running("demo") is None
    assert home.all_running() == []


def test_names_that_would_leave_the_folder_are_refused(home: Home) -> None:
    with pytest.raises(UsageError, match="invalid run id"):
        home.head("../x")
    with pytest.raises(UsageError, match="invalid crew name"):
        home.next_epoch("../x")


def test_an_unusable_home_is_named(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(UsageError, match="unusable state folder"):
        Home(tmp_path / "file").next_epoch("demo")


@pytest.mark.parametrize("durable", [True, False])
def test_a_replaced_file_leaves_nothing_beside(tmp_path: Path, durable: bool) -> None:
    path = tmp_path / "head.json"
    replace_file(path, b"1", durable=durable)
    replace_file(path, b"2", durable=durable)
    assert [(each.name, each.read_bytes()) for each in tmp_path.iterdir()] == [("head.json", b"2")]
