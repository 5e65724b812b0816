"""Rules as one message: the launcher reads the files once, every process and the journal carry what was read."""

import msgspec

from crew.contracts.contract import Contract
from crew.contracts.site import Crew, Rules
from crew.errors import UsageError
from crew.library import load_kind


class PackedRules(msgspec.Struct, frozen=True):
    """A crew and its contracts. Kinds are installed code: their digests stand for them."""

    crew: Crew
    contracts: dict[str, Contract]
    kinds: dict[str, str]


def pack(rules: Rules) -> PackedRules:
    """The rules as data."""
    return PackedRules(rules.crew, dict(rules.contracts), {name: kind.digest for name, kind in rules.kinds.items()})


def unpack(packed: PackedRules) -> Rules:
    """The rules with the kinds that are installed here. Raises UsageError if those declare something else."""
    kinds = {name: load_kind(name) for name in packed.kinds}
    for name, digest in packed.kinds.items():
        if kinds[name].digest != digest:
            raise UsageError(
                f"kind {name!r} differs: {kinds[name].digest[:12]} is installed, {digest[:12]} was used; "
                f"install the version of robot-crew that the run was made with"
            )
    return Rules(crew=packed.crew, kinds=kinds, contracts=packed.contracts)
