"""Adversarial fuzz: plans and world histories that know no planner, against the real machine and the real gate."""
