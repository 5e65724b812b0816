"""Robot kinds, one file each. A kind is a declaration; adapters implement it."""
