"""Signing and verifying one dispatch's permit, as the orchestrator and the robot do it."""

import time

from msgspec.structs import replace

from crew.contracts.plan import digest
from crew.messages import Dispatch
from crew.permit import permit, permit_problem
from crew.signing import SigningKey

KEY = SigningKey(bytes(range(32)))
CREW = "bench"


def measure(rounds: int) -> list[float]:
    """Microseconds for both together."""
    args = {"x_min": -6.0, "x_max": 10.0, "y_min": -6.0, "y_max": 10.0, "altitude": 5.0}
    unsigned = Dispatch(
        mission="m1a2b3c4d",
        step="search",
        purpose="execute",
        sequence=1,
        robot="iris",
        skill="search_target",
        args=args,
        epoch=7,
        lease="m1a2b3c4d",
        fence=3,
        boot_id="0123456789abcdef",
        issued_ns=1_000_000_000,
        expires_ns=3_000_000_000,
        args_digest=digest(args),
        plan_digest="0" * 64,
        contract_digest="0" * 64,
    )
    times_us = []
    for number in range(rounds):
        fresh = replace(unsigned, sequence=number)
        began_ns = time.perf_counter_ns()
        problem = permit_problem(permit(fresh, CREW, KEY), CREW, KEY.public)
        times_us.append((time.perf_counter_ns() - began_ns) / 1000)
        if problem is not None:
            raise RuntimeError(problem.detail)
    return times_us
