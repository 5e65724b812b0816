"""Vehicles that speak MAVLink 2: one adapter, a flavour file for each autopilot and kind of vehicle."""
