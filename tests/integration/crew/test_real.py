"""A crew whose robots have a `connection:`: vehicles of their own clock, that the crew meets on a socket only."""

import asyncio
import threading
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

import pytest

from crew.actors.recorder.rrd import FILE, is_whole
from crew.launch.alone import running_at
from crew.launch.table import free_udp_ports, loopback_endpoints
from crew.library import CREWS
from crew.signing import load_or_create_key
from crew.sim.config import WorldConfig
from crew.sim.scenes import open_world, survey
from tests.integration.crew.harness import NAME, SHORT_DRIVE, Desk, Up, Watch, watching

SLICE_NS = 50_000_000
ROLES = ("router", "orchestrator", "planner", "gateway", "robot-iris", "robot-tb3", "recorder")


@contextmanager
def vehicles(ports: dict[str, int]) -> Iterator[None]:
    """Two vehicles out there, in wall time."""
    links = {name: f"udp:127.0.0.1:{port}" for name, port in ports.items()}
    over = threading.Event()

    def turn() -> None:
        with open_world(WorldConfig(links=links)) as world:
            began, slices = time.monotonic(), 0
            while not over.is_set():
                slices += 1
                world.advance(slices * SLICE_NS)
                world.poll()
                over.wait(max(0.0, began + slices * SLICE_NS / 1e9 - time.monotonic()))

    thread = threading.Thread(target=turn, daemon=True)
    thread.start()
    try:
        yield
    finally:
        over.set()
        thread.join(10)


def crew_file(folder: Path, ports: dict[str, int]) -> Path:
    """The shipped crew, with connections in place of its simulation, and what a surveyor of the site would write."""
    site = survey("air_ground", "A")
    text = (CREWS / f"{NAME}.yaml").read_text()
    for name, port in ports.items():
        text = text.replace(f"    sim: {name}\n", f'    connection: "udpin:127.0.0.1:{port}"\n')
    text = text.replace("options: {", "options: {allow_unsigned: true, ")
    text = text.replace("aliases: [turtlebot3]\n", "aliases: [turtlebot3]\n    options: {allow_unsigned: true}\n")
    lat, lon, alt = site.origin
    text = text.replace(
        "sim: {scene: air_ground, map: A}\n", f"origin: {{lat_deg: {lat}, lon_deg: {lon}, alt_m: {alt}}}\n"
    )
    text += f"obstacles: {[list(disc) for disc in site.obstacles]}\n"
    (folder / "real.yaml").write_text(text)
    return folder / "real.yaml"


@pytest.fixture
def desk(tmp_path: Path) -> Desk:
    return Desk(tmp_path)


@pytest.fixture
def ports() -> dict[str, int]:
    return dict(zip(("iris", "tb3"), free_udp_ports(2), strict=True))


async def test_a_crew_with_real_connections_drives(desk: Desk, ports: dict[str, int]) -> None:
    file = crew_file(desk.folder, ports)
    with vehicles(ports), desk.up(str(file), speed="1") as up:
        assert "UNSECURED" not in up.said
        assert "simulation" not in up.children()
        async with watching(up.running) as watch:
            ended = await watch.mission(SHORT_DRIVE)
            assert ended.outcome == "completed", ended.text
            assert watch.truths == [], "nobody here knows the truth"


async def test_each_role_runs_by_itself_with_only_its_own_keys(desk: Desk, ports: dict[str, int]) -> None:
    """As the units of a deployment start them: a state folder for each role, and one crew file."""
    file = crew_file(desk.folder, ports)
    assert desk.crew("certs", "init", str(file)).returncode == 0
    router, guests = loopback_endpoints()
    where = ("--router", router, "--guests", guests)
    with vehicles(ports), ExitStack() as stack:
        own = {role: _own_folder(desk, role) for role in ROLES}
        orchestrator = own["orchestrator"]
        asked = orchestrator.crew("run", "orchestrator", str(file), *where)
        assert (asked.returncode, "no public key" in asked.stderr) == (2, True), "the operator's, for resets"
        for role in ("orchestrator", "robot-iris", "robot-tb3"):
            _give_key(desk.home.keys, own[role], "operator")
        for role in ROLES:
            if role.startswith("robot-"):
                _give_key(orchestrator.home.keys, own[role], "orchestrator")
        started = {}
        for role in ROLES:
            started[role] = own[role].spawn("run", role, str(file), *where)
            stack.callback(_end_with_sigterm, started[role])
            if role == "router":
                started[role].await_said("router serves", 30.0)
        for role, one in started.items():
            one.await_said(f"{role} serves", 30.0)
        running = running_at(NAME, desk.home, router, guests)
        async with watching(running) as watch:
            await _available(watch, 30.0)
            ended = await watch.mission(SHORT_DRIVE)
            assert ended.outcome == "completed", ended.text
    (recording,) = (own["recorder"].folder / "runs").glob(f"*/{FILE}")
    assert is_whole(recording)


async def _available(watch: Watch, seconds: float) -> None:
    """Wait until the orchestrator itself knows every robot, and each has found its vehicle."""
    deadline = time.monotonic() + seconds
    while missing := {r.robot: r.unavailable for r in (await watch.status()).robots if r.unavailable}:
        assert time.monotonic() < deadline, missing
        await asyncio.sleep(0.1)


def _own_folder(desk: Desk, role: str) -> Desk:
    """A state folder that holds what this role needs, and nothing that another one signs or shows."""
    folder = desk.folder / role
    folder.mkdir()
    mine = Desk(folder)
    certificates = mine.home.certificates(NAME)
    certificates.mkdir(mode=0o700)
    for name in ("authority.crt", f"{role}.crt", f"{role}.key"):
        (certificates / name).write_bytes((desk.home.certificates(NAME) / name).read_bytes())
        (certificates / name).chmod(0o600)
    return mine


def _give_key(keys: Path, to: Desk, name: str) -> None:
    """Somebody's public key, which is made where it is signed with."""
    public = load_or_create_key(keys, name).public
    to.home.keys.mkdir(mode=0o700, exist_ok=True)
    (to.home.keys / f"{name}.pub").write_text(public.hex())


def _end_with_sigterm(one: Up) -> None:
    one.process.terminate()
    assert one.process.wait(10) == 0, one.said


MIXED = "has a real connection and tb3 is simulated"


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("up", "--single-process"), "--single-process with real robots"),
        (("up", "--fault", "gps_loss"), "--fault is for a simulated site"),
        (("up", "--map", "B"), "--map is for a simulated site"),
        (("up", "--models", "."), "--models is for a simulated site"),
        (("up", "--seed", "3"), "--seed is for a simulated site"),
        (("demo",), "a demo moves simulated robots only"),
    ],
)
def test_what_real_robots_are_not_for(desk: Desk, ports: dict[str, int], words: tuple[str, ...], said: str) -> None:
    file = crew_file(desk.folder, ports)
    done = desk.crew(words[0], str(file), *words[1:], timeout_s=30)
    assert done.returncode == 2
    assert said in done.stderr
    assert "Traceback" not in done.stderr


def test_real_and_simulated_robots_do_not_mix(desk: Desk, ports: dict[str, int]) -> None:
    text = (CREWS / f"{NAME}.yaml").read_text().replace("    sim: iris\n", '    connection: "udpin:127.0.0.1:1"\n')
    (desk.folder / "mixed.yaml").write_text(text)
    done = desk.crew("up", "mixed.yaml", timeout_s=30)
    assert done.returncode == 2
    assert MIXED in done.stderr


def test_a_role_of_a_simulated_crew_does_not_run_alone(desk: Desk) -> None:
    done = desk.crew("run", "planner", timeout_s=30)
    assert done.returncode == 2
    assert "bring it up with crew up" in done.stderr
