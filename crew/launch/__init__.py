"""Brings a crew up and down: the process table, ports, folders, and the round trip that means ready."""
