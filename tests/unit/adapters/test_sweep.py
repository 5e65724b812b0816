"""The sweep shows every point of any zone to the camera and never leaves the zone."""

from hypothesis import given, settings
from hypothesis import strategies as st

from crew.adapters.ground.occupancy import distance_to_segment_m
from crew.adapters.mavlink.sweep import Sweep, Zone, path_length_m, plan_sweep

AREA = Zone(-6.0, 10.0, -6.0, 10.0)
sizes = st.floats(0.0, 40.0)
footprints = st.floats(2.0, 12.0)
shares = st.floats(0.0, 1.0)


def seen(sweep: Sweep, x: float, y: float, along_m: float, across_m: float) -> bool:
    """Whether some point of the path has (x, y) within its level footprint."""
    east = sweep.heading_rad > 1.0
    reach_x, reach_y = (along_m / 2, across_m / 2) if east else (across_m / 2, along_m / 2)
    ends = zip(sweep.points, sweep.points[1:] or sweep.points, strict=False)
    for (ax, ay), (bx, by) in ends:
        scaled = ((x / reach_x, y / reach_y), (ax / reach_x, ay / reach_y), (bx / reach_x, by / reach_y))
        steps = [(scaled[1][0] + t / 200 * (scaled[2][0] - scaled[1][0])) for t in range(201)]
        rises = [(scaled[1][1] + t / 200 * (scaled[2][1] - scaled[1][1])) for t in range(201)]
        if any(
            max(abs(scaled[0][0] - u), abs(scaled[0][1] - v)) <= 1.0 + 1e-9 for u, v in zip(steps, rises, strict=True)
        ):
            return True
    return False


@settings(max_examples=40, deadline=None)
@given(sizes, sizes, footprints, footprints, st.floats(0.0, 0.9), shares, shares)
def test_every_point_of_the_zone_is_seen(
    width: float, depth: float, along: float, across: float, overlap: float, u: float, v: float
) -> None:
    zone = Zone(-3.0, -3.0 + width, 2.0, 2.0 + depth)
    sweep = plan_sweep(zone, along, across, overlap, (0.0, 0.0))
    assert seen(sweep, zone.x_min + u * width, zone.y_min + v * depth, along, across)


@given(sizes, sizes, footprints, footprints, st.floats(0.0, 0.9))
def test_way_points_stay_within_the_zone(width: float, depth: float, along: float, across: float, lap: float) -> None:
    zone = Zone(-3.0, -3.0 + width, 2.0, 2.0 + depth)
    for x, y in plan_sweep(zone, along, across, lap, (50.0, -50.0)).points:
        assert zone.beyond_m(x, y) == 0.0


def test_it_begins_at_the_corner_nearest_to_the_start() -> None:
    for start in ((-6.0, -6.0), (10.0, -6.0), (-6.0, 10.0), (10.0, 10.0)):
        first = plan_sweep(AREA, 6.0, 8.0, 0.5, start).points[0]
        distance = distance_to_segment_m(start, first, first)
        assert distance < 6.0


def test_a_zone_smaller_than_the_footprint_is_one_point() -> None:
    assert plan_sweep(Zone(0.0, 1.0, 0.0, 1.0), 6.0, 8.0, 0.5, (5.0, 5.0)).points == ((0.5, 0.5),)


def test_more_overlap_is_a_longer_way() -> None:
    lengths = [path_length_m(plan_sweep(AREA, 6.0, 8.0, lap, (0.0, 0.0)).points) for lap in (0.2, 0.5, 0.8)]
    assert lengths == sorted(lengths)
