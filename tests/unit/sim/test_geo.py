"""Flat earth: both ways, and against a known length of a degree."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from crew.sim.geo import GeoFrame, enu_yaw_to_heading_rad, wrap_rad
from crew.sim.map import Origin

FRAME = GeoFrame(Origin(lat_deg=47.4, lon_deg=8.5, alt_m=488.0))
METRES = st.floats(-1000, 1000)


@given(METRES, METRES)
def test_there_and_back_is_the_same_place(x_m: float, y_m: float) -> None:
    assert FRAME.to_world(*FRAME.to_geo(x_m, y_m)) == pytest.approx((x_m, y_m), abs=1e-6)


def test_north_raises_latitude_and_east_longitude() -> None:
    lat, lon = FRAME.to_geo(100.0, 200.0)
    assert (lat - 47.4) * 111_319.49 == pytest.approx(200.0, rel=1e-5)
    assert (lon - 8.5) * 111_319.49 * math.cos(math.radians(47.4)) == pytest.approx(100.0, rel=1e-5)


@pytest.mark.parametrize(("yaw_deg", "heading_deg"), [(0, 90), (90, 0), (180, -90), (-90, 180), (45, 45)])
def test_heading_is_clockwise_from_north(yaw_deg: float, heading_deg: float) -> None:
    heading = enu_yaw_to_heading_rad(math.radians(yaw_deg))
    assert abs(wrap_rad(heading - math.radians(heading_deg))) < 1e-9
