"""Evaluations that tests are too short for; their results are committed in docs/study."""
