"""A declaration that does not fit together is refused in words when it is loaded, not found out when robots run."""

from typing import Annotated, Any

import pytest
from msgspec.structs import replace

from crew.contracts.kind_check import mistakes
from crew.contracts.kinds.humanoid import HUMANOID
from crew.contracts.kinds.quadruped import QUADRUPED
from crew.contracts.kinds.rover import ROVER
from crew.contracts.skill import Kind, Part, Published, SkillArgs, number
from crew.errors import UsageError
from crew.library import kind_names, load_kind


class Boundless(SkillArgs, frozen=True):
    speed: float
    height: Annotated[float, number(ge=3.0, le=1.0, unit="m", about="Swapped.")]


BY_LOOKING = Published(name="v", type="position", about=".", max_age_s=1.0, by=("look",))


def walking(**changes: Any) -> Kind:
    """The quadruped with a change of its first skill, `navigate`."""
    return replace(QUADRUPED, skills=(replace(QUADRUPED.skills[0], **changes), *QUADRUPED.skills[1:]))


def driving_off(**changes: Any) -> Kind:
    """The rover with a change of its first skill, `navigate_to`."""
    return replace(ROVER, skills=(replace(ROVER.skills[0], **changes), *ROVER.skills[1:]))


def placing(**changes: Any) -> Kind:
    skills = tuple(replace(s, **changes) if s.name == "pick_place" else s for s in HUMANOID.skills)
    return replace(HUMANOID, skills=skills)


@pytest.mark.parametrize("name", kind_names())
def test_what_is_installed_fits_together(name: str) -> None:
    assert mistakes(load_kind(name)) == ()


@pytest.mark.parametrize(
    ("kind", "words"),
    [
        (walking(effects={}), "skill navigate: it has no effect, puts nothing and reports nothing"),
        (walking(effects={"arrived": True}), "effects speaks of 'arrived', which no telemetry shows (declared"),
        (walking(needs={"standng": True}), "no telemetry shows; did you mean 'standing'?"),
        (walking(may=({"legs": "none"},)), "may speaks of 'legs'"),
        (walking(effects={"at": "$goal"}), "effects at is $goal, but it takes no such argument"),
        (walking(effects={"moving": "no"}), "effects moving is 'no', but moving is a bool"),
        (driving_off(effects={"clear_above": True}), "effects speaks of 'clear_above', which other robots change"),
        (walking(effects={"battery": True}), "effects battery is True, but battery is a number"),
        (walking(safe=True), "it is called safe, so it may need nothing"),
        (walking(reports=("requester",)), "it names value 'requester', which is not declared"),
        (walking(forms=(("location",),)), "argument location stands in a form, so it must be optional"),
        (walking(ranges=(("low", "high"),)), "it names argument 'low', which is not declared"),
        (walking(args=Boundless), "argument speed has no bounds; give it ge and le"),
        (walking(args=Boundless), "argument height has no bounds"),
        (placing(puts=("location", "object")), "it names an argument for an object, then one for a location"),
        (placing(puts=("object", "place")), "puts names object, place"),
        (replace(QUADRUPED, skills=(*QUADRUPED.skills, QUADRUPED.skills[0])), "skill navigate is declared twice"),
        (replace(QUADRUPED, parts=(Part(name="tray", holds="moving", about="."),)), "part tray: 'moving' is no"),
        (
            replace(QUADRUPED, publishes=(BY_LOOKING,)),
            "value v: it names skill 'look'",
        ),
    ],
)  # fmt: skip
def test_what_does_not_fit_is_named(kind: Kind, words: str) -> None:
    assert any(words in text for text in mistakes(kind)), mistakes(kind)


def test_a_kind_with_mistakes_is_not_loaded(monkeypatch: pytest.MonkeyPatch) -> None:
    load_kind.cache_clear()
    monkeypatch.setattr("crew.contracts.kinds.quadruped.QUADRUPED", walking(effects={"arrived": True}))
    with pytest.raises(UsageError) as raised:
        load_kind("quadruped")
    load_kind.cache_clear()
    assert str(raised.value).startswith(
        "kind 'quadruped' (crew.contracts.kinds.quadruped:QUADRUPED) does not fit together:\n"
    )
    assert "  skill navigate: effects speaks of 'arrived'" in str(raised.value)
