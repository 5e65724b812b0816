"""The scene `apartment`: a humanoid at a table, a quadruped with a tray, rooms with doorways, and a person who asks."""
