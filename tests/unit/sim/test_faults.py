"""Fault names."""

import pytest

from crew.sim.faults import Faults


def test_every_robot_has_its_own_unavailable_fault() -> None:
    assert Faults(["iris", "tb3"]).names == (
        "battery_low",
        "blocked_path",
        "gps_loss",
        "iris_unavailable",
        "link_loss",
        "missed_detection",
        "nan_transmission",
        "tb3_unavailable",
        "unmapped_obstacle",
        "wind_gusts",
    )


def test_unknown_fault_lists_the_valid_names_and_the_nearest() -> None:
    with pytest.raises(ValueError, match=r"unknown fault 'iris_unavaliable'; valid: battery_low, .*; nearest: iris_un"):
        Faults(["iris"]).set("iris_unavaliable", True)


def test_a_fault_goes_on_and_off() -> None:
    faults = Faults(["iris"], ["gps_loss"])
    assert faults.is_on("gps_loss")
    faults.set("gps_loss", False)
    assert not faults.is_on("gps_loss")


def test_a_fault_with_a_time_begins_then() -> None:
    faults = Faults(["tb3"], ["tb3_unavailable@40", "gps_loss@2.5"])
    faults.advance(2_499_999_999)
    assert not faults.is_on("gps_loss")
    faults.advance(2_500_000_000)
    assert faults.is_on("gps_loss")
    assert not faults.is_on("tb3_unavailable")
    faults.set("gps_loss", False)
    faults.advance(40_000_000_000)
    assert faults.is_on("tb3_unavailable")
    assert not faults.is_on("gps_loss"), "it begins once"


@pytest.mark.parametrize("text", ["gps_loss@", "gps_loss@soon", "gps_loss@-1", "gps_loss@nan", "gps_loss@inf"])
def test_a_time_that_is_none_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match=r"is no mission time; write gps_loss@40"):
        Faults(["iris"], [text])
