"""The phases of a flight as a table. Pure: says what follows from an event, does nothing.

A pair that is not in the table is an event that the phase does not take: a refused command, or nothing.
"""

from enum import StrEnum, auto


class Phase(StrEnum):
    DISARMED = auto()  # on the ground, rotors still
    ARMED = auto()  # on the ground, rotors turning
    TAKEOFF = auto()
    HOLD = auto()  # in the air: at a point or on the way to one
    RETURN = auto()
    LAND = auto()
    LANDED = auto()  # on the ground after a flight, about to disarm


class Event(StrEnum):
    ARM = auto()
    DISARM = auto()
    KILL = auto()  # a forced disarm
    TAKEOFF = auto()
    HOLD = auto()
    REPOSITION = auto()
    RETURN = auto()
    LAND = auto()
    REACHED = auto()  # the target, by telemetry
    TOUCHDOWN = auto()
    IDLE = auto()  # armed on the ground for too long


P, E = Phase, Event
AIRBORNE = frozenset({P.TAKEOFF, P.HOLD, P.RETURN, P.LAND})

_FLYING = {E.HOLD: P.HOLD, E.REPOSITION: P.HOLD, E.RETURN: P.RETURN, E.LAND: P.LAND}

TABLE: dict[tuple[Phase, Event], Phase] = {
    (P.DISARMED, E.ARM): P.ARMED,
    (P.DISARMED, E.DISARM): P.DISARMED,
    (P.DISARMED, E.HOLD): P.DISARMED,
    (P.ARMED, E.ARM): P.ARMED,
    (P.ARMED, E.DISARM): P.DISARMED,
    (P.ARMED, E.TAKEOFF): P.TAKEOFF,
    (P.ARMED, E.HOLD): P.ARMED,
    (P.ARMED, E.LAND): P.LANDED,
    (P.ARMED, E.RETURN): P.LANDED,
    (P.ARMED, E.IDLE): P.DISARMED,
    (P.TAKEOFF, E.REACHED): P.HOLD,
    (P.RETURN, E.REACHED): P.LAND,
    (P.LAND, E.TOUCHDOWN): P.LANDED,
    (P.LANDED, E.DISARM): P.DISARMED,
    (P.LANDED, E.TAKEOFF): P.TAKEOFF,
    (P.LANDED, E.HOLD): P.ARMED,
    (P.LANDED, E.LAND): P.LANDED,
    (P.LANDED, E.IDLE): P.DISARMED,
    **{(phase, E.ARM): phase for phase in (*AIRBORNE, P.LANDED)},
    **{(phase, event): after for phase in AIRBORNE for event, after in _FLYING.items()},
    **{(phase, E.KILL): P.DISARMED for phase in Phase},
}


def follow(phase: Phase, event: Event) -> Phase | None:
    """The phase after `event`, or None if `phase` does not take it."""
    return TABLE.get((phase, event))
