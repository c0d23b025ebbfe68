"""Rows in blocks that fit the cache: double-double arithmetic makes some thirty temporaries."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from stereodel._arrays import FloatArray

ROWS = 2048
"""Of 8 bytes: one temporary is 16 KB and a few of them stay in the first-level cache, all in the second."""


def by_blocks(function: Callable[[FloatArray], FloatArray], rows: FloatArray) -> FloatArray:
    """Apply a map of (m, k) to (m,) or (m, j) along the last axis of (..., k), block by block."""
    flat = rows.reshape(-1, rows.shape[-1])
    if len(flat) <= ROWS:
        result = function(flat)
    else:
        result = np.concatenate([function(flat[i : i + ROWS]) for i in range(0, len(flat), ROWS)])
    return result.reshape(rows.shape[:-1] + result.shape[1:])
