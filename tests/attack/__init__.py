"""The attack suite: whoever holds no right, on every key, against a crew that is up. `python -m tests.attack`."""
