"""What happened physically that must not, by the simulation's truth alone: motion of a robot that is not available,
leaving the area, departure without the load, motion after a stop."""

import math
from collections.abc import Iterator, Mapping, Sequence

from crew.contracts.plan import Zone
from crew.sim.oracle import Case, Finding, Frame, Sent

MOVED_M = 0.3
"""Less is noise: swaying on legs, settling on wheels."""
OUTSIDE_M = 0.5
"""As far outside the area as a sweep's turn may carry a robot."""
STOPPED_S = 3.0
"""What a robot may take to come to rest after a stop."""


def moved(frames: Sequence[Frame]) -> tuple[str, ...]:
    """Robots that were ever more than MOVED_M from where they were at first."""
    if not frames:
        return ()
    return tuple(robot for robot in frames[0].poses if _travel_m(robot, frames) > MOVED_M)


def consequences(
    sent: Sequence[Sent],
    broken: Sequence[Finding],
    case: Case,
    area: Zone,
    frames: Sequence[Frame],
    stopped: Mapping[str, int] | None = None,
) -> tuple[Finding, ...]:
    """All of them. `broken`: what `order_broken` found. `stopped`: robot to the mission time of a stop, nanoseconds."""
    found = [*_unavailable(sent, case, frames), *_outside(area, frames), *_unloaded(sent, broken, frames)]
    return (*found, *_after_stop(stopped or {}, frames))


def _unavailable(sent: Sequence[Sent], case: Case, frames: Sequence[Frame]) -> Iterator[Finding]:
    """Motion that begins with a dispatch: a robot that brakes or lands by itself as its fault begins is none."""
    for one in sent:
        since_ns = case.unavailable.get(one.robot)
        if one.safe or since_ns is None or since_ns > one.at_ns:
            continue
        far_m = _travel_m(one.robot, _between(frames, one.at_ns, one.ended_ns))
        if far_m > MOVED_M:
            yield _finding("moved_unavailable", one, f"{one.robot} was not available and moved {far_m:.1f} m")


def _outside(area: Zone, frames: Sequence[Frame]) -> Iterator[Finding]:
    robots = frames[0].poses if frames else {}
    for robot in robots:
        for frame in frames:
            x, y, *_ = frame.poses[robot]
            beyond_m = max(area.x_min - x, x - area.x_max, area.y_min - y, y - area.y_max)
            if beyond_m > OUTSIDE_M:
                where = f"{robot} left the area at ({x:.1f}, {y:.1f})"
                yield Finding(rule="left_area", robot=robot, at_ns=frame.at_ns, text=where)
                break


def _unloaded(sent: Sequence[Sent], broken: Sequence[Finding], frames: Sequence[Frame]) -> Iterator[Finding]:
    """A robot that was to go with a load, and truly went without it."""
    without = {finding.sequence: finding for finding in broken if finding.rule == "unloaded"}
    for one in sent:
        if one.sequence in without:
            far_m = _travel_m(one.robot, _between(frames, one.at_ns, one.ended_ns))
            if far_m > MOVED_M:
                yield _finding("departed_unloaded", one, f"it went {far_m:.1f} m: {without[one.sequence].text}")


def _after_stop(stopped: Mapping[str, int], frames: Sequence[Frame]) -> Iterator[Finding]:
    for robot, at_ns in stopped.items():
        later = [frame for frame in frames if frame.at_ns >= at_ns + STOPPED_S * 1e9]
        far_m = _travel_m(robot, later, axes=2)
        if far_m > MOVED_M:
            text = f"{robot} moved {far_m:.1f} m after it was to stand still"
            yield Finding(rule="moved_after_stop", robot=robot, at_ns=later[0].at_ns, text=text)


def _between(frames: Sequence[Frame], start_ns: int, end_ns: int) -> list[Frame]:
    return [frame for frame in frames if start_ns <= frame.at_ns <= end_ns]


def _travel_m(robot: str, frames: Sequence[Frame], axes: int = 3) -> float:
    """The greatest distance of the robot or its hand from where it was at first; with two axes a landing is none."""
    if not frames:
        return 0.0
    poses = [frame.poses[robot][:axes] for frame in frames]
    hands = [frame.hands[robot][:axes] for frame in frames if robot in frame.hands]
    return max(math.dist(way[0], place) for way in (poses, hands) if way for place in way)


def _finding(rule: str, one: Sent, text: str) -> Finding:
    return Finding(rule=rule, robot=one.robot, at_ns=one.at_ns, sequence=one.sequence, text=text)
