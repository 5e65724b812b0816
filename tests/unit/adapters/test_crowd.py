"""Who was seen: people told apart from each other, and from what is no person."""

import math
from random import Random

from crew.adapters.mavlink.camera import Look
from crew.adapters.mavlink.crowd import tell_apart

PERSON_M = (0.1, 0.8)


def around(x: float, y: float, frames: range, extent_m: float = 0.4, spread: float = 0.12) -> list[Look]:
    random = Random(f"{x}/{y}")
    return [
        Look(x + random.gauss(0, spread), y + random.gauss(0, spread), 5.0, i * 0.2, float(i), extent_m) for i in frames
    ]


def test_two_people_well_apart_are_two() -> None:
    crowd = tell_apart(around(5.0, 5.0, range(20)) + around(-3.0, 4.0, range(30, 38)), PERSON_M)
    assert [round(person.x_m) for person in crowd.people] == [5, -3]
    assert crowd.others == ()


def test_two_people_side_by_side_are_two_because_frames_show_both() -> None:
    looks = around(5.0, 5.0, range(20), spread=0.05) + around(5.7, 5.0, range(20), spread=0.05)
    crowd = tell_apart(looks, PERSON_M)
    assert sorted(round(person.x_m, 1) for person in crowd.people) == [5.0, 5.7]


def test_one_person_whose_looks_scatter_as_widely_is_one() -> None:
    crowd = tell_apart(around(5.0, 5.0, range(20), spread=0.3), PERSON_M)
    assert len(crowd.people) == 1


def test_a_thing_of_another_extent_is_no_person_however_often_it_was_seen() -> None:
    crowd = tell_apart(around(5.0, 5.0, range(6)) + around(-3.0, 4.0, range(20, 80), 1.9), PERSON_M)
    assert [round(person.x_m) for person in crowd.people] == [5]
    assert [round(other.x_m) for other in crowd.others] == [-3]


def test_a_detector_that_tells_no_extent_is_believed() -> None:
    assert len(tell_apart(around(5.0, 5.0, range(6), math.nan), PERSON_M).people) == 1


def test_stray_looks_are_nobody() -> None:
    strays = [Look(9.0, 9.0, 5.0, 3.0, 300.0), Look(-4.0, 0.0, 5.0, 4.0, 301.0)]
    crowd = tell_apart(around(5.0, 5.0, range(20)) + strays, PERSON_M)
    assert len(crowd.people) == 1
    assert tell_apart([], PERSON_M).people == ()
