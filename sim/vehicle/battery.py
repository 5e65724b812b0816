"""A battery that drains with use. Must not decide what follows from a low charge: that is the autopilot's."""


class Battery:
    """Charge as a fraction of full. capacity_j: energy when full; cells: lithium cells in series."""

    def __init__(self, capacity_j: float, cells: int) -> None:
        self.capacity_j = capacity_j
        self.cells = cells
        self.fraction = 1.0
        self.power_w = 0.0

    def drain(self, power_w: float, step_s: float) -> None:
        self.power_w = power_w
        self.fraction = max(0.0, self.fraction - power_w * step_s / self.capacity_j)

    @property
    def voltage_v(self) -> float:
        return self.cells * (3.5 + 0.7 * self.fraction)

    @property
    def current_a(self) -> float:
        return self.power_w / self.voltage_v

    @property
    def percent(self) -> int:
        return round(100.0 * self.fraction)
