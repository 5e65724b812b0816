"""What the models of contract and crew files share: strict shapes, and pydantic's complaints in plain words."""

import math
import re
from collections.abc import Callable
from typing import Annotated, Any, ClassVar, NamedTuple, TypeVar

from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    PlainValidator,
    StringConstraints,
    ValidationError,
    ValidationInfo,
    WithJsonSchema,
    model_validator,
)
from pydantic_core import ErrorDetails, PydanticCustomError

from crew.contracts.files.source import LONGEST, Block, Items, Loc, Problems, nearest_name

Name = Annotated[str, StringConstraints(pattern="^[a-z][a-z0-9_]{0,39}$")]
SOME_TEXT = r"\S"
Text = Annotated[str, StringConstraints(pattern=SOME_TEXT)]

_YAML_1_1 = {"yes": "true", "on": "true", "y": "true", "no": "false", "off": "false", "n": "false"}
_UNIT = re.compile(r"[-+]?[0-9][0-9.,_]*\s*([^\W\d_]|[°'\"%]).*")
_DIGITS = re.compile(r"[-+]?[0-9][0-9.,:_ ]*")


class FileModel(BaseModel):
    """Base of everything a person writes. A key it doesn't know is reported with its place, and then left out."""

    model_config = ConfigDict(strict=True, extra="forbid", frozen=True, allow_inf_nan=False)
    called: ClassVar[str]
    """What a person would call it, with its article."""

    @model_validator(mode="before")
    @classmethod
    def _known_keys(cls, data: Any, info: ValidationInfo) -> Any:
        closed = cls.model_config["extra"] == "forbid"
        if not closed or not isinstance(data, Block) or not isinstance(info.context, Problems):
            return data
        valid = [field.alias or name for name, field in cls.model_fields.items()]
        for key in data.keys() - set(valid):
            facts = {"observed": repr(key), "allowed": ", ".join(valid), "nearest": nearest_name(key, valid)}
            info.context.add(data.key_marks[key], f"unknown key of {cls.called}", **facts)
        empty = {key for key in valid if key in data and _is_empty(cls, key, data, info.context)}
        return {key: value for key, value in data.items() if key in valid and key not in empty}


M = TypeVar("M", bound=FileModel)


def _is_empty(model: type[FileModel], key: str, data: Block, problems: Problems) -> bool:
    """Whether an optional key has no value, which is reported: it could mean none, or be forgotten."""
    field = next(field for name, field in model.model_fields.items() if (field.alias or name) == key)
    if data[key] is not None or field.is_required():
        return False
    problems.add(data.key_marks[key], f"{key!r} of {model.called} has no value", fix="write one, or remove the key")
    return True


def validate(model: type[M], root: Block, problems: Problems) -> M | None:
    """The document as `model`; or None, with every mistake of shape added to `problems`."""
    try:
        return model.model_validate(root, context=problems)
    except ValidationError as error:
        for details in error.errors(include_url=False):
            _report(details, problems)
        return None


def expected(what: str) -> PydanticCustomError:
    """The error of a value that is not `what`."""
    return PydanticCustomError("expected", "expected {what}", {"what": what})


def one_or_many(value: Any) -> Any:
    """A single value where a list may stand."""
    return value if isinstance(value, list) or value is None else [value]


def _literal(value: Any) -> bool | float | str:
    if isinstance(value, bool | str):
        return value
    if isinstance(value, int | float):
        return _finite(float(value))
    raise expected("true, false, a number or a name")


def _argument(value: Any) -> float | str:
    if isinstance(value, str):
        return value
    if isinstance(value, int | float) and not isinstance(value, bool):
        return _finite(float(value))
    raise expected("a number, a name or $slot")


def _finite(value: float) -> float:
    if not math.isfinite(value):
        raise PydanticCustomError("finite_number", "expected a finite number")
    return value


class Compared(NamedTuple):
    """`value`, or `{not: value}`."""

    value: bool | float | str
    negated: bool


def _comparison(of: Callable[[Any], bool | float | str]) -> Callable[[Any], Compared]:
    def read(value: Any) -> Compared:
        if isinstance(value, dict):
            if list(value) != ["not"]:
                raise expected("a value, or {not: value}")
            return Compared(of(value["not"]), True)
        return Compared(of(value), False)

    return read


def _or_not(schema: dict[str, Any]) -> dict[str, Any]:
    negation = {"type": "object", "properties": {"not": schema}, "required": ["not"], "additionalProperties": False}
    return {"anyOf": [schema, negation]}


_LITERAL_SCHEMA = {"type": ["boolean", "number", "string"]}
_ARGUMENT_SCHEMA = {"type": ["number", "string"]}
LiteralValue = Annotated[bool | float | str, PlainValidator(_literal), WithJsonSchema(_LITERAL_SCHEMA)]
Argument = Annotated[float | str, PlainValidator(_argument), WithJsonSchema(_ARGUMENT_SCHEMA)]
ComparedLiteral = Annotated[Compared, PlainValidator(_comparison(_literal)), WithJsonSchema(_or_not(_LITERAL_SCHEMA))]
ComparedArgument = Annotated[
    Compared, PlainValidator(_comparison(_argument)), WithJsonSchema(_or_not(_ARGUMENT_SCHEMA))
]
Names = Annotated[list[str], BeforeValidator(one_or_many, json_schema_input_type=str | list[str])]

_KINDS = {
    "string_type": "text",
    "float_type": "a number",
    "int_type": "a whole number",
    "bool_type": "true or false",
    "dict_type": "a mapping",
    "model_type": "a mapping",
    "list_type": "a list",
    "finite_number": "a finite number",
    "string_pattern_mismatch": "a name: small letters, digits and _, a letter first",
    "expected": "{what}",
    "literal_error": "{expected}",
    "greater_than": "more than {gt:g}",
    "greater_than_equal": "{ge:g} or more",
    "less_than_equal": "{le:g} or less",
    "too_short": "at least {min_length}",
    "too_long": "at most {max_length}",
}


def _report(error: ErrorDetails, problems: Problems) -> None:
    kind, value = error["type"], error["input"]
    loc = _written(error["loc"], problems.root)
    if kind == "missing":
        problems.key(loc, f"missing key {error['loc'][-1]!r}{_inside(loc)}")
    elif error["loc"] and error["loc"][-1] == "[key]":
        problems.key(loc, f"not a name{_inside(loc[:-1])}", observed=show(value), allowed=_KINDS[kind])
    else:
        context = error.get("ctx", {})
        allowed = _KINDS.get(kind, error["msg"]).format(**context)
        if context.get("pattern") == SOME_TEXT:
            allowed = "some text"
        fix = advice(value, allowed, loc)
        problems.at(loc, f"bad value of {_path(loc)}", observed=show(value), allowed=allowed, fix=fix)


def _written(loc: Loc, root: Block) -> Loc:
    """The parts of a way that the file has: without the keys that lack and the indices of what is no list."""
    node: Any = root
    parts: list[str | int] = []
    for part in loc:
        written = part in node if isinstance(node, Block) else isinstance(node, Items) and isinstance(part, int)
        if written:
            parts.append(part)
            node = node[part]
    return tuple(parts)


def show(value: Any) -> str:
    """A value as a person wrote it, in short."""
    if value is None:
        return "nothing"
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, dict | list):
        return f"a {'list' if isinstance(value, list) else 'mapping'} of {len(value)}"
    if isinstance(value, str):
        return repr(value if len(value) <= LONGEST else value[:LONGEST] + "...")
    return f"{value:g}" if isinstance(value, float) else str(value)


def advice(value: Any, allowed: str, loc: Loc = ()) -> str:
    """What to do about a value of the wrong type; empty if nothing more can be said."""
    if isinstance(value, str):
        return _text_advice(value, allowed, loc)
    if value is None and allowed in ("a mapping", "a list"):
        return f"write {'{}' if allowed == 'a mapping' else '[]'} for an empty one"
    if allowed == "text" and isinstance(value, bool | int | float):
        return "put quotes around it"
    return ""


def _text_advice(value: str, allowed: str, loc: Loc) -> str:
    if "true" in allowed and value.lower() in _YAML_1_1:
        return f"YAML 1.2 reads {value} as text: write {_YAML_1_1[value.lower()]}"
    if "number" not in allowed:
        return ""
    if _UNIT.fullmatch(value):
        return f"write the number alone, without a unit, in {_unit(loc)}"
    return "YAML 1.2 reads this as text: write digits, with a point if need be" if _DIGITS.fullmatch(value) else ""


def _unit(loc: Loc) -> str:
    key = next((part for part in reversed(loc) if isinstance(part, str)), "")
    return {"deg": "degrees", "s": "seconds"}.get(key.rsplit("_", 1)[-1], "metres")


def _inside(loc: Loc) -> str:
    return f" in {_path(loc)}" if loc else ""


def _path(loc: Loc) -> str:
    return ".".join(str(part) for part in loc)
