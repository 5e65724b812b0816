"""The SDK's calls as a simulated robot answers them: the same codes as the real server, in the same order of checks."""

import json
from typing import Any

import pytest

from crew.sim.unitree.rpc import (
    BAD_PARAMETER,
    INTERNAL,
    LEASE_APPLY,
    LEASE_DENIED,
    LEASE_EXISTS,
    LEASE_NOT_EXIST,
    LEASE_RENEW,
    NOT_IMPLEMENTED,
    Service,
    Switchboard,
    number_of,
)

SECOND_NS = 10**9
MOVE, STOP, BREAK = 1008, 1003, 1666


class Client:
    """One client of a robot whose service remembers what it was told."""

    def __init__(self, switchboard: Switchboard, lease: int = 0) -> None:
        self._switchboard, self.lease = switchboard, lease

    def call(
        self, api: int, parameter: str = "{}", *, service: str = "sport", now_s: float = 0.0, noreply: bool = False
    ) -> tuple[int, str] | None:
        header = {
            "identity": {"id": 7, "api_id": api},
            "lease": {"id": self.lease},
            "policy": {"priority": 0, "noreply": noreply},
        }
        body: dict[str, Any] = {"header": header, "parameter": parameter, "binary": []}
        answer = self._switchboard.take(f"rt/api/{service}/request", body, round(now_s * SECOND_NS))
        if answer is None:
            return None
        topic, response = answer
        assert topic == f"rt/api/{service}/response"
        assert response["header"]["identity"] == {"id": 7, "api_id": api}
        return response["header"]["status"]["code"], response["data"]

    def apply(self, now_s: float = 0.0) -> int:
        answer = self.call(LEASE_APPLY, '{"name": "me"}', service="sport_lease", now_s=now_s)
        assert answer is not None
        code, data = answer
        if not code:
            self.lease = json.loads(data)["id"]
        return code


@pytest.fixture
def told() -> list[float]:
    return []


@pytest.fixture
def switchboard(told: list[float]) -> Switchboard:
    sport = Service("sport", "1.0.0.1")

    def move(parameters: Any) -> tuple[int, Any]:
        told.append(number_of(parameters, "x"))
        return 0, None

    def fail(_: Any) -> tuple[int, Any]:
        raise RuntimeError("worn out")

    sport.offer(MOVE, move)
    sport.offer(STOP, lambda _: (0, {"stopped": True}), leased=False)
    sport.offer(BREAK, fail)
    return Switchboard([sport])


def test_calls_are_carried_out_and_answered(switchboard: Switchboard, told: list[float]) -> None:
    client = Client(switchboard)
    assert client.call(1) == (0, "1.0.0.1")
    assert client.call(MOVE, '{"x": 0.5}') == (0, "")
    assert client.call(STOP) == (0, '{"stopped": true}')
    assert told == [0.5]


def test_a_call_without_reply_is_carried_out_silently(switchboard: Switchboard, told: list[float]) -> None:
    assert Client(switchboard).call(MOVE, '{"x": 0.5}', noreply=True) is None
    assert told == [0.5]


@pytest.mark.parametrize(
    ("api", "parameter", "code"),
    [
        (1999, "{}", NOT_IMPLEMENTED),
        (MOVE, "not json", BAD_PARAMETER),
        (MOVE, "[]", BAD_PARAMETER),
        (MOVE, "{}", BAD_PARAMETER),
        (MOVE, '{"x": "fast"}', BAD_PARAMETER),
        (MOVE, '{"x": NaN}', BAD_PARAMETER),
        (MOVE, '{"x": 1e9}', BAD_PARAMETER),
        (MOVE, '{"x": true}', BAD_PARAMETER),
        (BREAK, "{}", INTERNAL),
    ],
)
def test_bad_calls_get_the_codes_of_the_real_server(
    switchboard: Switchboard, told: list[float], api: int, parameter: str, code: int
) -> None:
    assert Client(switchboard).call(api, parameter) == (code, "")
    assert told == []


def test_one_client_at_a_time_holds_the_lease(switchboard: Switchboard, told: list[float]) -> None:
    ours, theirs = Client(switchboard), Client(switchboard)
    assert ours.apply() == 0
    assert theirs.apply(0.5) == LEASE_EXISTS
    assert theirs.call(MOVE, '{"x": 1}', now_s=0.5) == (LEASE_DENIED, "")
    assert theirs.call(STOP, now_s=0.5) == (0, '{"stopped": true}'), "stopping needs no lease"
    assert ours.call(MOVE, '{"x": 2}', now_s=0.5) == (0, "")
    assert told == [2.0]


def test_a_lease_that_is_not_renewed_runs_out(switchboard: Switchboard, told: list[float]) -> None:
    ours, theirs = Client(switchboard), Client(switchboard)
    assert ours.apply() == 0
    assert ours.call(LEASE_RENEW, service="sport_lease", now_s=0.9) == (0, "")
    assert theirs.apply(1.8) == LEASE_EXISTS, "renewed until 1.9 s"
    assert ours.call(LEASE_RENEW, service="sport_lease", now_s=2.0) == (LEASE_NOT_EXIST, "")
    assert theirs.apply(2.1) == 0
    assert ours.call(MOVE, '{"x": 1}', now_s=2.2) == (LEASE_DENIED, "")
    assert told == []


@pytest.mark.parametrize(
    "body",
    [{}, {"header": 3}, {"header": {"identity": {"id": "x", "api_id": 1}}}, {"header": None, "parameter": None}],
)
def test_what_is_no_request_is_dropped(switchboard: Switchboard, body: dict[str, Any]) -> None:
    assert switchboard.take("rt/api/sport/request", body, 0) is None
    assert switchboard.take("rt/api/other/request", body, 0) is None
