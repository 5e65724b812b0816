"""The text of a draft: slots from the skills' arguments, order from the wishes, safe states from the kinds."""

from collections.abc import Iterator, Mapping, Sequence

from crew.contracts.scaffold.cast import cast, prepared, skill_of
from crew.contracts.scaffold.invariant import Guard, guards_of
from crew.contracts.scaffold.wish import NAME, Wish, WishError
from crew.contracts.site import Rules
from crew.contracts.skill import NOTHING, Entity, FluentLiteral, Kind, Param

ZONE = ("x_min", "x_max", "y_min", "y_max")
DEADLINE_MARGIN = 2.0
"""The deadline is this times the skills' own time limits."""
WORDS = 3
"""Words of a skill that the example offers."""
Line = Iterator[str]


class Draft:
    """Collects the parts of one contract while its steps are gone through."""

    def __init__(self, name: str, wishes: Sequence[Wish], rules: Rules) -> None:
        if not NAME.fullmatch(name):
            raise WishError(f"{name!r} is no name; use small letters, digits and _, a letter first")
        if not wishes:
            raise WishError("a contract needs a step; give --do <role>.<skill>, once for each step")
        self.name, self.rules, self.wishes = name, rules, wishes
        self.kinds = cast(wishes, rules)
        self.steps = prepared(self._approached(wishes), self.kinds)
        self.slots: dict[str, str] = {}
        self.names = self._step_names()
        self.calls = [self._call(wish, optional) for wish, optional in self.steps]

    def text(self) -> str:
        """The whole file."""
        return "\n".join(self._lines()) + "\n"

    def _lines(self) -> Line:
        yield f"contract: {self.name}"
        yield f"summary: {self._summary()}"
        yield "examples:"
        yield f"  - {self._example()}"
        if self.slots:
            yield "slots:"
            yield from (f"  {name}: {written}" for name, written in self.slots.items())
        yield "roles:"
        yield from (f"  {role}: {{safe: {_safe(kind)}}}" for role, kind in self.kinds.items())
        yield f"asks: [{', '.join(self._asked())}]"
        yield "steps:"
        for index, (wish, optional) in enumerate(self.steps):
            yield from self._step(index, wish, optional)
        complete = self._complete()
        if complete:
            yield f"complete: [{', '.join(complete)}]"
        yield f"deadline_s: {DEADLINE_MARGIN * sum(skill_of(w, self.kinds).timeout_s for w, _ in self.steps):g}"

    def _summary(self) -> str:
        abouts = [skill_of(wish, self.kinds).about.rstrip(".") for wish in self.wishes]
        sentences = [abouts[0], *(about[:1].lower() + about[1:] for about in abouts[1:])]
        return f"{', then '.join(sentences)}.".replace(": ", ", ")

    def _example(self) -> str:
        """Words of the skills with what they are done to, one clause a wish."""
        clauses = []
        for wish, args in ((w, a) for (w, optional), a in zip(self.steps, self.calls, strict=True) if not optional):
            words = list(skill_of(wish, self.kinds).words[:WORDS])
            verb = f"({'|'.join(words)})" if len(words) > 1 else words[0]
            things = dict.fromkeys(v[1:].partition(".")[0] for v in args.values() if v.startswith("$"))
            said = [n for n in things if "free: true" not in self.slots[n]]
            clauses.append(" ".join([verb, *(f"{_joint(self.slots[n])}{{{n}}}" for n in said)]))
        return " and ".join(clauses)

    def _step(self, index: int, wish: Wish, optional: bool) -> Line:
        yield f"  {self.names[index]}:"
        yield f"    role: {wish.role}"
        if index:
            yield f"    after: [{self.names[index - 1]}]"
        if optional:
            yield "    optional: true"
        guards = dict.fromkeys(map(str, self._guards(index, wish)))
        if guards:
            yield f"    needs: [{', '.join(guards)}]"
        args = ", ".join(f"{name}: {value}" for name, value in self.calls[index].items())
        yield f"    do: {{{wish.skill}: {{{args}}}}}"

    def _guards(self, index: int, wish: Wish) -> Iterator[Guard]:
        """A robot that is loaded stands still and is empty; loaded, it does nothing before the load is seen.

        What must never happen by another contract of the crew must not happen by this one either.
        """
        place = self._put_on(index)
        if place:
            host, fluent = place
            if self.kinds[host].fluent("moving"):
                yield Guard(path=f"{host}.moving", value=False)
            yield Guard(path=f"{host}.{fluent}", value=NOTHING)
        for earlier in range(index):
            place = self._put_on(earlier)
            if place and place[0] == wish.role:
                skill = skill_of(self.steps[earlier][0], self.kinds)
                assert skill.puts is not None, "only such a skill puts something on a robot"
                yield Guard(path=f"{place[0]}.{place[1]}", value=self.calls[earlier][skill.puts[0]])
        yield from guards_of(wish, self.calls[index], self.slots, self.kinds, self.rules)

    def _approached(self, wishes: Sequence[Wish]) -> list[tuple[Wish, bool]]:
        """In front of a wish that another robot must stand somewhere for: that robot's going there."""
        found: list[tuple[Wish, bool]] = []
        for wish in wishes:
            for guard in guards_of(wish, wish.fixed, (), self.kinds, self.rules):
                role, _, fluent = guard.path.partition(".")
                goes = None if role == wish.role or guard.negated else _bringing(self.kinds[role], fluent, guard.value)
                if goes is not None:
                    found.append((Wish(role, *goes), True))
            found.append((wish, False))
        return found

    def _put_on(self, index: int) -> tuple[str, str] | None:
        """The role and fluent of the robot that a step puts something on."""
        wish = self.steps[index][0]
        skill = skill_of(wish, self.kinds)
        place = self.calls[index].get(skill.puts[1]) if skill.puts is not None else None
        hosts = ((role, part) for role, kind in self.kinds.items() if (part := kind.part(place or "")))
        return next(((role, part.holds) for role, part in hosts if role != wish.role), None)

    def _call(self, wish: Wish, optional: bool) -> dict[str, str]:
        """A step's arguments as the file writes them; each that is not fixed becomes a slot."""
        skill = skill_of(wish, self.kinds)
        unknown = [name for name in wish.fixed if skill.param(name) is None]
        if unknown:
            valid = ", ".join(p.name for p in skill.params) or "none"
            raise WishError(f"{wish.skill} has no argument {unknown[0]!r} (arguments: {valid})")
        given = {p.name for p in skill.params if not p.optional} | set(wish.fixed)
        given |= set(next((f for f in skill.forms if set(f) & set(wish.fixed)), skill.forms[0]))
        wanted = [param for param in skill.params if param.name in given]
        for group in (set(ZONE), {"x", "y"}):
            open_ = sorted(group - set(wish.fixed))
            if group <= given and 0 < len(open_) < len(group):
                raise WishError(f"{wish.role}.{wish.skill} fixes a part of a place; fix {', '.join(open_)} as well")
        return {p.name: wish.fixed.get(p.name) or self._slot(p, wanted, optional) for p in wanted}

    def _slot(self, param: Param, params: Sequence[Param], optional: bool) -> str:
        """The slot that an argument takes its value from; zones and points are slots of several arguments."""
        names = [p.name for p in params]
        if param.name in ZONE and set(ZONE) <= set(names):
            return f"${self._add('zone', '{type: zone, default: operational_area}')}.{param.name}"
        if param.axis and {"x", "y"} <= set(names):
            return f"${self._add('point', '{type: point}')}.{param.name}"
        if param.entity is Entity.OBJECT:
            return f"${self._add('object', '{type: object}')}"
        if param.entity is not Entity.NONE:
            values = [value.name for value in self.rules.crew.values] if param.entity is Entity.TARGET else []
            types = ", ".join(["location", *values] if self.rules.crew.locations else values)
            return f"${self._add(self._place_name(), f'{{type: [{types}]}}')}"
        if param.unit == "m" and not param.axis:
            return f"${self._add(param.name, '{type: altitude, free: true}')}"
        return f"{param.ge:g}" if param.ge is not None else "0"

    def _place_name(self) -> str:
        """Each step that goes to or puts at a place has a place of its own."""
        taken = sum(1 for name in self.slots if name.startswith("place"))
        name = "place" if not taken else f"place_{taken + 1}"
        return name if name not in self.kinds else f"to_{name}"

    def _add(self, name: str, written: str) -> str:
        while name in self.kinds or any(value.name == name for value in self.rules.crew.values):
            name = f"the_{name}"
        self.slots.setdefault(name, written)
        return name

    def _step_names(self) -> list[str]:
        names: list[str] = []
        for wish, _ in self.steps:
            name, nth = wish.skill, 2
            while name in names:
                name, nth = f"{wish.skill}_{nth}", nth + 1
            names.append(name)
        return names

    def _asked(self) -> list[str]:
        return [name for name, (_, optional) in zip(self.names, self.steps, strict=True) if not optional]

    def _complete(self) -> list[str]:
        """What the last step of each role that shows something new has brought about."""
        found: dict[str, str] = {}
        for index, (wish, optional) in enumerate(self.steps):
            kind, args = self.kinds[wish.role], self.calls[index]
            for name, value in skill_of(wish, self.kinds).effects.items():
                fluent = kind.fluent(name)
                path = f"{wish.role}.{name}"
                found.pop(path, None)
                written = _effect(value, args)
                if fluent is not None and fluent.resting != value and written and not optional:
                    found[path] = f"{{{path}: {written}}}"
        return list(found.values())


def _bringing(kind: Kind, fluent: str, value: FluentLiteral) -> tuple[str, dict[str, str]] | None:
    """The skill that brings a fluent to a name, with the argument that does."""
    for skill in kind.skills:
        effect = skill.effects.get(fluent)
        if isinstance(effect, str) and effect.startswith("$") and skill.param(effect[1:]) and isinstance(value, str):
            return skill.name, {effect[1:]: value}
    return None


def _effect(value: FluentLiteral, args: Mapping[str, str]) -> str:
    """An effect's value as the file writes it: its argument's slot, a whole point, or itself."""
    if not isinstance(value, str) or not value.startswith("$"):
        return _shown(value)
    names = ("target", "location") if value in ("$place", "$point") else (value[1:],)
    written = next((args[name] for name in names if name in args), "")
    if written or not args.get("x", "").startswith("$"):
        return written
    return args["x"].partition(".")[0]


def _shown(value: FluentLiteral) -> str:
    return str(value).lower() if isinstance(value, bool) else f"{value:g}" if isinstance(value, float) else value


def _safe(kind: Kind) -> str:
    """The kind's safe skill until its effects show; a robot without one stays as it is."""
    skill = next((s for s in kind.skills if s.safe), None)
    if skill is None:
        return "stay"
    reach = ", ".join(f"{name}: {_shown(value)}" for name, value in skill.effects.items())
    return f"{{by: {skill.name}, reach: {{{reach}}}}}"


def _joint(slot: str) -> str:
    """The word in front of a slot in an example."""
    return "to " if "location" in slot or "point" in slot else "at " if "altitude" in slot else ""
