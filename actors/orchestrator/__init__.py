"""The orchestrator: a thin shell around the mission machine and the gate, the only actor that may actuate."""
