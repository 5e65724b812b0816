"""The gate: what stands between a proposal and a robot. Pure."""
