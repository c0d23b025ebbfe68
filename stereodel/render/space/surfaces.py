"""Surfaces in space as triangles: balls, tubes along curves, regions of a sphere, flat polygons.

Triangles are counterclockwise as seen from outside. Corners have the normals of the exact surface, for smooth shading.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from typing import Final

import numpy as np

from stereodel._arrays import AnyIndices, BoolArray, FloatArray, Indices
from stereodel._extras import optional
from stereodel.drawing.scene.space_curves import CircleArc, Curve, Segment
from stereodel.drawing.scene.visibility import SphereRegion
from stereodel.sphere.vectors import units
from stereodel.triangulation import SphericalDelaunay

CURVE_ERROR: Final = 1 / 2000
"""Largest distance of a curve from its chords, in radii of the scene's ball: half a pixel in a thousand."""

BALL_LEVELS: Final = (4, 5, 6)
"""Subdivision levels of an icosahedron for a ball: 5120, 20480 or 81920 triangles."""

DOT_LEVEL: Final = 2
"""Subdivision level for dots, which are small: 320 triangles."""


@dataclass(frozen=True, eq=False)
class TriangleMesh:
    """Triangles (m, 3) that share corners (n, 3), whose normals are unit vectors outward."""

    points: FloatArray
    normals: FloatArray
    faces: Indices

    @property
    def depth(self) -> float:
        """Largest depth of the triangles of a part of the unit sphere below the sphere."""
        a, b, c = (self.points[self.faces[:, k]] for k in range(3))
        return 1 - float(np.sum(a * units(np.cross(b - a, c - a)), axis=1).min())

    @classmethod
    def joined(cls, surfaces: Sequence[TriangleMesh]) -> TriangleMesh:
        """Several surfaces as one; at least one of them."""
        first = np.cumsum([0, *(len(surface.points) for surface in surfaces)])
        faces = [surface.faces + start for surface, start in zip(surfaces, first[:-1], strict=True)]
        points, normals = ([getattr(s, name) for s in surfaces] for name in ("points", "normals"))
        return cls(np.concatenate(points), np.concatenate(normals), np.concatenate(faces))


@cache
def ball(level: int) -> TriangleMesh:
    """The unit ball: an icosahedron, its sides halved `level` times, corners on the sphere."""
    made = optional("trimesh.creation", "render").icosphere(subdivisions=level, radius=1.0)
    points = units(np.array(made.vertices, dtype=np.float64))
    return TriangleMesh(points, points, np.array(made.faces, dtype=np.intp))


# Tubes


def tube(curve: Curve, radius: float, error: float) -> TriangleMesh | None:
    """The points within `radius` of a curve, with round ends; None for a curve of length zero.

    curve: before any view, so that both radii of an arc have the same length.
    error: largest distance of the curve from its chords, and of cross-sections from theirs.
    """
    found = _frames(curve, error)
    if found is None:
        return None
    middle, along, side = found
    sides = max(6, _pieces(2 * np.pi, radius, error))
    turn = 2 * np.pi * np.arange(sides)[:, None] / sides
    rings = np.cos(turn) * side[:, None] + np.sin(turn) * np.cross(along, side)[:, None]
    if not curve.closed:
        # A ring at 45° between each end of a tube and the tip of its cap.
        begin, end = np.sqrt(0.5) * (rings[0] - along[0]), np.sqrt(0.5) * (rings[-1] + along[-1])
        rings = np.concatenate([begin[None], rings, end[None]])
        middle = np.concatenate([middle[:1], middle, middle[-1:]])
    normals, points = rings.reshape(-1, 3), (middle[:, None] + radius * rings).reshape(-1, 3)
    faces = _sleeve(len(middle), sides, closed=curve.closed)
    if curve.closed:
        return TriangleMesh(points, normals, faces)
    tips = np.array([-along[0], along[-1]])
    return TriangleMesh(
        np.concatenate([points, middle[[0, -1]] + radius * tips]),
        np.concatenate([normals, tips]),
        np.concatenate([faces, _tips(len(middle), sides)]),
    )


def dashed(curve: Curve, dash: float, gap: float) -> list[Curve]:
    """The dashes of a curve of positive length; only the last may be shorter."""
    length = _speed(curve) * (curve.stop - curve.start)
    if length == 0:
        return []
    starts = np.arange(0.0, length, dash + gap)
    ends = np.minimum(starts + dash, length)
    rate = (curve.stop - curve.start) / length
    return [
        curve.part(curve.start + rate * float(a), curve.start + rate * float(b))
        for a, b in zip(starts, ends, strict=True)
    ]


def _frames(curve: Curve, error: float) -> tuple[FloatArray, FloatArray, FloatArray] | None:
    """Points along a curve, tangents, and perpendicular directions that rotate as little as possible, (k, 3) each."""
    speed = _speed(curve)
    if speed == 0 or curve.stop <= curve.start:
        return None
    if isinstance(curve, Segment):
        along = curve.direction / speed
        # Perpendicular to the axis least aligned with the segment, to avoid cancellation in the product.
        across = np.cross(along, np.eye(3)[np.argmin(np.abs(along))])
        t = np.array([curve.start, curve.stop])
        return curve.sample(t), np.tile(along, (2, 1)), np.tile(across / np.sqrt(np.sum(across**2)), (2, 1))
    sweep = curve.stop - curve.start
    pieces = _pieces(sweep, speed, error)
    t = curve.start + sweep * np.arange(pieces + (not curve.closed)) / pieces
    cosine, sine = np.cos(t)[:, None], np.sin(t)[:, None]
    return curve.sample(t), (cosine * curve.v - sine * curve.u) / speed, (cosine * curve.u + sine * curve.v) / speed


def _speed(curve: Curve) -> float:
    """Length per unit of the parameter."""
    step = curve.u if isinstance(curve, CircleArc) else curve.sample(1.0) - curve.sample(0.0)
    return float(np.sqrt(np.sum(step**2)))


def _pieces(sweep: float, radius: float, error: float) -> int:
    """Number of chords that keep an arc within `error`: a chord over the angle 2a is radius·(1 − cos a) away."""
    widest = 2 * float(np.arccos(max(1 - error / radius, 0.5)))
    return max(1, int(np.ceil(sweep / widest)))


def _sleeve(rings: int, sides: int, *, closed: bool) -> Indices:
    """Triangles between neighbouring rings with equal numbers of points."""
    ring = np.arange(rings if closed else rings - 1)[:, None]
    here, after = ring * sides + np.arange(sides), ring * sides + np.roll(np.arange(sides), -1)
    there, there_after = (here + sides) % (rings * sides), (after + sides) % (rings * sides)
    return np.stack([here, after, there, after, there_after, there], axis=-1).reshape(-1, 3)


def _tips(rings: int, sides: int) -> Indices:
    """Triangles from the outermost rings of a tube to its two tips, whose points follow those of the rings."""
    ring, after = np.arange(sides), np.roll(np.arange(sides), -1)
    first, last = np.full(sides, rings * sides), np.full(sides, rings * sides + 1)
    high = (rings - 1) * sides
    return np.concatenate([np.column_stack([first, after, ring]), np.column_stack([last, high + ring, high + after])])


# Flat polygons and regions of a sphere


def polygon(corners: FloatArray, normal: FloatArray) -> TriangleMesh:
    """A flat simple polygon, corners (n, 3) in either order, visible from the side of its normal."""
    side = np.cross(normal, np.eye(3)[np.argmin(np.abs(normal))])
    flat = corners @ np.column_stack([side, np.cross(normal, side)])
    rings = np.array([len(corners)], dtype=np.uint32)
    found = optional("mapbox_earcut", "draw").triangulate_float64(flat, rings)
    faces = found.astype(np.intp).reshape(-1, 3)
    (ux, uy), (vx, vy) = ((flat[faces[:, i]] - flat[faces[:, 0]]).T for i in (1, 2))
    clockwise = ux * vy - uy * vx < 0
    faces[clockwise] = faces[clockwise][:, ::-1]
    return TriangleMesh(corners, np.tile(normal, (len(corners), 1)), faces)


def patch(region: SphereRegion, level: int) -> TriangleMesh:
    """A region on the unit sphere, left of its boundary, as triangles; ValueError if the boundary crosses itself.

    The points of a ball of that level and those of the boundary are triangulated together, without points of the ball
    that would separate neighbours on the boundary.
    """
    arcs = [arc.scaled(1 / region.radius, np.zeros(3)) for arc in region.boundary]
    steps = [np.linspace(a.start, a.stop, _pieces(a.stop - a.start, _speed(a), CURVE_ERROR) + 1) for a in arcs]
    for _ in range(24):  # times sides missing in the triangulation are halved, down to 1e-8 radii
        rim = units(np.concatenate([arc.sample(t[:-1]) for arc, t in zip(arcs, steps, strict=True)]))
        mesh = SphericalDelaunay(np.concatenate([rim, _away_from(rim, ball(level).points)]))
        crossed = ~_has_edges(mesh.simplices, len(rim))
        if not crossed.any():
            inside = mesh.simplices[_left_of(mesh.simplices, mesh.neighbors, len(rim))]
            used, numbers = np.unique(inside, return_inverse=True)
            return TriangleMesh(mesh.points[used], mesh.points[used], numbers.reshape(-1, 3))
        parts = np.split(crossed, np.cumsum([len(t) - 1 for t in steps])[:-1])
        steps = [np.sort([*t, *((t[:-1] + t[1:])[part] / 2)]) for t, part in zip(steps, parts, strict=True)]
    raise ValueError("the boundary of a region crosses itself; give the arcs of a loop that does not")


def _away_from(rim: FloatArray, points: FloatArray) -> FloatArray:
    """Points outside circles around the sides of a loop, whose diameters are a quarter longer than the sides."""
    after = np.roll(rim, -1, axis=0)
    middle, reach = (rim + after) / 2, 0.625 * np.sqrt(np.sum((rim - after) ** 2, axis=1))
    distance = np.sqrt(np.sum((points[:, None] - middle) ** 2, axis=-1))
    return points[(distance > reach).all(axis=1)]


def _has_edges(simplices: AnyIndices, count: int) -> BoolArray:
    """Which sides of the loop of points 0 … `count` − 1 are sides of triangles."""
    starts, ends = simplices.ravel(), np.roll(simplices, -1, axis=1).ravel()
    found = np.zeros(count, dtype=bool)
    found[starts[(starts < count) & (ends == (starts + 1) % count)]] = True
    return found


def _left_of(simplices: AnyIndices, neighbors: AnyIndices, count: int) -> BoolArray:
    """The triangles on the left of a loop of points 0 … `count` − 1, all of whose sides are sides of triangles."""
    # Side k of a triangle is opposite corner k: from corner k + 1 to corner k + 2.
    starts, ends = np.roll(simplices, -1, axis=1), np.roll(simplices, -2, axis=1)
    ahead = (starts < count) & (ends == (starts + 1) % count)
    behind = (ends < count) & (starts == (ends + 1) % count)
    beyond = np.where(ahead | behind, -1, neighbors)
    inside = ahead.any(axis=1)
    front = np.flatnonzero(inside)
    while len(front):
        reached = np.unique(beyond[front])
        front = reached[(reached >= 0) & ~inside[reached]]
        inside[front] = True
    return inside
