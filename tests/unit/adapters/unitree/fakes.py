"""A robot without a world: what was sent to it, and what a test lets it say."""

from collections.abc import Mapping
from typing import Any

from crew.adapters.unitree.transport import Body, Take


class FakeTransport:
    """Keeps what is published; `say` is a message of the robot."""

    def __init__(self) -> None:
        self.sent: list[tuple[str, Body]] = []
        self.reachable = True
        self._take: Take = lambda topic, body: None

    def open(self, take: Take) -> None:
        self._take = take

    def close(self) -> None:
        pass

    def publish(self, topic: str, body: Body) -> None:
        self.sent.append((topic, body))

    def say(self, topic: str, body: Mapping[str, Any]) -> None:
        self._take(topic, body)

    def requests(self) -> list[tuple[int, int]]:
        """Number and api of every request."""
        return [
            (body["header"]["identity"]["id"], body["header"]["identity"]["api_id"])
            for topic, body in self.sent
            if topic.endswith("/request")
        ]


def response(topic: str, number: int, api: int, code: int = 0, data: str = "") -> tuple[str, dict[str, Any]]:
    """A robot's answer to a call."""
    header = {"identity": {"id": number, "api_id": api}, "status": {"code": code}}
    return topic, {"header": header, "data": data, "binary": []}
