"""Whether the thing that a plan takes along was asked to go along: `pick up the cube and send the dog to room_a`."""

from crew.contracts.contract import Contract
from crew.contracts.language.licence import slots_in
from crew.contracts.language.mention import Mention, MentionKind, Reading
from crew.contracts.site import Rules


def left_behind(reading: Reading, contract: Contract, rules: Rules) -> Mention | None:
    """The thing that one step of a contract takes up for another, where nothing in the request joins the two.

    It is joined by a verb that means what the contract asks for, by one that no other contract has, or by the name of
    what carries it.
    """
    loading = _loading(contract)
    things = [m for m in reading.wanted if m.kind is MentionKind.OBJECT]
    if not loading or not things or any(v in rules.parts for m in reading.wanted for v in m.values):
        return None
    for thing in things:
        means = reading.mentions[thing.governor].means if thing.governor is not None else ()
        sent = any(ref.contract == contract.name and ref.step in contract.asks for ref in means)
        if sent or all(ref.contract == contract.name for ref in means):
            return None
    return things[0]


def _loading(contract: Contract) -> bool:
    """Whether a thing is handled only by steps that need not be asked for."""
    objects = {slot.name for slot in contract.slots if "object" in slot.types}
    handled = {s.name for s in contract.steps for p in s.do if objects & set(slots_in(p.args.values()))}
    return bool(handled) and not handled & set(contract.asks)


__all__ = ["left_behind"]
