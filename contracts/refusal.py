"""What the core says instead of raising: a refusal with its code, the field, observed against allowed."""

import msgspec

from crew.contracts.codes import Code


class Refusal(msgspec.Struct, frozen=True, kw_only=True):
    """Why something was refused. `message` is a sentence that a person understands."""

    code: Code
    message: str
    field: str = ""
    """Where, such as `steps[2].args.target` or `tb3.moving`."""
    observed: str = ""
    allowed: str = ""
    line: str = ""
    """The contract's line, such as `search_and_dispatch:31`."""
    question: str = ""
    """What a person has to decide before it can be asked for again; empty if nothing is theirs to decide."""

    def __str__(self) -> str:
        where = f" [{self.field}]" if self.field else ""
        return f"{self.code}: {self.message}{where}"


def show(value: object) -> str:
    """A value as people write it: no quotes, no needless decimals."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float):
        return f"{value:g}"
    return str(value)
