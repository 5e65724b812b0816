"""What a person asked for, read deterministically, and the check that a plan holds exactly that. No I/O, no model."""
