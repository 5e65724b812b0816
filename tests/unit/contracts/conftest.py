"""The shipped rules, for every test of the core."""

import pytest

from crew.contracts.site import Rules
from tests.unit.contracts.build import air_ground


@pytest.fixture(scope="session")
def rules() -> Rules:
    return air_ground()
