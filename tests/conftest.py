"""Profiles of the property tests: the default one is quick, `make soak` takes the long one."""

from hypothesis import settings

settings.register_profile("soak", max_examples=5_000, deadline=None)
