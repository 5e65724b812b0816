"""What both adapters ask of a UDP socket: an address, and everything that lies in it."""

import socket
from collections.abc import Iterator

Address = tuple[str, int]
MAX_BATCH = 256
"""Datagrams read before the loop gets its turn again."""


def waiting(sock: socket.socket) -> Iterator[tuple[bytes, Address]]:
    """The datagrams that wait in an unblocked socket, and where each is from. Ends early if it is closed meanwhile."""
    for _ in range(MAX_BATCH):
        try:
            yield sock.recvfrom(65536)
        except BlockingIOError:
            return
        except OSError:
            if sock.fileno() < 0:
                return
