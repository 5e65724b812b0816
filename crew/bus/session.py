"""The one place that opens Zenoh sessions, so that who may connect, and how, is decided once.

Everybody but the router is a client that listens nowhere and trusts nobody but the router. Both functions block: call
them in `asyncio.to_thread`.
"""

import json
from collections.abc import Mapping, Sequence
from typing import Any

import zenoh

from crew.access import client_access, router_access
from crew.bus.link import Link
from crew.errors import BusError, UsageError

CONNECT_TIMEOUT_S = 5.0
RETRY_MS = 20
BLOCKED_PUT_LIMIT_US = 500_000
"""How long a blocking put may wait for a stuck reader before Zenoh closes that link."""
LEASE_MS = 2000
"""A peer that says nothing for so long is gone (a process that dies is noticed at once)."""


def open_session(link: Link, *, timeout_s: float = CONNECT_TIMEOUT_S, restrained: bool = True) -> zenoh.Session:
    """A client session; BusError if no router answers in time, UsageError if the certificate is at fault.

    Without `restrained` it keeps no rules of its own: for trying what the router forbids.
    """
    settings = {
        **_common(),
        "mode": "client",
        "listen": {"endpoints": []},
        "connect": _connect(link.endpoint, timeout_s),
        "transport/link/protocols": [link.endpoint.partition("/")[0]],
    }
    if (identity := link.identity) is not None:
        settings |= {"transport/link/tls": _tls(link, "connect")}
        settings |= {"access_control": client_access(identity)} if restrained else {}
    try:
        return zenoh.open(_config(settings))
    except zenoh.ZError as error:
        _blame_certificate(link)
        raise BusError(
            f"no router for {link.role} on {link.endpoint}: nothing after {timeout_s} s ({_brief(error)}); "
            f"is the crew up on this address? (crew status)"
        ) from error


def open_router(link: Link, robots: Sequence[str], *, guests: str = "") -> zenoh.Session:
    """The router's session on `link`, and on `guests` (`tcp/127.0.0.1:port`) for those without a certificate.

    UsageError if an address cannot be listened on, or the certificate is at fault.
    """
    settings = router_settings(link, robots, guests=guests)
    endpoints = settings["listen"]["endpoints"]
    try:
        return zenoh.open(_config(settings))
    except zenoh.ZError as error:
        _blame_certificate(link)
        taken = "Address already in use" in str(error)
        what = "port in use" if taken else "cannot listen"
        remedy = "stop what holds it (ss -ltnp) or choose another port" if taken else "write it as tls/127.0.0.1:7448"
        raise UsageError(
            f"{what}: the router was to listen on {' and '.join(endpoints)} ({_brief(error)}); {remedy}"
        ) from error


def router_settings(link: Link, robots: Sequence[str], *, guests: str = "") -> dict[str, Any]:
    """What the router is configured with, by path; a stock one is given the same (`crew deploy`)."""
    endpoints = [link.endpoint, guests] if guests else [link.endpoint]
    return {
        **_common(),
        "mode": "router",
        "listen": {"endpoints": endpoints, "timeout_ms": 0, "exit_on_failure": True},
        "connect": {"endpoints": []},
        "transport/link/protocols": [endpoint.partition("/")[0] for endpoint in endpoints],
        "transport/link/tls": _tls(link, "listen"),
        "access_control": router_access(link.crew, robots),
    }


def _common() -> dict[str, Any]:
    return {
        "scouting": {"delay": 0, "timeout": 0, "multicast": {"enabled": False}, "gossip": {"enabled": False}},
        "transport/shared_memory/enabled": False,
        "transport/link/tx/lease": LEASE_MS,
        "transport/link/tx/queue/congestion_control/block/wait_before_close": BLOCKED_PUT_LIMIT_US,
    }


def _connect(endpoint: str, timeout_s: float) -> dict[str, Any]:
    retry = {"period_init_ms": RETRY_MS, "period_max_ms": RETRY_MS, "period_increase_factor": 1}
    return {"endpoints": [endpoint], "timeout_ms": round(timeout_s * 1000), "exit_on_failure": True, "retry": retry}


def _tls(link: Link, side: str) -> dict[str, Any]:
    """Mutual TLS with the crew's own authority. `side` is `connect` or `listen`."""
    return {
        "root_ca_certificate": str(link.authority),
        "enable_mtls": True,
        "verify_name_on_connect": True,
        f"{side}_certificate": str(link.certificate),
        f"{side}_private_key": str(link.private_key),
    }


def _blame_certificate(link: Link) -> None:
    """Raise UsageError if this role's certificate is why a session did not open."""
    if link.certificates:
        from pathlib import Path

        from crew.authority import check

        check(Path(link.certificates), [link.role])


def _config(settings: Mapping[str, Any]) -> zenoh.Config:
    config = zenoh.Config()
    for path, value in settings.items():
        config.insert_json5(path, json.dumps(value))
    return config


def _brief(error: zenoh.ZError) -> str:
    """Zenoh's own words without its source paths."""
    return str(error).partition(" at /")[0]
