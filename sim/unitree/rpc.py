"""The SDK's remote calls as a robot answers them: api ids, codes, one lease for each service. Knows no socket.

Source: the SDK's own server and lease server (`unitree_sdk2py.rpc`): the same codes in the same order of checks.
"""

import json
from collections.abc import Callable, Mapping
from typing import Any

import msgspec

VERSION_API = 1
LEASE_APPLY, LEASE_RENEW = 101, 102
INTERNAL, NOT_IMPLEMENTED, BAD_PARAMETER = 3202, 3203, 3204
LEASE_DENIED, LEASE_NOT_EXIST, LEASE_EXISTS = 3205, 3206, 3207
LEASE_TERM_S = 1.0

Handler = Callable[[Mapping[str, Any]], tuple[int, Any]]
"""Parameters to code and data; a code other than 0 comes without data."""


class BadParameter(Exception):  # noqa: N818 - an outcome, in the words of the protocol
    """A handler's parameters are not what it takes."""


class Request(msgspec.Struct, frozen=True):
    """What a call's header and body carry."""

    id: int
    api: int
    lease: int
    noreply: bool
    parameter: str


class Lease:
    """Who may command: one client at a time, until its term runs out unrenewed."""

    def __init__(self) -> None:
        self.id = 0
        self.name = ""
        self._until_ns = 0
        self._issued = 0

    def apply(self, name: str, now_ns: int) -> tuple[int, Any]:
        if self.id and now_ns <= self._until_ns:
            return LEASE_EXISTS, None
        self._issued += 1
        self.id, self.name = self._issued, name or "anonymous"
        self._until_ns = now_ns + round(LEASE_TERM_S * 1e9)
        return 0, {"id": self.id, "term": round(LEASE_TERM_S * 1e6)}

    def renew(self, lease: int, now_ns: int) -> tuple[int, Any]:
        if not lease or lease != self.id:
            return LEASE_NOT_EXIST, None
        if now_ns > self._until_ns:
            self.id = 0
            return LEASE_NOT_EXIST, None
        self._until_ns = now_ns + round(LEASE_TERM_S * 1e9)
        return 0, None

    def denies(self, lease: int, now_ns: int) -> bool:
        """Whether a call with this lease id is refused: somebody else's lease is in force, or a lost one is shown."""
        if self.id and now_ns > self._until_ns:
            self.id = 0
            return False
        return lease != self.id


class Service:
    """One named service: its handlers by api id, those that a lease guards, and its lease."""

    def __init__(self, name: str, version: str) -> None:
        self.name, self.version = name, version
        self.lease = Lease()
        self.answers: dict[int, int] = {}
        """Codes that calls are answered with instead of being carried out, by api id: for faults."""
        self.mute = False
        """Calls are heard and never answered."""
        self._handlers: dict[int, tuple[Handler, bool]] = {}

    def offer(self, api: int, handler: Handler, *, leased: bool = True) -> None:
        """Answer an api id; `leased` calls are refused while another client holds the lease."""
        self._handlers[api] = (handler, leased)

    def call(self, request: Request, now_ns: int) -> tuple[int, str]:
        """Carry a call out; its code and data."""
        code, data = self._call(request, now_ns)
        if code or data is None:
            return code, ""
        return 0, data if isinstance(data, str) else json.dumps(data)

    def call_lease(self, request: Request, now_ns: int) -> tuple[int, str]:
        """A call of the service's lease."""
        if request.api == LEASE_APPLY:
            try:
                code, data = self.lease.apply(str(_parameters(request.parameter).get("name", "")), now_ns)
            except BadParameter:
                code, data = BAD_PARAMETER, None
        elif request.api == LEASE_RENEW:
            code, data = self.lease.renew(request.lease, now_ns)
        else:
            code, data = NOT_IMPLEMENTED, None
        return code, "" if data is None else json.dumps(data)

    def _call(self, request: Request, now_ns: int) -> tuple[int, Any]:
        if request.api == VERSION_API:
            return 0, self.version
        if request.api in self.answers:
            return self.answers[request.api], None
        handler, leased = self._handlers.get(request.api, (None, False))
        if handler is None:
            return NOT_IMPLEMENTED, None
        if leased and self.lease.denies(request.lease, now_ns):
            return LEASE_DENIED, None
        try:
            return handler(_parameters(request.parameter))
        except BadParameter:
            return BAD_PARAMETER, None
        except Exception as error:
            print(f"{self.name}: api {request.api} failed: {error!r}")
            return INTERNAL, None


class Switchboard:
    """The services of one robot, by the topics that their calls come and go on."""

    def __init__(self, services: list[Service]) -> None:
        self.services = {service.name: service for service in services}

    def take(self, topic: str, body: Mapping[str, Any], now_ns: int) -> tuple[str, dict[str, Any]] | None:
        """The response to a request and its topic; None for what needs none, or is no request of these services."""
        name = topic.removeprefix("rt/api/").removesuffix("/request")
        service = self.services.get(name.removesuffix("_lease"))
        request = read_request(body)
        if service is None or request is None or service.mute:
            return None
        asked = service.call_lease if name.endswith("_lease") else service.call
        code, data = asked(request, now_ns)
        if request.noreply:
            return None
        header = {"identity": {"id": request.id, "api_id": request.api}, "status": {"code": code}}
        return f"rt/api/{name}/response", {"header": header, "data": data, "binary": []}


def read_request(body: Mapping[str, Any]) -> Request | None:
    """A request's parts as the SDK lays them out; None if it is no request."""
    match body:
        case {
            "header": {
                "identity": {"id": int(number), "api_id": int(api)},
                "lease": {"id": int(lease)},
                "policy": {"noreply": bool(noreply)},
            },
            "parameter": str(parameter),
        }:
            return Request(number, api, lease, noreply, parameter)
    return None


def number_of(parameters: Mapping[str, Any], name: str) -> float:
    """A finite number among the parameters. Raises BadParameter."""
    value = parameters.get(name)
    if isinstance(value, bool) or not isinstance(value, int | float) or not -1e6 < value < 1e6:
        raise BadParameter(name)
    return float(value)


def _parameters(text: str) -> Mapping[str, Any]:
    try:
        found = json.loads(text) if text else {}
    except ValueError as error:
        raise BadParameter(text) from error
    if not isinstance(found, dict):
        raise BadParameter(text)
    return found
