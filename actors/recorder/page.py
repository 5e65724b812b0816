"""Draws entries with Rerun. Everything that is drawn goes through here, live or from a journal."""

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import rerun as rr
from numpy.typing import NDArray

from crew.actors.recorder import blueprint
from crew.actors.recorder.blueprint import CONTRACT, LANES, LOG, PROPOSAL, TIMELINE, colours
from crew.actors.recorder.colour import TONES
from crew.actors.recorder.entry import (
    Area,
    Document,
    Entry,
    Graph,
    LaneChange,
    LogLine,
    Mark,
    Measure,
    Stamp,
    Whereabouts,
)
from crew.actors.recorder.lane import MISSION_LANE, lanes
from crew.actors.recorder.scene import Scene
from crew.contracts.site import Rules
from crew.messages import SimImage, SimScene, SimTruth

FLUSH_S = 0.2
"""What a killed recorder may lose is what it has not written for so long."""
SERVE_LIMIT = "256MiB"
LINGER, LINGER_NS = 0.05, 2_000_000_000
"""How long the last states are shown beyond the end: a part of the run, and at least so long."""


class Page:
    """One recording. Used by one thread; `close` must be called for a file that is whole."""

    def __init__(
        self,
        rules: Rules,
        run: str,
        path: Path,
        *,
        scene: SimScene | None = None,
        port: int = 0,
        facts: Mapping[str, str] = {},
    ) -> None:
        self._rules = rules
        self._recording = rr.RecordingStream(
            f"crew run {run}", recording_id=run, batcher_config=rr.ChunkBatcherConfig(flush_tick=FLUSH_S)
        )
        self._recording.set_log_time_enabled(False)
        self._recording.set_log_tick_enabled(False)
        self._lanes = lanes(rules)
        self._mission_lanes = {MISSION_LANE}
        self._changed: set[str] = set()
        self._begin_ns = self._end_ns = self._lane_ns = 0
        sinks: list[Any] = [rr.FileSink(path)]
        if port:
            sinks.append(rr.GrpcServerSink("127.0.0.1", port, server_memory_limit=SERVE_LIMIT))
        cameras = () if scene is None else scene.cameras
        self._recording.set_sinks(*sinks, default_blueprint=blueprint.page(rules, cameras))
        self._scene = Scene(self._recording, rules)
        self._preamble(run, facts)
        if scene is not None:
            self._scene.shapes(scene)

    def write(self, stamp: Stamp, entry: Entry) -> None:
        """Draw one entry at its time."""
        self._note_time(stamp.at_ns, entry)
        self._at(stamp.at_ns)
        match entry:
            case LaneChange(lane=lane, state=state):
                self._lane(stamp.at_ns, lane, state)
            case LogLine(text=text, tone=tone, level=level):
                self._recording.log(LOG, rr.TextLog(text, level=level, color=TONES[tone]))
            case Document(markdown=markdown):
                self._recording.log(PROPOSAL, rr.TextDocument(markdown, media_type="text/markdown"))
            case Graph():
                self._graph(entry)
            case Measure(series=series, value=value):
                self._recording.log(series, rr.Scalars(value))
            case Mark():
                self._scene.mark(entry)
            case Area():
                self._scene.area(entry)
            case Whereabouts():
                self._scene.whereabouts(stamp.at_ns, entry)

    def truth(self, truth: SimTruth) -> None:
        """Where everything in the simulated world is; written with the next `flush`."""
        self._end_ns = max(self._end_ns, truth.at_ns)
        self._scene.truth(truth)

    def image(self, image: SimImage) -> None:
        """One frame of a camera."""
        self._at(image.at_ns)
        self._scene.image(image)

    def flush(self) -> None:
        """Hand everything on to the file and to whoever watches."""
        self._scene.write()
        self._recording.flush(timeout_sec=5.0)

    def close(self, closing: str = "") -> None:
        """End the file with its index. The last states are shown a little longer, or nobody would see them."""
        self._scene.write()
        self._at(self._end_ns + round(max(LINGER_NS, LINGER * (self._end_ns - self._begin_ns))))
        for lane in self._changed:
            self._recording.log(f"{LANES}/{lane}", rr.StateChange(state=""))
        self._recording.send_property("end", rr.AnyValues(how=closing or "finished"))
        self._recording.flush(timeout_sec=5.0)
        self._recording.disconnect()

    # --- what is there from the start

    def _preamble(self, run: str, facts: Mapping[str, str]) -> None:
        self._recording.send_recording_name(run)
        self._recording.send_property("run", rr.AnyValues(drop_untyped_nones=True, **facts))
        self._at(0)
        for lane, states in self._lanes.items():
            self._configure(lane, states)
            self._recording.log(f"{LANES}/{lane}", rr.StateChange(state=""))
        for robot, colour in colours(self._rules).items():
            for curve in blueprint.CURVES:
                style = rr.SeriesPoints if curve == "latency" else rr.SeriesLines
                self._recording.log(f"{curve}/{robot}", style(colors=colour, names=robot), static=True)
        self._scene.site()

    def _configure(self, lane: str, states: Mapping[str, str]) -> None:
        values = list(states)
        shades = _shades(states.values())
        self._recording.log(
            f"{LANES}/{lane}", rr.StateConfiguration(values=values, labels=values, colors=shades), static=True
        )

    # --- entries

    def _lane(self, at_ns: int, lane: str, state: str) -> None:
        """Lanes never go back in time, though a robot's own word may come later than what a mission knew."""
        self._lane_ns = max(self._lane_ns, at_ns)
        self._at(self._lane_ns)
        self._changed.add(lane)
        if lane.startswith(MISSION_LANE) and lane not in self._mission_lanes:
            self._mission_lanes.add(lane)
            self._configure(lane, self._lanes[MISSION_LANE])
        self._recording.log(f"{LANES}/{lane}", rr.StateChange(state=state))

    def _graph(self, graph: Graph) -> None:
        path = f"{CONTRACT}/{graph.slot}"
        self._recording.log(
            path,
            rr.GraphNodes(
                [node.name for node in graph.nodes],
                positions=[(node.x, node.y) for node in graph.nodes],
                labels=[node.label for node in graph.nodes],
                colors=_shades(node.tone for node in graph.nodes),
                show_labels=True,
            ),
            rr.GraphEdges(list(graph.edges), graph_type="directed"),
        )

    def _note_time(self, at_ns: int, entry: Entry) -> None:
        """A run's page begins with its first mission, however long the crew had been waiting for it."""
        if not self._begin_ns and isinstance(entry, LaneChange) and entry.lane == MISSION_LANE:
            self._begin_ns = at_ns
        self._end_ns = max(self._end_ns, at_ns)

    def _at(self, at_ns: int) -> None:
        self._recording.set_time(TIMELINE, duration=np.timedelta64(at_ns, "ns"))


def _shades(tones: Iterable[str]) -> NDArray[np.uint32]:
    return np.array([TONES[tone] for tone in tones], dtype=np.uint32)
