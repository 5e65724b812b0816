"""The mission machine and what it is fed with: validation, effects, judgements. Pure."""
