"""Planners propose; they never move a robot. What they propose is judged by the orchestrator alone."""
