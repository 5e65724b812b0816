"""Why a run-time position can't be used, in words made here from numbers: text of a robot is never passed on.

And the question that a person has to answer then, where there is one: nobody chooses for them.
"""

from crew.contracts.snapshot import Point, StampedValue

WORDS = {
    "absent": "nobody was seen",
    "ambiguous": "more than one was seen",
    "uncertain": "somebody may have been seen, too seldom or not from above",
    "outside_zone": "somebody was seen, but outside the zone that was to be searched",
    "not_a_person": "something was seen that has not the shape of a person",
}


def why_no_position(name: str, stamped: StampedValue) -> str:
    """`status: words`, with the number of places."""
    reading = stamped.reading
    if reading.status not in WORDS:
        return f"no position: {stamped.source} reports none"
    seen = places(reading.candidates)
    return (
        f"{reading.status}: {stamped.source} reports of {name}: {WORDS[reading.status]}{f' at {seen}' if seen else ''}"
    )


def question(name: str, stamped: StampedValue | None) -> str:
    """What to ask a person; empty if there is nothing that a person could decide."""
    if stamped is None or stamped.reading.status not in WORDS or not stamped.reading.candidates:
        return ""
    status, seen = stamped.reading.status, places(stamped.reading.candidates)
    if status == "ambiguous":
        return f"Which of them is {name}: {seen}? Ask again with the point itself."
    return f"{WORDS[status].capitalize()}: {seen}. Is that {name}? If so, ask again with the point itself."


def places(points: tuple[Point, ...]) -> str:
    """Points in words, for reading and for asking again."""
    return " or ".join(f"({point.x:.2f}, {point.y:.2f})" for point in points[:8])
