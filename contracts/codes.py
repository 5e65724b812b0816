"""Refusal codes, in the order in which the gate checks them."""

from enum import StrEnum


class Code(StrEnum):
    """Why a call, a plan or a request was refused. The order of the members is the order of the checks."""

    # capability
    UNKNOWN_ROBOT = "unknown_robot"
    UNKNOWN_SKILL = "unknown_skill"
    # arguments
    MISSING_ARGUMENT = "missing_argument"
    UNKNOWN_ARGUMENT = "unknown_argument"
    BAD_ARGUMENT = "bad_argument"
    UNKNOWN_LOCATION = "unknown_location"
    UNKNOWN_OBJECT = "unknown_object"
    OUT_OF_BOUNDS = "out_of_bounds"
    # workflow
    MALFORMED_PLAN = "malformed_plan"
    UNKNOWN_CONTRACT = "unknown_contract"
    WRONG_ROLE = "wrong_role"
    NOT_IN_CONTRACT = "not_in_contract"
    INCOMPLETE_PLAN = "incomplete_plan"
    OUT_OF_ORDER = "out_of_order"
    NOT_IN_PLAN = "not_in_plan"
    ALREADY_CONSUMED = "already_consumed"
    # containment
    AMBIGUOUS_REQUEST = "ambiguous_request"
    FORBIDDEN_BY_REQUEST = "forbidden_by_request"
    NOT_REQUESTED = "not_requested"
    REQUEST_DROPPED = "request_dropped"
    UNREAD_WORDS = "unread_words"
    # state
    STOPPED = "stopped"
    ROBOT_UNAVAILABLE = "robot_unavailable"
    ROBOT_LEASED = "robot_leased"
    ROBOT_BUSY = "robot_busy"
    STATE_STALE = "state_stale"
    PRECONDITION_FAILED = "precondition_failed"
    DEADLINE_PASSED = "deadline_passed"
    APPROVAL_MISSING = "approval_missing"
    # run-time values
    NO_TARGET_FIX = "no_target_fix"
    NO_VALUE = "no_value"


class Group(StrEnum):
    """The six groups of checks."""

    CAPABILITY = "capability"
    ARGUMENTS = "arguments"
    WORKFLOW = "workflow"
    CONTAINMENT = "containment"
    STATE = "state"
    VALUES = "run-time values"


_FIRST = {
    Code.UNKNOWN_ROBOT: Group.CAPABILITY,
    Code.MISSING_ARGUMENT: Group.ARGUMENTS,
    Code.MALFORMED_PLAN: Group.WORKFLOW,
    Code.AMBIGUOUS_REQUEST: Group.CONTAINMENT,
    Code.STOPPED: Group.STATE,
    Code.NO_TARGET_FIX: Group.VALUES,
}


def _groups() -> dict[Code, Group]:
    table: dict[Code, Group] = {}
    group = Group.CAPABILITY
    for code in Code:
        group = _FIRST.get(code, group)
        table[code] = group
    return table


GROUP_OF: dict[Code, Group] = _groups()
"""The group of checks that each code belongs to."""

ORDER: dict[Code, int] = {code: index for index, code in enumerate(Code)}
"""The rank of each code in the order of the checks."""
