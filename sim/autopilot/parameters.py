"""An autopilot's parameters: a table with bounds, and their two encodings on the wire. Must not act on a change."""

import struct
from collections.abc import Iterable
from typing import Any, NamedTuple

from pymavlink.dialects.v20 import common as mavlink

INT32, REAL32 = mavlink.MAV_PARAM_TYPE_INT32, mavlink.MAV_PARAM_TYPE_REAL32


class Spec(NamedTuple):
    """One parameter: its default decides its type (int is INT32, float is REAL32); both bounds are allowed values."""

    name: str
    default: float
    low: float
    high: float


class Parameters:
    """Current values.

    bytewise: an INT32 travels as its four bytes in the float's place (PX4), else as a float of equal value (ArduPilot).
    """

    def __init__(self, specs: Iterable[Spec], *, bytewise: bool) -> None:
        self._specs = {spec.name: spec for spec in specs}
        self._order = tuple(self._specs)
        self._values = {name: spec.default for name, spec in self._specs.items()}
        self._bytewise = bytewise

    def __getitem__(self, name: str) -> float:
        return self._values[name]

    def __len__(self) -> int:
        return len(self._order)

    def find(self, name: str, index: int) -> str | None:
        """The name that PARAM_REQUEST_READ means: by index, or by name where index is -1."""
        if index >= 0:
            return self._order[index] if index < len(self._order) else None
        return name if name in self._values else None

    def set_from_wire(self, name: str, raw: float, kind: int) -> bool:
        """Take a PARAM_SET. False if the parameter is unknown, of another type or out of bounds: nothing changes."""
        spec = self._specs.get(name)
        if spec is None or (self._bytewise and kind != _kind(spec)):
            return False
        value = self._decode(raw, spec)
        if not spec.low <= value <= spec.high:
            return False
        self._values[name] = round(value) if isinstance(spec.default, int) else value
        return True

    def message(self, name: str) -> Any:
        """PARAM_VALUE of a known parameter."""
        spec = self._specs[name]
        return mavlink.MAVLink_param_value_message(
            name.encode(), self._encode(spec), _kind(spec), len(self._order), self._order.index(name)
        )

    def messages(self) -> list[Any]:
        return [self.message(name) for name in self._order]

    def _encode(self, spec: Spec) -> float:
        value = self._values[spec.name]
        if self._bytewise and isinstance(spec.default, int):
            return float(struct.unpack("<f", struct.pack("<i", int(value)))[0])
        return float(value)

    def _decode(self, raw: float, spec: Spec) -> float:
        if self._bytewise and isinstance(spec.default, int):
            return float(struct.unpack("<i", struct.pack("<f", raw))[0])
        return raw


def _kind(spec: Spec) -> int:
    return int(INT32 if isinstance(spec.default, int) else REAL32)
