"""The shape of a contract file. What its names mean is checked in `contract_check`."""

from typing import Annotated, Any, ClassVar, Literal

from pydantic import BeforeValidator, ConfigDict, Field

from crew.contracts.files.file_model import (
    Argument,
    ComparedArgument,
    ComparedLiteral,
    FileModel,
    LiteralValue,
    Name,
    Names,
    Text,
    one_or_many,
)

CallModel = Annotated[dict[str, dict[str, Argument]], Field(min_length=1, max_length=1)]
"""One skill and its arguments: `{navigate_to: {target: $person}}`."""


class SlotModel(FileModel):
    """A request variable shared by all steps."""

    called: ClassVar[str] = "a slot"
    type: Annotated[
        Names, Field(min_length=1, description="object, location, zone, point, altitude or a run-time value")
    ]
    default: Annotated[Argument | None, Field(description="What the slot is if the request names nothing")] = None
    free: Annotated[bool, Field(description="The planner may choose within the skill's bounds")] = False
    optional: Annotated[bool, Field(description="A request may leave the slot open")] = False
    said: Annotated[Literal["from"] | None, Field(description="A claim about an origin")] = None
    beyond: Annotated[str | None, Field(description="A role: only places that its robot does not reach")] = None


class SafeModel(FileModel):
    """How a role is brought to safety."""

    called: ClassVar[str] = "a safe state"
    by: Annotated[str, Field(description="The skill to call")]
    reach: Annotated[dict[str, LiteralValue], Field(min_length=1, description="The fluents that must then hold")]


def _stay_is_none(value: Any) -> Any:
    return None if value == "stay" else {} if value is None else value


class RoleModel(FileModel):
    """A part that one robot plays throughout a mission."""

    called: ClassVar[str] = "a role"
    safe: Annotated[
        SafeModel | None, BeforeValidator(_stay_is_none, json_schema_input_type=Literal["stay"] | SafeModel)
    ] = None


class GuardModel(FileModel):
    """`path: value` or `path: {not: value}`, once or more; with `if` in front it counts only for such a request."""

    model_config = ConfigDict(extra="allow")
    called: ClassVar[str] = "a guard"
    __pydantic_extra__: dict[str, ComparedLiteral] = Field(init=False)
    when: dict[str, str] = Field(default_factory=dict, alias="if")

    @property
    def clauses(self) -> dict[str, Any]:
        """Path to `Compared`."""
        return self.__pydantic_extra__


class StepModel(FileModel):
    """One step of the workflow."""

    called: ClassVar[str] = "a step"
    role: Annotated[str, Field(description="Who does it")]
    do: Annotated[
        list[CallModel],
        BeforeValidator(one_or_many, json_schema_input_type=CallModel | list[CallModel]),
        Field(min_length=1, description="One call, or a list of alternatives"),
    ]
    after: list[str] = Field(default_factory=list, description="Steps that come before")
    optional: Annotated[bool, Field(description="A plan may leave the step out")] = False
    needs: list[GuardModel] = Field(default_factory=list, description="Guards at the step's dispatch")
    words: list[Text] = Field(default_factory=list, description="Words of a request that mean this step")
    approval: Annotated[bool, Field(description="A person must approve the exact call")] = False


class NeverModel(FileModel):
    """A call that must never start in some state: proved, not enforced."""

    called: ClassVar[str] = "a never"
    starts: Annotated[str, Field(description="<role>.<skill>")]
    with_args: dict[str, ComparedArgument] = Field(default_factory=dict, alias="with")
    during: Annotated[GuardModel, Field(alias="while")]
    why: Text


class ContractModel(FileModel):
    """A workflow contract."""

    called: ClassVar[str] = "a contract"
    contract: Name
    summary: Text
    examples: list[Text] = Field(default_factory=list, description="Templates of requests")
    slots: dict[Name, SlotModel] = Field(default_factory=dict)
    roles: Annotated[dict[Name, RoleModel], Field(min_length=1)]
    needs: list[GuardModel] = Field(default_factory=list, description="Guards at the mission's start")
    steps: Annotated[dict[Name, StepModel], Field(min_length=1)]
    asks: Annotated[list[str], Field(description="The steps that the person must have asked for")]
    never: list[NeverModel] = Field(default_factory=list)
    complete: list[GuardModel] = Field(default_factory=list, description="What holds when the mission is completed")
    deadline_s: Annotated[float, Field(gt=0)] = 600.0
    preempts: Annotated[bool, Field(description="Ends the missions that hold its robots")] = False
