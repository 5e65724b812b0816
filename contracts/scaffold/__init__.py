"""A first draft of a contract, written from the skills that it shall use: valid, and provable as it stands. Pure."""
