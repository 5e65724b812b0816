"""Kinds are declarations: what they say must fit together, and their digest must change with any of it."""

import pytest
from msgspec.structs import replace

from crew.contracts.kinds.humanoid import HUMANOID
from crew.contracts.kinds.quadcopter import QUADCOPTER
from crew.contracts.kinds.quadruped import QUADRUPED
from crew.contracts.kinds.rover import ROVER
from crew.contracts.skill import Entity, Kind
from crew.library import kind_names, load_kind

KINDS = (QUADCOPTER, ROVER, HUMANOID, QUADRUPED)
by_name = pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.name)


def test_the_kinds_are_installed() -> None:
    assert {kind.name for kind in KINDS} <= set(kind_names())
    assert all(load_kind(kind.name) is kind for kind in KINDS)


@by_name
def test_skills_speak_only_of_declared_fluents_and_arguments(kind: Kind) -> None:
    for skill in kind.skills:
        spoken = {*skill.all_needs, *skill.effects, *skill.during, *(name for left in skill.may for name in left)}
        assert all(kind.fluent(name) for name in spoken), skill.name
        assert all(skill.param(low) and skill.param(high) for low, high in skill.ranges), skill.name
        assert all((param := skill.param(name)) and param.optional for form in skill.forms for name in form), skill.name


@by_name
def test_a_safe_skill_needs_nothing_and_shows_its_effect(kind: Kind) -> None:
    """A safe call is judged by the freshness of its effects: without any it could never be sent."""
    safe = [skill for skill in kind.skills if skill.safe]
    assert safe or not any(fluent.domain == "place" for fluent in kind.fluents), "a robot that travels can be ended"
    assert all(not skill.needs and not skill.params and skill.effects for skill in safe)


@by_name
def test_every_skill_shows_what_telemetry_did_not_show_at_rest(kind: Kind) -> None:
    """An effect that holds already would count as done whatever the robot did; a safe skill may find it done."""
    for skill in kind.skills:
        new = [f for f, value in skill.effects.items() if (known := kind.fluent(f)) and known.resting != value]
        assert new or skill.puts or skill.reports or skill.safe, skill.name


@by_name
def test_what_is_put_somewhere_is_named_by_arguments_and_parts_hold_an_object(kind: Kind) -> None:
    for skill in kind.skills:
        if skill.puts is not None:
            entities = [param.entity for name in skill.puts if (param := skill.param(name))]
            assert entities == [Entity.OBJECT, Entity.LOCATION]
    for part in kind.parts:
        assert (fluent := kind.fluent(part.holds)) is not None
        assert fluent.domain == "object"


@by_name
def test_what_a_skill_reports_is_what_the_kind_publishes(kind: Kind) -> None:
    reported = {(skill.name, value) for skill in kind.skills for value in skill.reports}
    assert reported == {(skill, published.name) for published in kind.publishes for skill in published.by}


@by_name
def test_every_number_has_bounds_a_unit_and_words(kind: Kind) -> None:
    for skill in kind.skills:
        for param in skill.params:
            assert param.about
            if param.entity is Entity.NONE:
                assert param.ge is not None
                assert param.le is not None
                assert param.ge < param.le
                assert param.unit


@by_name
def test_the_digest_changes_with_the_declaration(kind: Kind) -> None:
    skill, fluent = kind.skills[0], kind.fluents[0]
    changed = (
        replace(kind, about="Another."),
        replace(kind, skills=kind.skills[1:]),
        replace(kind, skills=(replace(skill, timeout_s=1.0), *kind.skills[1:])),
        replace(kind, skills=(replace(skill, args=kind.skills[-1].args), *kind.skills[1:])),
        replace(kind, fluents=(replace(fluent, max_age_s=60.0), *kind.fluents[1:])),
    )
    digests = {kind.digest, *(other.digest for other in changed)}
    assert len(digests) == len(changed) + 1
    assert replace(kind).digest == kind.digest
