"""Plane and sphere as spaces of the kernel: the same functions for points (n, 2) and for directions (n, 3).

Code that works on either chooses its space once, with ``space_of(points)``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from stereodel import _kernel
from stereodel._arrays import FloatArray

if TYPE_CHECKING:
    from stereodel._kernel.space import Space


def space_of(points: FloatArray) -> Space:
    """The plane for points (n, 2), the sphere for directions (n, 3)."""
    return _kernel.plane if points.shape[1] == 2 else _kernel.sphere
