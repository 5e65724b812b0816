"""Fault names."""

import pytest

from crew.sim.faults import Faults


def test_every_robot_has_its_own_unavailable_fault() -> None:
    assert Faults(["iris", "tb3"]).names == (
        "battery_low",
        "gps_loss",
        "iris_unavailable",
        "link_loss",
        "missed_detection",
        "nan_transmission",
        "tb3_unavailable",
    )


def test_unknown_fault_lists_the_valid_names_and_the_nearest() -> None:
    with pytest.raises(ValueError, match=r"unknown fault 'iris_unavaliable'; valid: battery_low, .*; nearest: iris_un"):
        Faults(["iris"]).set("iris_unavaliable", True)


def test_a_fault_goes_on_and_off() -> None:
    faults = Faults(["iris"], ["gps_loss"])
    assert faults.is_on("gps_loss")
    faults.set("gps_loss", False)
    assert not faults.is_on("gps_loss")
