"""The crew's own certificate authority: one certificate for each trust domain, kept in private files.

Keys are never printed and never leave their files. Everything here raises UsageError with what to do next.
"""

import fcntl
import ipaddress
import os
import secrets
import shutil
import stat
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from datetime import UTC, datetime, timedelta
from pathlib import Path

import msgspec
from cryptography import x509
from cryptography.exceptions import InvalidSignature
from cryptography.hazmat.primitives import hashes, serialization
from cryptography.hazmat.primitives.asymmetric import ec
from cryptography.x509.oid import ExtendedKeyUsageOID, NameOID

from crew.access import ROUTER
from crew.errors import UsageError

AUTHORITY = "authority"
LOOPBACK = ("127.0.0.1", "localhost")
BACKDATED = timedelta(days=1)
"""Certificates are valid from a day before they are made: clocks of two machines may differ."""
VALID = timedelta(days=397)
AUTHORITY_VALID = timedelta(days=3650)
EXPIRES_SOON = timedelta(days=30)
LONGEST_NAME = 64
"""Of a certificate's common name, by the standard."""
REMEDY = "make new ones with crew certs rotate"


class Certificate(msgspec.Struct, frozen=True, kw_only=True):
    """What a person may see of a certificate."""

    name: str
    issuer: str
    valid_from: datetime
    valid_until: datetime
    fingerprint: str
    hosts: tuple[str, ...] = ()


def establish(
    folder: Path, roles: Sequence[str], *, hosts: Iterable[str] = LOOPBACK, now: datetime | None = None
) -> list[str]:
    """Make the authority if there is none, issue what has never been issued, check all; names of what was issued.

    Raises UsageError if a file is missing, unreadable, open to others, expired or not what its name says.
    """
    now = now or datetime.now(UTC)
    with _locked(folder):
        if not any(folder.glob("*.crt")) and not any(folder.glob("*.key")):
            _make_authority(folder, now)
        new = [role for role in roles if not _path(folder, role, "crt").exists() and not _key(folder, role).exists()]
        if new:
            _issue(folder, new, tuple(hosts), now)
        check(folder, roles, now=now)
    return new


def check(folder: Path, roles: Iterable[str], *, now: datetime | None = None) -> list[Certificate]:
    """The certificates of these roles, each found to be whole, current, its role's own and this authority's."""
    now = now or datetime.now(UTC)
    authority = _load(folder, AUTHORITY)
    _check_current(_path(folder, AUTHORITY, "crt"), authority, now)
    return [_checked(folder, role, authority, now) for role in roles]


def rotate(folder: Path, roles: Sequence[str], *, hosts: Iterable[str] = LOOPBACK) -> None:
    """A new authority and new certificates in place of all earlier ones, which are worth nothing from then on."""
    fresh = folder.with_name(f".{folder.name}.{os.getpid()}")
    shutil.rmtree(fresh, ignore_errors=True)
    establish(fresh, roles, hosts=hosts)
    old = folder.with_name(f".{folder.name}.old-{os.getpid()}")
    if folder.exists():
        folder.rename(old)
    fresh.rename(folder)
    shutil.rmtree(old, ignore_errors=True)


def hosts_of(folder: Path) -> tuple[str, ...]:
    """Names and addresses under which clients may know the router."""
    return _describe(ROUTER, _load(folder, ROUTER)).hosts


@contextmanager
def _locked(folder: Path) -> Iterator[None]:
    """The folder, private, for one process at a time."""
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        with (folder / ".lock").open("a") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            _refuse_open(folder, folder.stat().st_mode, "0700")
            yield
    except OSError as error:
        raise UsageError(
            f"unusable certificates in {folder}: {error.strerror} ({error.filename}); make the folder your own"
        ) from error


def _make_authority(folder: Path, now: datetime) -> None:
    key = ec.generate_private_key(ec.SECP256R1())
    name = _name(f"crew authority {secrets.token_hex(8)}")
    usage = _key_usage(signs_certificates=True)
    made = (
        _builder(name, name, key, now, AUTHORITY_VALID)
        .add_extension(x509.BasicConstraints(ca=True, path_length=0), critical=True)
        .add_extension(usage, critical=True)
        .sign(key, hashes.SHA256())
    )
    _write(folder, AUTHORITY, key, made)


def _issue(folder: Path, roles: Sequence[str], hosts: tuple[str, ...], now: datetime) -> None:
    authority = _load(folder, AUTHORITY)
    signer = _private_key(_key(folder, AUTHORITY))
    for role in roles:
        key = ec.generate_private_key(ec.SECP256R1())
        serves = role == ROUTER
        usages = [ExtendedKeyUsageOID.SERVER_AUTH] if serves else [ExtendedKeyUsageOID.CLIENT_AUTH]
        builder = (
            _builder(_name(role), authority.subject, key, now, VALID)
            .add_extension(x509.BasicConstraints(ca=False, path_length=None), critical=True)
            .add_extension(_key_usage(signs_certificates=False), critical=True)
            .add_extension(x509.ExtendedKeyUsage(usages), critical=True)
        )
        if serves:
            builder = builder.add_extension(x509.SubjectAlternativeName([_general(h) for h in hosts]), critical=False)
        _write(folder, role, key, builder.sign(signer, hashes.SHA256()))


def _builder(
    subject: x509.Name, issuer: x509.Name, key: ec.EllipticCurvePrivateKey, now: datetime, valid: timedelta
) -> x509.CertificateBuilder:
    return (
        x509.CertificateBuilder()
        .subject_name(subject)
        .issuer_name(issuer)
        .public_key(key.public_key())
        .serial_number(x509.random_serial_number())
        .not_valid_before(now - BACKDATED)
        .not_valid_after(now + valid)
    )


def _key_usage(*, signs_certificates: bool) -> x509.KeyUsage:
    return x509.KeyUsage(
        digital_signature=not signs_certificates,
        content_commitment=False,
        key_encipherment=False,
        data_encipherment=False,
        key_agreement=False,
        key_cert_sign=signs_certificates,
        crl_sign=signs_certificates,
        encipher_only=False,
        decipher_only=False,
    )


def _name(common_name: str) -> x509.Name:
    if len(common_name) > LONGEST_NAME:
        raise UsageError(f"no certificate can be made for {common_name!r}: over {LONGEST_NAME} characters; rename it")
    return x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, common_name)])


def _general(host: str) -> x509.GeneralName:
    try:
        return x509.IPAddress(ipaddress.ip_address(host))
    except ValueError:
        return x509.DNSName(host)


def _write(folder: Path, name: str, key: ec.EllipticCurvePrivateKey, certificate: x509.Certificate) -> None:
    secret = key.private_bytes(
        serialization.Encoding.PEM, serialization.PrivateFormat.PKCS8, serialization.NoEncryption()
    )
    for path, content, mode in (
        (_key(folder, name), secret, 0o600),
        (_path(folder, name, "crt"), certificate.public_bytes(serialization.Encoding.PEM), 0o644),
    ):
        with os.fdopen(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW, mode), "wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())


def _checked(folder: Path, role: str, authority: x509.Certificate, now: datetime) -> Certificate:
    path, certificate = _path(folder, role, "crt"), _load(folder, role)
    key = _private_key(_key(folder, role))
    found = _describe(role, certificate)
    if found.name != role:
        raise UsageError(f"swapped certificate: {path} is {found.name}'s, not {role}'s; put it back, or {REMEDY}")
    if key.public_key() != certificate.public_key():
        raise UsageError(f"swapped key: {_key(folder, role)} does not belong to {path}; put it back, or {REMEDY}")
    try:
        certificate.verify_directly_issued_by(authority)
    except (ValueError, TypeError, InvalidSignature) as error:
        raise UsageError(
            f"foreign certificate: {path} was not issued by {_path(folder, AUTHORITY, 'crt')}; {REMEDY}"
        ) from error
    _check_current(path, certificate, now)
    return found


def _check_current(path: Path, certificate: x509.Certificate, now: datetime) -> None:
    until, since = certificate.not_valid_after_utc, certificate.not_valid_before_utc
    if now > until:
        raise UsageError(
            f"expired certificate: {path} was valid until {until:%Y-%m-%d %H:%M} UTC, and this machine's clock says "
            f"{now:%Y-%m-%d %H:%M} UTC; {REMEDY}, or set the clock"
        )
    if now < since:
        raise UsageError(
            f"certificate from the future: {path} is valid from {since:%Y-%m-%d %H:%M} UTC, and this machine's clock "
            f"says {now:%Y-%m-%d %H:%M} UTC; set the clock (timedatectl)"
        )


def _load(folder: Path, name: str) -> x509.Certificate:
    path = _path(folder, name, "crt")
    try:
        return x509.load_pem_x509_certificate(path.read_bytes())
    except OSError as error:
        raise UsageError(f"missing or unreadable certificate {path}: {error.strerror}; {REMEDY}") from error
    except ValueError as error:
        raise UsageError(f"broken certificate {path}: it holds no certificate in PEM; {REMEDY}") from error


def _private_key(path: Path) -> ec.EllipticCurvePrivateKey:
    try:
        with os.fdopen(os.open(path, os.O_RDONLY | os.O_NOFOLLOW), "rb") as file:
            _refuse_open(path, os.fstat(file.fileno()).st_mode, "0600")
            key = serialization.load_pem_private_key(file.read(65536), password=None)
    except OSError as error:
        raise UsageError(f"missing or unreadable key {path}: {error.strerror}; {REMEDY}") from error
    except (ValueError, TypeError) as error:
        raise UsageError(f"broken key {path}: it holds no private key in PEM; {REMEDY}") from error
    if not isinstance(key, ec.EllipticCurvePrivateKey):
        raise UsageError(f"broken key {path}: it holds no elliptic curve key; {REMEDY}")
    return key


def _describe(role: str, certificate: x509.Certificate) -> Certificate:
    digits = certificate.fingerprint(hashes.SHA256()).hex()[:16]
    return Certificate(
        name=_common_name(certificate.subject) or f"{role}?",
        issuer=_common_name(certificate.issuer),
        valid_from=certificate.not_valid_before_utc,
        valid_until=certificate.not_valid_after_utc,
        fingerprint="-".join(digits[start : start + 4] for start in range(0, 16, 4)),
        hosts=_hosts(certificate),
    )


def _hosts(certificate: x509.Certificate) -> tuple[str, ...]:
    try:
        names = certificate.extensions.get_extension_for_class(x509.SubjectAlternativeName).value
    except x509.ExtensionNotFound:
        return ()
    return tuple(str(general.value) for general in names)


def _common_name(name: x509.Name) -> str:
    found = name.get_attributes_for_oid(NameOID.COMMON_NAME)
    return str(found[0].value) if found else ""


def _refuse_open(path: Path, mode: int, wanted: str) -> None:
    permissions = stat.S_IMODE(mode)
    if permissions & 0o077:
        raise UsageError(
            f"open to others: {path} has permissions {permissions:04o}, not {wanted}; chmod {wanted} {path}, "
            f"and {REMEDY} if somebody may have read a key"
        )


def _path(folder: Path, name: str, kind: str) -> Path:
    return folder / f"{name}.{kind}"


def _key(folder: Path, name: str) -> Path:
    return _path(folder, name, "key")
