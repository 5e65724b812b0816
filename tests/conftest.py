"""For every test: the property tests' profiles, and a Ctrl-C that counts.

The default profile is quick; `make soak` takes the long one.
"""

import signal

from hypothesis import settings

settings.register_profile("soak", max_examples=5_000, deadline=None)

# A shell that starts the tests in the background ignores Ctrl-C for them, and so for every crew that they start.
signal.signal(signal.SIGINT, signal.default_int_handler)
