"""The few errors of the project. A message says what happened, where, observed against allowed, what to do next."""

from collections.abc import Iterable
from difflib import get_close_matches


class CrewError(Exception):
    """Base of every error that a person may meet; `exit_code` is what the command line ends with."""

    exit_code = 1


class UsageError(CrewError):
    """A mistake in a file, an argument or the configuration: nothing was started."""

    exit_code = 2


class BusError(CrewError):
    """The bus could not be opened, or a peer did not answer in time."""


class JournalError(CrewError):
    """A record could not be committed, or a journal does not hold what its chain promises."""


class AdapterError(CrewError):
    """A vehicle did not do what it was asked: `reason` is the vehicle's own word where it gave one."""

    def __init__(self, message: str, *, code: str = "adapter_failed", reason: str = "") -> None:
        super().__init__(message)
        self.code = code
        self.reason = reason


class Latched(AdapterError):  # noqa: N818 - an outcome, in the words of the stop
    """The robot's stop is latched: nothing but its own landing may move it until a reset."""

    def __init__(self, message: str) -> None:
        super().__init__(message, code="stopped")


def nearest(name: str, valid: Iterable[str]) -> str:
    """`'; did you mean x? valid: a, b, c'` for a name that is not one of `valid`."""
    names = sorted(valid)
    close = get_close_matches(name, names, n=1, cutoff=0.6)
    hint = f"; did you mean {close[0]!r}?" if close else ""
    return f"{hint} (valid: {', '.join(names) or 'none'})"
