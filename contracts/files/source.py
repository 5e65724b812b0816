"""YAML 1.2 text to plain data that remembers where every key and value stands, and errors that point there.

Text in, data out: nothing here opens a file. Only what a person should write is read: one mapping, no anchors,
no tags, no key twice.
"""

from collections.abc import Iterable
from functools import lru_cache
from typing import Any, NamedTuple

Loc = tuple[str | int, ...]
"""The way to a node: keys of mappings and indices of lists, from the document's root."""

SHOWN = 20
"""Of a file's problems, and of the valid names, this many are printed; the rest is counted."""
LONGEST = 60
"""Characters of a written text that a message repeats."""


class Mark(NamedTuple):
    """A position in a file; both count from 1."""

    line: int
    column: int


class Block(dict[str, Any]):
    """A mapping as written: plain data, plus where it, its keys and its values stand."""

    def __init__(self, mark: Mark) -> None:
        super().__init__()
        self.mark = mark
        self.key_marks: dict[str, Mark] = {}
        self.value_marks: dict[str, Mark] = {}


class Items(list[Any]):
    """A list as written: plain data, plus where it and its items stand."""

    def __init__(self, mark: Mark) -> None:
        super().__init__()
        self.mark = mark
        self.marks: list[Mark] = []


class SourceError(Exception):
    """One mistake in a file that a person wrote: where, what, observed against allowed, and what to do."""

    def __init__(
        self,
        file: str,
        mark: Mark,
        what: str,
        *,
        observed: str = "",
        allowed: str = "",
        nearest: str = "",
        fix: str = "",
    ) -> None:
        super().__init__(what)
        self.file = file
        self.line, self.column = mark
        self.what = what
        self.observed = observed
        self.allowed = allowed
        self.nearest = nearest
        """The valid name closest to the one written, or empty."""
        self.fix = fix

    def __str__(self) -> str:
        facts = [f"found {self.observed}"] if self.observed else []
        facts += [f"allowed: {self.allowed}"] if self.allowed else []
        head = f"{self.file}:{self.line}:{self.column}: {self.what}"
        advice = [f"did you mean {self.nearest!r}?"] if self.nearest else []
        advice += [self.fix] if self.fix else []
        return "; ".join([f"{head}: {', '.join(facts)}" if facts else head, *advice])


class SourceErrors(Exception):  # noqa: N818 (plural: it holds several)
    """Every mistake found in one file, in the order of the lines."""

    def __init__(self, errors: Iterable[SourceError]) -> None:
        self.errors = tuple(sorted(errors, key=lambda e: (e.line, e.column, e.what)))
        super().__init__(self.errors)

    def __str__(self) -> str:
        lines = [str(error) for error in self.errors[:SHOWN]]
        more = len(self.errors) - SHOWN
        return "\n".join([*lines, f"... and {more} more"] if more > 0 else lines)


class Problems:
    """Collects the mistakes of one file, so that they are reported together."""

    def __init__(self, file: str, root: Block) -> None:
        self.file = file
        self.root = root
        self.errors: list[SourceError] = []

    def at(self, loc: Loc, what: str, **facts: str) -> None:
        """A mistake in the value at `loc`."""
        self.add(locate(self.root, loc), what, **facts)

    def key(self, loc: Loc, what: str, **facts: str) -> None:
        """A mistake in the key that ends `loc`, or in what stands below it as a whole."""
        self.add(locate(self.root, loc, key=True), what, **facts)

    def unknown(
        self, loc: Loc, what: str, name: str, valid: Iterable[str], *, key: bool = False, fix: str = ""
    ) -> None:
        """A name that is none of `valid`: lists them, and the nearest."""
        names = list(dict.fromkeys(valid))
        more = [f"... ({len(names)} in all)"] if len(names) > SHOWN else []
        allowed = ", ".join([*names[:SHOWN], *more]) or "none"
        shown = repr(name if len(name) <= LONGEST else name[:LONGEST] + "...")
        facts = {"observed": shown, "allowed": allowed, "nearest": nearest_name(name, names)}
        self.add(locate(self.root, loc, key=key), what, **facts, fix=fix)

    def add(self, mark: Mark, what: str, **facts: str) -> None:
        self.errors.append(SourceError(self.file, mark, what, **facts))

    def done(self) -> None:
        """Raises SourceErrors if there was any."""
        if self.errors:
            raise SourceErrors(self.errors)


@lru_cache(maxsize=16)
def parse(text: str, *, file: str) -> Block:
    """The document as plain data with positions, to be read only: the same text is parsed once. Raises SourceErrors."""
    from crew.contracts.files.yaml_reader import read  # ruamel.yaml is imported when a file is read, not before

    return read(text, file=file)


def locate(root: Block, loc: Loc, *, key: bool = False) -> Mark:
    """Where `loc` stands, or its nearest ancestor that was written. `key`: the key's place, not its value's."""
    node: Any = root
    mark = root.mark
    for part in loc:
        if isinstance(node, Block) and part in node:
            mark = (node.key_marks if key else node.value_marks)[str(part)]
        elif isinstance(node, Items) and isinstance(part, int) and part < len(node):
            mark = node.marks[part]
        else:
            continue
        node = node[part]
    return mark


def nearest_name(name: str, valid: Iterable[str]) -> str:
    """The valid name that was probably meant, or an empty text."""
    from difflib import get_close_matches

    close = get_close_matches(name[:LONGEST].lower(), list(valid), n=1, cutoff=0.6)
    return close[0] if close else ""
