"""Who lives in a crew: orchestrator, planner, robot, gateway."""
