"""A signed link end to end: the vehicle's side checks by the protocol library, ours by our own parser."""

from pathlib import Path

import pytest

from crew.adapter import AdapterConfig
from crew.adapters.mavlink.adapter import MavlinkAdapter
from crew.clock import SimClock
from crew.contracts.kinds.quadcopter import Land, Takeoff
from crew.errors import AdapterError
from tests.integration.adapters.stage import SimulatedStage
from tests.integration.adapters.suite import set_mode

KEY = bytes(range(32))


async def test_a_signed_vehicle_obeys_the_key_and_nobody_else(tmp_path: Path) -> None:
    file = tmp_path / "key"
    file.write_text(KEY.hex())
    file.chmod(0o600)
    stage = SimulatedStage("quadcopter", "px4", signing_keys={"iris": KEY}, signing_key=str(file))
    try:
        await stage.run(stage.adapter.connect())
        await stage.run(stage.adapter.execute("takeoff", Takeoff(altitude=3), {}))
        stage.relay.as_station(set_mode(4, 6))
        await stage.advance(1.5)
        assert stage.adapter._vehicle.mode() == "AUTO.LOITER", "an unsigned station commands nothing"
        forged = stage.adapter._counts.malformed
        stage.relay.as_vehicle(set_mode(4, 6), 1)
        await stage.advance(0.1)
        assert stage.adapter._counts.malformed == forged + 1
        await stage.run(stage.adapter.execute("land", Land(), {}))
    finally:
        await stage.close()


async def test_a_vehicle_that_does_not_sign_is_not_found_on_a_signed_link(tmp_path: Path) -> None:
    file = tmp_path / "key"
    file.write_text(KEY.hex())
    file.chmod(0o600)
    stage = SimulatedStage("rover", "ardupilot", signing_key=str(file), connect_timeout_s=2.0)
    try:
        with pytest.raises(AdapterError, match=r"no heartbeat of a rover.*[1-9]\d* unsigned or wrongly signed"):
            await stage.run(stage.adapter.connect())
    finally:
        await stage.close()


def test_a_key_that_cannot_be_read_is_refused_before_anything_is_opened(tmp_path: Path) -> None:
    config = AdapterConfig(
        robot="iris", kind="quadcopter", connection="udpin:127.0.0.1:14550", area=(0, 1, 0, 1), origin=(47, 8, 0),
        options={"signing_key": str(tmp_path / "none")},
    )  # fmt: skip
    with pytest.raises(AdapterError, match="iris: signing_key: cannot read"):
        MavlinkAdapter(config, SimClock())
