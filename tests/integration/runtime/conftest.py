"""Real processes and a real router for the runtime's tests."""

import socket
from collections.abc import AsyncIterator
from pathlib import Path

import pytest

from crew.supervisor import Child, Exit, Supervisor
from tests.open_router import OpenRouterSpec

ROOT = Path(__file__).parents[3]
READY_S = 20.0


@pytest.fixture(autouse=True)
def children_find_the_tests(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PYTHONPATH", str(ROOT))


@pytest.fixture
def endpoint() -> str:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return f"tcp/127.0.0.1:{probe.getsockname()[1]}"


@pytest.fixture
def router(endpoint: str) -> Child:
    return Child(name="router", module="tests.open_router", spec=OpenRouterSpec(endpoint), last=True)


@pytest.fixture
def exits() -> list[Exit]:
    return []


@pytest.fixture
async def supervisor(tmp_path: Path, exits: list[Exit]) -> AsyncIterator[Supervisor]:
    async with Supervisor(tmp_path, on_exit=exits.append) as supervisor:
        yield supervisor
