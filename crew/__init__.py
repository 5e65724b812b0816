"""crew: command a crew of robots in plain language; no language model ever moves one."""
