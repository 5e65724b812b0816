"""Which failures are going on, so that a failsafe acts once: when its failure begins. Pure."""


class Failures:
    """Names of failures that are active."""

    def __init__(self) -> None:
        self._active: set[str] = set()

    def __bool__(self) -> bool:
        return bool(self._active)

    def begins(self, what: str, failing: bool) -> bool:
        """Note whether `what` is failing now; True only at its beginning."""
        if not failing:
            self._active.discard(what)
            return False
        new = what not in self._active
        self._active.add(what)
        return new

    def clear(self) -> None:
        self._active.clear()
