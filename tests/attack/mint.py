"""Certificates that the crew's authority would never issue: expired ones, and servers in another role's name."""

import shutil
from datetime import UTC, datetime, timedelta
from pathlib import Path

from cryptography import x509
from cryptography.hazmat.primitives import hashes, serialization
from cryptography.hazmat.primitives.asymmetric import ec
from cryptography.x509.oid import ExtendedKeyUsageOID

from crew.authority import _general, _name, _write


def mint(authority: Path, folder: Path, name: str, *, server: bool = False, expired: bool = False) -> None:
    """A certificate of this authority in `folder`, beside the authority's own, as somebody with its key could make."""
    folder.mkdir(mode=0o700)
    shutil.copy(authority / "authority.crt", folder)
    issuer = x509.load_pem_x509_certificate((authority / "authority.crt").read_bytes())
    signer = serialization.load_pem_private_key((authority / "authority.key").read_bytes(), password=None)
    assert isinstance(signer, ec.EllipticCurvePrivateKey)
    key = ec.generate_private_key(ec.SECP256R1())
    until = datetime.now(UTC) + timedelta(hours=-1 if expired else 1)
    usage = ExtendedKeyUsageOID.SERVER_AUTH if server else ExtendedKeyUsageOID.CLIENT_AUTH
    made = (
        x509.CertificateBuilder()
        .subject_name(_name(name))
        .issuer_name(issuer.subject)
        .public_key(key.public_key())
        .serial_number(x509.random_serial_number())
        .not_valid_before(until - timedelta(days=2))
        .not_valid_after(until)
        .add_extension(x509.BasicConstraints(ca=False, path_length=None), critical=True)
        .add_extension(x509.ExtendedKeyUsage([usage]), critical=True)
        .add_extension(x509.SubjectAlternativeName([_general("127.0.0.1")]), critical=False)
    )
    _write(folder, name, key, made.sign(signer, hashes.SHA256()))
