"""Faces of the sphere as polygons on the map of longitude and latitude that tile it."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from stereodel._arrays import BoolArray
from stereodel.constants import BORDER_HALVINGS, DEGREE_ROUNDING
from stereodel.io.arcs import Arcs, Chains, sample
from stereodel.io.extras import optional
from stereodel.io.faces import Faces, Indices
from stereodel.io.rings import Rings, around, rings_of
from stereodel.sphere.latitudes import Latitude

Geometries = npt.NDArray[np.object_]


def sphere_polygons(arcs: Arcs, faces: Faces, max_segment: float, latitude: Latitude) -> Geometries:
    """A Polygon or MultiPolygon for each face, empty for one without sides.

    Straight lines on a map between points of neighbouring arcs may cross where a face is narrow. If all rings are
    simple and counterclockwise they tile the map, as each side is shared by two; so chords that cross are halved.
    """
    chains = sample(arcs, max_segment, latitude)
    result, wrong = assembled(rings_of(faces, chains), len(faces.offsets) - 1)
    for _ in range(BORDER_HALVINGS):
        places = _crossing_steps(faces.subset(np.flatnonzero(wrong)), chains)
        if not len(places):
            break
        finer = np.unique(chains.owner[places])
        chains = chains.with_middles(places)
        changed = np.unique(faces.owner[np.isin(faces.arcs, finer)])
        result[changed], wrong[changed] = assembled(rings_of(faces.subset(changed), chains), len(changed))
    return repaired(result, wrong)


def _crossing_steps(faces: Faces, chains: Chains) -> Indices:
    """Steps that meet another one of the same face, or all steps of a face in which none do."""
    shapely = optional("shapely", "geo")
    index, face, step = around(faces, chains)
    if not len(index):
        return step
    ends = chains.on_map(step)
    lines = shapely.linestrings(ends)
    i, j = shapely.STRtree(lines).query(lines, predicate="intersects")
    meeting = np.zeros(len(index), dtype=np.bool_)
    meeting[i[(face[i] == face[j]) & (ends[i][:, :, None] != ends[j][:, None]).any(axis=-1).all(axis=(1, 2))]] = True
    strays = chains.straying(step, chains.middles(step)).max(axis=1) > DEGREE_ROUNDING
    found = np.bincount(face, meeting, minlength=len(faces.offsets) - 1) > 0
    return np.unique(step[(meeting | ~found[face]) & strays])


def assembled(rings: Rings, count: int) -> tuple[Geometries, BoolArray]:
    """Polygons (count,) of rings, and which of them are not simple and counterclockwise."""
    shapely = optional("shapely", "geo")
    outlines = shapely.linearrings(rings.points, indices=rings.ring) if len(rings.face) else np.zeros(0, dtype=object)
    parts = shapely.polygons(outlines)
    wrong = np.zeros(count, dtype=np.bool_)
    wrong[rings.face[~shapely.is_valid(parts) | ~shapely.is_ccw(outlines)]] = True
    return grouped(parts, rings.face, np.full(count, shapely.Polygon()), shapely.multipolygons), wrong


def grouped(parts: Geometries, owner: Indices, empty: Geometries, collect: Any) -> Geometries:
    """One geometry for each owner, several parts as one of `collect`, and `empty` where there are none."""
    counts, result = np.bincount(owner, minlength=len(empty)), empty.copy()
    alone = counts[owner] == 1
    result[owner[alone]] = parts[alone]
    several, number = np.unique(owner[~alone], return_inverse=True)
    if len(several):
        result[several] = collect(parts[~alone], indices=number.ravel())
    return result


def repaired(geometries: Geometries, wrong: BoolArray) -> Geometries:
    """Valid polygons in place of those that are smaller than the spacing of degrees as doubles."""
    shapely = optional("shapely", "geo")
    for place in np.flatnonzero(wrong).tolist():
        parts = shapely.get_parts(shapely.make_valid(geometries[place]))
        flat = shapely.get_dimensions(parts) < 2
        geometries[place] = shapely.union_all(parts[~flat])
    return geometries
