"""Bodies and inner loops: what a vehicle does by itself, whatever autopilot protocol it speaks."""
