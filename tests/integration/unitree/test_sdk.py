"""The unmodified SDK over loopback DDS: its own clients and the adapter drive the simulated robots."""

import importlib.util
import json
import subprocess
import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from typing import Any

import pytest

from tests.integration.paced import free_port

pytestmark = pytest.mark.skipif(
    importlib.util.find_spec("unitree_sdk2py") is None or importlib.util.find_spec("cyclonedds") is None,
    reason="the SDK is an optional extra: make sdk installs it where cyclonedds has a wheel",
)
DOMAINS = {"quadruped": "71", "humanoid": "72"}
CHILD = (sys.executable, "-m", "tests.integration.unitree.sdk_child")
CLIENT_S = 60.0


@contextmanager
def child(*command: str, ready: str) -> Iterator[None]:
    """A process that says when it is ready, and is ended with the block."""
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    try:
        assert process.stdout is not None
        said = []
        for line in process.stdout:
            said.append(line)
            if ready in line:
                break
        assert process.poll() is None, "".join(said)
        yield
    finally:
        process.kill()
        process.wait()
        assert process.stdout is not None
        process.stdout.close()


@pytest.fixture(scope="module")
def robots() -> Iterator[None]:
    """The apartment, and a bridge for each robot on a domain of its own."""
    ports = {kind: free_port() for kind in DOMAINS}
    with ExitStack() as stack:
        for kind, domain in DOMAINS.items():
            bridge = (sys.executable, "-m", "crew.sim.unitree.bridge", "--kind", kind, "--domain", domain)
            stack.enter_context(child(*bridge, "--port", str(ports[kind]), ready="bridge is up"))
        stack.enter_context(
            child(*CHILD, "world", str(ports["humanoid"]), str(ports["quadruped"]), ready="world is up")
        )
        yield


def client(role: str, kind: str) -> dict[str, Any]:
    """What a client saw."""
    done = subprocess.run([*CHILD, role, DOMAINS[kind]], capture_output=True, text=True, timeout=CLIENT_S, check=False)
    assert done.returncode == 0, done.stderr
    found: dict[str, Any] = json.loads(done.stdout.strip().splitlines()[-1])
    return found


@pytest.mark.usefixtures("robots")
def test_the_sdks_sport_client_walks_the_quadruped() -> None:
    saw = client("go2", "quadruped")
    assert saw["version"] == "1.0.0.1"
    assert (saw["stand_up"], saw["balance"], saw["move"], saw["stop"]) == (0, 0, 0, 0)
    assert saw["denied"] == 3205, "another client holds the lease"
    assert saw["not_implemented"] == 3203
    assert 0.3 < saw["walked_m"] < 1.2
    assert saw["drift_m"] < 0.05


@pytest.mark.usefixtures("robots")
def test_the_sdks_clients_make_the_humanoid_wave() -> None:
    saw = client("g1", "humanoid")
    assert (saw["set_fsm"], saw["list"], saw["wave"]) == (0, 0, 0)
    assert saw["velocity"] == 3203, "its pelvis is held: it says that it does not walk"
    assert saw["unknown"] == 7402
    assert "high wave" in saw["actions"]
    assert saw["raised_rad"] > 0.6


@pytest.mark.usefixtures("robots")
def test_the_adapter_walks_the_quadruped_over_dds() -> None:
    saw = client("adapter", "quadruped")
    assert saw["away_m"] < 0.3
    assert saw["health"] == ""
