"""Settings of all tests."""

import os

from hypothesis import settings

# No deadline: the first call of a test may load a library or meet a busy machine. In CI the same examples every time.
settings.register_profile("stereodel", deadline=None, derandomize=bool(os.environ.get("CI")))
settings.load_profile("stereodel")
