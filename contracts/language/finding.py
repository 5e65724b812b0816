"""What a plan is held against, and what is found: shared by the parts of the containment check."""

from typing import NamedTuple

import msgspec

from crew.contracts.codes import Code
from crew.contracts.contract import Contract
from crew.contracts.language.mention import Reading
from crew.contracts.plan import Instance
from crew.contracts.site import Rules


class Finding(msgspec.Struct, frozen=True, kw_only=True):
    """Why a plan does not hold what was asked for. `span` lies in the request's text."""

    code: Code
    message: str
    field: str = ""
    span: tuple[int, int] | None = None
    allowed: tuple[str, ...] = ()


class Case(NamedTuple):
    """One instance against one reading."""

    reading: Reading
    instance: Instance
    contract: Contract
    rules: Rules
