"""The scene of the attacks: a crew that is up, attackers' sessions, and witnesses at everybody's ears."""

import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager

import msgspec
import zenoh

from crew.access import Identity, Role, Way
from crew.bus.intruder import Intruder
from crew.bus.link import Link
from crew.home import Running
from crew.keys import Keys

INSIDERS = ("planner", "gateway", "robot-iris", "robot-tb3", "simulation", "recorder", "operator")
ATTACKERS = ("guest", *INSIDERS)
WITNESSES = ("orchestrator", "robot-tb3", "simulation", "operator")
ARRIVE_S = 10.0
SETTLE_S = 0.4
"""For declarations and samples to get to where they could get, on a loaded machine."""


class Heard(msgspec.Struct, frozen=True):
    """One sample, token or query as a witness met it."""

    witness: str
    kind: str
    key: str
    payload: bytes


class Scene:
    """Everybody's sessions. Witnesses hold the certificates of rightful readers and keep no rules of their own."""

    def __init__(self, running: Running, stack: ExitStack) -> None:
        self.running, self.keys = running, Keys(running.crew)
        self._stack = stack
        self._sessions: dict[str, zenoh.Session] = {}
        self._kept: list[object] = []
        self.heard: list[Heard] = []

    def session(self, role: str) -> zenoh.Session:
        """A session with this role's certificate and no restraint; a guest's comes over plain TCP."""
        if role not in self._sessions:
            guest = Link(role=role, endpoint=self.running.guests)
            link = guest if role == Role.GUEST else self.running.link(role)
            self._sessions[role] = self._stack.enter_context(Intruder(link)).session
        return self._sessions[role]

    def key(self, below: str) -> str:
        return f"crew/{self.running.crew}/{below}"

    def keep(self, declared: object) -> None:
        """Until the scene closes: Zenoh undeclares what is forgotten."""
        self._kept.append(declared)

    def post_witnesses(self) -> None:
        """Subscribe to all that the witnesses may hear, and to answer what they may not."""
        for role in WITNESSES:
            identity = Identity.of(self.running.crew, role)
            for key_expr in identity.hears(Way.PUT):
                self._listen(role, key_expr)
        watcher = self.session("orchestrator").liveliness()
        self.keep(
            watcher.declare_subscriber(self.key("*/alive"), lambda s: self._note("orchestrator", s), history=True)
        )

    def _listen(self, role: str, key_expr: str) -> None:
        self.keep(
            self.session(role).declare_subscriber(
                key_expr, lambda sample: self._note(role, sample), allowed_origin=zenoh.Locality.REMOTE
            )
        )

    def _note(self, role: str, sample: zenoh.Sample) -> None:
        kind = "put" if sample.kind == zenoh.SampleKind.PUT else "delete"
        self.heard.append(Heard(role, kind, str(sample.key_expr), sample.payload.to_bytes()))

    def marked(self, mark: str) -> list[Heard]:
        """What any witness met of a message with this mark, in its payload or in its key."""
        return [h for h in self.heard if mark.encode() in h.payload or mark in h.key.split("/")]

    def settle(self) -> None:
        """Wait until what could arrive has arrived."""
        time.sleep(SETTLE_S)


def arrived(look: Callable[[], Sequence[object]]) -> int:
    """Wait for what a positive control sent to be there; how much is."""
    deadline = time.monotonic() + ARRIVE_S
    while not (found := look()) and time.monotonic() < deadline:
        time.sleep(0.02)
    return len(found)


@contextmanager
def scene_of(running: Running) -> Iterator[Scene]:
    """The scene around a crew that is up."""
    with ExitStack() as stack:
        scene = Scene(running, stack)
        for role in (*ATTACKERS, *WITNESSES):
            scene.session(role)
        scene.post_witnesses()
        scene.settle()
        yield scene
