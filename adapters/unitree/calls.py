"""The SDK's remote calls over a writer: a deadline on each, and its codes as errors that say what to do."""

import asyncio
import json
from collections.abc import Mapping
from typing import Any

from crew.adapter import Permit
from crew.adapters.unitree.transport import Body, Transport
from crew.adapters.unitree.writer import Writer
from crew.clock import Clock, within
from crew.errors import AdapterError

NO_SERVER, TIMEOUT, NOT_MATCHING, BAD_DATA = 3102, 3104, 3105, 3106
LEASE_DENIED, LEASE_NOT_EXIST, LEASE_EXISTS = 3205, 3206, 3207
MEANING = {
    NO_SERVER: "no server: nobody was heard on this link; is the robot on, and on this network and domain?",
    TIMEOUT: "no answer in time; does the robot offer this service?",
    NOT_MATCHING: "the answer belongs to another call",
    BAD_DATA: "the answer can't be read",
    3201: "the robot could not send its answer",
    3202: "the robot's server failed",
    3203: "not implemented: the robot's firmware does not know this call",
    3204: "the robot does not take these parameters",
    LEASE_DENIED: "lease denied: another client holds the service; end it, or wait until its lease runs out",
    LEASE_NOT_EXIST: "the lease is not known any more",
    LEASE_EXISTS: "lease exists: another client holds the service; end it, or wait until its lease runs out",
    7400: "the arm is being commanded on rt/arm_sdk",
    7402: "no such action",
    7404: "not in a state that allows it",
}


class CallError(AdapterError):
    """A call that was not carried out; `number` is the SDK's own code."""

    def __init__(self, what: str, number: int) -> None:
        super().__init__(f"{what} failed with {number}: {MEANING.get(number, 'unknown code')}", code=f"sdk_{number}")
        self.number = number


class Calls:
    """Requests that wait for their responses. `take` gets every response that came in."""

    def __init__(self, robot: str, clock: Clock, writer: Writer, transport: Transport, timeout_s: float) -> None:
        self._robot, self._clock, self._writer, self._transport = robot, clock, writer, transport
        self._timeout_s = timeout_s
        self._waiting: dict[tuple[str, int], asyncio.Future[Body]] = {}

    async def call(self, service: str, api: int, parameters: Mapping[str, Any], permit: Permit | None = None) -> Any:
        """The response's data, read as JSON where it is. Raises CallError with the SDK's code."""
        what = f"{self._robot}: {service} {api}"
        if not self._transport.reachable:
            raise CallError(what, NO_SERVER)
        number = self._writer.request(service, api, parameters, permit)
        future: asyncio.Future[Body] = asyncio.get_running_loop().create_future()
        self._waiting[(service, number)] = future
        try:
            body = await within(self._clock, self._timeout_s, future)
        except TimeoutError:
            raise CallError(what, TIMEOUT) from None
        finally:
            del self._waiting[(service, number)]
        return _data(what, api, body)

    def take(self, topic: str, body: Body) -> bool:
        """Hand a response to who waits for it; whether the topic is one of a response at all."""
        if not (topic.startswith("rt/api/") and topic.endswith("/response")):
            return False
        service = topic.removeprefix("rt/api/").removesuffix("/response")
        match body:
            case {"header": {"identity": {"id": int(number)}}}:
                future = self._waiting.get((service, number))
                if future is not None and not future.done():
                    future.set_result(body)
        return True


def _data(what: str, api: int, body: Body) -> Any:
    match body:
        case {"header": {"identity": {"api_id": int(answered)}, "status": {"code": int(code)}}, "data": str(data)}:
            if code or answered != api:
                raise CallError(what, code or NOT_MATCHING)
            try:
                return json.loads(data) if data[:1] in ("{", "[", '"') else data
            except ValueError:
                raise CallError(what, BAD_DATA) from None
    raise CallError(what, BAD_DATA)
