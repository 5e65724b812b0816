"""The deployment's files are what the table makes, and each is checked by its own tool."""

import json
import re
import shutil
import subprocess
import time
from pathlib import Path

import pytest
import zenoh

from crew.access import ROUTER
from crew.authority import establish
from crew.bus.intruder import Intruder
from crew.bus.link import Link
from crew.cli.deploy import deployment, nested, run_deploy
from crew.launch.table import free_tcp_port, roles
from crew.library import load_crew_file

DEPLOY = Path(__file__).parents[2] / "deploy"
CREW = load_crew_file("air_ground")
MOST_EXPOSED = 2.0


def test_the_committed_files_are_what_the_command_writes(tmp_path: Path) -> None:
    assert run_deploy("air_ground", tmp_path) == 0
    written = {str(p.relative_to(tmp_path)): p.read_text() for p in tmp_path.rglob("*") if p.is_file()}
    committed = {
        str(p.relative_to(DEPLOY)): p.read_text() for p in DEPLOY.rglob("*") if p.name != "README.md" and p.is_file()
    }
    assert written == committed, "write them anew with: crew deploy"


@pytest.fixture
def tool() -> str:
    found = shutil.which("systemd-analyze")
    assert found is not None, "the units are checked by systemd-analyze: install systemd (.ci/run does)"
    return found


@pytest.fixture
def units(tmp_path: Path) -> list[str]:
    """The units as they are, but for programs that are not installed here."""
    found = []
    for path in sorted((DEPLOY / "systemd").iterdir()):
        text = re.sub(r"^ExecStart=\S+", "ExecStart=/bin/true", path.read_text(), flags=re.MULTILINE)
        (tmp_path / path.name).write_text(text)
        found.append(str(tmp_path / path.name))
    return found


def test_the_units_are_sound(tool: str, units: list[str]) -> None:
    done = subprocess.run([tool, "verify", "--man=no", *units], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


def test_a_broken_unit_is_found(tool: str, units: list[str]) -> None:
    broken = Path(units[0])
    broken.write_text(broken.read_text().replace("ProtectSystem=strict", "ProtectSystem=a little"))
    done = subprocess.run([tool, "verify", "--man=no", str(broken)], capture_output=True, text=True, check=False)
    assert "ignoring: a little" in done.stderr


def test_the_units_are_hardened(tool: str, units: list[str]) -> None:
    for unit in (u for u in units if u.endswith(".service")):
        done = subprocess.run([tool, "security", "--offline=true", unit], capture_output=True, text=True, check=False)
        exposure = re.search(r"exposure level for \S+: ([0-9.]+)", done.stdout)
        assert exposure is not None, done.stdout + done.stderr
        assert float(exposure[1]) <= MOST_EXPOSED, unit


def test_every_role_that_may_write_has_a_unit_and_a_user() -> None:
    users = (DEPLOY / "sysusers.d" / "crew.conf").read_text()
    for role in (ROUTER, "orchestrator", "planner", "gateway", "recorder"):
        unit = (DEPLOY / "systemd" / f"crew-{role}.service").read_text()
        assert f"User=crew-{role}\n" in unit
        assert f"u crew-{role} " in users


def test_zenoh_takes_the_routers_configuration_and_keeps_its_rules(tmp_path: Path) -> None:
    """As it is committed, but for where it listens and where the certificates lie."""
    zenoh.Config.from_file(str(DEPLOY / "air_ground" / "router.json5"))
    certificates, port = tmp_path / "certificates", free_tcp_port()
    establish(certificates, roles(CREW))
    text = deployment(CREW)["air_ground/router.json5"]
    text = text.replace("/etc/crew/air_ground/certificates", str(certificates)).replace(":7448", f":{port}")
    (tmp_path / "router.json5").write_text(text.replace(":7447", f":{free_tcp_port()}"))

    def link(role: str) -> Link:
        return Link(role=role, endpoint=f"tls/127.0.0.1:{port}", crew=CREW.name, certificates=str(certificates))

    with zenoh.open(zenoh.Config.from_file(str(tmp_path / "router.json5"))), Intruder(link("robot-tb3")) as robot:
        heard = robot.listen("crew/air_ground/tb3/@act/**")
        time.sleep(0.3)
        for role in ("planner", "orchestrator"):
            with Intruder(link(role)) as sender:
                sender.put("crew/air_ground/tb3/@act/stop", role.encode())
                time.sleep(0.3)
    assert [payload for _, payload in heard] == [b"orchestrator"]


def test_paths_become_a_tree() -> None:
    flat = {"mode": "router", "transport/link/tls": {"enable_mtls": True}, "transport/link/tx/lease": 1}
    assert nested(flat) == {
        "mode": "router",
        "transport": {"link": {"tls": {"enable_mtls": True}, "tx": {"lease": 1}}},
    }
    assert json.dumps(nested(flat))
