"""The only way anything leaves for the robot: one lock orders Moves, joint targets, calls and the stop.

No motion-causing message leaves after the latch is set: the check and the write happen under the same lock, and every
request carries the next number of one sequence.
"""

import json
from collections.abc import Mapping
from typing import Any

from crew.adapter import Permit, StopLatch
from crew.adapters.unitree.transport import Body, Transport
from crew.errors import Latched

HARMLESS_APIS = frozenset({1, 101, 102, 7001, 7002, 7003, 7004, 7005, 7107})
"""Calls that move nothing: versions, leases, queries."""


class Writer:
    """Safe to call from any thread; never waits for anything but the lock."""

    def __init__(self, latch: StopLatch, transport: Transport, first: int) -> None:
        self._latch, self._transport = latch, transport
        self._number = first
        self.lease = 0
        """The lease that requests show."""

    def request(
        self, service: str, api: int, parameters: Mapping[str, Any], permit: Permit | None, *, noreply: bool = False
    ) -> int:
        """Send a call; its number. Raises Latched, or the permit's reason, when it may cause motion and must not."""
        with self._latch.lock:
            if api not in HARMLESS_APIS:
                self._admit(f"{service} {api}", permit)
            return self._request(service, api, parameters, noreply)

    def publish(self, topic: str, body: Body, permit: Permit) -> None:
        """Send a motion-causing message that is no call."""
        with self._latch.lock:
            self._admit(topic, permit)
            self._transport.publish(topic, body)

    def stop_by_call(self, service: str, api: int) -> None:
        """Send the call that stops the robot: always allowed, latched or not."""
        with self._latch.lock:
            self._request(service, api, {}, True)

    def stop_by_message(self, topic: str, body: Body) -> None:
        """Send the message that stops the robot: always allowed, latched or not."""
        with self._latch.lock:
            self._transport.publish(topic, body)

    def _admit(self, what: str, permit: Permit | None) -> None:
        assert permit is not None, f"{what} may cause motion and came without a permit"
        permit.check()
        if self._latch.latched and not permit.safe:
            raise Latched(f"{what} not sent: the stop is latched; reset the robot first")

    def _request(self, service: str, api: int, parameters: Mapping[str, Any], noreply: bool) -> int:
        self._number += 1
        header = {
            "identity": {"id": self._number, "api_id": api},
            "lease": {"id": self.lease},
            "policy": {"priority": 0, "noreply": noreply},
        }
        body = {"header": header, "parameter": json.dumps(dict(parameters)), "binary": []}
        self._transport.publish(f"rt/api/{service}/request", body)
        return self._number
