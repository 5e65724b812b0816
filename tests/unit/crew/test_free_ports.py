from collections.abc import Callable

import pytest

from crew.launch.table import free_tcp_ports, free_udp_ports

MANY = 500
"""Found one by one, some of so many would be the same."""


@pytest.mark.parametrize("free_ports", [free_tcp_ports, free_udp_ports])
def test_ports_that_are_found_together_differ(free_ports: Callable[[int], list[int]]) -> None:
    assert len(set(free_ports(MANY))) == MANY
