"""Robots that speak the Unitree SDK: a quadruped that walks, a humanoid's arm; over a socket or over DDS."""
