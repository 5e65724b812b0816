"""Robots without hardware: worlds, vehicles and faults."""
