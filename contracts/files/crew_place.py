"""What a crew's places mean together with its kinds: whom a part belongs to, and what a robot that stands reaches."""

from collections.abc import Mapping

from crew.contracts.files.crew_check import plain_words
from crew.contracts.files.source import Problems
from crew.contracts.site import Crew, RobotSpec
from crew.contracts.skill import Kind


def check_places(crew: Crew, kinds: Mapping[str, Kind], problems: Problems) -> None:
    """Every mistake that shows only once the kinds are known, added to `problems`."""
    parts = {part.name: robot for robot in crew.robots for part in kinds[robot.kind].parts}
    spoken = {plain_words(w): p for k in kinds.values() for p in k.parts for w in (p.name, *p.aliases)}
    for group in ("robots", "locations", "zones", "objects", "values"):
        for thing in getattr(crew, group):
            for words in (thing.name, *thing.aliases):
                if plain_words(words) in spoken:
                    part = spoken[plain_words(words)]
                    what = f"{words!r} means the {part.name} of {parts[part.name].name} already"
                    problems.key((group, thing.name), what, fix="rename it")
    for robot in crew.robots:
        _check_reach(robot, kinds[robot.kind], [*(p.name for p in crew.locations), *parts], problems)


def _check_reach(robot: RobotSpec, kind: Kind, places: list[str], problems: Problems) -> None:
    loc = ("robots", robot.name)
    bound = [skill.name for skill in kind.skills if any(param.reach for param in skill.params)]
    if bound and not robot.reach:
        fix = f"write reach: [...] with the places that {robot.name} reaches from where it stands"
        problems.key(loc, f"{robot.name} has no reach, which {', '.join(bound)} of a {kind.name} needs", fix=fix)
    elif robot.reach and not bound:
        fix = "remove it"
        problems.key((*loc, "reach"), f"no skill of a {kind.name} places anything within a reach", fix=fix)
    for index, place in enumerate(robot.reach):
        if place not in places:
            problems.unknown((*loc, "reach", index), "unknown place", place, places)
