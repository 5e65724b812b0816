"""`crew doctor`: what would keep a crew from running here, and the command that puts it right."""

import os
import re
import shutil
import socket
import stat
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from datetime import UTC, datetime
from enum import StrEnum
from importlib.metadata import PackageNotFoundError, requires, version
from pathlib import Path

import msgspec

from crew.authority import EXPIRES_SOON, check
from crew.cli.output import coloured, say, say_json
from crew.cli.session import home, run
from crew.contracts.site import Crew
from crew.errors import UsageError
from crew.home import Home
from crew.launch.options import LaunchOptions
from crew.launch.table import roles
from crew.library import load_crew_file

DISTRIBUTION = "robot-crew"
OLDEST_PYTHON = (3, 11)
LEAST_FREE_BYTES = 200_000_000
_REQUIREMENT = re.compile(r"([A-Za-z0-9_.-]+)(?:\[[^]]*\])?\s*([^;]*?)\s*(?:;.*extra\s*==\s*['\"]([a-z]+)['\"])?$")


class Verdict(StrEnum):
    PASS = "PASS"
    WARN = "WARN"
    FAIL = "FAIL"
    SKIP = "SKIP"


COLOURS = {Verdict.PASS: "green", Verdict.WARN: "amber", Verdict.FAIL: "red", Verdict.SKIP: "dim"}


class Finding(msgspec.Struct, frozen=True):
    """One thing that was looked at; `remedy` is a command where one helps."""

    verdict: Verdict
    what: str
    found: str
    remedy: str = ""


def run_doctor(crew: str, authority: bool, as_json: bool) -> int:
    """0 if nothing failed, 2 otherwise."""
    loaded = load_crew_file(crew)
    if authority:
        from crew.cli.authority import examine

        return run(examine(loaded, home(), as_json))
    findings = [finding for look in CHECKS for finding in look(loaded, home())]
    if as_json:
        say_json({"crew": loaded.name, "findings": findings})
    else:
        for finding in findings:
            say_finding(finding)
    return UsageError.exit_code if any(f.verdict is Verdict.FAIL for f in findings) else 0


def say_finding(finding: Finding) -> None:
    """One line, and the remedy below it."""
    say(f"{coloured(finding.verdict, COLOURS[finding.verdict])}  {finding.what:14} {finding.found}")
    if finding.remedy:
        say(f"      {'':14} -> {finding.remedy}")


def _python(crew: Crew, home: Home) -> Iterator[Finding]:
    found = ".".join(str(part) for part in sys.version_info[:3])
    if sys.version_info >= OLDEST_PYTHON and sys.platform == "linux":
        yield Finding(Verdict.PASS, "python", f"{found} on {sys.platform}")
    elif sys.version_info >= OLDEST_PYTHON:
        yield Finding(Verdict.WARN, "python", f"{found} on {sys.platform}, which is untested: Linux is what is known")
    else:
        wanted = ".".join(str(part) for part in OLDEST_PYTHON)
        yield Finding(Verdict.FAIL, "python", f"{found}, older than {wanted}", f"install Python {wanted} or later")


def _packages(crew: Crew, home: Home) -> Iterator[Finding]:
    """Everything that the distribution asks for: there, and of a version that was tested."""
    for line in requires(DISTRIBUTION) or ():
        name, wanted, extra = _requirement(line)
        if extra == "dev" or name == DISTRIBUTION:
            continue
        what = f"{name} ({extra})" if extra else name
        try:
            found = version(name)
        except PackageNotFoundError:
            missing = Verdict.SKIP if extra else Verdict.FAIL
            yield Finding(missing, "package", f"{what} is not installed", f"pip install '{DISTRIBUTION}[all]'")
            continue
        if not satisfies(found, wanted):
            remedy = f"pip install '{name}{wanted}'"
            yield Finding(Verdict.FAIL, "package", f"{what} is {found}, tested with {wanted}", remedy)
            continue
        yield Finding(Verdict.PASS, "package", f"{what} {found}")


def _requirement(line: str) -> tuple[str, str, str]:
    """Name, versions and extra of one line of the distribution's metadata."""
    found = _REQUIREMENT.match(line)
    assert found is not None, line
    return found[1], found[2], found[3] or ""


def satisfies(found: str, wanted: str) -> bool:
    """Whether a version fulfils every clause of a list such as `>=1.10,<1.11` or `==0.41.*`."""
    compare: dict[str, Callable[[tuple[int, ...], tuple[int, ...]], bool]] = {
        ">=": lambda a, b: a >= b,
        "<=": lambda a, b: a <= b,
        "<": lambda a, b: a < b,
        ">": lambda a, b: a > b,
        "!=": lambda a, b: a != b,
        "==": lambda a, b: a == b,
    }
    for clause in filter(None, (c.strip() for c in wanted.split(","))):
        sign = next(s for s in compare if clause.startswith(s))
        limit = clause.removeprefix(sign).strip()
        mine, theirs = _numbers(found), _numbers(limit)
        if limit.endswith(".*"):
            mine = mine[: len(theirs)]
        width = max(len(mine), len(theirs))
        if not compare[sign](mine + (0,) * (width - len(mine)), theirs + (0,) * (width - len(theirs))):
            return False
    return True


def _numbers(text: str) -> tuple[int, ...]:
    return tuple(int(part) for part in re.findall(r"\d+", re.split(r"[a-z+]", text)[0]))


def _ports(crew: Crew, home: Home) -> Iterator[Finding]:
    port = LaunchOptions(crew=crew.name).port
    holder = next((r for r in home.all_running() if r.guests.endswith(f":{port}")), None)
    if holder is not None:
        yield Finding(Verdict.PASS, "port", f"{port} is held by the crew {holder.crew} (process {holder.pid})")
    elif _is_free(port):
        yield Finding(Verdict.PASS, "port", f"{port} on 127.0.0.1 is free")
    else:
        remedy = f"ss -ltnp 'sport = :{port}', and end it; or crew up --port 0"
        yield Finding(Verdict.FAIL, "port", f"{port} on 127.0.0.1 is taken by another program", remedy)


def _is_free(port: int) -> bool:
    with socket.socket() as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind(("127.0.0.1", port))
        except OSError:
            return False
    return True


def _state_folder(crew: Crew, home: Home) -> Iterator[Finding]:
    nearest = next(p for p in (home.path.absolute(), *home.path.absolute().parents) if p.exists())
    if not os.access(nearest, os.W_OK):
        yield Finding(Verdict.FAIL, "state folder", f"{nearest} can't be written", "set CREW_HOME to a folder of yours")
        return
    yield Finding(Verdict.PASS, "state folder", f"{home.path}")
    free = shutil.disk_usage(nearest).free
    if free < LEAST_FREE_BYTES:
        yield Finding(Verdict.WARN, "disk", f"{free / 1e6:.0f} MB free: a journal that can't be written ends a crew")
    for folder in (home.path / "keys", home.path / "certificates"):
        yield from _private(folder, "0700", 0o700)
    for key in sorted((home.path / "keys").glob("*.key")):
        yield from _private(key, "0600", 0o600)


def _private(path: Path, wanted: str, mode: int) -> Iterator[Finding]:
    if path.exists() and stat.S_IMODE(path.stat().st_mode) & 0o077:
        found = f"{path} has permissions {stat.S_IMODE(path.stat().st_mode):04o}: others can reach what is private"
        yield Finding(Verdict.FAIL, "permissions", found, f"chmod {mode:04o} {path}")


def _certificates(crew: Crew, home: Home) -> Iterator[Finding]:
    folder = home.certificates(crew.name)
    if not [*folder.glob("*.crt"), *folder.glob("*.key")]:
        yield Finding(Verdict.SKIP, "certificates", f"{crew.name} has none yet; crew up makes them")
        return
    try:
        found = check(folder, roles(crew))
    except UsageError as error:
        yield Finding(Verdict.FAIL, "certificates", str(error), f"crew certs rotate {crew.name}")
        return
    first = min(found, key=lambda certificate: certificate.valid_until)
    left = first.valid_until - datetime.now(UTC)
    text = f"{len(found)} of {crew.name}, the first ({first.name}) expires in {left.days} days"
    if left < EXPIRES_SOON:
        yield Finding(Verdict.WARN, "certificates", text, f"crew certs rotate {crew.name}")
    else:
        yield Finding(Verdict.PASS, "certificates", text)


def _clock(crew: Crew, home: Home) -> Iterator[Finding]:
    """Whether the clock is kept, and not behind what was written with it."""
    newest = max((p.stat().st_mtime for p in home.path.glob("*/*")), default=0.0)
    behind_s = newest - time.time_ns() / 1e9
    if behind_s > 5.0:
        found = f"{behind_s:.0f} s behind what was written in {home.path}"
        yield Finding(Verdict.FAIL, "clock", found, "timedatectl set-ntp true")
        return
    kept = _ntp()
    if kept is None:
        yield Finding(Verdict.SKIP, "clock", "nobody here says whether it is synchronised")
    elif kept:
        yield Finding(Verdict.PASS, "clock", "synchronised")
    else:
        found = "not synchronised: certificates are judged by it, and journals are read by it"
        yield Finding(Verdict.WARN, "clock", found, "timedatectl set-ntp true")


def _ntp() -> bool | None:
    """Whether the system keeps its clock; None if it does not tell."""
    tool = shutil.which("timedatectl")
    if tool is None:
        return None
    done = subprocess.run(
        [tool, "show", "-p", "NTPSynchronized", "--value"], capture_output=True, text=True, timeout=5, check=False
    )
    return {"yes": True, "no": False}.get(done.stdout.strip())


CHECKS = (_python, _packages, _ports, _state_folder, _certificates, _clock)
