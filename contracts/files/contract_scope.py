"""What the names in a contract file may mean: slots, roles with the kinds behind them, and the crew's own names."""

from collections.abc import Iterable, Mapping

import msgspec

from crew.contracts.contract import Slot, SlotType
from crew.contracts.files.contract_model import ContractModel
from crew.contracts.matching import FIELDS
from crew.contracts.site import Crew, RobotSpec
from crew.contracts.skill import Fluent, Kind, Skill

PLACE_SLOTS = {SlotType.LOCATION, SlotType.POINT, SlotType.VALUE}


class Scope(msgspec.Struct, frozen=True, kw_only=True):
    """The vocabulary of one contract in one crew."""

    crew: Crew
    kinds: tuple[Kind, ...]
    """The kinds of the crew's robots."""
    slots: Mapping[str, Slot]
    casts: Mapping[str, tuple[RobotSpec, ...]]
    """Role to the robots that have every skill it needs; to all robots if none has."""
    uncast: frozenset[str]
    """Roles that no robot can play: of their fluents it is only asked that some kind has them."""
    by_name: Mapping[str, Kind]

    @property
    def values(self) -> list[str]:
        return [value.name for value in self.crew.values]

    @property
    def objects(self) -> list[str]:
        return [thing.name for thing in self.crew.objects]

    @property
    def locations(self) -> list[str]:
        return [place.name for place in self.crew.locations] + self.parts

    @property
    def parts(self) -> list[str]:
        """Places that are parts of robots."""
        return list(dict.fromkeys(part.name for kind in self.kinds for part in kind.parts))

    @property
    def zones(self) -> list[str]:
        return [zone.name for zone in self.crew.zones]

    def kinds_of(self, role: str) -> tuple[Kind, ...]:
        """The kinds that may play a role, each once."""
        return distinct(self.by_name[spec.kind] for spec in self.casts[role])

    def skill_of(self, role: str, name: str) -> Skill | None:
        """A skill of one of the kinds that may play the role."""
        return next((skill for kind in self.kinds_of(role) if (skill := kind.skill(name))), None)

    def fluent_of(self, role: str, name: str) -> Fluent | None:
        """A fluent that every kind that may play the role has."""
        found = [kind.fluent(name) for kind in self.kinds_of(role)]
        if role in self.uncast:
            return next((fluent for fluent in found if fluent), None)
        return found[0] if found and all(found) else None


def scope_of(model: ContractModel, crew: Crew, kinds: Mapping[str, Kind]) -> Scope:
    robots = [spec for spec in crew.robots if spec.kind in kinds]
    known = distinct(kinds[spec.kind] for spec in robots)
    real = {skill.name for kind in known for skill in kind.skills}
    able: dict[str, list[RobotSpec]] = {}
    for role in model.roles:
        needed = needed_skills(model, role) & real
        able[role] = [spec for spec in robots if all(kinds[spec.kind].skill(name) for name in needed)]
    return Scope(
        crew=crew,
        kinds=known,
        slots={name: slot_of(name, model, crew) for name in model.slots},
        casts={role: tuple(found or robots) for role, found in able.items()},
        uncast=frozenset(role for role, found in able.items() if not found),
        by_name=kinds,
    )


def needed_skills(model: ContractModel, role: str) -> set[str]:
    """Skills that a robot needs to play a role; a step with a choice of skills asks for none of them."""
    needed = set()
    for step in model.steps.values():
        skills = {skill for call in step.do for skill in call}
        if step.role == role and len(skills) == 1:
            needed |= skills
    return needed


def slot_of(name: str, model: ContractModel, crew: Crew) -> Slot:
    """A slot as data; types that name nothing are left out (`contract_check` reports them)."""
    written = model.slots[name]
    values = tuple(word for word in written.type if crew.value(word) is not None and word not in PLAIN_TYPES)
    plain = tuple(SlotType(word) for word in written.type if word in PLAIN_TYPES)
    return Slot(
        name=name,
        types=(*plain, SlotType.VALUE) if values else plain,
        values=values,
        default=written.default,
        free=written.free,
        optional=written.optional,
        said_from=written.said == "from",
        beyond=written.beyond or "",
    )


PLAIN_TYPES = tuple(kind.value for kind in SlotType if kind is not SlotType.VALUE)
"""What a slot's `type` may say beside the name of a run-time value."""


def fields_of(slot: Slot) -> list[str]:
    """The fields that `$slot.field` may name."""
    return [field for kind in slot.types for field in FIELDS.get(kind, ())]


def distinct(kinds: Iterable[Kind]) -> tuple[Kind, ...]:
    return tuple({kind.name: kind for kind in kinds}.values())
