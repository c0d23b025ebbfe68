"""Regions of a sphere bounded by arcs, and their visible part: the outline with pieces of the limb, and a lit mesh.

Everything here is in view axes about the ball's centre.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray
from stereodel.constants import LIMB_DEPTH, ON_BALL
from stereodel.drawing.space_curves import CircleArc, Curve
from stereodel.drawing.visibility import Place, split_on_ball

MESH_STEP_RAD = np.radians(1.0)
"""Steps of a mesh along a boundary: its chords leave the arc by 4e-5 of the radius, 0.04 pixels at 1000."""

RING_STEP_RAD = np.radians(4.0)
"""Steps of a mesh across a region, where only the normals matter and those are interpolated."""


@dataclass(frozen=True, eq=False)
class SphereRegion:
    """The part of a sphere about the origin to the left of each of its boundary arcs.

    Parameters
    ----------
    boundary : tuple of CircleArc
        A connected loop on the sphere, counterclockwise about the region as seen from outside.
    radius : float
        Of the sphere.
    """

    boundary: tuple[CircleArc, ...]
    radius: float

    def turned(self, matrix: FloatArray) -> SphereRegion:
        """The region in other axes."""
        return SphereRegion(tuple(arc.moved(matrix, np.zeros(3)) for arc in self.boundary), self.radius)

    def far_side(self) -> SphereRegion:
        """The mirror image in the page, whose near side shows where the far side of this region is."""
        mirror = np.array([1.0, 1.0, -1.0])
        arcs = (
            CircleArc(mirror * arc.center, mirror * arc.u, -mirror * arc.v, -arc.stop, -arc.start)
            for arc in reversed(self.boundary)
        )
        return SphereRegion(tuple(arcs), self.radius)

    def contains(self, points: FloatArray) -> npt.NDArray[np.bool_]:
        """Whether points (..., 3) of the sphere are inside, by more than rounding."""
        inside = np.ones(points.shape[:-1], dtype=bool)
        for arc in self.boundary:
            normal = np.cross(arc.u, arc.v)
            height = np.sum((points - arc.center) * normal, axis=-1) / np.sqrt(np.sum(normal**2))
            inside &= height > ON_BALL * self.radius
        return inside

    def visible_outline(self) -> list[list[Curve]]:
        """Closed runs of arcs that bound the part on the near side (fill: even-odd rule); none when it is hidden."""
        pieces = [piece for arc in self.boundary for piece in split_on_ball(arc, self.radius)]
        front = [place is Place.FRONT for _, place in pieces]
        if self._deepest_toward() <= ON_BALL * self.radius:
            return [[limb(self.radius)]] if self.contains(np.array([0.0, 0.0, self.radius])) else []
        if all(front):
            around = self.contains(limb(self.radius).sample(np.linspace(0, 2 * np.pi, 8))).all()
            runs: list[list[Curve]] = [[curve for curve, _ in pieces]]
            return [*runs, [limb(self.radius)]] if around else runs
        return self._closed_along_limb(_runs([curve for curve, _ in pieces], front))

    def _deepest_toward(self) -> float:
        """How far the boundary comes toward the viewer, seen at sampled points."""
        return max(float(arc.sample(np.linspace(arc.start, arc.stop, 65))[:, 2].max()) for arc in self.boundary)

    def _closed_along_limb(self, runs: list[list[Curve]]) -> list[list[Curve]]:
        """Join runs that start and end on the limb: from each end counterclockwise along it to the nearest start.

        The region is on the left of its boundary and the near side on the left of the limb, so the boundary of both
        together turns left at the limb.
        """
        starts = np.array([_page_angle(run[0].sample(run[0].start)) for run in runs])
        loops, waiting = [], set(range(len(runs)))
        while waiting:
            number = min(waiting)
            loop: list[Curve] = []
            while number in waiting:
                waiting.remove(number)
                loop += runs[number]
                end = _page_angle(loop[-1].sample(loop[-1].stop))
                number = int(np.argmin(np.mod(starts - end, 2 * np.pi)))
                loop.append(limb(self.radius).part(end, end + float(np.mod(starts[number] - end, 2 * np.pi))))
            loops.append(loop)
        return loops

    def visible_mesh(self) -> tuple[FloatArray, npt.NDArray[np.int32]]:
        """Vertices (n, 3) on the sphere and faces (m, 3), counterclockwise from outside, of the near side."""
        rim = self._sampled_boundary()
        middle = self._middle(rim)
        angle = np.arccos(np.clip(np.sum(rim * middle, axis=-1) / self.radius**2, -1.0, 1.0))
        rings = max(1, int(np.ceil(angle.max() / RING_STEP_RAD)))
        share = np.linspace(0.0, 1.0, rings + 1)[1:, None, None]
        sine = np.maximum(np.sin(angle), LIMB_DEPTH)[:, None]
        grid = (np.sin((1 - share) * angle[:, None]) * middle + np.sin(share * angle[:, None]) * rim) / sine
        vertices = np.concatenate([middle[None], grid.reshape(-1, 3)])
        return clipped_to_front(vertices, fan_faces(rings, len(rim)), self.radius)

    def _sampled_boundary(self) -> FloatArray:
        steps = [max(2, int(np.ceil((arc.stop - arc.start) / MESH_STEP_RAD))) for arc in self.boundary]
        sampled = [
            arc.sample(np.linspace(arc.start, arc.stop, n + 1)[:-1])
            for arc, n in zip(self.boundary, steps, strict=True)
        ]
        return np.concatenate(sampled)

    def _middle(self, rim: FloatArray) -> FloatArray:
        """A point of the sphere from which great circles reach all of the rim: a cap's pole, or the rim's mean."""
        first = self.boundary[0]
        toward = np.cross(first.u, first.v) if len(self.boundary) == 1 else rim.mean(axis=0)
        middle: FloatArray = self.radius * toward / np.sqrt(np.sum(toward**2))
        return middle


def limb(radius: float) -> CircleArc:
    """The outline of the ball, counterclockwise on the page."""
    return CircleArc(np.zeros(3), np.array([radius, 0.0, 0.0]), np.array([0.0, radius, 0.0]))


def near_hemisphere(radius: float) -> tuple[FloatArray, npt.NDArray[np.int32]]:
    """Mesh of the half of the ball that the viewer sees: vertices (n, 3), faces (m, 3)."""
    rings, around = round(np.pi / 2 / RING_STEP_RAD), round(2 * np.pi / MESH_STEP_RAD)
    depth = np.linspace(0, np.pi / 2, rings + 1)[1:, None, None]
    rim = limb(1.0).sample(np.linspace(0, 2 * np.pi, around + 1)[:-1])
    grid = np.sin(depth) * rim + np.cos(depth) * np.array([0.0, 0.0, 1.0])
    vertices = np.concatenate([[[0.0, 0.0, 1.0]], grid.reshape(-1, 3)])
    return radius * vertices, fan_faces(rings, around)


def fan_faces(rings: int, around: int) -> npt.NDArray[np.int32]:
    """Faces of a disc of `rings` rings of `around` vertices about vertex 0, counterclockwise if the rings are."""
    here = np.arange(around, dtype=np.int32)
    there = np.roll(here, -1)
    inner = [np.stack([np.zeros_like(here), 1 + here, 1 + there], axis=1)]
    for ring in range(rings - 1):
        low, high = 1 + ring * around, 1 + (ring + 1) * around
        inner.append(np.stack([low + here, high + here, high + there], axis=1))
        inner.append(np.stack([low + here, high + there, low + there], axis=1))
    return np.concatenate(inner).astype(np.int32)


def clipped_to_front(
    vertices: FloatArray, faces: npt.NDArray[np.int32], radius: float
) -> tuple[FloatArray, npt.NDArray[np.int32]]:
    """A mesh on the sphere without what lies behind the limb; cut edges end on the limb."""
    seen = vertices[:, 2] >= -LIMB_DEPTH * radius
    count = seen[faces].sum(axis=1)
    pieces = [vertices[faces[count == 3]]]
    for kept in (1, 2):
        triangles = _rotated(faces[count == kept], seen, kept)
        a, b, c = (vertices[triangles[:, i]] for i in range(3))
        pieces += [np.stack(corners, axis=1) for corners in _cut_corners(a, b, c, kept, radius)]
    soup = np.concatenate(pieces).reshape(-1, 3)
    unique, index = np.unique(soup, axis=0, return_inverse=True)
    return unique, index.reshape(-1, 3).astype(np.int32)


def _rotated(faces: npt.NDArray[np.int32], seen: npt.NDArray[np.bool_], kept: int) -> npt.NDArray[np.int32]:
    """Faces turned so that the odd corner, the one seen or the one hidden, comes first."""
    odd = np.argmax(seen[faces] == (kept == 1), axis=1)
    return np.take_along_axis(faces, (odd[:, None] + np.arange(3)) % 3, axis=1)


def _cut_corners(
    a: FloatArray, b: FloatArray, c: FloatArray, kept: int, radius: float
) -> list[tuple[FloatArray, FloatArray, FloatArray]]:
    """The seen part of triangles whose corner a alone is seen (1) or hidden (2)."""
    on_ab, on_ac = _at_limb(a, b, radius), _at_limb(a, c, radius)
    return [(a, on_ab, on_ac)] if kept == 1 else [(on_ab, b, c), (on_ab, c, on_ac)]


def _at_limb(a: FloatArray, b: FloatArray, radius: float) -> FloatArray:
    """Where edges a–b cross the limb, pushed out onto it."""
    share = a[:, 2:] / (a[:, 2:] - b[:, 2:])
    point = a + share * (b - a)
    point[:, 2] = 0.0
    pushed: FloatArray = point * (radius / np.maximum(np.sqrt(np.sum(point**2, axis=1)), ON_BALL * radius))[:, None]
    return pushed


def _runs(curves: list[Curve], front: list[bool]) -> list[list[Curve]]:
    """Maximal runs of front pieces of a closed loop that is not all front, each in order."""
    first_hidden = front.index(False)
    order = [(first_hidden + i) % len(curves) for i in range(len(curves))]
    runs: list[list[Curve]] = []
    for before, number in zip([order[-1], *order[:-1]], order, strict=True):
        if front[number]:
            runs.append([*runs.pop(), curves[number]] if front[before] else [curves[number]])
    return runs


def _page_angle(point: FloatArray) -> float:
    return float(np.arctan2(point[1], point[0]))
