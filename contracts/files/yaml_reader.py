"""The events of ruamel.yaml folded into `Block` and `Items`. YAML 1.2 core schema; whatever surprises is refused."""

import re
from collections.abc import Iterator
from typing import Any

from ruamel.yaml import YAML
from ruamel.yaml.error import MarkedYAMLError, YAMLError
from ruamel.yaml.events import (
    AliasEvent,
    DocumentStartEvent,
    Event,
    MappingEndEvent,
    MappingStartEvent,
    NodeEvent,
    ScalarEvent,
    SequenceEndEvent,
    SequenceStartEvent,
)
from ruamel.yaml.reader import ReaderError

from crew.contracts.files.source import Block, Items, Mark, SourceError, SourceErrors

MAX_BYTES = 1_000_000
MAX_DEPTH = 32
START = Mark(1, 1)

_BOOLS = {"true": True, "True": True, "TRUE": True, "false": False, "False": False, "FALSE": False}
_NULLS = {"", "~", "null", "Null", "NULL"}
_INT = re.compile(r"[-+]?[0-9]+")
_BASED = re.compile(r"0o[0-7]+|0x[0-9a-fA-F]+")
_FLOAT = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?")
_INF_NAN = re.compile(r"[-+]?\.(inf|Inf|INF)|\.(nan|NaN|NAN)")
_TAB = re.compile(r"^ *\t", re.MULTILINE)
_LONGEST_INT = 15
"""Digits up to which an integer is exact as a float too."""


def read(text: str, *, file: str) -> Block:
    """The one mapping that the text holds. Raises SourceErrors."""
    size = len(text.encode("utf-8", "surrogatepass"))
    if size > MAX_BYTES:
        raise SourceErrors(
            [SourceError(file, START, "file too large", observed=f"{size} bytes", allowed=f"{MAX_BYTES} bytes")]
        )
    reader = _Reader(text.removeprefix("\ufeff"), file)
    try:
        root = reader.document()
    except _ReadError:
        root = None
    except YAMLError as error:
        reader.refuse(*_syntax(error, text))
        root = None
    if reader.errors or not isinstance(root, Block):
        raise SourceErrors(reader.errors or [_not_a_mapping(file, root)])
    return root


def scalar(text: str) -> bool | int | float | str | None:
    """A plain scalar by the YAML 1.2 core schema: `yes`, `on` and `1_000` are text."""
    if text in _NULLS:
        return None
    if text in _BOOLS:
        return _BOOLS[text]
    if _INT.fullmatch(text):
        return int(text) if len(text) <= _LONGEST_INT else float(text)
    if _BASED.fullmatch(text):
        return int(text, 0)
    if _FLOAT.fullmatch(text):
        return float(text)
    if _INF_NAN.fullmatch(text):
        return float(text.replace(".", "", 1))
    return text


class _ReadError(Exception):
    """Reading on makes no sense; the reason is already recorded."""


class _Reader:
    """Consumes the events of one text. Mistakes that leave the rest readable are collected."""

    def __init__(self, text: str, file: str) -> None:
        self.file = file
        self.errors: list[SourceError] = []
        for tab in _TAB.finditer(text):
            mark = Mark(text.count("\n", 0, tab.start()) + 1, tab.end() - tab.start())
            self.refuse(mark, "a tab indents this line", fix="indent with spaces")
        self.text = text

    def document(self) -> Any:
        if self.errors:
            raise _ReadError
        events: Iterator[Event] = YAML(typ="safe", pure=True).parse(self.text)
        root: Any = None
        documents = 0
        for event in events:
            if isinstance(event, DocumentStartEvent):
                documents += 1
                self._document_start(event, documents)
            elif isinstance(event, NodeEvent):
                root = self._node(event, events, depth=0)
        return root

    def refuse(self, mark: Mark, what: str, *, observed: str = "", allowed: str = "", fix: str = "") -> None:
        self.errors.append(SourceError(self.file, mark, what, observed=observed, allowed=allowed, fix=fix))

    def _document_start(self, event: DocumentStartEvent, count: int) -> None:
        if count > 1:
            self.refuse(
                _mark(event), "a second document begins here", allowed="one mapping a file", fix="split the file"
            )
            raise _ReadError
        version = event.version
        if version is not None and tuple(version) != (1, 2):
            shown = ".".join(str(part) for part in version)
            self.refuse(START, "unsupported YAML version", observed=shown, allowed="1.2", fix="remove the %YAML line")

    def _node(self, event: Event, events: Iterator[Event], depth: int) -> Any:
        self._plain_only(event)
        if isinstance(event, MappingStartEvent):
            return self._block(_mark(event), events, self._deeper(event, depth))
        if isinstance(event, SequenceStartEvent):
            return self._items(_mark(event), events, self._deeper(event, depth))
        if isinstance(event, ScalarEvent):
            return scalar(event.value) if event.implicit[0] else event.value
        return None

    def _deeper(self, event: Event, depth: int) -> int:
        if depth >= MAX_DEPTH:
            self.refuse(_mark(event), "nested too deeply", allowed=f"{MAX_DEPTH} levels")
            raise _ReadError
        return depth + 1

    def _block(self, mark: Mark, events: Iterator[Event], depth: int) -> Block:
        block = Block(mark)
        for event in events:
            if isinstance(event, MappingEndEvent):
                break
            key, key_mark = self._node(event, events, depth), _mark(event)
            value_event = next(events)
            value = self._node(value_event, events, depth)
            if self._key_is_good(key, event, block):
                block[key] = value
                block.key_marks[key] = key_mark
                block.value_marks[key] = _mark(value_event)
        return block

    def _items(self, mark: Mark, events: Iterator[Event], depth: int) -> Items:
        items = Items(mark)
        for event in events:
            if isinstance(event, SequenceEndEvent):
                break
            items.append(self._node(event, events, depth))
            items.marks.append(_mark(event))
        return items

    def _key_is_good(self, key: Any, event: Event, block: Block) -> bool:
        mark = _mark(event)
        if isinstance(event, AliasEvent):
            return False
        if key == "<<" and isinstance(event, ScalarEvent) and event.implicit[0]:
            self.refuse(mark, "merge key", observed="'<<'", fix="write the keys out")
        elif not isinstance(key, str):
            written = repr(event.value) if isinstance(event, ScalarEvent) else "a nested structure"
            self.refuse(mark, "a key that is not text", observed=written, allowed="a name", fix="put quotes around it")
        elif key in block:
            first = block.key_marks[key].line
            self.refuse(
                mark, "duplicate key", observed=f"{key!r} again", fix=f"it is already on line {first}; keep one"
            )
        else:
            return True
        return False

    def _plain_only(self, event: Event) -> None:
        if isinstance(event, AliasEvent):
            self.refuse(_mark(event), "reference to an anchor", observed=f"*{event.anchor}", fix="write the value out")
        elif isinstance(event, NodeEvent) and event.anchor is not None:
            fix = "remove it; write the value where it is used"
            self.refuse(_mark(event), "anchor", observed=f"&{event.anchor}", fix=fix)
        tag = getattr(event, "tag", None)
        if tag is not None:
            self.refuse(_mark(event), "tag", observed=str(tag), fix="remove it; put quotes around text")


def _mark(event: Event) -> Mark:
    return Mark(event.start_mark.line + 1, event.start_mark.column + 1)


def _syntax(error: YAMLError, text: str) -> tuple[Mark, str]:
    """Where the parser gave up, and its words."""
    if isinstance(error, MarkedYAMLError):
        mark = error.problem_mark or error.context_mark
        words = " ".join(part for part in (error.context, error.problem) if part)
        return (Mark(mark.line + 1, mark.column + 1) if mark else START), f"not YAML: {words}"
    if isinstance(error, ReaderError):
        before = text[: error.position]
        mark = Mark(before.count("\n") + 1, len(before) - before.rfind("\n"))
        return mark, f"not YAML: the character {chr(error.character)!r} is not allowed"
    return START, f"not YAML: {error}"


def _not_a_mapping(file: str, root: Any) -> SourceError:
    seen = "nothing" if root is None else "a list" if isinstance(root, Items) else f"the value {root!r:.60}"
    return SourceError(
        file, START, "not a mapping", observed=seen, allowed="keys with values", fix="begin with `key: value`"
    )
