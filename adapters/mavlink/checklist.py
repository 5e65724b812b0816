"""What a person would check before a real vehicle may be commanded. Asks and measures; sets nothing, moves nothing."""

import math
from collections.abc import AsyncIterator
from statistics import median

from pymavlink.dialects.v20 import common as mavlink

from crew.adapter import Check
from crew.adapters.mavlink.command import Command
from crew.adapters.mavlink.fence import BREACH_M
from crew.adapters.mavlink.flavours.flavour import Failsafe
from crew.adapters.mavlink.options import VehicleOptions
from crew.adapters.mavlink.preflight import HOME_MAX_AGE_S, bad_sensors
from crew.adapters.mavlink.vehicle import Vehicle, seconds_since
from crew.errors import AdapterError

HOME_AWAY_M = 100.0
HEIGHT_OFF_M = 15.0
LISTEN_S = 3.0
POSITIONS_MIN_HZ = 5.0
DAMAGED_MAX = 0.01
ROUND_TRIPS = 5
ROUND_TRIP_MAX_S = 0.3
BATTERY_SPARE_PERCENT = 30.0
"""On top of what a vehicle needs to take a skill at all."""


async def walk(vehicle: Vehicle, options: VehicleOptions) -> AsyncIterator[Check]:
    """Every item, in the order in which a person would go through them."""
    telemetry, flavour = vehicle.telemetry, vehicle.flavour
    yield Check("vehicle", True, f"{flavour.title}, system {vehicle.system}", "one that is supported")
    yield Check("disarmed", not telemetry.armed, "armed" if telemetry.armed else "disarmed", "disarmed")
    bad = bad_sensors(telemetry, flavour)
    yield Check("sensors", not bad, ", ".join(bad) or "healthy", "healthy", "see the vehicle's own messages")
    for failsafe in flavour.failsafes:
        yield await _parameter(vehicle, "failsafe", failsafe)
    for fence in flavour.fences:
        yield await _parameter(vehicle, "geofence", fence)
    yield _home(vehicle)
    yield _position(vehicle)
    yield _battery(vehicle, options)
    async for check in _link(vehicle):
        yield check
    signed = bool(options.signing_key)
    yield Check(
        "signing", signed or options.allow_unsigned, "signed" if signed else "unsigned", "signed",
        "give the vehicle and the crew file's signing_key one key, or write allow_unsigned: true for a cable",
    )  # fmt: skip


async def _parameter(vehicle: Vehicle, group: str, wanted: Failsafe) -> Check:
    what = f"{group} {wanted.parameter}"
    try:
        value = await vehicle.parameters.read(wanted.parameter)
    except AdapterError as error:
        return Check(what, False, "not told", wanted.says, str(error))
    return Check(what, wanted.allowed(value), f"{value:g}", wanted.says, "set it on the vehicle")


def _home(vehicle: Vehicle) -> Check:
    home, told = vehicle.telemetry.home, vehicle.telemetry
    if home is None or told.age_s(home) > HOME_MAX_AGE_S:
        return Check("home", False, "not told", f"told within {HOME_MAX_AGE_S:g} s", "wait for a position, set home")
    away_m = math.hypot(home.value.x_m, home.value.y_m)
    off_m = home.value.amsl_m - vehicle.config.origin[2]
    return Check(
        "home",
        away_m <= HOME_AWAY_M and abs(off_m) <= HEIGHT_OFF_M,
        f"{away_m:.0f} m from the crew's origin, {off_m:+.0f} m above it",
        f"within {HOME_AWAY_M:g} m and {HEIGHT_OFF_M:g} m of height",
        "correct the crew file's origin, or set the vehicle's home",
    )


def _position(vehicle: Vehicle) -> Check:
    motion = vehicle.telemetry.motion
    if motion is None:
        return Check("position", False, "not told", "inside the area", "wait for a position")
    x_min, x_max, y_min, y_max = vehicle.config.area
    x_m, y_m = motion.value.x_m, motion.value.y_m
    inside = x_min - BREACH_M <= x_m <= x_max + BREACH_M and y_min - BREACH_M <= y_m <= y_max + BREACH_M
    allowed = f"inside x [{x_min:g}, {x_max:g}], y [{y_min:g}, {y_max:g}]"
    return Check("position", inside, f"({x_m:.1f}, {y_m:.1f})", allowed, "carry it there, or correct origin and area")


def _battery(vehicle: Vehicle, options: VehicleOptions) -> Check:
    battery, needed = vehicle.telemetry.battery_percent, options.min_battery_percent + BATTERY_SPARE_PERCENT
    told = math.nan if battery is None else battery.value
    return Check("battery", told >= needed, f"{told:.0f} %", f"at least {needed:.0f} %", "charge it")


async def _link(vehicle: Vehicle) -> AsyncIterator[Check]:
    """Round trips of a harmless question, then some seconds of listening."""
    trips_s = []
    for _ in range(ROUND_TRIPS):
        start_ns = vehicle.clock.now_ns()
        try:
            await vehicle.commander.send(_ask_home())
        except AdapterError:
            trips_s.append(math.inf)
        else:
            trips_s.append(seconds_since(vehicle.clock, start_ns))
    trip_s = median(trips_s)
    near = "bring the ground station nearer, or free the radio's channel"
    yield Check("link, round trip", trip_s <= ROUND_TRIP_MAX_S, f"{trip_s:.2f} s", f"{ROUND_TRIP_MAX_S:g} s", near)
    counts = vehicle.link.counts
    damaged, received, positions = counts.malformed, counts.received, vehicle.telemetry.positions
    await vehicle.clock.sleep(LISTEN_S)
    rate_hz = (vehicle.telemetry.positions - positions) / LISTEN_S
    share = (counts.malformed - damaged) / max(1, counts.received - received)
    ask = "raise the stream's rate on the vehicle"
    yield Check("link, positions", rate_hz >= POSITIONS_MIN_HZ, f"{rate_hz:.1f} Hz", f"{POSITIONS_MIN_HZ:g} Hz", ask)
    yield Check("link, damaged", share <= DAMAGED_MAX, f"{share:.1%}", f"at most {DAMAGED_MAX:.0%}", near)


def _ask_home() -> Command:
    return Command(id=mavlink.MAV_CMD_REQUEST_MESSAGE, params=(float(mavlink.MAVLINK_MSG_ID_HOME_POSITION),))
