"""Where each argument of a plan came from: the request's own words, a contract's default or constant, or run time."""

from crew.contracts.contract import Contract
from crew.contracts.language.mention import Reading
from crew.contracts.plan import ArgValue, Instance, InstanceStep, SlotValue
from crew.contracts.site import Rules


def sources(step: InstanceStep, instance: Instance, reading: Reading, rules: Rules) -> dict[str, str]:
    """Argument to a phrase that says where its value came from; nothing for a plan that runs as it is listed."""
    contract = rules.contracts[instance.contract]
    declared = contract.step(step.step)
    if declared is None:
        return {}
    pattern = next(p for p in declared.do if p.skill == step.call.skill and set(p.args) == set(step.call.args))
    return {
        name: _source(wanted, step.call.args[name], contract, instance, reading, rules)
        for name, wanted in pattern.args.items()
    }


def _source(
    wanted: ArgValue, given: ArgValue, contract: Contract, instance: Instance, reading: Reading, rules: Rules
) -> str:
    if not isinstance(wanted, str) or not wanted.startswith("$"):
        return f"constant of {contract.name}"
    name = wanted[1:].partition(".")[0]
    slot = contract.slot(name)
    runtime = ", its place is read when it is dispatched" if rules.crew.value(str(given)) is not None else ""
    words = _words_for(instance.slots[name], reading)
    if words:
        return f'request: "{words}"{runtime}'
    if slot is not None and slot.default is not None:
        return f"default of {contract.name}: {slot.default}{runtime}"
    return f"chosen by the planner within the skill's bounds{runtime}"


def _words_for(value: SlotValue, reading: Reading) -> str:
    """The request's words that name this value."""
    return next((m.text for m in reading.wanted if value in m.values), "")
