"""What somebody with a session may try: guests, and every role with a certificate of its own but without the right."""

import os
import signal
import time
from collections.abc import Iterator
from typing import Any

import msgspec
import zenoh

from crew.messages import CrewStatus
from tests.attack.forgery import ACT, FORGERIES, Forgery, forged
from tests.attack.row import Row
from tests.attack.scene import ARRIVE_S, ATTACKERS, Heard, Scene, arrived
from tests.integration.crew.harness import children_of

REMOTE = zenoh.Locality.REMOTE
WILD = ("crew/**", "**", "**/@act/**", "crew/*/*/@act/**", "crew/{crew}/*/@act/**", "crew/{crew}/tb3/@act/**")
SILENCE = "nothing: the put returns, and nobody hears it"


def attacks(scene: Scene) -> Iterator[Row]:
    """Every attack of those who hold a session."""
    for forgery in FORGERIES:
        yield _forge(scene, forgery)
    for attack in (_delete, _wildcard_put, _publish, _query, _rogue_queryable, _eavesdrop, _announce, _withdraw):
        yield attack(scene)


def _forge(scene: Scene, forgery: Forgery) -> Row:
    by = _others(forgery.rightful)
    key, stem = scene.key(forgery.key), forgery.name.replace(" ", "-").replace(",", "")

    def put(role: str, mark: str) -> None:
        payload, encoding = forged(forgery.key, mark)
        scene.session(role).put(key, payload, encoding=encoding)

    before = _steady(scene)
    for attacker in by:
        put(attacker, f"{stem}-by-{attacker}")
    scene.settle()
    seen = _operator_sees(before, _status(scene))
    delivered = sum(len(scene.marked(f"{stem}-by-{attacker}")) for attacker in by)
    if forgery.live:
        controlled = arrived(lambda: [h for h in scene.heard if h.key == key and h.witness == forgery.witness])
    else:
        put(forgery.rightful, f"{stem}-control")
        controlled = arrived(lambda: [h for h in scene.marked(f"{stem}-control") if h.witness == forgery.witness])
    return _row(forgery.name, by, len(by), delivered, SILENCE, seen, forgery.rightful, controlled)


def _delete(scene: Scene) -> Row:
    by = _others("orchestrator")
    mark = "deleted"
    before = _steady(scene)
    for attacker in by:
        scene.session(attacker).delete(scene.key(f"tb3/@act/{mark}"))
    scene.settle()
    seen = _operator_sees(before, _status(scene))
    return _row("delete on an actuation key", by, len(by), len(scene.marked(mark)), SILENCE, seen, *_act(scene, "d"))


def _wildcard_put(scene: Scene) -> Row:
    by = _others("orchestrator")
    before = _steady(scene)
    wild = [key.format(crew=scene.running.crew) for key in WILD]
    for attacker in by:
        for key in wild:
            payload, encoding = forged(ACT, f"wild-by-{attacker}")
            scene.session(attacker).put(key, payload, encoding=encoding)
    scene.settle()
    seen = _operator_sees(before, _status(scene))
    delivered = sum(len(scene.marked(f"wild-by-{attacker}")) for attacker in by)
    name = "put on " + ", ".join(f"`{key.replace('{crew}', '<crew>')}`" for key in WILD)
    return _row(name, by, len(by) * len(wild), delivered, SILENCE, seen, *_act(scene, "w"))


def _publish(scene: Scene) -> Row:
    by = _others("orchestrator")
    before = _steady(scene)
    matching = 0
    for attacker in by:
        publisher = scene.session(attacker).declare_publisher(scene.key(ACT))
        scene.keep(publisher)
        payload, encoding = forged(ACT, f"published-by-{attacker}")
        publisher.put(payload, encoding=encoding)
        matching += _matches(publisher) and attacker != "robot-tb3"  # which listens there itself
    scene.settle()
    seen = _operator_sees(before, _status(scene))
    delivered = sum(len(scene.marked(f"published-by-{attacker}")) for attacker in by)
    sees = "its publisher matches nobody" if not matching else f"MATCHES {matching}"
    own = scene.session("orchestrator").declare_publisher(scene.key(ACT))
    scene.keep(own)
    arrived(lambda: [own] if _matches(own) else [])
    payload, encoding = forged(ACT, "published-control")
    own.put(payload, encoding=encoding)
    controlled = arrived(lambda: scene.marked("published-control"))
    return _row(
        "declared publisher of an actuation key", by, len(by), delivered, sees, seen, "orchestrator", controlled
    )


def _matches(publisher: zenoh.Publisher) -> bool:
    status: Any = publisher.matching_status
    return bool(status.matching)


def _query(scene: Scene) -> Row:
    """Robots answer no query on actuation; the status answers only those who may ask."""
    heard: list[str] = []
    queryable = scene.session("robot-tb3").declare_queryable(
        scene.key("tb3/@act/**"), lambda q: heard.append("query"), allowed_origin=REMOTE
    )
    scene.keep(queryable)
    asked = {attacker: [scene.key(ACT), "**/@act/**", "crew/**", "@/**"] for attacker in _others("orchestrator")}
    for attacker in asked:
        if attacker not in ("guest", "operator", "recorder"):
            asked[attacker].append(scene.key("status"))
    before = _steady(scene)
    replies = sum(_asked(scene, attacker, key) for attacker, keys in asked.items() for key in keys)
    seen = _operator_sees(before, _status(scene))
    attempts = sum(len(keys) for keys in asked.values())
    controlled = _asked(scene, "operator", scene.key("status"), wait_s=ARRIVE_S)
    name = "query of actuation keys, of everything, of the router itself, of the status"
    return _row(
        name, tuple(asked), attempts, replies + len(heard), "no reply", seen, "operator asks status", controlled
    )


def _rogue_queryable(scene: Scene) -> Row:
    by = tuple(a for a in ATTACKERS if a != "gateway")
    heard: list[str] = []
    for attacker in by:
        for key in ("status", "request", "**"):
            rogue = scene.session(attacker).declare_queryable(
                scene.key(key), lambda q: heard.append(str(q.key_expr)), allowed_origin=REMOTE
            )
            scene.keep(rogue)
    scene.settle()
    before = _steady(scene)
    replies = _asked(scene, "operator", scene.key("status"), wait_s=ARRIVE_S)
    seen = _operator_sees(before, _status(scene))
    name = "rogue queryable of the status, of requests, of everything"
    return _row(name, by, 3 * len(by), len(heard), "is never asked", seen, "orchestrator answers", min(replies, 1))


def _eavesdrop(scene: Scene) -> Row:
    by = tuple(a for a in _others("orchestrator") if a != "robot-tb3")
    heard: list[str] = []
    keys = (scene.key("*/@act/**"), "**/@act/**", "crew/**/@act/**", scene.key("tb3/@act/**"), scene.key(ACT))
    for attacker in by:
        for key in keys:
            scene.keep(
                scene.session(attacker).declare_subscriber(key, lambda sample: heard.append(str(sample.key_expr)))
            )
    scene.settle()
    before = _steady(scene)
    seen = _operator_sees(before, _status(scene))
    control, controlled = _act(scene, "e")
    scene.settle()
    return _row("eavesdropping on actuation", by, len(by) * len(keys), len(heard), "nothing", seen, control, controlled)


def _announce(scene: Scene) -> Row:
    """Liveliness in another's name, and in nobody's."""
    by = ATTACKERS
    before = _steady(scene)
    for attacker in by:
        token = scene.session(attacker).liveliness().declare_token(scene.key(f"ghost-{attacker}/alive"))
        scene.keep(token)
    scene.settle()
    seen = _operator_sees(before, _status(scene))
    delivered = sum(len(scene.marked(f"ghost-{attacker}")) for attacker in by)
    controlled = arrived(lambda: [h for h in scene.heard if (h.kind, h.key) == ("put", scene.key("iris/alive"))])
    return _row("liveliness in another name", by, len(by), delivered, "nothing", seen, "robot-iris", controlled)


def _withdraw(scene: Scene) -> Row:
    """A token announced and taken back would make a living robot look dead. Ends the planner: to be the last."""
    by = _others("robot-tb3")
    before, count = _steady(scene), len(_gone(scene, "tb3")) + len(_gone(scene, "orchestrator"))
    for attacker in by:
        for name in ("tb3", "orchestrator"):
            token = scene.session(attacker).liveliness().declare_token(scene.key(f"{name}/alive"))
            token.undeclare()  # type: ignore[no-untyped-call]
    scene.settle()
    seen = _operator_sees(before, _status(scene))
    delivered = len(_gone(scene, "tb3")) + len(_gone(scene, "orchestrator")) - count
    os.kill(children_of(scene.running.pid)["planner"], signal.SIGKILL)
    controlled = arrived(lambda: list(_gone(scene, "planner")))
    name = "liveliness of a robot and of the orchestrator, announced and withdrawn"
    return _row(name, by, 2 * len(by), delivered, "nothing", seen, "the planner is killed", controlled)


def _gone(scene: Scene, name: str) -> list[Heard]:
    return [h for h in scene.heard if h.kind == "delete" and h.key == scene.key(f"{name}/alive")]


def _act(scene: Scene, letter: str) -> tuple[str, int]:
    """The positive control of attacks on actuation: the orchestrator's message reaches the robot."""
    mark = f"act-control-{letter}"
    payload, encoding = forged(ACT, mark)
    scene.session("orchestrator").put(scene.key(ACT), payload, encoding=encoding)
    return "orchestrator", arrived(lambda: [h for h in scene.marked(mark) if h.witness == "robot-tb3"])


def _others(rightful: str) -> tuple[str, ...]:
    return tuple(attacker for attacker in ATTACKERS if attacker != rightful)


def _asked(scene: Scene, role: str, key: str, *, wait_s: float = 0.3) -> int:
    """How many replies a query brings."""
    replies = scene.session(role).get(key, timeout=wait_s, target=zenoh.QueryTarget.ALL, allowed_destination=REMOTE)
    return sum(1 for reply in replies if reply.ok is not None)


def _status(scene: Scene) -> CrewStatus:
    for reply in scene.session("operator").get(scene.key("status"), timeout=ARRIVE_S):
        if reply.ok is not None:
            return msgspec.msgpack.decode(reply.ok.payload.to_bytes(), type=CrewStatus)
    raise AssertionError("the orchestrator does not answer")


def _steady(scene: Scene) -> CrewStatus:
    """The status once the controls of earlier attacks have been counted."""
    known, deadline = _status(scene), time.monotonic() + ARRIVE_S
    while time.monotonic() < deadline:
        scene.settle()
        now = _status(scene)
        if _told(known) == _told(now):
            break
        known = now
    return known


def _operator_sees(before: CrewStatus, after: CrewStatus) -> str:
    """What `crew status` tells of an attack: nothing that moved, latched, failed, began, or was dropped."""
    if _told(before) == _told(after):
        return "nothing: `crew status` tells the same as before"
    return f"A CHANGE: {_told(before)} became {_told(after)}"


def _told(status: CrewStatus) -> object:
    robots = [(r.robot, r.unavailable, r.stopped, r.running) for r in status.robots]
    return robots, [m.mission for m in status.missions], dict(status.dropped), status.stopped, status.epoch


def _row(
    name: str, by: tuple[str, ...], attempts: int, delivered: int, sees: str, operator: str, control: str, arrived: int
) -> Row:
    return Row(
        attack=name,
        by=by,
        attempts=attempts,
        delivered=delivered,
        attacker_sees=sees,
        operator_sees=operator,
        control=control,
        controlled=arrived,
    )
