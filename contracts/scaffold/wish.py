"""What a person asks a draft to do: `role.skill`, or `role.skill(argument=value)`."""

import re
from typing import NamedTuple

_WISH = re.compile(r"(?P<role>[a-z][a-z0-9_]*)\.(?P<skill>[a-z][a-z0-9_]*)(?:\((?P<args>[^()]*)\))?")
_ARG = re.compile(r"\s*(?P<name>[a-z][a-z0-9_]*)\s*=\s*(?P<value>[^,=]+?)\s*")
NAME = re.compile(r"[a-z][a-z0-9_]*")


class Wish(NamedTuple):
    """One step of a draft: who does what, and which arguments are fixed."""

    role: str
    skill: str
    fixed: dict[str, str]


class WishError(ValueError):
    """A wish that can't be carried out, in words for a person."""


def read_wish(text: str) -> Wish:
    """`loader.pick_place(location=payload_tray)` as data. Raises WishError."""
    found = _WISH.fullmatch(text.strip())
    if found is None:
        raise WishError(f"{text!r} is no step; write <role>.<skill> or <role>.<skill>(<argument>=<value>)")
    fixed: dict[str, str] = {}
    for part in (found["args"] or "").split(",") if found["args"] else ():
        arg = _ARG.fullmatch(part)
        if arg is None:
            raise WishError(f"{part.strip()!r} in {text!r} is no argument; write <argument>=<value>")
        fixed[arg["name"]] = arg["value"]
    return Wish(found["role"], found["skill"], fixed)
