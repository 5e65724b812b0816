"""The one place that opens Zenoh sessions, so that who may connect, and how, is decided once.

Everybody but the router is a client that listens nowhere. Both functions block: call them in `asyncio.to_thread`.
"""

import json
from collections.abc import Mapping, Sequence
from typing import Any

import zenoh

from crew.errors import BusError, UsageError

CONNECT_TIMEOUT_S = 5.0
RETRY_MS = 20
BLOCKED_PUT_LIMIT_US = 500_000
"""How long a blocking put may wait for a stuck reader before Zenoh closes that link."""
LEASE_MS = 2000
"""A peer that says nothing for so long is gone (a process that dies is noticed at once)."""


def open_session(role: str, endpoints: Sequence[str], *, timeout_s: float = CONNECT_TIMEOUT_S) -> zenoh.Session:
    """A client session for `role`; BusError if no router answers on `endpoints` (`tcp/host:port`) in time."""
    settings = {**_common(), "mode": "client", "listen": {"endpoints": []}, "connect": _connect(endpoints, timeout_s)}
    try:
        return zenoh.open(_config(settings))
    except zenoh.ZError as error:
        raise BusError(
            f"no router for {role} on {', '.join(endpoints)}: nothing after {timeout_s} s ({_brief(error)}); "
            f"is the crew up on this address? (crew status)"
        ) from error


def open_router(listen: str) -> zenoh.Session:
    """The router's session on `listen` (`tcp/host:port`); UsageError if the address cannot be listened on."""
    listening = {"endpoints": [listen], "timeout_ms": 0, "exit_on_failure": True}
    settings = {**_common(), "mode": "router", "listen": listening, "connect": {"endpoints": []}}
    try:
        return zenoh.open(_config(settings))
    except zenoh.ZError as error:
        taken = "Address already in use" in str(error)
        what = "port in use" if taken else "cannot listen"
        remedy = "stop what holds it (ss -ltnp) or choose another port" if taken else "write it as tcp/127.0.0.1:7447"
        raise UsageError(f"{what}: the router was to listen on {listen} ({_brief(error)}); {remedy}") from error


def _common() -> dict[str, Any]:
    return {
        "scouting": {"delay": 0, "timeout": 0, "multicast": {"enabled": False}, "gossip": {"enabled": False}},
        "transport/shared_memory/enabled": False,
        "transport/link/tx/lease": LEASE_MS,
        "transport/link/tx/queue/congestion_control/block/wait_before_close": BLOCKED_PUT_LIMIT_US,
    }


def _connect(endpoints: Sequence[str], timeout_s: float) -> dict[str, Any]:
    retry = {"period_init_ms": RETRY_MS, "period_max_ms": RETRY_MS, "period_increase_factor": 1}
    return {
        "endpoints": list(endpoints),
        "timeout_ms": round(timeout_s * 1000),
        "exit_on_failure": True,
        "retry": retry,
    }


def _config(settings: Mapping[str, Any]) -> zenoh.Config:
    config = zenoh.Config()
    for path, value in settings.items():
        config.insert_json5(path, json.dumps(value))
    return config


def _brief(error: zenoh.ZError) -> str:
    """Zenoh's own words without its source paths."""
    return str(error).partition(" at /")[0]
