"""The run's rules: the crew file with the command line's choices, and the known obstacles of a simulated site."""

from msgspec.structs import replace

from crew.contracts.site import Crew, Rules, SimSpec
from crew.errors import UsageError
from crew.launch.options import LaunchOptions
from crew.library import load_rules


def resolve(options: LaunchOptions) -> Rules:
    """Rules as this run uses them. Raises UsageError for a real connection: there are no locks yet."""
    rules = load_rules(options.crew, contracts=options.contracts)
    crew = rules.crew
    real = [r.name for r in crew.robots if r.connection]
    if real:
        raise UsageError(
            f"{', '.join(real)} of {crew.source} has a real connection; this version secures no bus and starts "
            f"simulated robots only: write sim: instead of connection:"
        )
    if crew.sim is None:
        raise UsageError(f"{crew.source} has no sim: section, which its simulated robots need; add sim: {{scene: ...}}")
    sim = SimSpec(
        scene=crew.sim.scene,
        map=options.map or crew.sim.map,
        seed=crew.sim.seed if options.seed is None else options.seed,
        faults=(*crew.sim.faults, *options.faults),
        autopilots=crew.sim.autopilots,
    )
    return replace(rules, crew=_surveyed(crew, sim))


def _surveyed(crew: Crew, sim: SimSpec) -> Crew:
    """The crew with what a surveyor of the simulated site would have written: its origin, a disc for each obstacle."""
    from crew.sim.scenes import survey

    try:
        site = survey(sim.scene, sim.map)
    except ValueError as error:
        raise UsageError(f"the simulated site can't be loaded: {error}") from error
    return replace(crew, sim=sim, origin=site.origin, obstacles=(*crew.obstacles, *site.obstacles))
