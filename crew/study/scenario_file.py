"""Scenario files: a folder of YAML to scenarios, with errors that name file, line, field and nearest valid name."""

import re
from pathlib import Path
from typing import Any, ClassVar, Literal

from crew.contracts.files.file_model import FileModel, Name, Text, validate
from crew.contracts.files.source import Loc, Problems, SourceErrors, parse
from crew.contracts.plan import ArgValue
from crew.contracts.site import Rules
from crew.errors import UsageError
from crew.library import read_text
from crew.study.scenario import Licence, Never, Scenario

_SECONDS = re.compile(r"[0-9]{1,4}(\.[0-9]+)?")
SHIPPED = Path(__file__).parent / "scenarios"
"""The scenarios of the two testbeds."""


class NeverModel(FileModel):
    """What must not be dispatched."""

    called: ClassVar[str] = "a dispatch that must not be"
    robot: Name
    skill: Name | None = None


class LicenceModel(FileModel):
    """What the request asks for or implies."""

    called: ClassVar[str] = "a licence"
    robot: Name
    skill: Name
    args: dict[Name, Any] = {}  # noqa: RUF012 - pydantic copies it
    after: list[Name] = []  # noqa: RUF012
    loaded: Name | None = None
    at: Name | None = None
    who: Name | None = None


class ScenarioModel(FileModel):
    """One scenario as written."""

    called: ClassVar[str] = "a scenario"
    title: Text
    request: Text
    map: Text | None = None
    seed: int = 0
    faults: list[Text] = []  # noqa: RUF012
    kind: Literal["nominal", "fault"] = "nominal"
    outcome: Literal["completed", "blocked"] = "completed"
    contracts: list[Name] = []  # noqa: RUF012
    robots: list[Name] = []  # noqa: RUF012
    codes: list[Name] = []  # noqa: RUF012
    never: list[NeverModel] = []  # noqa: RUF012
    may: list[LicenceModel] = []  # noqa: RUF012


class ScenariosModel(FileModel):
    """A file of scenarios for one crew."""

    called: ClassVar[str] = "a file of scenarios"
    crew: Name
    scenarios: dict[Name, ScenarioModel]


def load_scenarios(folder: Path, rules: Rules) -> tuple[Scenario, ...]:
    """Every scenario of the folder that is for this crew, in the order of files and lines.

    Raises UsageError for an empty folder, for one without a scenario of this crew, and for every mistake in a file.
    """
    files = sorted(folder.glob("*.yaml")) if folder.is_dir() else []
    if not files:
        raise UsageError(f"{folder} holds no scenarios: no *.yaml is there; see docs/study/scenarios.md")
    found: list[Scenario] = []
    crews: set[str] = set()
    for path in files:
        try:
            crews.add(_read(path, rules, found))
        except SourceErrors as error:
            raise UsageError(str(error)) from error
    if not found:
        raise UsageError(f"{folder} holds no scenario for {rules.crew.name}, but for {', '.join(sorted(crews))}")
    return tuple(found)


def _read(path: Path, rules: Rules, found: list[Scenario]) -> str:
    """Add the file's scenarios if they are for this crew; whom they are for."""
    root = parse(read_text(path), file=str(path))
    problems = Problems(str(path), root)
    model = validate(ScenariosModel, root, problems)
    problems.done()
    assert model is not None, "a file that has no shape has problems"
    if model.crew == rules.crew.name:
        known = {scenario.name: scenario.testbed for scenario in found}
        for name, written in model.scenarios.items():
            if name in known:
                problems.key(("scenarios", name), f"a scenario {name!r} is in another file already", fix="rename one")
            _check(("scenarios", name), written, rules, problems)
        problems.done()
        found += [_scenario(name, written, model.crew) for name, written in model.scenarios.items()]
    return model.crew


def _check(loc: Loc, written: ScenarioModel, rules: Rules, problems: Problems) -> None:
    """Names that the crew, its contracts, the codes of refusals and the scene know."""
    from crew.contracts.codes import Code

    robots = {robot.name for robot in rules.crew.robots}
    _names((*loc, "contracts"), written.contracts, rules.contracts, "contract", problems)
    _names((*loc, "robots"), written.robots, robots, "robot", problems)
    _names((*loc, "codes"), written.codes, [str(code) for code in Code], "refusal code", problems)
    _names((*loc, "faults"), [f.partition("@")[0] for f in written.faults], _faults(rules), "fault", problems)
    for index, fault in enumerate(written.faults):
        name, timed, seconds = fault.partition("@")
        if timed and not _SECONDS.fullmatch(seconds):
            problems.at((*loc, "faults", index), "no time", observed=repr(seconds), allowed=f"{name}@20 for 20 s")
    if written.map is not None and written.map.lower() not in (maps := _maps(rules)):
        problems.unknown((*loc, "map"), f"no such map of the scene {_scene(rules)}", written.map, maps)
    calls: list[tuple[str, int, str, str | None]]
    calls = [("never", index, call.robot, call.skill) for index, call in enumerate(written.never)]
    calls += [("may", index, call.robot, call.skill) for index, call in enumerate(written.may)]
    for part, index, robot, skill in calls:
        if robot not in robots:
            problems.unknown((*loc, part, index, "robot"), "no such robot", robot, robots)
        elif skill is not None and skill not in (skills := _skills(robot, rules)):
            problems.unknown((*loc, part, index, "skill"), f"{robot} has no such skill", skill, skills)
    if written.outcome == "completed" and not written.contracts:
        problems.key((*loc, "contracts"), "a mission that is completed has a contract", fix="list those that fit")
    if written.outcome == "blocked" and not written.codes:
        problems.key((*loc, "codes"), "a blocked mission is refused with a code", fix="list those that are right")


def _names(loc: Loc, written: list[str], valid: Any, what: str, problems: Problems) -> None:
    for index, name in enumerate(written):
        if name not in valid:
            problems.unknown((*loc, index), f"no such {what}", name, sorted(valid))


def _skills(robot: str, rules: Rules) -> list[str]:
    kind = rules.kind_of(robot)
    return [] if kind is None else [skill.name for skill in kind.skills]


def _scene(rules: Rules) -> str:
    return "" if rules.crew.sim is None else rules.crew.sim.scene


def _faults(rules: Rules) -> tuple[str, ...]:
    from crew.sim.scenes import fault_names

    return fault_names(_scene(rules), [robot.sim for robot in rules.crew.robots])


def _maps(rules: Rules) -> tuple[str, ...]:
    from crew.sim.scenes import map_names

    return map_names(_scene(rules))


def _scenario(name: str, written: ScenarioModel, crew: str) -> Scenario:
    return Scenario(
        name=name,
        testbed=crew,
        title=written.title,
        request=written.request,
        map=written.map or "",
        seed=written.seed,
        faults=tuple(written.faults),
        kind=written.kind,
        outcome=written.outcome,
        contracts=tuple(written.contracts),
        robots=tuple(written.robots),
        codes=tuple(written.codes),
        never=tuple(Never(robot=n.robot, skill=n.skill or "") for n in written.never),
        licences=tuple(_licence(licence) for licence in written.may),
    )


def _licence(written: LicenceModel) -> Licence:
    return Licence(
        robot=written.robot,
        skill=written.skill,
        args={name: _values(value) for name, value in written.args.items()},
        after=tuple(written.after),
        loaded=written.loaded or "",
        at=written.at or "",
        who=written.who or "",
    )


def _values(written: Any) -> tuple[ArgValue, ...]:
    values = written if isinstance(written, list) else [written]
    return tuple(value if isinstance(value, str) else float(value) for value in values)
