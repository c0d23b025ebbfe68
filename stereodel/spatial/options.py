"""Which of SciPy's options to Qhull mean something for an exact triangulation of the plane."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

WITHOUT_EFFECT = frozenset({"QJ", "Qs", "Qt", "Qx", "Q11", "Q12", "Q14", "Pp"})
"""They prevent, report or repair what rounding does to Qhull, or concern other dimensions."""

KNOWN = WITHOUT_EFFECT | {"Qbb", "Qc", "Qz"}


@dataclass(frozen=True)
class Options:
    """What is left of Qhull's options.

    scaled: "Qbb", the height of the paraboloid is scaled to the size of the coordinates.
    at_infinity: "Qz", there is a point at infinity, with an empty Voronoi region.
    coplanar: "Qc", points that are not vertices are listed.
    """

    scaled: bool
    at_infinity: bool
    coplanar: bool


def as_options(qhull_options: Any, furthest_site: Any, incremental: bool) -> Options:
    """The options of a constructor; TypeError or ValueError for what has no meaning here or that Qhull refuses."""
    if furthest_site:
        raise ValueError("furthest_site=True is not supported; use the class of scipy.spatial for furthest sites")
    if not isinstance(qhull_options, str | None):
        raise TypeError(f"qhull_options must be a string or None, got {qhull_options!r}")
    if qhull_options is None:
        return Options(scaled=not incremental, at_infinity=not incremental, coplanar=True)
    words = set(qhull_options.split())
    if unknown := sorted(words - KNOWN):
        raise ValueError(
            f"qhull_options has {', '.join(map(repr, unknown))}; known here are {', '.join(sorted(KNOWN))}. "
            "Leave it out, or use the class of scipy.spatial"
        )
    if incremental and (refused := sorted(words & {"Qbb", "Qz"})):
        raise ValueError(f"qhull_options {', '.join(map(repr, refused))} cannot be used with incremental=True")
    return Options("Qbb" in words, "Qz" in words, "Qc" in words)
