"""Every flavour of the MAVLink adapter through the inherited suite.

With CREW_SITL=udp:PORT and CREW_SITL_HOME=lat,lon,alt a real autopilot is tested: choose its class with -k.
"""

from tests.integration.adapters.suite import QuadcopterSuite, RoverSuite, set_mode


class TestPx4Quadcopter(QuadcopterSuite):
    autopilot = "px4"
    taken = set_mode(4, 6)
    taken_mode = "AUTO.LAND"
    stop_mode = "AUTO.LOITER"


class TestArduPilotCopter(QuadcopterSuite):
    autopilot = "ardupilot"
    taken = set_mode(5)
    taken_mode = "LOITER"
    stop_mode = "BRAKE"


class TestPx4Rover(RoverSuite):
    autopilot = "px4"
    taken = set_mode(1)
    taken_mode = "MANUAL"
    stop_mode = "AUTO.LOITER"


class TestArduPilotRover(RoverSuite):
    autopilot = "ardupilot"
    taken = set_mode(0)
    taken_mode = "MANUAL"
    stop_mode = "HOLD"
