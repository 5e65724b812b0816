"""Every oddity of a crew's contracts, in the order of the files and lines."""

from collections.abc import Mapping

from crew.contracts.files.source import parse
from crew.contracts.odd.guards import odd_guards
from crew.contracts.odd.likeness import odd_pairs
from crew.contracts.odd.oddity import Oddity, Written
from crew.contracts.odd.slots import odd_slots
from crew.contracts.site import Rules


def oddities(rules: Rules, texts: Mapping[str, str]) -> tuple[Oddity, ...]:
    """What is legal but odd in the contracts of a crew; `texts` are the files' texts by contract."""
    library = {
        name: Written(rules.contracts[name], parse(text, file=rules.contracts[name].source))
        for name, text in texts.items()
        if name in rules.contracts
    }
    found = [oddity for of in library.values() for oddity in (*odd_guards(of, rules), *odd_slots(of, rules))]
    return tuple(sorted({*found, *odd_pairs(library)}))
