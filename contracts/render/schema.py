"""JSON Schema of what people and planners write: contract files, crew files, a planner's proposal, a skill's call."""

from typing import Any

from crew.contracts.gate.arguments import bounds, names_for
from crew.contracts.site import Rules
from crew.contracts.skill import Param, Skill

DIALECT = "https://json-schema.org/draft/2020-12/schema"
Schema = dict[str, Any]


def contract_file_schema() -> Schema:
    """The shape of a contract file, for editors; the loader checks names and types beyond it."""
    from crew.contracts.files.contract_model import ContractModel

    return {"$schema": DIALECT, **_tidy(ContractModel.model_json_schema())}


def crew_file_schema() -> Schema:
    """The shape of a crew file, for editors; the loader checks names and places beyond it."""
    from crew.contracts.files.crew_model import CrewModel

    return {"$schema": DIALECT, **_tidy(CrewModel.model_json_schema())}


def plan_tool() -> Schema:
    """The planner's tool `submit_plan`. Open on purpose: what a plan may say is the gate's business."""
    value = {"anyOf": [{"type": "number"}, {"type": "string"}]}
    argument = _object({"name": {"type": "string"}, "value": value})
    step = _object({"robot": {"type": "string"}, "skill": {"type": "string"}, "args": _list(argument)})
    return {
        "name": "submit_plan",
        "description": "Propose a plan: the name of a workflow contract, and the calls in their order.",
        "input_schema": _object({"contract": {"type": "string"}, "steps": _list(step)}),
    }


def skill_schema(skill: Skill, rules: Rules, reach: tuple[str, ...] = ()) -> Schema:
    """The arguments of one skill: bounds narrowed by the operational area, names from the crew and a robot's reach."""
    required = [param.name for param in skill.params if not param.optional]
    schema = {"description": skill.about, **_object({p.name: _param(p, rules, reach) for p in skill.params}, required)}
    forms = [list(form) for form in skill.forms]
    if any(forms):
        optional = [param.name for param in skill.params if param.optional]
        schema["oneOf"] = [_form(form, optional) for form in forms]
    return schema


def robot_schemas(robot: str, rules: Rules) -> dict[str, Schema]:
    """Skill to the schema of its arguments, for one robot; empty for a robot that the crew does not have."""
    spec, kind = rules.crew.robot(robot), rules.kind_of(robot)
    if spec is None or kind is None:
        return {}
    return {skill.name: skill_schema(skill, rules, spec.reach) for skill in kind.skills}


def _form(form: list[str], optional: list[str]) -> Schema:
    """Exactly these optional arguments."""
    others = [{"required": [name]} for name in optional if name not in form]
    return {"required": form, "not": {"anyOf": others}} if others else {"required": form}


def _param(param: Param, rules: Rules, reach: tuple[str, ...]) -> Schema:
    about: Schema = {"description": param.about} if param.about else {}
    if not param.is_number:
        names = list(reach) if param.reach else names_for(param.entity, rules)
        return {"type": "string", "enum": names, **about}
    low, high = bounds(param, rules)
    unit: Schema = {"x-unit": param.unit} if param.unit else {}
    return {"type": "number", "minimum": low, "maximum": high, **about, **unit}


def _tidy(schema: Any) -> Any:
    """Without the titles that pydantic makes up; names that don't match their pattern are refused."""
    if isinstance(schema, list):
        return [_tidy(part) for part in schema]
    if not isinstance(schema, dict):
        return schema
    options = [option for option in schema.get("anyOf", []) if option != {"type": "null"}]
    if len(options) == 1:
        schema = {**options[0], **{key: part for key, part in schema.items() if key != "anyOf"}}
    made_up = {"title"} if isinstance(schema.get("title"), str) else set()
    made_up |= {"default"} if "default" in schema and schema["default"] is None else set()
    closed: Schema = {"additionalProperties": False} if "patternProperties" in schema else {}
    return {key: _tidy(part) for key, part in schema.items() if key not in made_up} | closed


def _object(properties: Schema, required: list[str] | None = None) -> Schema:
    needed = list(properties) if required is None else required
    return {"type": "object", "properties": properties, "required": needed, "additionalProperties": False}


def _list(items: Schema) -> Schema:
    return {"type": "array", "items": items}
