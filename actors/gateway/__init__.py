"""The gateway: people's requests, as text, JSON or msgpack, become typed messages for the orchestrator."""
