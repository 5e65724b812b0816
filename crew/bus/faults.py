"""What a fabric in memory does to samples on purpose. No threads here: the fabric holds its lock around each call."""

from dataclasses import dataclass, field
from enum import StrEnum

from crew.bus.keyexpr import checked_key_expr, intersects
from crew.bus.port import Sample


class FaultKind(StrEnum):
    DROP = "drop"
    DUPLICATE = "duplicate"
    REORDER = "reorder"


@dataclass(eq=False)
class _Fault:
    kind: FaultKind
    key_expr: str
    remaining: int
    held: list[Sample] = field(default_factory=list)


class Faults:
    """The faults still to come, each used up by samples whose key intersects its expression."""

    def __init__(self) -> None:
        self._faults: list[_Fault] = []
        self._delays_s: dict[str, float] = {}

    def add(self, kind: FaultKind, key_expr: str, count: int) -> None:
        if count > 0:
            self._faults.append(_Fault(kind, checked_key_expr(key_expr), count))

    def delay(self, key_expr: str, seconds: float) -> None:
        self._delays_s[checked_key_expr(key_expr)] = seconds

    def delay_s(self, key: str) -> float:
        return max((seconds for expr, seconds in self._delays_s.items() if intersects(expr, key)), default=0.0)

    def dropped(self, key: str) -> bool:
        """Whether what goes to `key` now is lost; uses up one fault if so."""
        return self._take(FaultKind.DROP, key) is not None

    def applied(self, sample: Sample) -> list[Sample]:
        """What is delivered now in place of `sample`."""
        if self.dropped(sample.key):
            return []
        if (fault := self._take(FaultKind.REORDER, sample.key)) is not None:
            fault.held.insert(0, sample)
            return fault.held if fault.remaining == 0 else []
        return [sample, sample] if self._take(FaultKind.DUPLICATE, sample.key) is not None else [sample]

    def _take(self, kind: FaultKind, key: str) -> _Fault | None:
        for fault in self._faults:
            if fault.kind == kind and intersects(fault.key_expr, key):
                fault.remaining -= 1
                if fault.remaining == 0:
                    self._faults.remove(fault)
                return fault
        return None
