"""How many threads a call takes: what `workers=` means everywhere."""

from __future__ import annotations

import os
from typing import Any

from stereodel._arrays import as_workers
from stereodel.constants import POINTS_WORTH_THREADS


def thread_count(workers: Any, size: int) -> int:
    """Threads for a task of `size` points: as many as `workers` says, -1 for all processors, None by the size."""
    chosen = as_workers(workers)
    if chosen is None and size < POINTS_WORTH_THREADS:
        return 1
    if chosen is None or chosen == -1:
        return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    return chosen
