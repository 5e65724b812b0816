"""The hardware checklist: what is not as it must be is named, with what to do; nothing moves."""

import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from pymavlink.dialects.v20 import common as mavlink

from crew.adapter import Check
from tests.integration.adapters.stage import SimulatedStage
from tests.integration.clients.paced_world import PacedWorld

FLAVOURS = [("quadcopter", "px4"), ("quadcopter", "ardupilot"), ("rover", "px4"), ("rover", "ardupilot")]
CREW = """
crew: field
area: {{x: [-6, 10], y: [-6, 10]}}
origin: {{lat_deg: 47.397742, lon_deg: 8.545594, alt_m: {alt}}}
robots:
  tb3: {{kind: rover, adapter: mavlink, connection: "udpin:127.0.0.1:{port}", options: {{allow_unsigned: true}}}}

"""


async def checks(stage: SimulatedStage) -> dict[str, Check]:
    async def walk() -> list[Check]:
        return [check async for check in stage.adapter.checklist()]

    await stage.run(stage.adapter.connect())
    await stage.advance(1.0)
    return {check.what: check for check in await stage.run(walk())}


@pytest.mark.parametrize(("kind", "autopilot"), FLAVOURS)
async def test_a_vehicle_in_good_order_lacks_only_the_signature(kind: str, autopilot: str) -> None:
    stage = SimulatedStage(kind, autopilot)
    try:
        found = await checks(stage)
        assert [str(check) for check in found.values() if not check.ok] == [
            "signing: unsigned; allowed: signed; give the vehicle and the crew file's signing_key one key, "
            "or write allow_unsigned: true for a cable"
        ]
        assert any(what.startswith("failsafe") for what in found)
        assert any(what.startswith("geofence") for what in found)
        assert not set(stage.relay.commands()) - {mavlink.MAV_CMD_SET_MESSAGE_INTERVAL, mavlink.MAV_CMD_REQUEST_MESSAGE}
    finally:
        await stage.close()


async def test_what_is_not_as_it_must_be_is_named_with_what_to_do() -> None:
    stage = SimulatedStage("quadcopter", "px4", allow_unsigned=True)
    try:
        for name, value in (("NAV_DLL_ACT", 0.0), ("GF_MAX_VER_DIST", 0.0)):
            stage.world._copter.parameters._values[name] = value
        stage.world.set_fault("battery_low", True)
        stage.world._copter.home_alt_m += 60.0
        failed = {what: check for what, check in (await checks(stage)).items() if not check.ok}
        assert set(failed) == {"sensors", "failsafe NAV_DLL_ACT", "geofence GF_MAX_VER_DIST", "home", "battery"}
        assert "NAV_DLL_ACT: 0; allowed: not 0 (off)" in str(failed["failsafe NAV_DLL_ACT"])
        assert "+60 m above it" in str(failed["home"])
        assert "12 %; allowed: at least 45 %; charge it" in str(failed["battery"])
    finally:
        await stage.close()


async def test_a_link_that_loses_answers_is_not_good_enough() -> None:
    stage = SimulatedStage("rover", "ardupilot", allow_unsigned=True)
    try:
        await stage.run(stage.adapter.connect())
        stage.relay.ack_delay_s = 0.8

        async def walk() -> list[Check]:
            return [check async for check in stage.adapter.checklist()]

        failed = [check.what for check in await stage.run(walk()) if not check.ok]
        assert failed == ["link, round trip"]
    finally:
        await stage.close()


def command(path: Path) -> Any:
    crew = Path(sys.executable).with_name("crew")
    return subprocess.run([crew, "checklist", str(path)], capture_output=True, text=True, timeout=60, check=False)


@pytest.mark.parametrize(("alt", "code", "words"), [(488, 0, "ok   battery: 100 %"), (0, 2, "FAIL home: ")])
def test_the_command_walks_through_a_crew_file_for_real_vehicles(
    tmp_path: Path, alt: int, code: int, words: str
) -> None:
    with PacedWorld(1.0) as paced:
        path = tmp_path / "field.yaml"
        path.write_text(CREW.format(port=paced.ports["tb3"], alt=alt))
        done = command(path)
        assert not paced.truth().robots["tb3"].armed
    assert done.returncode == code, done.stdout + done.stderr
    assert words in done.stdout
    assert "Traceback" not in done.stderr
    assert (code == 0) or "the checklist is not clear: tb3: home" in done.stderr


def test_a_simulated_crew_has_nothing_to_check() -> None:
    done = command(Path("crew/crews/air_ground.yaml"))
    assert done.returncode == 2
    assert "has no real robot" in done.stderr
