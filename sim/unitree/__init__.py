"""Robots that offer the Unitree SDK's services: bodies, inner loops, and the calls that they answer."""
