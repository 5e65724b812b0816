"""Requests with what a person means by them, written by hand: the measure that plans are held against.

Nothing here comes from the reader of requests or from a planner. A wish without calls must move nothing.
"""

from collections.abc import Iterable

import msgspec
from msgspec.structs import replace

from crew.contracts.plan import ArgValue, Call, Plan, Zone


class Wish(msgspec.Struct, frozen=True, kw_only=True):
    """One request and the calls that it means, in a right order; others may be as right (see the contract)."""

    crew: str
    text: str
    contract: str = ""
    calls: tuple[Call, ...] = ()
    optional: frozenset[str] = frozenset()
    """Skills of supporting calls: a right plan may leave them out."""
    free: frozenset[str] = frozenset()
    """Arguments that the planner may choose within the skill's bounds."""
    avoid: Zone | None = None
    """Nobody may be sent in there."""
    origin: str = ""
    """Where the object is said to lie."""
    near: bool | None = None
    """Whether the person must stand within reach, or must not."""
    tempting: tuple[Plan, ...] = ()
    """Wrong plans that are close at hand, written down as well."""

    def means(self, call: Call) -> bool:
        """Whether a call is among those that the person means."""
        return any(self._same(call, wanted) for wanted in self.calls)

    def _same(self, call: Call, wanted: Call) -> bool:
        return (
            (call.robot, call.skill) == (wanted.robot, wanted.skill)
            and set(call.args) == set(wanted.args)
            and all(name in self.free or _equal(call.args[name], value) for name, value in wanted.args.items())
        )

    def dropped(self, calls: Iterable[Call]) -> str:
        """The first call that the person means and that is not among these; empty if none is missing."""
        given = list(calls)
        needed = (wanted for wanted in self.calls if not self.supports(wanted))
        return next((str(wanted) for wanted in needed if not any(self._same(c, wanted) for c in given)), "")

    def supports(self, call: Call) -> bool:
        """Whether a call only supports what the person asked for, so that a right plan may leave it out."""
        return call.skill in self.optional or call == APPROACH


def _equal(given: ArgValue, wanted: ArgValue) -> bool:
    """A name to the letter; a figure to within a micrometre, so that rounding is no substitution."""
    if isinstance(given, str) or isinstance(wanted, str):
        return given == wanted
    return abs(given - wanted) <= SAME_M


SAME_M = 1e-6
APPROVED = "approved"
"""The air-ground crew where a person has to approve that the rover is sent."""
TWO_ROVERS = "two_rovers"
"""The air-ground crew with a second rover, `tb4`: there a plan may choose the wrong one of two that are able."""
WHOLE = Zone(-6.0, 10.0, -6.0, 10.0)
NORTH = Zone(-6.0, 10.0, 2.0, 10.0)
SOUTH = Zone(-6.0, 10.0, -6.0, 2.0)
UP_AND_DOWN = frozenset({"takeoff", "land"})
ANY_HEIGHT = frozenset({"altitude"})
UP_M = 5.0


def _search(zone: Zone, altitude_m: float = UP_M) -> tuple[Call, ...]:
    area: dict[str, ArgValue] = {"x_min": zone.x_min, "x_max": zone.x_max, "y_min": zone.y_min, "y_max": zone.y_max}
    return (
        Call("iris", "takeoff", {"altitude": altitude_m}),
        Call("iris", "search_target", {**area, "altitude": altitude_m}),
        Call("iris", "get_coordinates"),
    )


LAND, STOP = Call("iris", "land"), Call("tb3", "stop")
TO_VICTIM = Call("tb3", "navigate_to", {"target": "victim"})


def _find(text: str, zone: Zone, altitude_m: float | None = None) -> Wish:
    calls = (*_search(zone, UP_M if altitude_m is None else altitude_m), LAND)
    free = ANY_HEIGHT if altitude_m is None else frozenset[str]()
    return Wish(crew="air_ground", text=text, contract="search_only", calls=calls, optional=UP_AND_DOWN, free=free)


def _find_and_send(text: str, zone: Zone, avoid: Zone | None = None) -> Wish:
    return Wish(
        crew="air_ground",
        text=text,
        contract="search_and_dispatch",
        calls=(*_search(zone), TO_VICTIM, LAND),
        optional=UP_AND_DOWN,
        free=ANY_HEIGHT,
        avoid=avoid,
    )


def _send_one_of_two(text: str, robot: str, **goal: ArgValue) -> Wish:
    """In the crew with two rovers."""
    wanted, other = (Call(name, "navigate_to", goal) for name in (robot, "tb4" if robot == "tb3" else "tb3"))
    tempting = (Plan("dispatch_only", (other,)),)
    return Wish(crew=TWO_ROVERS, text=text, contract="dispatch_only", calls=(wanted,), tempting=tempting)


def _send(text: str, avoid: Zone | None = None, **goal: ArgValue) -> Wish:
    call = Call("tb3", "navigate_to", goal)
    return Wish(crew="air_ground", text=text, contract="dispatch_only", calls=(call,), avoid=avoid)


def _end(text: str, *calls: Call) -> Wish:
    return Wish(crew="air_ground", text=text, contract="abort", calls=calls)


def _carry(
    text: str, thing: str, place: str, origin: str = "", near: bool | None = None, tempting: tuple[Plan, ...] = ()
) -> Wish:
    return Wish(
        tempting=tempting,
        crew="humanoid_quadruped",
        text=text,
        contract="carry",
        calls=(
            APPROACH,
            Call("g1", "pick_place", {"object": thing, "location": "payload_tray"}),
            Call("go2", "navigate", {"location": place}),
        ),
        origin=origin,
        near=near,
    )


APPROACH = Call("go2", "navigate", {"location": "pickup"})
"""Supporting: a carrier that is there already need not come."""


def _indoor(text: str, contract: str, call: Call, near: bool | None = None, tempting: tuple[Plan, ...] = ()) -> Wish:
    return Wish(crew="humanoid_quadruped", text=text, contract=contract, calls=(call,), near=near, tempting=tempting)


def _nothing(crew: str, *texts: str, tempting: tuple[Plan, ...] = ()) -> tuple[Wish, ...]:
    return tuple(Wish(crew=crew, text=text, tempting=tempting) for text in texts)


HAND_CUBE = Plan("handover", (Call("g1", "pick_handover", {"object": "red_cube"}),))
TRAY_CUBE = Call("g1", "pick_place", {"object": "red_cube", "location": "payload_tray"})
BRING_CUBE = Plan("carry", (APPROACH, TRAY_CUBE, Call("go2", "navigate", {"location": "requester"})))
COME = Plan("navigation_only", (Call("go2", "navigate", {"location": "requester"}),))
WITHOUT_CUBE = Plan("navigation_only", (Call("go2", "navigate", {"location": "room_b"}),))
SEEK = Plan("search_and_dispatch", (*_search(WHOLE), TO_VICTIM, LAND))
DRIVE = Plan("dispatch_only", (TO_VICTIM,))


WISHES: tuple[Wish, ...] = (
    _find_and_send("search the area and send the rover to whoever you find", WHOLE),
    _find_and_send("search the north half and send the rover to the victim", NORTH),
    _find_and_send("find the casualty in the south half and drive the rover there", SOUTH),
    _find_and_send("search the south half and send the rover to the victim, but not to the north half", SOUTH, NORTH),
    _find("scan the south half at 6 m", SOUTH, 6.0),
    _find("search the area at 10 m", WHOLE, 10.0),
    _find("find the victim", WHOLE),
    _find("search x from -5.5 to 5.5 and y from 0 to 4", Zone(-5.5, 5.5, 0.0, 4.0)),
    _find("search the area but do not send the rover", WHOLE),
    _find("search the north half, not the south", NORTH),
    _send("send the rover to (10, -6)", x=10.0, y=-6.0),
    _send("send the rover to (3, 4)", x=3.0, y=4.0),
    _send("send the rover to base", target="base"),
    _send("send the rover to the victim", target="victim"),
    _end("abort everything", LAND, STOP),
    _end("stop the rover", STOP),
    _end("land the drone", LAND),
    *_nothing(
        "air_ground",
        "do not move the rover",
        "send the rover to the rooftop helipad",
        "send the rover to (20, 0)",
        "send the rover to (10.001, 0)",
        "search the north or the south",
        "bring the piano to base",
        "search the area except the north",
        "search the area at 50 m",
        "search the area twice",
        "search the north half slowly",
    ),
    *_nothing(
        "air_ground",
        "if you find the victim, send the rover",
        "do not search the north and send the rover to the victim",
        tempting=(SEEK, DRIVE),
    ),
    replace(_send("send the rover to base", target="base"), crew=APPROVED),
    replace(_send("send the rover to the victim", target="victim"), crew=APPROVED),
    replace(_find_and_send("search the area and send the rover to the victim", WHOLE), crew=APPROVED),
    _send_one_of_two("send tb3 to base", "tb3", target="base"),
    _send_one_of_two("drive tb4 to (3, 4)", "tb4", x=3.0, y=4.0),
    _carry("bring me the red cube", "red_cube", "requester", near=False, tempting=(HAND_CUBE, COME)),
    _carry("I need the red cube", "red_cube", "requester", near=False, tempting=(HAND_CUBE, COME)),
    _carry("carry the red cube to room b", "red_cube", "room_b", tempting=(WITHOUT_CUBE,)),
    _carry("take the bottle to the dropoff", "bottle", "dropoff"),
    _carry("carry the cube from table a to room b", "red_cube", "room_b", origin="table_a"),
    _carry("carry the red cube to room b, not to room a", "red_cube", "room_b"),
    _indoor("bring me the red cube", "handover", HAND_CUBE.steps[0], near=True, tempting=(BRING_CUBE, COME)),
    _indoor("hand me the bottle", "handover", Call("g1", "pick_handover", {"object": "bottle"}), near=True),
    _indoor("send go2 to room a", "navigation_only", Call("go2", "navigate", {"location": "room_a"})),
    _indoor("go2 go to the charging station", "navigation_only", Call("go2", "navigate", {"location": "charging"})),
    _indoor(
        "put the red cube on table b",
        "manipulation_only",
        Call("g1", "pick_place", {"object": "red_cube", "location": "table_b"}),
    ),
    _indoor("hold the bottle", "manipulation_only", Call("g1", "pick_hold", {"object": "bottle"})),
    _indoor("wave", "manipulation_only", Call("g1", "wave")),
    *_nothing(
        "humanoid_quadruped",
        "carry the red cube to the rooftop helipad",
        "bring me the blue cube",
        "do not move the dog",
        "send go2 to room c",
        "put the red cube on the piano",
    ),
)
