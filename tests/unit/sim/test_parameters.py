"""Parameters: bounds, and both encodings."""

import struct

from crew.sim.autopilot.parameters import INT32, REAL32, Parameters, Spec

SPECS = (Spec("ACT", 3, 0, 5), Spec("SPEED", 2.0, 0.5, 5.0))


def _bits(value: int) -> float:
    return float(struct.unpack("<f", struct.pack("<i", value))[0])


def test_px4_sends_integers_as_bytes() -> None:
    parameters = Parameters(SPECS, bytewise=True)
    assert parameters.message("ACT").param_value == _bits(3)
    assert parameters.message("SPEED").param_value == 2.0
    assert parameters.set_from_wire("ACT", _bits(1), INT32)
    assert parameters["ACT"] == 1


def test_ardupilot_sends_integers_as_floats() -> None:
    parameters = Parameters(SPECS, bytewise=False)
    assert parameters.message("ACT").param_value == 3.0
    assert parameters.set_from_wire("ACT", 1.0, REAL32)
    assert parameters["ACT"] == 1


def test_bounds_are_allowed_and_beyond_them_nothing_changes() -> None:
    parameters = Parameters(SPECS, bytewise=False)
    for good in (0.5, 5.0):
        assert parameters.set_from_wire("SPEED", good, REAL32)
    for bad in (0.49, 5.01, float("nan"), float("inf")):
        assert not parameters.set_from_wire("SPEED", bad, REAL32)
    assert parameters["SPEED"] == 5.0


def test_px4_refuses_another_type_and_an_unknown_name() -> None:
    parameters = Parameters(SPECS, bytewise=True)
    assert not parameters.set_from_wire("ACT", 1.0, REAL32)
    assert not parameters.set_from_wire("NONE", 1.0, REAL32)


def test_found_by_name_or_index() -> None:
    parameters = Parameters(SPECS, bytewise=True)
    assert parameters.find("SPEED", -1) == "SPEED"
    assert parameters.find("", 0) == "ACT"
    assert parameters.find("", 2) is None
    assert parameters.find("NONE", -1) is None
