"""The request as it was asked, with what was read in it marked."""

from collections.abc import Iterator

from crew.contracts.language.mention import Mention, MentionKind, Reading
from crew.report.html import Child, Html, tag
from crew.visible import LONGEST

_CLASSES = {
    MentionKind.ACTION: "action",
    MentionKind.ROBOT: "robot",
    MentionKind.ROBOT_CLASS: "robot",
    MentionKind.UNKNOWN: "unknown",
}
_Marked = tuple[int, int, str, str]
"""Start, end, class and title."""


def marked_request(text: str, reading: Reading) -> Html:
    """The request's text; each part that was read, excluded, or not understood stands out, with what it counts as."""
    return tag("blockquote", list(_pieces(text[:LONGEST], reading)), _rest(text), class_="request")


def _rest(text: str) -> str | None:
    return None if len(text) <= LONGEST else f"... ({len(text) - LONGEST} more characters; the journal holds them)"


def _pieces(text: str, reading: Reading) -> Iterator[Child]:
    at = 0
    for start, end, name, title in sorted(_marks(reading)):
        if at <= start < end <= len(text):
            yield text[at:start]
            yield tag("mark", text[start:end], class_=f"w-{name}", title=title)
            at = end
    yield text[at:]


def _marks(reading: Reading) -> Iterator[_Marked]:
    for mention in reading.mentions:
        name = _CLASSES.get(mention.kind, "value") if mention.positive else "excluded"
        yield (*mention.span, name, meaning(mention))
    for unread in reading.unread:
        yield (*unread.span, "unread", "not understood")
    for doubt in reading.ambiguous:
        yield (*doubt.span, "unread", f"ambiguous: {doubt.why}")


def meaning(mention: Mention) -> str:
    """What a mention was read as, in a few words."""
    kind = str(mention.kind).replace("_", " ")
    excluded = "" if mention.positive else "excluded "
    direction = "" if str(mention.direction) == "none" else f" ({mention.direction})"
    if mention.kind is MentionKind.ACTION:
        skills = ", ".join(dict.fromkeys(ref.skill for ref in mention.means))
        return f"{excluded}action: {skills or mention.name}"
    if mention.kind is MentionKind.UNKNOWN:
        return f"{excluded}unknown name{direction}"
    return f"{excluded}{kind}: {mention.name}{direction}"
