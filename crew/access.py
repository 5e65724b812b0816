"""Who may do what on which key: one table of roles and keys, and the access control that is generated from it.

Pure data. Whoever adds a key adds its row here; a test holds this table against `crew.keys`.
"""

from collections.abc import Iterable, Iterator
from enum import StrEnum
from typing import Any

import msgspec

from crew.errors import UsageError, nearest
from crew.keys import checked_chunk, checked_robot

ROUTER = "router"
"""The router's certificate. It routes, and has no rights of its own."""
ROBOTS, OWN, ANY = "{robot}", "{own}", "*"
ROBOT_PREFIX = "robot-"
GUESTS_PROTOCOL = "tcp"
"""Whoever comes over plain TCP, without a certificate, is a guest."""


class Role(StrEnum):
    """A trust domain. Each has a certificate of its own; the guest has none."""

    ORCHESTRATOR = "orchestrator"
    PLANNER = "planner"
    GATEWAY = "gateway"
    ROBOT = "robot"
    SIMULATION = "simulation"
    RECORDER = "recorder"
    OPERATOR = "operator"
    GUEST = "guest"


class Way(StrEnum):
    """How a key is used: PUT by writers for subscribers, ASK by queriers of answerers, ALIVE by tokens' holders."""

    PUT = "put"
    ASK = "ask"
    ALIVE = "alive"


class Row(msgspec.Struct, frozen=True):
    """A key below `crew/<crew>/` and who may use it.

    `{robot}` is the robot's own name for a robot, and any robot's for everybody else; `{own}` is the writer's own name.
    """

    key: str
    way: Way
    writers: tuple[Role, ...]
    readers: tuple[Role, ...]
    peers: bool = False
    """A robot that reads it reads any robot's, for they keep clear of each other."""


ORC, PLA, GAT, ROB = Role.ORCHESTRATOR, Role.PLANNER, Role.GATEWAY, Role.ROBOT
SIM, REC, OPE, GUE = Role.SIMULATION, Role.RECORDER, Role.OPERATOR, Role.GUEST

ACTUATION = Row("{robot}/@act/**", Way.PUT, (ORC,), (ROB,))
HEARTBEAT = Row("orchestrator/heartbeat", Way.PUT, (ORC,), (ROB, OPE, REC))

TABLE = (
    # actuation, stop, reset
    ACTUATION,
    Row("@stop", Way.PUT, (OPE, GUE, ORC), (ROB, ORC, OPE, REC)),
    Row("@reset", Way.PUT, (OPE,), (ROB, ORC, REC)),
    # a person's side
    Row("request", Way.PUT, (OPE, GUE), (GAT, REC)),
    Row("request", Way.ASK, (OPE, GUE), (GAT,)),
    Row("status", Way.ASK, (OPE, GUE, REC), (ORC,)),
    Row("mission/*/event", Way.PUT, (ORC, GAT), (OPE, GUE, REC)),
    Row("mission/*/progress", Way.PUT, (ORC,), (OPE, REC)),
    Row("mission/*/confirm", Way.PUT, (OPE,), (ORC, REC)),
    Row("mission/*/cancel", Way.PUT, (OPE,), (ORC, REC)),
    # among the actors
    Row("gateway/intake", Way.PUT, (GAT,), (ORC, REC)),
    Row("planner/ask", Way.PUT, (ORC,), (PLA, REC)),
    Row("planner/proposal", Way.PUT, (PLA,), (ORC, REC)),
    HEARTBEAT,
    Row("orchestrator/alive", Way.ALIVE, (ORC,), (ROB, ORC, OPE, REC)),
    Row("{own}/alive", Way.ALIVE, (PLA, GAT, ROB, SIM, REC), (ORC, OPE, REC)),
    # robots
    Row("{robot}/card", Way.PUT, (ROB,), (ORC, OPE, REC)),
    Row("{robot}/state", Way.PUT, (ROB,), (ORC, OPE, REC, GUE, ROB), peers=True),
    Row("{robot}/event", Way.PUT, (ROB,), (ORC, OPE, REC)),
    Row("{robot}/value/*", Way.PUT, (ROB,), (ORC, OPE, REC)),
    # simulation
    Row("clock", Way.PUT, (SIM,), (ROB, ORC, OPE, REC)),
    Row("clock/ack/{own}", Way.PUT, (ROB, ORC), (SIM, REC)),
    Row("sim/truth", Way.PUT, (SIM,), (OPE, REC)),
    Row("sim/fault", Way.PUT, (OPE,), (SIM, REC)),
    Row("sim/scene", Way.ASK, (OPE, REC), (SIM,)),
    Row("sim/camera/*", Way.PUT, (SIM,), (OPE, REC)),
)


def came_with(row: Row, peer: str) -> tuple[str, str]:
    """The certificate that a message on this row's key was sent with, and how that is known, as a sentence.

    `peer` is the certificate at the other end of the reader's own link. The name is empty where it shows none.
    """
    if peer != ROUTER:
        return "", f"with whose certificate is not known: this link shows {peer or 'none'}"
    who = " or ".join(row.writers)
    return (
        who,
        f"sent with the certificate of {who}, for the crew's router (certificate {peer}) lets nobody else put here",
    )


class Identity(msgspec.Struct, frozen=True):
    """One role in one crew; for a robot, that one robot. `name` is the common name of its certificate."""

    crew: str
    role: Role
    own: str
    """The name that stands for `{own}` in its keys."""

    @property
    def name(self) -> str:
        return f"{ROBOT_PREFIX}{self.own}" if self.role is Role.ROBOT else str(self.role)

    @classmethod
    def of(cls, crew: str, name: str) -> "Identity":
        """The identity whose certificate has this common name. Raises UsageError for a name that no role has."""
        checked_chunk(crew, "crew name")
        if name.startswith(ROBOT_PREFIX):
            return cls(crew, Role.ROBOT, checked_robot(name.removeprefix(ROBOT_PREFIX)))
        roles = {str(role): role for role in Role if role is not Role.ROBOT}
        if name not in roles:
            raise UsageError(f"no role is called {name!r}{nearest(name, [*roles, 'robot-<name>'])}")
        return cls(crew, roles[name], name)

    def may(self, way: Way) -> list[str]:
        """Key expressions that it may put on, query, or hold a token on."""
        return [self._key(row, writes=True) for row in TABLE if row.way is way and self.role in row.writers]

    def hears(self, way: Way) -> list[str]:
        """Key expressions that it may subscribe to, answer, or watch tokens on."""
        found = [self._key(row, writes=False) for row in TABLE if row.way is way and self.role in row.readers]
        return [*found, f"crew/{self.crew}/**"] if way is Way.PUT and self.role is Role.RECORDER else found

    def audience(self, way: Way) -> list[str]:
        """What its readers or answerers may have declared, so that it learns that somebody is there."""
        rows = [row for row in TABLE if row.way is way and self.role in row.writers]
        found = [f"crew/{self.crew}/{row.key.replace(ROBOTS, ANY).replace(OWN, ANY)}" for row in rows]
        return [*found, f"crew/{self.crew}/**"] if any(Role.RECORDER in row.readers for row in rows) else found

    def _key(self, row: Row, *, writes: bool) -> str:
        peers = row.peers and not writes
        robot = self.own if self.role is Role.ROBOT and not peers else ANY
        return f"crew/{self.crew}/{row.key.replace(ROBOTS, robot).replace(OWN, self.own if writes else ANY)}"


def identities(crew: str, robots: Iterable[str]) -> list[Identity]:
    """Everybody who has a place in the crew, the guest last."""
    fixed = [Identity.of(crew, str(role)) for role in Role if role not in (Role.ROBOT, Role.GUEST)]
    return [*fixed, *(Identity.of(crew, f"{ROBOT_PREFIX}{r}") for r in robots), Identity.of(crew, str(Role.GUEST))]


def router_access(crew: str, robots: Iterable[str]) -> dict[str, Any]:
    """The router's access control, as Zenoh is configured: nothing is allowed but what the table allows."""
    everybody = identities(crew, robots)
    rules = {identity.name: list(_rules(identity, to_router="ingress", from_router="egress")) for identity in everybody}
    subjects = [
        {"id": i.name, "link_protocols": [GUESTS_PROTOCOL]}
        if i.role is Role.GUEST
        else {"id": i.name, "link_protocols": ["tls"], "cert_common_names": [i.name]}
        for i in everybody
    ]
    return _access_control(rules, subjects)


def client_access(identity: Identity) -> dict[str, Any]:
    """A client's own access control: it deals with the router alone, and with what the table gives it alone."""
    rules = {ROUTER: list(_rules(identity, to_router="egress", from_router="ingress"))}
    return _access_control(rules, [{"id": ROUTER, "link_protocols": ["tls"], "cert_common_names": [ROUTER]}])


def _access_control(rules: dict[str, list[dict[str, Any]]], subjects: list[dict[str, Any]]) -> dict[str, Any]:
    return {
        "enabled": True,
        "default_permission": "deny",
        "rules": [rule for found in rules.values() for rule in found],
        "subjects": subjects,
        "policies": [{"rules": [r["id"] for r in found], "subjects": [name]} for name, found in rules.items() if found],
    }


def _rules(identity: Identity, *, to_router: str, from_router: str) -> Iterator[dict[str, Any]]:
    """One identity's rules, each of one flow and one set of messages."""
    may, hears, audience = identity.may, identity.hears, identity.audience
    wanted = (
        ("puts", to_router, ("put",), may(Way.PUT)),
        ("subscribes", to_router, ("declare_subscriber",), hears(Way.PUT)),
        ("asks", to_router, ("query",), may(Way.ASK)),
        ("answers", to_router, ("declare_queryable", "reply"), hears(Way.ASK)),
        ("lives", to_router, ("liveliness_token",), may(Way.ALIVE)),
        ("watches", to_router, ("declare_liveliness_subscriber", "liveliness_query"), hears(Way.ALIVE)),
        ("hears", from_router, ("put",), hears(Way.PUT)),
        ("is-asked", from_router, ("query",), hears(Way.ASK)),
        ("is-answered", from_router, ("reply",), may(Way.ASK)),
        ("sees", from_router, ("liveliness_token",), hears(Way.ALIVE)),
        ("learns-of-readers", from_router, ("declare_subscriber",), audience(Way.PUT)),
        ("learns-of-answerers", from_router, ("declare_queryable",), audience(Way.ASK)),
    )
    for what, flow, messages, keys in wanted:
        if keys:
            yield {
                "id": f"{identity.name}-{what}",
                "permission": "allow",
                "flows": [flow],
                "messages": list(messages),
                "key_exprs": keys,
            }
