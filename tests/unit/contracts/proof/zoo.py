"""The zoo: contracts with a mistake that a person would make, each with what is said of it."""

from collections.abc import Iterator
from functools import cache
from pathlib import Path

from msgspec.structs import replace

from crew.contracts.files.contract_file import load_contract
from crew.contracts.files.source import SourceErrors
from crew.contracts.proof.checker import check
from crew.contracts.proof.report import Finding
from crew.contracts.site import Rules
from crew.library import load_rules

ZOO = Path(__file__).parent / "zoo"
BEASTS = sorted(f"{path.parent.name}/{path.stem}" for path in ZOO.glob("*/*.yaml"))


@cache
def rules_of(crew: str) -> Rules:
    """The crew that a folder of the zoo is written for; indoors with three places, for the sake of speed."""
    if crew == "two_carriers":
        return _two_carriers()
    rules = load_rules(crew)
    kept = tuple(p for p in rules.crew.locations if p.name in ("base", "pickup", "table_a", "room_a"))
    return replace(rules, crew=replace(rules.crew, locations=kept))


def _two_carriers() -> Rules:
    rules = load_rules("humanoid_quadruped")
    first = next(spec for spec in rules.crew.robots if spec.name == "go2")
    crew = replace(rules.crew, robots=(*rules.crew.robots, replace(first, name="go3", sim="go3")))
    return replace(rules, crew=crew)


def verdict(beast: str) -> str:
    """Everything that reading and proving a beast says, as text."""
    crew, _, name = beast.partition("/")
    text = (ZOO / f"{beast}.yaml").read_text(encoding="utf-8")
    rules = rules_of(crew)
    try:
        contract = load_contract(text, source=f"{name}.yaml", crew=rules.crew, kinds=rules.kinds)
    except SourceErrors as errors:
        return f"not read:\n{errors}\n"
    beside = _header(text, "beside")
    others = {n: replace(rules.contracts[n], source=f"{n}.yaml") for n in beside.split(", ") if n}
    report = check(replace(rules, contracts={name: contract, **others}), name)
    assert not report.bound_reached
    return "\n".join(line for finding in report.findings for line in _lines(finding)) + "\n" if report.findings else ""


def mistake(beast: str) -> str:
    """The mistake, in the words of its file."""
    return _header((ZOO / f"{beast}.yaml").read_text(encoding="utf-8"), "mistake")


def golden(beast: str) -> Path:
    return ZOO / f"{beast}.txt"


def _header(text: str, key: str) -> str:
    lines = (line.removeprefix(f"# {key}: ") for line in text.splitlines() if line.startswith(f"# {key}: "))
    return next(lines, "")


def _lines(finding: Finding) -> Iterator[str]:
    yield f"{finding.rule}: {finding.message} [{', '.join(finding.where)}]"
    yield from (f"  {sentence}" for sentence in finding.story)
    if finding.repair:
        yield f"  repair: {finding.repair}"
