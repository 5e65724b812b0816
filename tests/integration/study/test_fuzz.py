"""Ten thousand plans against the real gate; the same on two processes as on one."""

import msgspec

from crew.study.fuzz.run import run


def test_ten_thousand_plans_send_nothing_unsafe() -> None:
    tally = run(seed=2026, plans=10_000, processes=2)
    assert tally.plans >= 10_000
    assert tally.stories == []
    assert tally.unsafe == 0
    assert tally.needless == 0


def test_two_processes_count_what_one_counts() -> None:
    one, two = run(seed=3, plans=1_000), run(seed=3, plans=1_000, processes=2)
    assert msgspec.to_builtins(one) == msgspec.to_builtins(two)
