"""Kinds, skills and fluents: what a robot can do, declared once. Nothing here performs anything."""

import hashlib
import types
from collections.abc import Mapping
from enum import StrEnum
from functools import cached_property
from typing import Annotated, Any, Literal, Union, get_args, get_origin, get_type_hints

import msgspec
from msgspec import Meta

FluentLiteral = bool | str | float
NOTHING = "none"
"""The value of a fluent that may name an object and names none."""


class SkillArgs(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True, omit_defaults=True):
    """Base of a skill's typed arguments: one field an argument, bounds and units in `msgspec.Meta`."""


class Entity(StrEnum):
    """What an argument's text names. A plain number names nothing."""

    NONE = "none"
    LOCATION = "location"
    OBJECT = "object"
    TARGET = "target"
    """A run-time value of type position, or a named location."""


def number(*, ge: float, le: float, unit: str, frame: str = "", axis: str = "", about: str) -> Meta:
    """The `Meta` of a numeric argument: inclusive bounds, unit and frame; `axis` ties it to the operational area."""
    return Meta(ge=ge, le=le, description=about, extra={"unit": unit, "frame": frame, "axis": axis})


def entity(what: Entity, about: str, *, reach: bool = False) -> Meta:
    """The `Meta` of an argument that names a location, an object or a run-time value.

    `reach`: only places that the crew file lists as within the robot's reach.
    """
    return Meta(description=about, extra={"entity": what.value, "reach": reach})


class Param(msgspec.Struct, frozen=True, kw_only=True, dict=True):
    """One argument of a skill, read off its `SkillArgs`."""

    name: str
    entity: Entity = Entity.NONE
    ge: float | None = None
    le: float | None = None
    unit: str = ""
    frame: str = ""
    axis: str = ""
    reach: bool = False
    """Only a place within the robot's reach, which the crew file lists."""
    about: str = ""
    optional: bool = False

    @cached_property
    def is_number(self) -> bool:
        return self.entity is Entity.NONE


class Relation(StrEnum):
    """A fact between robots, which the orchestrator makes of what they tell of themselves; see `separation`."""

    COLUMN_BELOW = "column_below"
    """Nobody stands or drives below this robot."""
    COLUMN_ABOVE = "column_above"
    """Nobody comes down upon this robot."""


class Fluent(msgspec.Struct, frozen=True, kw_only=True):
    """A fact about a robot that is observed: its domain, by whom, and how old it may be."""

    name: str
    domain: Literal["bool", "place", "object", "number"]
    about: str
    relation: Relation | None = None
    """Observed by the orchestrator, of this robot and the others; without it, by the robot's own telemetry."""
    max_age_s: float = 2.0
    tolerance_m: float = 0.0
    """For a place: how far from it still counts as being there."""
    at_rest: FluentLiteral | None = None
    """What it is while a healthy robot waits for its first task; see `resting`."""

    @property
    def resting(self) -> FluentLiteral | None:
        """`at_rest`, or what goes without saying: false, no object; None for a place or a number."""
        usual: dict[str, FluentLiteral] = {"bool": False, "object": NOTHING}
        return usual.get(self.domain) if self.at_rest is None else self.at_rest


class Published(msgspec.Struct, frozen=True, kw_only=True):
    """A run-time value that a kind publishes: made by skills, or observed all the time."""

    name: str
    type: Literal["position"]
    about: str
    max_age_s: float
    by: tuple[str, ...] = ()
    """Skills whose run makes or reports the value; empty if it is observed all the time."""
    each_object: bool = False
    """One value for each object of the crew, under the object's own name."""
    tolerance_m: float = 0.0
    """How far from a place still counts as being there."""


class Part(msgspec.Struct, frozen=True, kw_only=True):
    """A place that is part of a robot and moves along with it, such as a tray."""

    name: str
    aliases: tuple[str, ...] = ()
    holds: str
    """The fluent that tells which object lies there."""
    about: str


class Skill(msgspec.Struct, frozen=True, kw_only=True, dict=True):
    """A skill's declaration. Effects map a fluent to a literal, or to `$argument` for the argument's value."""

    name: str
    about: str
    args: type[SkillArgs]
    forms: tuple[tuple[str, ...], ...] = ((),)
    """Which optional arguments go together: exactly one form must be given, on top of the required arguments."""
    ranges: tuple[tuple[str, str], ...] = ()
    """Pairs of arguments of which the first must be smaller than the second."""
    words: tuple[str, ...]
    """Action words of a request that mean this skill."""
    needs: Mapping[str, FluentLiteral] = {}
    step_needs: Mapping[str, FluentLiteral] = {}
    """Preconditions of a step of a plan, from which the way to the safe state is exempt."""
    effects: Mapping[str, FluentLiteral] = {}
    during: Mapping[str, FluentLiteral] = {}
    may: tuple[Mapping[str, FluentLiteral], ...] = ()
    """Leftovers that a failure may leave behind."""
    puts: tuple[str, str] | None = None
    """The arguments that name an object and the place where it must be seen afterwards.

    At a part of a robot its host sees it; anywhere else the object's published position shows it.
    """
    reports: tuple[str, ...] = ()
    """Published values that a run of this skill renews."""
    timeout_s: float
    cost: float = 1.0
    on_stop: str
    on_link_loss: str
    safe: bool = False
    """May serve as a safe state's skill: then it has no preconditions."""

    @cached_property
    def all_needs(self) -> Mapping[str, FluentLiteral]:
        """Preconditions of a step."""
        return {**self.needs, **self.step_needs}

    @cached_property
    def params(self) -> tuple[Param, ...]:
        return _params(self.args)

    @cached_property
    def targets(self) -> tuple[Param, ...]:
        """The arguments whose place may be known at run time alone."""
        return tuple(p for p in self.params if p.entity is Entity.TARGET)

    @cached_property
    def required(self) -> tuple[str, ...]:
        """The arguments that every call gives."""
        return tuple(p.name for p in self.params if not p.optional)

    @cached_property
    def optional(self) -> frozenset[str]:
        """The arguments of which a call gives one form."""
        return frozenset(p.name for p in self.params if p.optional)

    @cached_property
    def form_sets(self) -> frozenset[frozenset[str]]:
        """The forms, in whatever order their arguments come."""
        return frozenset(map(frozenset, self.forms))

    @cached_property
    def _param_by_name(self) -> dict[str, Param]:
        return {p.name: p for p in self.params}

    def param(self, name: str) -> Param | None:
        return self._param_by_name.get(name)


class Kind(msgspec.Struct, frozen=True, kw_only=True, dict=True):
    """A kind of robot: its fluents, its skills, the values it publishes, what it does when left alone."""

    name: str
    about: str
    aliases: tuple[str, ...]
    fluents: tuple[Fluent, ...]
    skills: tuple[Skill, ...]
    publishes: tuple[Published, ...] = ()
    parts: tuple[Part, ...] = ()
    idle_on_stop: str
    idle_on_link_loss: str

    @cached_property
    def _skill_by_name(self) -> dict[str, Skill]:
        return {s.name: s for s in self.skills}

    @cached_property
    def _fluent_by_name(self) -> dict[str, Fluent]:
        return {f.name: f for f in self.fluents}

    @cached_property
    def own_fluents(self) -> tuple[Fluent, ...]:
        """What a robot's own telemetry tells; the rest are facts between robots."""
        return tuple(f for f in self.fluents if f.relation is None)

    def skill(self, name: str) -> Skill | None:
        return self._skill_by_name.get(name)

    def fluent(self, name: str) -> Fluent | None:
        return self._fluent_by_name.get(name)

    def part(self, name: str) -> Part | None:
        return next((p for p in self.parts if p.name == name), None)

    @cached_property
    def digest(self) -> str:
        """SHA-256 over the whole declaration: two sides with the same digest mean the same bounds and effects."""
        return hashlib.sha256(msgspec.json.encode(_plain(self), order="sorted")).hexdigest()


def _plain(value: Any) -> Any:
    """A declaration as builtins; a `SkillArgs` class becomes its parameters."""
    if isinstance(value, type) and issubclass(value, SkillArgs):
        return [_plain(p) for p in _params(value)]
    if isinstance(value, msgspec.Struct):
        return {f: _plain(getattr(value, f)) for f in value.__struct_fields__}
    if isinstance(value, Mapping):
        return {str(k): _plain(v) for k, v in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(v) for v in value]
    return value


def _params(args: type[SkillArgs]) -> tuple[Param, ...]:
    hints = get_type_hints(args, include_extras=True)
    optional = {f.name for f in msgspec.structs.fields(args) if not f.required}
    return tuple(_param(name, hints[name], name in optional) for name in args.__struct_fields__)


def _param(name: str, hint: Any, optional: bool) -> Param:
    meta = _meta(hint)
    extra = (meta.extra if meta else None) or {}
    return Param(
        name=name,
        entity=Entity(extra.get("entity", "none")),
        ge=None if meta is None or meta.ge is None else float(meta.ge),
        le=None if meta is None or meta.le is None else float(meta.le),
        unit=extra.get("unit", ""),
        frame=extra.get("frame", ""),
        axis=extra.get("axis", ""),
        reach=extra.get("reach", False),
        about=(meta.description if meta else None) or "",
        optional=optional,
    )


def _meta(hint: Any) -> Meta | None:
    """The `Meta` of an annotation, also inside `X | None`."""
    if get_origin(hint) is Annotated:
        return next((m for m in get_args(hint)[1:] if isinstance(m, Meta)), None)
    if get_origin(hint) in (Union, types.UnionType):
        return next((m for m in map(_meta, get_args(hint)) if m is not None), None)
    return None
