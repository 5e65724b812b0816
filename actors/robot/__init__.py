"""The robot actor: one robot, one adapter, one latch."""
