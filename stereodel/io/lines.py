"""Arcs of the sphere as lines on the map of longitude and latitude."""

from __future__ import annotations

import numpy as np

from stereodel._arrays import FloatArray
from stereodel._extras import optional
from stereodel.io.arcs import Arcs, Chains, sample
from stereodel.io.faces import Indices
from stereodel.io.polygons import Geometries, grouped
from stereodel.sphere.latitudes import Latitude


def sphere_lines(arcs: Arcs, max_segment: float, latitude: Latitude) -> Geometries:
    """A LineString for each arc, a MultiLineString for one that crosses the 180th meridian or a pole."""
    return lines_on_map(sample(arcs, max_segment, latitude), len(arcs.start))


def lines_on_map(chains: Chains, count: int) -> Geometries:
    """The same for each of `count` chains."""
    shapely = optional("shapely", "geo")
    ends, owner, line = _pieces(chains)
    empty = np.full(count, shapely.LineString())
    if not len(line):
        return empty
    _, begins = np.unique(line, return_index=True)
    # All starts of the steps of a line, and the end of its last step.
    points = np.insert(
        ends[:, 0], np.append(begins[1:], len(line)), ends[np.append(begins[1:], len(line)) - 1, 1], axis=0
    )
    numbers = np.insert(line, np.append(begins[1:], len(line)), line[begins])
    return grouped(shapely.linestrings(points, indices=numbers), owner[begins], empty, shapely.multilinestrings)


def _pieces(chains: Chains) -> tuple[FloatArray, Indices, Indices]:
    """Both ends of every step on the map, (s, 2, 2), its arc, and the number of its line."""
    step = chains.steps()
    ends = chains.on_map(step)
    special = chains.pole | chains.seam
    along_seam = special[step] & special[step + 1]
    ends[along_seam, :, 0] = 180.0
    owner = chains.owner[step]
    new = np.ones(len(step), dtype=np.bool_)
    new[1:] = (owner[1:] != owner[:-1]) | (special[step[1:]] & ~(along_seam[1:] & along_seam[:-1]))
    return ends, owner, np.cumsum(new) - 1
