"""The fuzz's own world: robots that do what they are sent to do, or not, and telemetry that is put to its limits."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from random import Random

from crew.contracts.plan import Call
from crew.contracts.site import Rules
from crew.contracts.snapshot import FluentValue, Point, RobotState, Snapshot, Stamped, StampedValue, ValueReading
from crew.study.fuzz.wish import Wish

SECOND_NS = 1_000_000_000
EDGE_NS = (-1, 0, 0, 1, 1, SECOND_NS)
"""Around the greatest age that is allowed."""
AHEAD_NS = (-500_000_000, -500_000_001, -SECOND_NS, -1)
NEAR_M = 1e-6
VICTIM = Point(5.0, 5.0)
LYING = {"red_cube": "table_a", "bottle": "table_b"}


class FuzzWorld:
    """What is true, and what telemetry says of it. Mission time in nanoseconds; places in world ENU, metres."""

    def __init__(self, wish: Wish, rules: Rules, mission: str, chance: Random, *, calm: bool) -> None:
        self.wish, self.rules, self.mission, self.chance = wish, rules, mission, chance
        self.now_ns = 1_000 * SECOND_NS + chance.randrange(SECOND_NS)
        self.stopped = False
        self.fluents = {r.name: dict(self._resting(r.name, r.kind)) for r in rules.crew.robots}
        self.ages_ns: dict[tuple[str, str], int] = {}
        """Of single fluents, where it is not the usual one."""
        self.flags: dict[str, dict[str, str | bool]] = {r.name: {} for r in rules.crew.robots}
        self.silent: set[str] = set()
        self.values: dict[str, tuple[ValueReading, str]] = {}
        self.value_ages_ns: dict[str, int] = {}
        self.heard_ns: dict[str, int] = {}
        """When each value was received."""
        self._begin(calm=calm)

    def _resting(self, name: str, kind: str) -> Iterator[tuple[str, FluentValue]]:
        for fluent in self.rules.kinds[kind].fluents:
            if fluent.resting is not None:
                yield fluent.name, fluent.resting
            elif fluent.domain == "place":
                yield fluent.name, {"iris": Point(-4, -4), "tb3": Point(-4, -2.5)}.get(name, Point(1.0, -0.5))
            else:
                yield fluent.name, 80.0 if fluent.name == "battery" else 0.0

    def _begin(self, *, calm: bool) -> None:
        """What differs from one mission to the next, all of it in order."""
        chance, wish = self.chance, self.wish
        if "iris" in self.fluents:
            self.fluents["iris"]["airborne"] = chance.random() < 0.2
            if chance.random() < (0.9 if wish.contract == "dispatch_only" else 0.3) or calm:
                self._publish("victim", "iris", position=VICTIM, stamp_ns=self.now_ns - 5 * SECOND_NS)
            return
        if chance.random() < 0.25:
            self.fluents["go2"]["at"] = self._at("pickup")
        near = chance.random() < 0.5 if wish.near is None else wish.near
        self._publish("requester", "g1", position=Point(0.4, -0.3) if near else Point(4.0, 0.5), near=near)
        for thing, place in LYING.items():
            self._publish(thing, "g1", position=self._at(place))

    def _publish(self, name: str, source: str, stamp_ns: int | None = None, **what: object) -> None:
        stamp = self.now_ns if stamp_ns is None else stamp_ns
        reading = ValueReading(name=name, stamp_ns=stamp, **{"status": "ok", **what})  # type: ignore[arg-type]
        self.values[name] = (reading, source)
        self.heard_ns[name] = self.now_ns

    def _at(self, place: str) -> Point:
        location = self.rules.crew.location(place)
        assert location is not None
        return Point(location.x, location.y)

    @property
    def supports(self) -> frozenset[str]:
        """The supporting calls that this world has room for."""
        found = {"land"}
        if "iris" in self.fluents:
            return frozenset(found if self.fluents["iris"]["airborne"] else found | {"takeoff"})
        return frozenset(found if self.fluents["go2"]["at"] == self._at("pickup") else found | {"approach"})

    def snapshot(self) -> Snapshot:
        """What the orchestrator knows now."""
        robots = {r.name: self._robot(r.name, r.kind) for r in self.rules.crew.robots if r.name not in self.silent}
        values = {name: self._stamped(*told) for name, told in self.values.items()}
        return Snapshot(robots=robots, values=values, stopped=self.stopped)

    def _robot(self, name: str, kind: str) -> RobotState:
        fluents = {}
        for fluent, value in self.fluents[name].items():
            at_ns = self.now_ns - self.ages_ns.get((name, fluent), 0)
            fluents[fluent] = Stamped(value, at_ns, self.now_ns)
        flags = {"kind_digest": self.rules.kinds[kind].digest, "lease": self.mission, **self.flags[name]}
        return RobotState(name=name, boot_id="boot", fluents=fluents, **flags)  # type: ignore[arg-type]

    def _stamped(self, reading: ValueReading, source: str) -> StampedValue:
        """Values that are observed all the time are as old as told; a victim's fix keeps the time it was made."""
        if reading.name != "victim" or reading.name in self.value_ages_ns:
            age_ns = self.value_ages_ns.get(reading.name, 0)
            told = ValueReading(
                name=reading.name,
                status=reading.status,
                position=reading.position,
                near=reading.near,
                stamp_ns=self.now_ns - age_ns,
            )
            return StampedValue(told, source, self.heard_ns[reading.name])
        return StampedValue(reading, source, self.heard_ns[reading.name])

    # --- what robots do

    def perform(self, call: Call, places: dict[str, Point]) -> None:
        """The call has its effect in the world, as far as the world allows."""
        mine = self.fluents[call.robot]
        match call.skill:
            case "takeoff":
                mine |= {"airborne": True, "altitude": float(call.args["altitude"])}
            case "search_target":
                mine |= {"swept": True}
                self._find()
            case "get_coordinates":
                self._find()
            case "land":
                mine |= {"airborne": False, "altitude": 0.0}
            case "navigate_to" | "navigate" | "fly_to":
                goal = next(iter(places.values()), None)
                mine |= {"at": goal or Point(float(call.args["x"]), float(call.args["y"])), "moving": False}
            case "stop":
                mine |= {"moving": False}
            case "wave":
                mine |= {"waved": True}
            case "pick_handover":
                mine |= {"handed": call.args["object"], "holding": "none"}
            case "pick_hold":
                mine |= {"holding": call.args["object"]}
            case "pick_place":
                self._place(str(call.args["object"]), str(call.args["location"]))

    def shows(self, call: Call, places: Mapping[str, Point]) -> bool:
        """Whether the world is already as the call would make it."""
        mine = self.fluents[call.robot]
        wanted: dict[str, tuple[str, FluentValue]] = {
            "takeoff": ("airborne", True),
            "land": ("airborne", False),
            "stop": ("moving", False),
            "search_target": ("swept", True),
            "wave": ("waved", True),
        }
        if call.skill in wanted:
            fluent, value = wanted[call.skill]
            return mine.get(fluent) == value
        at, goal = mine.get("at"), next(iter(places.values()), None)
        if call.skill in ("navigate", "navigate_to") and isinstance(at, Point) and goal is not None:
            return math.dist((at.x, at.y), (goal.x, goal.y)) <= 0.9
        return call.skill in ("pick_hold", "pick_handover", "pick_place")

    def _place(self, thing: str, place: str) -> None:
        if place != "payload_tray":
            self._publish(thing, "g1", position=self._at(place))
            return
        self.values.pop(thing, None)
        at = self.fluents["go2"]["at"]
        assert isinstance(at, Point)
        if math.dist((at.x, at.y), (self._at("pickup").x, self._at("pickup").y)) <= 0.3:
            self.fluents["go2"]["tray"] = thing

    def _find(self) -> None:
        """A search ends: mostly with a fix, sometimes with one at the edge of use, or with none."""
        chance, area = self.chance, self.rules.crew.area
        stamp_ns = self.now_ns - chance.choices((0, 1, SECOND_NS, 30 * SECOND_NS, -SECOND_NS), (85, 5, 4, 5, 1))[0]
        if chance.random() < 0.75:
            return self._publish("victim", "iris", stamp_ns, position=VICTIM)
        inf, edge = math.inf, area.x_max
        xs = (math.nan, inf, edge, math.nextafter(edge, inf), edge + 3)
        odd: list[dict[str, object]] = [{"status": s} for s in ("absent", "ambiguous", "uncertain")]
        odd += [{"position": Point(x, 1.0)} for x in xs]
        odd += [{"position": Point(1.0, 1.0, math.nan)}, {"position": None}, {"position": Point(2.0, 3.0)}]
        odd += [{"status": "absent", "position": VICTIM}]
        source = chance.choice(("iris", "iris", "iris", "tb3"))
        return self._publish("victim", source, stamp_ns, **chance.choice(odd))

    # --- what goes wrong

    def disturb(self, robots: Sequence[str]) -> str:
        """One thing about these robots, or what they need, is put to a limit or out of order; what it was."""
        robot = self.chance.choice(robots)
        return f"{self.chance.choice(DISTURBANCES)(self, robot)} of {robot}"

    def _aged(self, robot: str) -> str:
        kind = self.rules.kind_of(robot)
        assert kind is not None
        fluent = self.chance.choice(kind.fluents)
        limit_ns = round(fluent.max_age_s * 1e9)
        age_ns = self.chance.choice((*(limit_ns + off for off in EDGE_NS), *AHEAD_NS))
        self.ages_ns[robot, fluent.name] = age_ns
        return f"{fluent.name} is {age_ns} ns old"

    def _all_aged(self, robot: str) -> str:
        age_ns = 2 * SECOND_NS + self.chance.choice(EDGE_NS)
        self.ages_ns |= {(robot, name): age_ns for name in self.fluents[robot]}
        return f"everything is {age_ns} ns old"

    def _flag(self, robot: str) -> str:
        name, value = self.chance.choice(
            (
                ("unavailable", "no heartbeat"),
                ("stopped", True),
                ("lease", "m2"),
                ("lease", ""),
                ("kind_digest", "another"),
                ("running", "something"),
            )
        )
        self.flags[robot][name] = value
        return f"{name} is {value!r}"

    def _crew_stopped(self, robot: str) -> str:
        self.stopped = True
        return "the stop of the crew"

    def _gone(self, robot: str) -> str:
        self.silent.add(robot)
        return "the silence"

    def _forgotten(self, robot: str) -> str:
        name = self.chance.choice(sorted(self.fluents[robot]) or [""])
        self.fluents[robot].pop(name, None)
        return f"the absence of {name}"

    def _flipped(self, robot: str) -> str:
        """A fluent says the opposite, or something else of its domain, or a place just within or beyond tolerance."""
        kind = self.rules.kind_of(robot)
        assert kind is not None
        fluent = self.chance.choice([f for f in kind.fluents if f.name != "battery"])
        old = self.fluents[robot].get(fluent.name)
        value: FluentValue = {"bool": not old, "object": self.chance.choice(("none", "red_cube", "bottle"))}.get(
            fluent.domain, math.nan
        )
        if fluent.domain == "place":
            place = self.chance.choice(self.rules.crew.locations)
            off_m = fluent.tolerance_m + self.chance.choice((-NEAR_M, NEAR_M, 2.0, -fluent.tolerance_m))
            value = self.chance.choice((Point(place.x + off_m, place.y), Point(math.nan, 0.0)))
        self.fluents[robot][fluent.name] = value
        return f"{fluent.name} says {value}"

    def _value_changed(self, robot: str) -> str:
        """A published value gets old, changes its source, loses its place, or is not seen any more."""
        if not self.values:
            return "nothing"
        name = self.chance.choice(sorted(self.values))
        reading, source = self.values[name]
        limit_ns = (600 if name == "victim" else 3) * SECOND_NS
        how = self.chance.randrange(6)
        if how < 2:
            self.value_ages_ns[name] = self.chance.choice((*(limit_ns + off for off in EDGE_NS), *AHEAD_NS))
            return f"{name} is {self.value_ages_ns[name]} ns old"
        if how == 2:
            self.values[name] = (reading, self.chance.choice([r.name for r in self.rules.crew.robots]))
            return f"{name} comes from {self.values[name][1]}"
        if how == 3:
            del self.values[name]
            return f"{name} is gone"
        position = self.chance.choice((None, Point(math.nan, 0.0), VICTIM, Point(50.0, 0.0), reading.position))
        near = self.chance.choice((reading.near, not reading.near, None))
        status = self.chance.choice(("ok", "ok", "absent"))
        changed = ValueReading(name=name, stamp_ns=reading.stamp_ns, status=status, position=position, near=near)
        self.values[name] = (changed, source)
        return f"{name} is {status} at {position}, near {near}"


DISTURBANCES: Sequence[Callable[[FuzzWorld, str], str]] = (
    *(FuzzWorld._aged, FuzzWorld._aged, FuzzWorld._all_aged, FuzzWorld._flag, FuzzWorld._flag),
    *(FuzzWorld._crew_stopped, FuzzWorld._gone, FuzzWorld._forgotten, FuzzWorld._flipped, FuzzWorld._flipped),
    *(FuzzWorld._value_changed, FuzzWorld._value_changed),
)
