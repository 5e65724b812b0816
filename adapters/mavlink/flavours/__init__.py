"""What differs between autopilots: one file for each autopilot and kind of vehicle, and a table to choose from."""
