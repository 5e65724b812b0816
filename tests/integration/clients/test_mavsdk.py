"""MAVSDK flies and drives every flavour of the simulated vehicles: discovery, health, arming, goto, landing."""

import json
import subprocess
import sys

import pytest

from tests.integration.clients.paced_world import PacedWorld

SPEED = 3.0
FLAVOURS = [
    ("quadcopter", "px4"),
    ("rover", "ardupilot"),
    pytest.param("quadcopter", "ardupilot", marks=pytest.mark.soak),
    pytest.param("rover", "px4", marks=pytest.mark.soak),
]
VEHICLES = {"quadcopter": "iris", "rover": "tb3"}


@pytest.mark.parametrize(("kind", "autopilot"), FLAVOURS)
def test_mavsdk_takes_the_vehicle_there_and_back_to_rest(kind: str, autopilot: str) -> None:
    name = VEHICLES[kind]
    with PacedWorld(SPEED, autopilots={name: autopilot}) as paced:
        before = paced.truth().robots[name]
        command = [sys.executable, "-m", "tests.integration.clients.mavsdk_flight", kind, autopilot]
        done = subprocess.run(
            [*command, str(paced.ports[name])], capture_output=True, text=True, timeout=90, check=False
        )
        after = paced.truth().robots[name]
    assert done.returncode == 0, done.stderr[-2000:]
    told = json.loads(done.stdout.splitlines()[-1])
    assert told["healthy"]
    assert told["disarmed"]
    assert told["battery"] > 50
    assert abs(told["north_m"] - 2.2) < 1.0
    assert abs(after.y_m - before.y_m - 2.2) < 1.0, "it really went there"
    assert not after.armed
    assert after.z_m < 0.1
