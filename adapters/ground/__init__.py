"""Ways over the ground, for whatever drives or walks: what is occupied, and how to get around it."""
