"""Integrals over flat and spherical triangles."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from stereodel._arrays import AnyIndices, FloatArray
from stereodel.constants import QUADRATURE_CHORD


class Rule(NamedTuple):
    """Barycentric coordinates (k, 3) of nodes, and their weights (k,), which sum to one."""

    nodes: FloatArray
    shares: FloatArray


MIDPOINTS = Rule((np.ones((3, 3)) - np.eye(3)) / 2, np.full(3, 1 / 3))
"""Exact for polynomials of degree two."""


def _radon() -> Rule:
    root = np.sqrt(15.0)
    equal = (np.array([6.0 - root, 6.0 + root]) / 21)[:, None, None]
    corners = equal + np.eye(3) * (1 - 3 * equal)
    nodes = np.vstack([np.full((1, 3), 1 / 3), corners.reshape(6, 3)])
    return Rule(nodes, np.repeat([9 / 40, (155 - root) / 1200, (155 + root) / 1200], [1, 3, 3]))


RADON = _radon()
"""Exact for polynomials of degree five: J. Radon, "Zur mechanischen Kubatur" (1948)."""


def flat_nodes(triangles: FloatArray, rule: Rule) -> tuple[FloatArray, FloatArray]:
    """Nodes (t, k, 2) and weights (t, k) for counterclockwise triangles (t, 3, 2) of the plane."""
    b, c = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    areas = (b[:, 0] * c[:, 1] - b[:, 1] * c[:, 0]) / 2
    return np.einsum("kc,tcd->tkd", rule.nodes, triangles), areas[:, None] * rule.shares


def spherical_nodes(triangles: FloatArray, rule: Rule) -> tuple[FloatArray, FloatArray]:
    """Nodes (t, k, 3), unit vectors, and weights (t, k) for counterclockwise triangles (t, 3, 3) of unit vectors.

    The flat triangle's nodes y are projected from the centre: a small area of it, seen from there, is
    det[a b c] / |y|³ times as large as its share of the triangle, halved.
    """
    a, b, c = (triangles[:, k] for k in range(3))
    determinant = np.einsum("ti,ti->t", a, np.cross(b - a, c - a))
    flat = np.einsum("kc,tcd->tkd", rule.nodes, triangles)
    length = np.sqrt(np.einsum("tkd,tkd->tk", flat, flat))
    return flat / length[..., None], (determinant / 2)[:, None] * rule.shares / length**3


def split_long(triangles: FloatArray, number: AnyIndices) -> tuple[FloatArray, AnyIndices]:
    """Spherical triangles (t, 3, 3) and their numbers (t,), halved until no side is longer than QUADRATURE_CHORD."""
    done = [(triangles[:0], number[:0])]
    while len(triangles):
        # Side k is the one opposite corner k: from the corner after it to the corner before it.
        sides = np.linalg.norm(np.roll(triangles, -1, axis=1) - np.roll(triangles, 1, axis=1), axis=2)
        long = sides.max(axis=1) > QUADRATURE_CHORD
        done.append((triangles[~long], number[~long]))
        triangles, number = _halves(triangles[long], sides[long]), np.tile(number[long], 2)
    return np.concatenate([t for t, _ in done]), np.concatenate([n for _, n in done])


def _halves(triangles: FloatArray, sides: FloatArray) -> FloatArray:
    """Both halves (2t, 3, 3) of triangles cut from the middle of the longest side, which is opposite its corner."""
    # Corners turned so that the longest side is bc; its middle on the sphere is the direction of b + c.
    turn = (np.argmax(sides, axis=1)[:, None] + np.arange(3)) % 3
    a, b, c = np.moveaxis(np.take_along_axis(triangles, turn[:, :, None], axis=1), 1, 0)
    middle = b + c
    length = np.linalg.norm(middle, axis=1, keepdims=True)
    middle = np.where(length > 0, middle / np.where(length > 0, length, 1.0), a)
    return np.concatenate([np.stack([a, b, middle], axis=1), np.stack([a, middle, c], axis=1)])
