"""Elements of a page. Whatever is not `Html` already is text and is escaped: there is no other way to make one."""

from collections.abc import Iterable
from html import escape

from crew.visible import visible

_VOID = frozenset({"br", "meta", "rect", "line", "circle", "path", "col"})


class Html(str):
    """Markup that was made here."""

    __slots__ = ()


Child = str | Html | None | Iterable["Child"]


def tag(name: str, /, *children: Child, **attributes: str | float | None) -> Html:
    """An element. Attributes of None are left out; `class_` stands for `class`, other underscores for hyphens."""
    shown = "".join(
        f' {_name(key)}="{escape(visible(_value(value)), quote=True)}"'
        for key, value in attributes.items()
        if value is not None
    )
    if name in _VOID and not children:
        return Html(f"<{name}{shown}>" if name in ("br", "meta", "col") else f"<{name}{shown}/>")
    return Html(f"<{name}{shown}>{join(children)}</{name}>")


def join(children: Iterable[Child]) -> Html:
    """Children one after the other."""
    return Html("".join(map(_markup, children)))


def _markup(child: Child) -> str:
    if child is None:
        return ""
    if isinstance(child, Html):
        return child
    if isinstance(child, str):
        return escape(visible(child), quote=False)
    return join(child)


def _name(key: str) -> str:
    return key.rstrip("_").replace("_", "-")


def _value(value: str | float) -> str:
    return value if isinstance(value, str) else f"{value:.6g}"
