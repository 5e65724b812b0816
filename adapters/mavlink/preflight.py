"""What must hold before a vehicle is set in motion: its failsafes, its health, its battery. Moves nothing."""

from crew.adapters.mavlink.flavours.flavour import Flavour
from crew.adapters.mavlink.parameter import Parameters
from crew.adapters.mavlink.telemetry import Telemetry
from crew.errors import AdapterError

HEARTBEAT_MAX_AGE_S = 3.0
POSITION_MAX_AGE_S = 2.0
HOME_MAX_AGE_S = 5.0


async def check_failsafes(flavour: Flavour, parameters: Parameters) -> None:
    """Read the failsafe parameters. Raises AdapterError `failsafe_off` naming one that is not as it must be."""
    for failsafe in flavour.failsafes:
        value = await parameters.read(failsafe.parameter)
        if not failsafe.allowed(value):
            raise AdapterError(
                f"{flavour.title}: {failsafe.parameter} is {value:g}, allowed is {failsafe.says}; "
                "set it on the vehicle before it may move",
                code="failsafe_off",
                reason=f"{failsafe.parameter}={value:g}",
            )


def link_fault(telemetry: Telemetry) -> str:
    """Why the vehicle cannot be followed any more; empty if it can."""
    if telemetry.rebooted:
        return "vehicle rebooted: reconnect"
    silent_s = telemetry.age_s(telemetry.heartbeat)
    if silent_s > HEARTBEAT_MAX_AGE_S:
        return f"link lost: no heartbeat for {silent_s:.1f} s"
    blind_s = telemetry.age_s(telemetry.motion)
    if blind_s > POSITION_MAX_AGE_S:
        return f"position lost: none for {blind_s:.1f} s"
    return ""


def fitness_fault(telemetry: Telemetry, flavour: Flavour, min_battery_percent: float) -> str:
    """Why the vehicle may not be set in motion; empty if it may."""
    if telemetry.age_s(telemetry.home) > HOME_MAX_AGE_S:
        return "no fresh home position"
    if telemetry.home_jump:
        return telemetry.home_jump
    battery = telemetry.battery_percent
    if battery is None:
        return "battery unknown"
    if battery.value < min_battery_percent:
        return f"battery at {battery.value:.0f} %, needs {min_battery_percent:.0f} %"
    if bad := bad_sensors(telemetry, flavour):
        return f"unhealthy: {', '.join(bad)}"
    critical = telemetry.heartbeat is not None and telemetry.heartbeat.value.critical
    return "the vehicle reports a critical state" if critical else ""


def bad_sensors(telemetry: Telemetry, flavour: Flavour) -> list[str]:
    """Names of the required health bits that are not good."""
    bad = telemetry.sensors_bad.value if telemetry.sensors_bad else 0
    names = [name for bit, name in flavour.sensors.items() if bad & bit]
    if bad & flavour.prearm_bit and not telemetry.armed:
        names.append("pre-arm check")
    return names
