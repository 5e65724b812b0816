"""`crew eval fuzz`: plans and worlds from no planner against the real gate; the page, and an exit code."""

import sys
from collections.abc import Sequence
from pathlib import Path

from crew.cli.output import say, say_json
from crew.study.fuzz.command import fuzz, write


def run_fuzz(seed: int, plans: int, mutants: Sequence[str], jobs: int, out: Path, *, as_json: bool = False) -> int:
    """0 if nothing unsafe was sent and no mutant lives, 1 otherwise. Raises UsageError for a wrong option."""
    terminal = sys.stderr.isatty()

    def told(what: str) -> None:
        print(f"\r\033[K{what}" if terminal else what, end="" if terminal else "\n", file=sys.stderr, flush=True)

    results = fuzz(seed, plans, mutants, jobs, told)
    told("")
    text, data = write(results, out)
    tally, alive = results.tally, [killed.name for killed in results.mutants if killed.case < 0]
    if as_json:
        say_json(
            {
                "plans": tally.plans,
                "unsafe": tally.unsafe,
                "needless_dispatch": [tally.needless, tally.in_order],
                "needless_plans": [tally.needless_plans, tally.right],
                "mutants": len(results.mutants),
                "alive": alive,
                "seconds": results.seconds,
                "results": str(data),
            }
        )
        return 0 if results.sound else 1
    say(f"{tally.plans:,} plans in {tally.cases:,} missions, {results.seconds:g} s: {tally.unsafe:,} unsafe")
    needless = f"{tally.needless:,} of {tally.in_order:,} steps, {tally.needless_plans} of {tally.right} plans"
    say(f"needlessly refused: {needless}")
    for story in tally.stories:
        say(f"UNSAFE case {story.case} ({story.request}): {'; '.join(story.what)}")
    if results.mutants:
        dead = len(results.mutants) - len(alive)
        say(f"{dead} of {len(results.mutants)} mutants killed; alive: {', '.join(alive) or 'none'}")
    say(f"the page is {text}")
    return 0 if results.sound else 1
