"""Key expressions by Zenoh's rules: `*` is one chunk, `**` any number; a chunk with `@` first matches only itself."""

from functools import lru_cache

from crew.errors import BusError


def checked_key_expr(key_expr: str) -> str:
    """`key_expr` if it is one; BusError otherwise. `$*` inside a chunk is not used by the crew and is refused."""
    chunks = key_expr.split("/")
    if not all(chunks) or any(_illegal(chunk) for chunk in chunks):
        raise BusError(f"invalid key expression {key_expr!r}: non-empty chunks, '*' and '**' whole chunks, none of #?$")
    return key_expr


def is_key(key_expr: str) -> bool:
    """Whether the expression names exactly one key."""
    return "*" not in key_expr


@lru_cache(maxsize=4096)
def intersects(left: str, right: str) -> bool:
    """Whether some key belongs to both expressions."""
    return _intersect(tuple(left.split("/")), tuple(right.split("/")))


def _illegal(chunk: str) -> bool:
    wild = "*" in chunk and chunk not in ("*", "**")
    return wild or any(character in chunk for character in "#?$")


def _intersect(left: tuple[str, ...], right: tuple[str, ...]) -> bool:
    """Walk both at once; row `j` says whether what was read of `left` can meet the first `j` chunks of `right`."""
    row = [True, *(False for _ in right)]
    for j, chunk in enumerate(right):
        row[j + 1] = row[j] and chunk == "**"
    for mine in left:
        row = _next_row(mine, right, row)
    return row[-1]


def _next_row(mine: str, right: tuple[str, ...], above: list[bool]) -> list[bool]:
    row = [above[0] and mine == "**"]
    for j, theirs in enumerate(right):
        skip_mine = mine == "**" and (above[j + 1] or (row[j] and not _verbatim(theirs)))
        skip_theirs = theirs == "**" and (row[j] or (above[j + 1] and not _verbatim(mine)))
        row.append(skip_mine or skip_theirs or (above[j] and _meets(mine, theirs)))
    return row


def _meets(mine: str, theirs: str) -> bool:
    if mine == theirs:
        return True
    return "*" in (mine[0], theirs[0]) and not _verbatim(mine) and not _verbatim(theirs)


def _verbatim(chunk: str) -> bool:
    return chunk.startswith("@")
