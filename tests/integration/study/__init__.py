"""The study: long checks that need no robots."""
