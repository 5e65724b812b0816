"""What a proof rests on, as one digest: the same basis, the same verdict."""

from msgspec.structs import replace

from crew.contracts.plan import digest
from crew.contracts.site import Rules


def basis(rules: Rules) -> str:
    """SHA-256 over all that a check reads of the rules: no words for people, no adapters, no simulation, no files."""
    crew = rules.crew
    return digest(
        {
            "area": crew.area,
            "robots": [(robot.name, robot.kind, robot.reach) for robot in crew.robots],
            "locations": [(place.name, place.x, place.y) for place in crew.locations],
            "zones": [(zone.name, zone.zone) for zone in crew.zones],
            "objects": [thing.name for thing in crew.objects],
            "values": [(value.name, value.standoff_m) for value in crew.values],
            "kinds": {name: kind.digest for name, kind in rules.kinds.items()},
            "contracts": {name: replace(contract, source="") for name, contract in rules.contracts.items()},
        }
    )
