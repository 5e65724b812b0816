"""The adapter's own geofence: targets inside the area, and the vehicle itself near it."""

import math

import msgspec
import pytest

from crew.adapter import AdapterConfig
from crew.adapters.mavlink.fence import BREACH_M, check_breach
from crew.errors import AdapterError


def test_a_vehicle_far_outside_the_area_is_a_breach() -> None:
    config = AdapterConfig(robot="iris", kind="quadcopter", connection="", area=(-6, 10, -6, 10), origin=(0, 0, 0))
    check_breach(config, 10.0 + BREACH_M, 0.0)
    with pytest.raises(AdapterError, match="origin") as caught:
        check_breach(config, 10.1 + BREACH_M, 0.0)
    assert caught.value.code == "geofence_breach"
    with pytest.raises(AdapterError):
        check_breach(config, math.nan, 0.0)
    check_breach(msgspec.structs.replace(config, geofence=False), 100.0, 0.0)
