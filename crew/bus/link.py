"""One role's way to its crew's router: where it listens, and which certificate shows who comes."""

from pathlib import Path

import msgspec

from crew.access import Identity


class Link(msgspec.Struct, frozen=True, kw_only=True):
    """What a session is opened with. Without `certificates` it is a guest's: plain TCP, and few rights."""

    role: str
    """The role's name, which is its certificate's common name: `orchestrator`, `robot-iris`."""
    endpoint: str
    crew: str = ""
    certificates: str = ""
    """The folder with the crew's authority and this role's certificate and key."""

    @property
    def identity(self) -> Identity | None:
        """Who comes; None for a guest, whom the router alone judges."""
        return Identity.of(self.crew, self.role) if self.certificates else None

    @property
    def authority(self) -> Path:
        return Path(self.certificates) / "authority.crt"

    @property
    def certificate(self) -> Path:
        return Path(self.certificates) / f"{self.role}.crt"

    @property
    def private_key(self) -> Path:
        return Path(self.certificates) / f"{self.role}.key"
