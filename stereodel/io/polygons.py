"""Faces of the sphere as polygons on the map of longitude and latitude that tile it."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from stereodel._arrays import BoolArray, FloatArray
from stereodel._extras import optional
from stereodel.constants import BORDER_STEPS, DEGREE_ROUNDING, THIN_CELL
from stereodel.io.arcs import Arcs, Chains, sample
from stereodel.io.faces import Faces, Indices
from stereodel.io.rings import WORLD, Rings, around, rings_of
from stereodel.sphere.latitudes import Latitude

Geometries = npt.NDArray[np.object_]


def sphere_polygons(arcs: Arcs, faces: Faces, max_segment: float, latitude: Latitude) -> Geometries:
    """A Polygon or MultiPolygon for each face, empty for one without sides.

    Straight lines on a map between points of neighbouring arcs may cross where a face is narrow. If all rings are
    simple and counterclockwise they tile the map, as each side is shared by two; so chords of the others are halved.
    """
    chains = sample(arcs, max_segment, latitude)
    result, wrong = assembled(rings_of(faces, chains), len(faces.offsets) - 1)
    while len(places := _straying_steps(faces.subset(np.flatnonzero(wrong)), chains)):
        finer = np.unique(chains.owner[places])
        chains = chains.with_middles(places)
        changed = np.unique(faces.owner[np.isin(faces.arcs, finer)])
        result[changed], wrong[changed] = assembled(rings_of(faces.subset(changed), chains), len(changed))
    shapely = optional("shapely", "geo")
    # A border that runs round a pole the other way by rounding has the rest of the map inside.
    inverted = (_widths(faces, chains) < THIN_CELL) & (shapely.area(result) > WORLD.width * WORLD.height / 10)
    result[inverted] = shapely.Polygon()
    return repaired(result, wrong)


def _straying_steps(faces: Faces, chains: Chains) -> Indices:
    """Steps whose chords stray as far as to another step of the same face, or all of a face without such steps."""
    shapely = optional("shapely", "geo")
    index, face, step = around(faces, chains)
    if not len(index):
        return step
    ends, off = chains.on_map(step), chains.straying(step, chains.middles(step)).max(axis=1)
    lines = shapely.linestrings(ends)
    i, j = shapely.STRtree(lines).query(lines, predicate="dwithin", distance=2 * off)
    apart = (ends[i][:, :, None] != ends[j][:, None]).any(axis=-1).all(axis=(1, 2))
    near = np.zeros(len(index), dtype=np.bool_)
    near[i[(face[i] == face[j]) & apart]] = True
    count = len(faces.offsets) - 1
    chosen = (near | (np.bincount(face, near, minlength=count) == 0)[face]) & (off > DEGREE_ROUNDING)
    useful = (np.bincount(face, chosen, minlength=count) <= BORDER_STEPS) & (_widths(faces, chains) > THIN_CELL)
    return np.unique(step[chosen & useful[face]])


def _widths(faces: Faces, chains: Chains) -> FloatArray:
    """About how wide faces are, (f,): area over length of the border; infinite for those that are not narrow at all.

    The area as seen from the middle of the border, where chords of one great circle cancel however they are cut. A
    narrow face is no longer than half a great circle, whose points have a mean of length 2/π.
    """
    index, face, step = around(faces, chains)
    start, chord, count = chains.xyz[step], chains.xyz[step + 1] - chains.xyz[step], len(faces.offsets) - 1
    lengths = np.sqrt(np.sum(chord**2, axis=1))
    length = np.bincount(face, lengths, minlength=count)
    sums = np.column_stack([np.bincount(face, start[:, k] * lengths, minlength=count) for k in range(3)])
    middle = sums / np.where(length > 0, length, 1.0)[:, None]
    seen = np.sum(middle[face] * np.cross(start, chord), axis=1) * np.where(index == step, 1.0, -1.0)
    area = np.abs(np.bincount(face, seen, minlength=count))
    narrow = np.sum(middle**2, axis=1) > 1 / 4
    return np.where(narrow, area / np.where(length > 0, length, 1.0), np.inf)


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
