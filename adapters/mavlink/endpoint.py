"""Connection strings of the ground side. Opens nothing."""

import msgspec

from crew.adapters.datagram import Address
from crew.errors import AdapterError


class Endpoint(msgspec.Struct, frozen=True):
    """One UDP end: `listen` waits for the vehicle to speak first, otherwise it is spoken to at this address."""

    listen: bool
    host: str
    port: int

    @property
    def address(self) -> Address:
        return self.host, self.port


def parse_endpoint(text: str) -> Endpoint:
    """`udpin:HOST:PORT` (listen) or `udpout:HOST:PORT` (speak first). Raises AdapterError `bad_connection`."""
    scheme, _, rest = text.partition(":")
    host, _, port = rest.rpartition(":")
    if scheme not in ("udpin", "udpout") or not host or not port.isdecimal() or not 0 < int(port) < 65536:
        raise AdapterError(
            f"connection {text!r} is not understood; write udpin:HOST:PORT or udpout:HOST:PORT", code="bad_connection"
        )
    return Endpoint(listen=scheme == "udpin", host=host, port=int(port))
