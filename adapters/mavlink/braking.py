"""Coming to rest: brake and confirm by telemetry that the vehicle stands nearly still."""

from crew.adapters.mavlink.run import Run
from crew.errors import AdapterError

BRAKE_S = 15.0


async def brake(run: Run, still_mps: float) -> None:
    """Send the flavour's stop and return once the vehicle is slower than `still_mps`.

    Raises AdapterError `still_moving` after 15 s of mission time: treat the vehicle as still moving.
    """
    vehicle = run.vehicle
    start_ns = vehicle.clock.now_ns()
    await run.command(*vehicle.flavour.stops, leads_to=frozenset({vehicle.flavour.stop_mode}))

    def still() -> bool:
        motion = vehicle.telemetry.motion
        return motion is not None and motion.stamp_ns > start_ns and motion.value.speed_mps < still_mps

    await run.hold(BRAKE_S, over=still)
    if not still():
        motion = vehicle.telemetry.motion
        speed = f"{motion.value.speed_mps:.2f} m/s" if motion else "unknown"
        raise AdapterError(
            f"{vehicle.config.robot}: speed is {speed} {BRAKE_S:g} s after the stop, allowed is {still_mps:g} m/s; "
            "treat it as still moving",
            code="still_moving",
        )
