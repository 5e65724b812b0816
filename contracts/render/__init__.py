"""A contract or a kind in other forms: prose, JSON Schema, a diagram, a card. All from the same structs."""
