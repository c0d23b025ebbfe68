"""Other processes: whether they are gone, and waiting for it."""

import time
from pathlib import Path


def ended(pid):
    """Whether a process is gone, or waits for nobody to ask after it."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] == "Z"
    except OSError:
        return True


def wait_until(condition, seconds=60):
    limit = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < limit
        time.sleep(0.02)
