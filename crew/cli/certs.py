"""`crew certs init`, `show` and `rotate`: the crew's own authority and what it issued. No key is ever printed."""

from datetime import UTC, datetime

from crew.authority import AUTHORITY, EXPIRES_SOON, LOOPBACK, Certificate, check, establish, hosts_of, rotate
from crew.cli.output import coloured, say, say_json
from crew.cli.session import home
from crew.errors import UsageError
from crew.launch.table import roles
from crew.library import load_crew_file


def run_init(crew: str, hosts: tuple[str, ...]) -> int:
    """Make what is missing, keep what is there. `hosts` are further names of the router's machine."""
    loaded = load_crew_file(crew)
    folder = home().certificates(loaded.name)
    wanted = (*LOOPBACK, *hosts)
    issued = establish(folder, roles(loaded), hosts=wanted)
    if hosts and set(hosts_of(folder)) != set(wanted):
        raise UsageError(
            f"the router's certificate in {folder} names {', '.join(hosts_of(folder))} already; "
            f"for other hosts: crew certs rotate {crew} {' '.join(f'--host {host}' for host in hosts)}"
        )
    say(f"issued: {', '.join(issued)}" if issued else "nothing was missing")
    return run_show(crew, as_json=False)


def run_show(crew: str, as_json: bool) -> int:
    """Print every certificate of a crew; UsageError if one of them would keep the crew from starting."""
    loaded = load_crew_file(crew)
    folder = home().certificates(loaded.name)
    if not (folder / f"{AUTHORITY}.crt").exists():
        raise UsageError(f"{loaded.name} has no certificates in {folder} yet; make them with crew certs init {crew}")
    found = check(folder, roles(loaded))
    if as_json:
        say_json({"folder": str(folder), "certificates": found})
        return 0
    say(f"{loaded.name}: {found[0].issuer}, in {folder}")
    for certificate in found:
        say(_line(certificate, datetime.now(UTC)))
    return 0


def run_rotate(crew: str, hosts: tuple[str, ...]) -> int:
    """Replace the authority and everything that it issued; refused while the crew runs."""
    loaded = load_crew_file(crew)
    if (running := home().running(loaded.name)) is not None:
        raise UsageError(f"{loaded.name} runs (process {running.pid}) with the certificates that it has; end it first")
    folder = home().certificates(loaded.name)
    rotate(folder, roles(loaded), hosts=(*LOOPBACK, *hosts))
    say("all earlier certificates of this crew are worthless now; copies on other machines must be replaced")
    return run_show(crew, as_json=False)


def _line(certificate: Certificate, now: datetime) -> str:
    left = certificate.valid_until - now
    until = f"until {certificate.valid_until:%Y-%m-%d} ({left.days} days)"
    where = f"  for {', '.join(certificate.hosts)}" if certificate.hosts else ""
    shown = coloured(until, "amber") if left < EXPIRES_SOON else until
    return f"  {certificate.name:20} {certificate.fingerprint}  {shown}{where}"
