"""The run's rules: the crew file with the command line's choices, and the known obstacles of a simulated site."""

from msgspec.structs import replace

from crew.contracts.site import Crew, Rules, SimSpec
from crew.errors import UsageError
from crew.launch.options import LaunchOptions
from crew.library import load_rules


def resolve(options: LaunchOptions) -> Rules:
    """Rules as this run uses them: a simulated site with its survey, or real robots and none.

    Raises UsageError where the command line and the crew file do not go together.
    """
    rules = load_rules(options.crew, contracts=options.contracts)
    crew = rules.crew
    real = [r.name for r in crew.robots if r.connection]
    if real:
        _check_real(crew, real, options)
        return replace(rules, crew=replace(crew, sim=None))
    if crew.sim is None:
        raise UsageError(f"{crew.source} has no sim: section, which its simulated robots need; add sim: {{scene: ...}}")
    sim = SimSpec(
        scene=crew.sim.scene,
        map=options.map or crew.sim.map,
        seed=crew.sim.seed if options.seed is None else options.seed,
        faults=(*crew.sim.faults, *options.faults),
        autopilots=crew.sim.autopilots,
    )
    _check_models(sim.scene, options.models)
    return replace(rules, crew=_surveyed(crew, sim))


def _check_real(crew: Crew, real: list[str], options: LaunchOptions) -> None:
    """Real robots share no time and no process with anything simulated."""
    simulated = [r.name for r in crew.robots if not r.connection]
    if simulated:
        raise UsageError(
            f"{', '.join(real)} of {crew.source} has a real connection and {', '.join(simulated)} is simulated, but "
            f"mission time is either the wall's or the simulation's; write connection: or sim: for all of them"
        )
    if options.single_process:
        raise UsageError(
            f"--single-process with real robots ({', '.join(real)}): one process would hold every key; leave it out"
        )
    for given, option in (
        (options.faults, "--fault"),
        (options.map, "--map"),
        (options.seed is not None, "--seed"),
        (options.models, "--models"),
    ):
        if given:
            raise UsageError(
                f"{option} is for a simulated site, and {', '.join(real)} has a real connection; leave it out"
            )


def _check_models(scene: str, folder: str) -> None:
    from crew.sim.scenes import check_models

    try:
        check_models(scene, folder)
    except ValueError as error:
        raise UsageError(f"--models: {error}") from error


def _surveyed(crew: Crew, sim: SimSpec) -> Crew:
    """The crew with what a surveyor of the simulated site would have written: its origin, a disc for each obstacle."""
    from crew.sim.scenes import survey

    try:
        site = survey(sim.scene, sim.map)
    except ValueError as error:
        raise UsageError(f"the simulated site can't be loaded: {error}") from error
    return replace(crew, sim=sim, origin=site.origin, obstacles=(*crew.obstacles, *site.obstacles))
