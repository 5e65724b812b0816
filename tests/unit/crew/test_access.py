"""The table of who may do what: against the keys that there are, and against the rules that are generated from it."""

import inspect
from collections.abc import Iterator
from typing import Any

import pytest
import zenoh

from crew.access import TABLE, Identity, Role, Way, client_access, identities, router_access
from crew.errors import UsageError
from crew.keys import Keys

CREW, ROBOTS = "demo", ("iris", "tb3")
KEYS = Keys(CREW)
EVERYBODY = {identity.name: identity for identity in identities(CREW, ROBOTS)}
ACCESS = router_access(CREW, ROBOTS)
NAMES = {"robot": "iris", "name": "iris", "mission": "m1", "skill": "land"}
WILD = (
    "crew/**",
    "**",
    "**/@act/**",
    "crew/demo/**",
    "crew/demo/*/@act/**",
    "crew/demo/iris/**",
    "crew/*/iris/@act/land",
)
WRITERS = {
    "request": {"operator", "guest"},
    "mission_event": {"orchestrator", "gateway"},
    "mission_progress": {"orchestrator"},
    "mission_confirm": {"operator"},
    "mission_cancel": {"operator"},
    "planner_ask": {"orchestrator"},
    "planner_proposal": {"planner"},
    "intake": {"gateway"},
    "heartbeat": {"orchestrator"},
    "robot_card": {"robot-iris"},
    "robot_state": {"robot-iris"},
    "robot_event": {"robot-iris"},
    "robot_value": {"robot-iris"},
    "act": {"orchestrator"},
    "act_cancel": {"orchestrator"},
    "stop": {"operator", "guest", "orchestrator"},
    "reset": {"operator"},
    "clock": {"simulation"},
    "clock_ack": {"robot-iris"},
    "sim_truth": {"simulation"},
    "sim_fault": {"operator"},
    "sim_camera": {"simulation"},
}
"""Who may put on each key, written a second time on purpose. Keys that are not here are asked or announced only."""
AMONG_ROBOTS = {"robot_state"}
"""What a robot may hear of another one."""
PUBLIC = {"mission_event", "robot_state"}
"""What a guest may hear; beside it a guest may ask `status` and `request`."""


def single_keys() -> Iterator[tuple[str, str]]:
    """Every key of `crew.keys` that names one place, by the member that makes it."""
    for name, member in inspect.getmembers(Keys):
        if name.startswith("_") or name in ("crew", "name_in"):
            continue
        if isinstance(member, property):
            key = getattr(KEYS, name)
        else:
            wanted = [p for p in inspect.signature(member).parameters if p != "self"]
            arguments = ["orchestrator"] if name == "heartbeat" else [NAMES[p] if p != "value" else "v" for p in wanted]
            key = getattr(KEYS, name)(*arguments)
        if "*" not in key:
            yield name, key


SINGLE = dict(single_keys())


def allowed(access: dict[str, Any], subject: str, flow: str, message: str, key: str) -> bool:
    """What Zenoh would decide: some rule of the subject's policy includes the key."""
    assert access["enabled"] is True
    assert access["default_permission"] == "deny"
    mine = {rule for policy in access["policies"] if subject in policy["subjects"] for rule in policy["rules"]}
    return any(
        zenoh.KeyExpr(expression).includes(zenoh.KeyExpr(key))
        for rule in access["rules"]
        if rule["id"] in mine and flow in rule["flows"] and message in rule["messages"]
        for expression in rule["key_exprs"]
    )


def who(flow: str, message: str, key: str) -> set[str]:
    return {name for name in EVERYBODY if allowed(ACCESS, name, flow, message, key)}


def test_every_key_has_its_writers_and_nobody_else() -> None:
    assert {name: found for name, key in SINGLE.items() if (found := who("ingress", "put", key))} == WRITERS


def test_every_row_belongs_to_a_key_and_every_key_to_a_row() -> None:
    rows = {(f"crew/{CREW}/{row.key}".replace("{robot}", "iris").replace("{own}", "iris"), row.way) for row in TABLE}
    rows |= {("crew/demo/orchestrator/heartbeat", Way.PUT), ("crew/demo/orchestrator/alive", Way.ALIVE)}
    for name, key in SINGLE.items():
        assert any(zenoh.KeyExpr(row).includes(zenoh.KeyExpr(key)) for row, _ in rows), name
    keys = [*SINGLE.values(), "crew/demo/orchestrator/alive"]
    for row, _ in rows:
        assert any(zenoh.KeyExpr(row).includes(zenoh.KeyExpr(key)) for key in keys), row


@pytest.mark.parametrize("name", WRITERS)
def test_every_key_has_its_readers_and_nobody_else(name: str) -> None:
    (row,) = [row for row in TABLE if row.way is Way.PUT and includes(row.key, SINGLE[name])]
    anybodys = "{robot}" not in row.key or name in AMONG_ROBOTS
    readers = {i.name for i in EVERYBODY.values() if i.role in row.readers and (anybodys or own(i))}
    assert who("egress", "put", SINGLE[name]) == readers
    assert who("ingress", "declare_subscriber", SINGLE[name]) == readers


def own(identity: Identity) -> bool:
    return identity.role is not Role.ROBOT or identity.own == "iris"


def includes(row: str, key: str) -> bool:
    pattern = f"crew/{CREW}/{row}".replace("{robot}", "*").replace("{own}", "*")
    return zenoh.KeyExpr(pattern).includes(zenoh.KeyExpr(key))


def test_actuation_is_the_orchestrators_and_its_robots_alone() -> None:
    for key in (KEYS.act("tb3", "navigate_to"), KEYS.act_cancel("tb3")):
        assert who("ingress", "put", key) == {"orchestrator"}
        assert who("egress", "put", key) == {"robot-tb3"}
        assert who("ingress", "declare_subscriber", key) == {"robot-tb3"}
        for message in ("query", "reply", "declare_queryable", "delete", "liveliness_token"):
            assert who("ingress", message, key) == who("egress", message, key) == set()


@pytest.mark.parametrize("key", WILD)
def test_nobody_puts_on_a_wildcard_that_reaches_more_than_the_table_gives(key: str) -> None:
    assert who("ingress", "put", key) == ({"orchestrator"} if key == "crew/demo/*/@act/**" else set())


def test_nobody_deletes_and_nobody_reaches_another_crew() -> None:
    for key in (*SINGLE.values(), "@/router/x"):
        assert who("ingress", "delete", key) == set()
        assert who("ingress", "put", key.replace("crew/demo", "crew/other").replace("@/", "@/")) == set()
        assert who("ingress", "query", key.replace("crew/demo", "crew/other")) == set()


def test_the_recorder_hears_everything_but_actuation_and_says_nothing() -> None:
    for name, key in SINGLE.items():
        heard = allowed(ACCESS, "recorder", "egress", "put", key)
        assert heard is (name not in ("act", "act_cancel")), name
    assert EVERYBODY["recorder"].may(Way.PUT) == []


def test_a_guest_may_ask_hear_what_is_public_and_stop() -> None:
    assert {name for name, key in SINGLE.items() if "guest" in who("ingress", "put", key)} == {"request", "stop"}
    assert {name for name, key in SINGLE.items() if "guest" in who("egress", "put", key)} == PUBLIC
    assert {name for name, key in SINGLE.items() if "guest" in who("ingress", "query", key)} == {"request", "status"}
    for message in ("declare_queryable", "liveliness_token", "liveliness_query", "declare_liveliness_subscriber"):
        assert [k for k in SINGLE.values() if "guest" in who("ingress", message, k)] == []


def test_guests_are_told_by_the_protocol_and_others_by_their_certificate() -> None:
    subjects = {subject["id"]: subject for subject in ACCESS["subjects"]}
    assert subjects.pop("guest") == {"id": "guest", "link_protocols": ["tcp"]}
    for name, subject in subjects.items():
        assert subject == {"id": name, "link_protocols": ["tls"], "cert_common_names": [name]}
    assert "router" not in subjects, "the router has no rights of its own"


def test_a_client_deals_with_the_router_alone() -> None:
    for identity in EVERYBODY.values():
        access = client_access(identity)
        assert access["subjects"] == [{"id": "router", "link_protocols": ["tls"], "cert_common_names": ["router"]}]
        for key in SINGLE.values():
            for mine, theirs in (("ingress", "egress"), ("egress", "ingress")):
                for message in ("put", "query", "reply", "declare_subscriber", "liveliness_token", "delete"):
                    assert allowed(access, "router", mine, message, key) is allowed(
                        ACCESS, identity.name, theirs, message, key
                    )


def test_a_publisher_learns_that_somebody_listens() -> None:
    """Without it a declared publisher stays mute, silently."""
    for row in TABLE:
        for reader in (i for i in EVERYBODY.values() if i.role in row.readers):
            for writer in (i for i in EVERYBODY.values() if i.role in row.writers):
                message = {Way.PUT: "declare_subscriber", Way.ASK: "declare_queryable"}.get(row.way)
                for declared in reader.hears(row.way) if message else ():
                    if includes(row.key, declared) and zenoh.KeyExpr(declared).intersects(
                        zenoh.KeyExpr(writer_key(writer, row.key))
                    ):
                        assert allowed(ACCESS, writer.name, "egress", str(message), declared), (row, declared)


def writer_key(writer: Identity, key: str) -> str:
    robot = writer.own if writer.role is Role.ROBOT else "*"
    return f"crew/{CREW}/{key.replace('{robot}', robot).replace('{own}', writer.own)}"


@pytest.mark.parametrize("name", ["", "robot", "robot-", "robot-planner", "robot-@act", "Planner", "router", "root"])
def test_a_name_that_no_role_has_is_refused(name: str) -> None:
    with pytest.raises(UsageError):
        Identity.of(CREW, name)
