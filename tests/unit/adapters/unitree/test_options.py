"""The options of a crew file, and connections: a mistake is named with what is allowed."""

import pytest

from crew.adapter import AdapterConfig
from crew.adapters.options import read_options
from crew.adapters.unitree.adapter import UnitreeAdapter
from crew.adapters.unitree.datagrams import parse_address
from crew.adapters.unitree.options import ManipulatorOptions, WalkerOptions
from crew.clock import SimClock
from crew.errors import AdapterError


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"cruise": 1}, r"go2: no option 'cruise'; did you mean 'cruise_mps'"),
        ({"cruise_mps": 0}, "cruise_mps"),
        ({"backend": "dds"}, "backend"),
        ({"berths": {"pickup": {"heading_deg": 0}}}, "enter_from"),
    ],
)
def test_a_wrong_option_is_named(given: dict[str, object], message: str) -> None:
    with pytest.raises(AdapterError, match=message):
        read_options("go2", given, WalkerOptions)


def test_where_a_humanoid_stands_must_be_said() -> None:
    with pytest.raises(AdapterError, match="stands_at"):
        read_options("g1", {}, ManipulatorOptions)


@pytest.mark.parametrize("text", ["", "udp:127.0.0.1:5", "udpin:127.0.0.1:x", "udpin::7", "udpin:127.0.0.1:70000"])
def test_a_wrong_connection_is_refused(text: str) -> None:
    with pytest.raises(AdapterError, match="write udpin:HOST:PORT"):
        parse_address(text)


def test_another_kind_is_refused() -> None:
    config = AdapterConfig(robot="x", kind="rover", connection="", area=(0, 1, 0, 1), origin=(0, 0, 0))
    with pytest.raises(AdapterError, match=r"no kind 'rover'.*humanoid, quadruped"):
        UnitreeAdapter(config, SimClock())
