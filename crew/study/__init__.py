"""Measurements of whole crews: many missions in simulation, tables of what came out. Decides and moves nothing."""
