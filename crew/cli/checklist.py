"""`crew checklist`, and the same before `crew up` with real robots: every item is said; one that fails ends it."""

from crew.cli.output import coloured, say
from crew.cli.session import run
from crew.contracts.site import Rules
from crew.errors import UsageError


def run_checklist(crew: str) -> int:
    """0 if everything is as it must be. Moves nothing."""
    return run(_checklist(crew))


async def _checklist(crew: str) -> int:
    from crew.launch.checklist import real_robots
    from crew.library import load_rules

    rules = load_rules(crew)
    if not real_robots(rules):
        raise UsageError(f"{rules.crew.source} has no real robot: a checklist is for a robot with a connection:")
    await check_hardware(rules)
    return 0


async def check_hardware(rules: Rules) -> None:
    """Walk through the checklist of every real robot. Raises UsageError naming what is not as it must be."""
    from crew.launch.checklist import real_robots, walk_through

    failed = []
    for robot in real_robots(rules):
        say(f"{robot.name} ({robot.kind}) on {robot.connection}")
        async for check in walk_through(robot, rules):
            say(f"  {coloured('ok  ', 'green') if check.ok else coloured('FAIL', 'red')} {check}")
            if not check.ok:
                failed.append(f"{robot.name}: {check.what}")
    if failed:
        raise UsageError(f"the checklist is not clear: {'; '.join(failed)}; put it right and run it again")
