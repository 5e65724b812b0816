"""One run of a skill: its permit, what it watches, how it waits. Ends by telemetry, never by an answer to a call."""

from collections.abc import Callable, Mapping
from typing import Any

from crew.adapter import Permit
from crew.adapters.unitree.robot import POLL_S, Robot
from crew.clock import SECOND_NS, seconds_ns
from crew.errors import AdapterError


class Run:
    """What a skill holds while it runs. `watch` says why the body can't go on, empty if it can."""

    def __init__(self, robot: Robot, permit: Permit, watch: Callable[[], tuple[str, str]]) -> None:
        self.robot, self.permit = robot, permit
        self.moved = False
        """Whether anything that causes motion was sent."""
        self._watch = watch

    def check(self) -> None:
        """Raise why the run is over: stopped or cancelled, robot lost, body unfit."""
        self.permit.check()
        if fault := self.robot.link_fault():
            raise AdapterError(f"{self.robot.config.robot}: {fault}", code="link_lost")
        code, why = self._watch()
        if code and not self.permit.safe:
            raise AdapterError(f"{self.robot.config.robot}: {why}", code=code)

    async def call(self, service: str, api: int, parameters: Mapping[str, Any]) -> Any:
        """A call that may cause motion, and its answer."""
        self.check()
        self.moved = True
        return await self.robot.calls.call(service, api, parameters, self.permit)

    def send(self, service: str, api: int, parameters: Mapping[str, Any]) -> None:
        """A call without an answer, as setpoints are sent."""
        self.check()
        self.moved = True
        self.robot.writer.request(service, api, parameters, self.permit, noreply=True)

    def publish(self, topic: str, body: Mapping[str, Any]) -> None:
        """A setpoint on a topic of its own."""
        self.check()
        self.moved = True
        self.robot.writer.publish(topic, body, self.permit)

    async def tick(self) -> None:
        """Wait until the next setpoint is due."""
        await self.robot.clock.sleep(POLL_S)
        self.check()

    async def until(self, done: Callable[[], bool], seconds: float, what: str, code: str) -> None:
        """Wait until telemetry shows something, for a bounded time. Raises AdapterError with the code."""
        end_ns = self.robot.clock.now_ns() + seconds_ns(seconds)
        while not done():
            if self.robot.clock.now_ns() >= end_ns:
                raise AdapterError(f"{self.robot.config.robot}: {what} not seen within {seconds:g} s", code=code)
            await self.tick()

    def since_s(self, start_ns: int) -> float:
        """Mission time that has passed."""
        return (self.robot.clock.now_ns() - start_ns) / SECOND_NS
