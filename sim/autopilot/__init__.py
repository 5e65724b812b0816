"""Autopilots: the vendor-facing side of a simulated vehicle. MAVLink stays inside this package."""
