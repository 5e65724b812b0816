"""A robot's `options` of the crew file, read as an adapter declares them."""

from typing import Any, TypeVar

import msgspec

from crew.errors import AdapterError, nearest

Options = TypeVar("Options", bound=msgspec.Struct)


def read_options(robot: str, given: dict[str, Any], kind: type[Options]) -> Options:
    """The options, checked. Raises AdapterError `bad_option` naming the option and what is allowed."""
    for name in given:
        if name not in kind.__struct_fields__:
            hint = nearest(name, kind.__struct_fields__)
            raise AdapterError(f"{robot}: no option {name!r}{hint}", code="bad_option")
    try:
        return msgspec.convert(given, kind)
    except msgspec.ValidationError as error:
        raise AdapterError(f"{robot}: options: {error}", code="bad_option") from error
