"""The page's layout. It is stored in the recording, so that any viewer shows it."""

from collections.abc import Sequence
from typing import Any

import rerun as rr
import rerun.blueprint as rrb

from crew.actors.recorder.colour import robot_colour
from crew.contracts.site import Rules

TIMELINE = "mission"
SCENE, LANES, LOG, PROPOSAL, CONTRACT, CAMERA = "world", "lane", "log", "proposal", "contract", "camera"
CURVES = {"battery": "Battery, percent", "age": "Age of state, s", "latency": "Decision to accepted, ms"}


def page(rules: Rules, cameras: Sequence[str]) -> rrb.Blueprint:
    """The layout; lanes and curves show the whole run, however long it has become."""
    whole = rr.TimeRange(start=rr.TimeRangeBoundary.infinite(), end=rr.TimeRangeBoundary.infinite())
    axis = rrb.TimeAxis(view_range=whole)
    told = rrb.Vertical(
        rrb.TextDocumentView(origin=PROPOSAL, name="Proposal"),
        rrb.GraphView(origin=CONTRACT, name="Contract"),
        row_shares=[2, 1],
    )
    seen = [rrb.Spatial2DView(origin=f"{CAMERA}/{robot}", name=f"Camera of {robot}") for robot in cameras]
    decided = rrb.TextLogView(
        origin=LOG,
        name="Decisions",
        columns=rrb.TextLogColumns(timeline_columns=[TIMELINE], text_log_columns=["LogLevel", "Body"]),
    )
    heard = rrb.Vertical(decided, rrb.Tabs(*seen), row_shares=[3, 2]) if seen else decided
    return rrb.Blueprint(
        rrb.Vertical(
            rrb.Horizontal(_scene(rules), told, heard, column_shares=[9, 8, 9]),
            rrb.StateTimelineView(origin=LANES, name="Who does what, and what is held", time_view=axis),
            rrb.Horizontal(
                *(rrb.TimeSeriesView(origin=curve, name=name, axis_x=axis) for curve, name in CURVES.items())
            ),
            row_shares=[11, 4, 3],
        ),
        rrb.TimePanel(timeline=TIMELINE, state="collapsed", play_state="following"),
        rrb.SelectionPanel(state="hidden"),
        rrb.BlueprintPanel(state="hidden"),
        auto_views=False,
        auto_layout=False,
    )


def _scene(rules: Rules) -> rrb.Spatial3DView:
    area = rules.crew.area
    x, y = (area.x_min + area.x_max) / 2, (area.y_min + area.y_max) / 2
    reach = max(area.x_max - area.x_min, area.y_max - area.y_min, 4.0)
    past = rrb.VisibleTimeRange(
        TIMELINE, start=rr.TimeRangeBoundary.infinite(), end=rr.TimeRangeBoundary.cursor_relative()
    )
    trails: Any = {f"/{SCENE}/trail/{spec.name}": rrb.VisibleTimeRanges([past]) for spec in rules.crew.robots}
    return rrb.Spatial3DView(
        origin=SCENE,
        name="World",
        overrides=trails,
        background=rrb.Background(color=[18, 22, 27]),
        line_grid=rrb.LineGrid3D(visible=False),
        eye_controls=rrb.EyeControls3D(
            position=(x - 0.1 * reach, y - 1.15 * reach, 1.0 * reach), look_target=(x, y - 0.05 * reach, 0.0)
        ),
    )


def colours(rules: Rules) -> dict[str, int]:
    """Each robot's colour."""
    return {spec.name: robot_colour(number) for number, spec in enumerate(rules.crew.robots)}
