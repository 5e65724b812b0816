"""Who and what was seen: looks told apart into things, and things into people and others. Pure. World ENU, metres."""

import math
from collections import defaultdict
from collections.abc import Sequence

import msgspec

from crew.adapters.mavlink.camera import Look
from crew.adapters.mavlink.fix import Fix, cluster, locate

APART_M = 2.0
"""Looks within this of a thing's centre are of that thing, or stray ones; what lies beyond may be another."""
LOOKS_MIN = 3
"""Fewer looks than this are no second thing."""
PAIR_M = 0.35
"""Two detections of one frame further apart than this are two things: a frame's pose error moves both alike."""
PAIR_FRAMES = 3


class Crowd(msgspec.Struct, frozen=True):
    """Fixes of people and of what is none, most looks first."""

    people: tuple[Fix, ...]
    others: tuple[Fix, ...]


def tell_apart(looks: Sequence[Look], extent_m: tuple[float, float]) -> Crowd:
    """Everything that was seen. A thing whose extent lies outside `extent_m` is no person."""
    fixes = sorted((locate(part) for group in _groups(looks) for part in _split(group)), key=lambda fix: -fix.looks)
    low_m, high_m = extent_m
    people = [fix for fix in fixes if math.isnan(fix.extent_m) or low_m <= fix.extent_m <= high_m]
    return Crowd(tuple(people), tuple(fix for fix in fixes if fix not in people))


def _groups(looks: Sequence[Look]) -> list[list[Look]]:
    """Looks by neighbourhood, the densest first; stray ones are in none."""
    groups: list[list[Look]] = []
    left = list(looks)
    while left and (not groups or len(left) >= LOOKS_MIN):
        group = cluster(left)
        if groups and len(group) < LOOKS_MIN:
            break
        groups.append(group)
        x_m = sum(look.x_m for look in group) / len(group)
        y_m = sum(look.y_m for look in group) / len(group)
        left = [look for look in left if math.hypot(look.x_m - x_m, look.y_m - y_m) > APART_M]
    return groups


def _split(group: list[Look]) -> list[list[Look]]:
    """Two groups instead of one if several frames show two things in it."""
    pairs = _pairs(group)
    if len(pairs) < PAIR_FRAMES:
        return [group]
    first, second = max(pairs, key=lambda pair: _apart_m(*pair))
    centres = ((first.x_m, first.y_m), (second.x_m, second.y_m))
    parts = [group]
    for _ in range(3):
        parts = [[], []]
        for look in group:
            nearer = min((0, 1), key=lambda i: math.dist(centres[i], (look.x_m, look.y_m)))
            parts[nearer].append(look)
        if not all(parts):
            return [group]
        centres = (_mean(parts[0]), _mean(parts[1]))
    return parts


def _pairs(group: list[Look]) -> list[tuple[Look, Look]]:
    """Of each frame with several detections, the two that are furthest apart, if that is far enough."""
    frames: defaultdict[float, list[Look]] = defaultdict(list)
    for look in group:
        if look.frame >= 0.0:
            frames[look.frame].append(look)
    widest = (
        max(((a, b) for i, a in enumerate(seen) for b in seen[i + 1 :]), key=lambda pair: _apart_m(*pair))
        for seen in frames.values()
        if len(seen) > 1
    )
    return [pair for pair in widest if _apart_m(*pair) > PAIR_M]


def _apart_m(a: Look, b: Look) -> float:
    return math.hypot(a.x_m - b.x_m, a.y_m - b.y_m)


def _mean(looks: list[Look]) -> tuple[float, float]:
    return sum(look.x_m for look in looks) / len(looks), sum(look.y_m for look in looks) / len(looks)
