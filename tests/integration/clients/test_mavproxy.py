"""MAVProxy, headless, flies and drives the ArduPilot flavours: modes, arming, takeoff, a point, landing, its own log.

It is in no list of dependencies (docs/decisions/0066): `CREW_MAVPROXY` is its `mavproxy.py` in an environment of its
own.
"""

import os
import subprocess
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from types import TracebackType
from typing import Self

import pytest
from pymavlink import mavutil

from tests.integration.clients.paced_world import PacedWorld

PROGRAM = Path(os.environ.get("CREW_MAVPROXY", "mavproxy.py"))
SPEED = 3.0
WAIT_S = 30.0

pytestmark = pytest.mark.mavproxy


class Console:
    """MAVProxy with its standard input and output for a person's."""

    def __init__(self, port: int, folder: Path) -> None:
        python = PROGRAM.parent / "python"
        options = [f"--master=udpin:127.0.0.1:{port}", f"--state-basedir={folder}", "--nowait"]
        self._process = subprocess.Popen(
            [str(python), "-u", str(PROGRAM), *options],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        self._told = ""
        self._read = threading.Thread(target=self._listen, daemon=True)

    def __enter__(self) -> Self:
        self._read.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._process.kill()
        self._process.wait(WAIT_S)
        self._read.join(WAIT_S)
        for stream in (self._process.stdin, self._process.stdout):
            assert stream is not None
            stream.close()

    def say(self, command: str, *answers: str) -> None:
        """Type a command, and wait until each answer was told after it."""
        assert self._process.stdin is not None
        before = len(self._told)
        self._process.stdin.write(f"{command}\n")
        self._process.stdin.flush()
        for answer in answers:
            self.heard(answer, since=before)

    def heard(self, answer: str, *, since: int = 0) -> None:
        end_s = time.monotonic() + WAIT_S
        while answer not in self._told[since:]:
            assert time.monotonic() < end_s, f"never told {answer!r}: {self._told[since:]}"
            time.sleep(0.05)

    def _listen(self) -> None:
        assert self._process.stdout is not None
        while text := os.read(self._process.stdout.fileno(), 4096):
            self._told += text.decode(errors="replace")


def reached(paced: PacedWorld, name: str, height_m: float) -> None:
    """Wait until the vehicle is truly that high."""
    end_s = time.monotonic() + WAIT_S
    while paced.truth().robots[name].z_m < height_m:
        assert time.monotonic() < end_s, f"only {paced.truth().robots[name].z_m:.1f} m high"
        time.sleep(0.05)


def logged(folder: Path) -> Iterator[float]:
    """Heights above home in MAVProxy's own telemetry log, metres."""
    log = mavutil.mavlink_connection(str(folder / "mav.tlog"))
    while (message := log.recv_match(type="GLOBAL_POSITION_INT")) is not None:
        yield message.relative_alt / 1e3


def test_mavproxy_flies_a_copter_up_and_down(tmp_path: Path) -> None:
    paced = PacedWorld(SPEED, autopilots={"iris": "ardupilot"})
    with paced, Console(paced.ports["iris"], tmp_path) as console:
        console.heard("online system 1")
        console.say("long SET_MESSAGE_INTERVAL 33 100000 0 0 0 0 0", "SET_MESSAGE_INTERVAL: ACCEPTED")
        console.say("mode GUIDED", "DO_SET_MODE: ACCEPTED", "Mode GUIDED")
        console.say("arm throttle", "COMPONENT_ARM_DISARM: ACCEPTED", "ARMED")
        console.say("takeoff 4", "NAV_TAKEOFF: ACCEPTED")
        reached(paced, "iris", 3.5)
        console.say("mode LAND", "Mode LAND", "DISARMED")
        after = paced.truth().robots["iris"]
    assert not after.armed
    assert after.z_m < 0.1
    assert 3.5 < max(logged(tmp_path)) < 4.5, "its telemetry shows the flight"


def test_mavproxy_drives_a_rover_to_a_point(tmp_path: Path) -> None:
    paced = PacedWorld(SPEED, autopilots={"tb3": "ardupilot"})
    with paced, Console(paced.ports["tb3"], tmp_path) as console:
        origin, before = paced.world.map.origin, paced.truth().robots["tb3"]
        console.heard("online system 2")
        console.say("mode GUIDED", "DO_SET_MODE: ACCEPTED", "Mode GUIDED")
        console.say("arm throttle", "COMPONENT_ARM_DISARM: ACCEPTED", "ARMED")
        lat_deg = origin.lat_deg + (before.y_m + 2.0) / 111_320.0
        console.say(f"guided {lat_deg:.7f} {origin.lon_deg + before.x_m / 75_500.0:.7f} 0", "DO_REPOSITION: ACCEPTED")
        end_s = time.monotonic() + WAIT_S
        while abs(paced.truth().robots["tb3"].y_m - before.y_m - 2.0) > 0.5:
            assert time.monotonic() < end_s, "it never came there"
            time.sleep(0.05)
        console.say("mode HOLD", "Mode HOLD")
        console.say("disarm", "DISARMED")
        after = paced.truth().robots["tb3"]
    assert not after.armed
    assert abs(after.y_m - before.y_m - 2.0) < 0.7
