"""Faces of the sphere as rings on the map of longitude and latitude, cut at meridian 180 and opened at the poles."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from stereodel._arrays import BoolArray, FloatArray
from stereodel.io.arcs import Chains
from stereodel.io.boxes import Box, close_along
from stereodel.io.faces import Faces, Indices, spans

WORLD = Box(-180.0, 180.0, -90.0, 90.0)


@dataclass(frozen=True, eq=False)
class Rings:
    """Closed rings, the first point not repeated at the end.

    Attributes
    ----------
    points : (p, 2) array
    ring : (p,) array of int
        The ring of each point, in order.
    face : (r,) array of int
        The face of each ring, in order; a face that the map cuts has several.
    """

    points: FloatArray
    ring: Indices
    face: Indices


def rings_of(faces: Faces, chains: Chains) -> Rings:
    """Counterclockwise rings of faces no larger than a hemisphere; none for a face without sides."""
    index, face, _ = around(faces, chains)
    touched = np.zeros(len(faces.offsets) - 1, dtype=np.bool_)
    touched[face[chains.pole[index] | chains.seam[index]]] = True
    whole = ~touched[face]
    points = [chains.lonlat[index[whole]]]
    owners = [face[whole]]
    rings = [owners[0]]
    for number, owner in enumerate(np.flatnonzero(touched).tolist()):
        cut = border_pieces(chains, index[slice(*np.searchsorted(face, [owner, owner + 1]))])
        for piece, loop in enumerate(close_along(WORLD, cut)):
            points.append(loop)
            owners.append(np.full(len(loop), owner))
            rings.append(np.full(len(loop), len(touched) + 2 * number + piece))
    return gathered(np.concatenate(points), np.concatenate(owners), np.concatenate(rings))


def around(faces: Faces, chains: Chains) -> tuple[Indices, Indices, Indices]:
    """The points around each face, without the last of each side; their face; the step of the chain that follows.

    A step has the number of the point of the chain at which it begins.
    """
    lengths = np.diff(chains.offsets)[faces.arcs] - 1
    first = chains.offsets[faces.arcs]
    forward = spans(first, lengths)
    reverse = np.repeat(faces.reverse, lengths)
    mirrored = np.repeat(2 * first + lengths, lengths) - forward
    index = np.where(reverse, mirrored, forward)
    return index, np.repeat(faces.owner, lengths), index - reverse


def border_pieces(chains: Chains, ring: Indices) -> list[FloatArray]:
    """The pieces on the map, from border to border, of one ring on the sphere that touches its border."""
    following = np.roll(ring, -1)
    special = chains.pole[ring] | chains.seam[ring]
    kept = ~(special & np.roll(special, -1))
    ends = chains.between(ring, following)
    begins = np.flatnonzero(special & kept)
    pieces = []
    for begin in begins.tolist():
        length = int(np.argmax(np.roll(special, -begin - 1))) + 1
        steps = (begin + np.arange(length)) % len(ring)
        pieces.append(np.concatenate([ends[steps, 0], ends[steps[-1:], 1]]))
    return pieces


def gathered(points: FloatArray, owner: Indices, ring: Indices) -> Rings:
    """Rings without points that follow themselves and without rings of fewer than three points, faces in order."""
    order = np.lexsort((ring, owner))
    points, owner, ring = points[order], owner[order], ring[order]
    kept = ~_repeated(points, ring)
    points, owner, ring = points[kept], owner[kept], ring[kept]
    _, number, counts = np.unique(ring, return_inverse=True, return_counts=True)
    large = counts[number] > 2
    points, owner, ring = points[large], owner[large], ring[large]
    new = np.ones(len(ring), dtype=np.bool_)
    new[1:] = ring[1:] != ring[:-1]
    return Rings(points, np.cumsum(new) - 1, owner[new])


def _repeated(points: FloatArray, ring: Indices) -> BoolArray:
    """Points equal to the one before them in their ring; the first one is compared with the last."""
    first = np.ones(len(ring), dtype=np.bool_)
    first[1:] = ring[1:] != ring[:-1]
    before = np.arange(len(ring)) - 1
    last = np.append(np.flatnonzero(first)[1:], len(ring)) - 1
    before[first] = last
    same: BoolArray = (points == points[before]).all(axis=1) & (before != np.arange(len(ring)))
    return same
