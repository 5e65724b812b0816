"""The prover: every reachable state of a contract's missions, explored through the real gate and the real machine."""
