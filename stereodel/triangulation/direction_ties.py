"""The tie rule for directions, as `polygon_diagonals` needs it: their order, and which way the displacement goes.

Each direction is displaced outward along itself, the first in lexicographic order most. Seen from a facet whose bubble
is smaller than a hemisphere this leads out of the hull, from a closing facet into it, and in a plane through the centre
it stays in the plane: there displacements along x, then y, then z decide, by the outward normal's sign.
"""

from __future__ import annotations

from functools import cmp_to_key

import numpy as np

from stereodel._arrays import BoolArray, FloatArray
from stereodel.predicates.rays import compare_directions, ray, turn_signs
from stereodel.triangulation.cells import Cycles, Indices, spread_triples
from stereodel.triangulation.circle_order import normal_signs


def displaced_outward(points: FloatArray, cycles: Cycles) -> BoolArray:
    """Whether the displacement carries the sites of each polygon out of the hull, (c,)."""
    triples = points[spread_triples(cycles)]
    signs = turn_signs(triples[:, 0], triples[:, 1], triples[:, 2])
    for k in np.flatnonzero(signs == 0).tolist():
        signs[k] = next(s for s in normal_signs(triples[k]) if s)
    return np.asarray(signs > 0)


def direction_ranks(points: FloatArray, cycles: Cycles) -> Indices:
    """Place of each site in the lexicographic order of directions, (n,); 0 where no polygon above three needs it."""
    long = np.repeat(np.diff(cycles.offsets) > 3, np.diff(cycles.offsets))
    sites = np.unique(cycles.members[long])
    rays = {site: ray(p) for site, p in zip(sites.tolist(), points[sites].tolist(), strict=True)}
    ordered = sorted(rays, key=cmp_to_key(lambda a, b: compare_directions(rays[a], rays[b])))
    rank = np.zeros(len(points), dtype=np.intp)
    rank[ordered] = np.arange(len(ordered))
    return rank
