"""`crew run ROLE`: one role by itself, for a service manager."""

import signal

from crew.cli.session import home, run
from crew.launch.alone import child_of, serve
from crew.launch.options import LaunchOptions
from crew.supervisor import Child

TERMINATED = 128 + signal.SIGTERM


def run_role(role: str, options: LaunchOptions, router: str, guests: str) -> int:
    """Until SIGTERM, which is an orderly end here: 0."""
    child = child_of(role, options, home(), router=router, guests=guests)
    ended = run(_served(child, role))
    return 0 if ended == TERMINATED else ended


async def _served(child: Child, role: str) -> int:
    await serve(child, tell=f"{role} serves")
    return 0
