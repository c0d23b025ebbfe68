"""Regions on the sphere as triangles: their images under a lens, and the parts of them that a view shows.

A region is cut into triangles once, where it is given. Under a lens every side that would show as a chord is halved,
on both sides of it alike, so that neighbours stay joined; a region that reaches across the limb, ±180° or a pole, or
holds the whole far side of the globe, needs no case of its own.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, read_only
from stereodel.conformal import MoebiusMap
from stereodel.conformal.polylines import great_circle_radii, largest_scale
from stereodel.constants import INNER_TOLERANCE, SHORTEST_SIDE
from stereodel.globe.lines import measures_in_lonlat, on_rim
from stereodel.sphere import lonlat_to_xyz
from stereodel.sphere.latitudes import Latitude
from stereodel.sphere.vectors import units

Indices = npt.NDArray[np.intp]

# Corners 0, 1, 2 and the middles 3, 4, 5 of the sides 01, 12, 20; which sides are cut → the triangles that come of it.
PIECES = {
    (True, True, True): [(0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5)],
    (True, True, False): [(3, 1, 4), (0, 3, 4), (0, 4, 2)],
    (False, True, True): [(5, 4, 2), (0, 1, 4), (0, 4, 5)],
    (True, False, True): [(0, 3, 5), (3, 1, 2), (3, 2, 5)],
    (True, False, False): [(0, 3, 2), (3, 1, 2)],
    (False, True, False): [(0, 1, 4), (0, 4, 2)],
    (False, False, True): [(0, 1, 5), (5, 1, 2)],
}


Cap = tuple[FloatArray, float]
"""The points x of the sphere with toward·x ≥ edge."""


@dataclass(frozen=True, eq=False)
class SphereMesh:
    """Triangles that cover regions of the sphere, counterclockwise as seen from outside.

    Parameters
    ----------
    corners : (n, 2) or (n, 3) array
        Longitudes and latitudes in degrees, between which sides are straight in them, as those of map files are; or
        unit vectors, between which sides are great-circle arcs.
    faces : (m, 3) array
        Where triangles meet they share their corners.
    owners : (m,) array
        Number of the region that a triangle belongs to.
    latitude : {"spherical", "geodetic", "authalic"}
        Of `corners` in degrees.
    """

    corners: FloatArray
    faces: Indices
    owners: Indices
    latitude: Latitude = "spherical"

    def __post_init__(self) -> None:
        for name in ("corners", "faces", "owners"):
            read_only(getattr(self, name))

    def through(self, lens: MoebiusMap, *, tolerance: float, cap: Cap | None = None) -> Mesh:
        """The images of the regions as triangles: sides on a border are within `tolerance` radii of their images.

        Sides inside a region, where nothing shows, are so within `INNER_TOLERANCE`. Triangles that are wholly outside a
        cap may be left out.
        """
        corners, faces, owners = self.corners, self.faces, self.owners
        xyz = self._place(corners)
        if cap is not None:
            near = self._may_reach(lens, xyz, cap)
            faces, owners = faces[near], owners[near]
        border = self._border
        done_faces, done_owners = [faces[:0]], [owners[:0]]
        while len(faces):
            sides, which = sides_of(faces)
            on_border = _among(_codes(sides), border)
            allowed = np.where(on_border, tolerance, max(tolerance, INNER_TOLERANCE))
            long = self._bends(lens, corners, xyz, sides, allowed)
            pattern = long[which]
            whole = ~pattern.any(axis=1)
            done_faces.append(faces[whole])
            done_owners.append(owners[whole])
            middle = np.cumsum(long) - 1 + len(xyz)
            halves = np.stack([sides, np.broadcast_to(middle[:, None], sides.shape)], axis=2)[long & on_border]
            border = np.sort(np.concatenate([border, _codes(halves.reshape(-1, 2))]))
            added = self._middles(corners[sides[long, 0]], corners[sides[long, 1]])
            corners, xyz = np.concatenate([corners, added]), np.concatenate([xyz, self._place(added)])
            faces, owners = _halved(np.concatenate([faces, middle[which]], axis=1), pattern, owners)
        weld = self._weld(corners, xyz)
        return Mesh(lens(xyz), weld[np.concatenate(done_faces)], np.concatenate(done_owners))

    @cached_property
    def _border(self) -> npt.NDArray[np.int64]:
        """Codes, in order, of the sides that one triangle alone has, or triangles of two regions."""
        sides, which = sides_of(self.faces)
        low, high = np.full(len(sides), len(self.owners)), np.full(len(sides), -1)
        owner = np.repeat(self.owners, 3)
        np.minimum.at(low, which.ravel(), owner)
        np.maximum.at(high, which.ravel(), owner)
        alone = np.bincount(which.ravel(), minlength=len(sides)) == 1
        return _codes(sides[alone | (low != high)])

    def _may_reach(self, lens: MoebiusMap, xyz: FloatArray, cap: Cap) -> npt.NDArray[np.bool_]:
        """Which triangles have images that may reach into a cap.

        A triangle lies within its size of its first corner; the largest scale there bounds how far its image goes.
        """
        first = self.faces[:, 0]
        sizes = self._sizes(xyz)
        toward, edge = cap
        highest = (lens(xyz[first]) @ toward) + sizes * largest_scale(lens, xyz[first], sizes)
        near: npt.NDArray[np.bool_] = highest >= edge
        return near

    def _sizes(self, xyz: FloatArray) -> FloatArray:
        """Radii of discs about the first corners that hold the triangles, radians."""
        if self.corners.shape[1] == 3:
            chords = xyz[self.faces] - xyz[np.roll(self.faces, -1, axis=1)]
            longest: FloatArray = np.sqrt(np.sum(chords**2, axis=2)).max(axis=1)
            angles: FloatArray = 2 * np.arcsin(np.minimum(longest / 2, 1.0))
            return angles
        width, height = np.radians(np.ptp(self.corners[self.faces], axis=1)).T
        z = xyz[self.faces, 2]
        lowest = np.where(z.min(axis=1) * z.max(axis=1) < 0, 0.0, np.abs(z).min(axis=1))
        sizes: FloatArray = np.hypot(np.sqrt(np.maximum(0.0, 1 - lowest**2)) * width, height)
        return sizes

    def _place(self, corners: FloatArray) -> FloatArray:
        return lonlat_to_xyz(corners, latitude=self.latitude) if corners.shape[1] == 2 else corners

    def _middles(self, start: FloatArray, end: FloatArray) -> FloatArray:
        return (start + end) / 2 if start.shape[1] == 2 else units(start + end)

    def _bends(
        self, lens: MoebiusMap, corners: FloatArray, xyz: FloatArray, sides: Indices, tolerance: FloatArray
    ) -> npt.NDArray[np.bool_]:
        """Which sides may stray from the chords of their images by more than a tolerance.

        The largest scale within the length of a side from one of its ends bounds the length of its image, and that
        squared over eight radii of the image's circle the height of the arc over its chord. A triangle that holds the
        focus has an end of its longest side no farther from it than that, so that it is never taken for flat.
        """
        first, second = sides.T
        start, end = xyz[first], xyz[second]
        bend: FloatArray | float = 0.0
        if corners.shape[1] == 2:
            length, bend = measures_in_lonlat(corners[first], corners[second], start, end)
        else:
            length = 2 * np.arcsin(np.minimum(np.sqrt(np.sum((end - start) ** 2, axis=1)) / 2, 1.0))
        scale = largest_scale(lens, start, length)
        height = (scale * length) ** 2 / (8 * great_circle_radii(lens, start, end)) + bend * scale
        strays: npt.NDArray[np.bool_] = (np.minimum(height, scale * length) > tolerance) & (length > SHORTEST_SIDE)
        return strays

    def _weld(self, corners: FloatArray, xyz: FloatArray) -> Indices:
        """For each corner the first one at the same place: only those on ±180° and at the poles come twice."""
        number = np.arange(len(xyz))
        if corners.shape[1] == 3:
            return number
        twice = np.flatnonzero((np.abs(corners[:, 0]) == 180) | (np.abs(corners[:, 1]) == 90))
        _, first, where = np.unique(xyz[twice], axis=0, return_index=True, return_inverse=True)
        number[twice] = twice[first][where.ravel()]
        return number


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles in space: unit vectors (n, 3), faces (m, 3), and the region that each face belongs to (m,)."""

    points: FloatArray
    faces: Indices
    owners: Indices

    def clipped(self, edge: float, *, tolerance: float) -> tuple[Mesh, npt.NDArray[np.bool_]]:
        """The part in the cap z ≥ edge, points being in view axes, and which of its points lie on the rim.

        Sides along the rim are within `tolerance` radii of it.
        """
        inside = self.points[:, 2] >= edge
        count = inside[self.faces].sum(axis=1)
        # Sides that cross the rim get one corner there, whichever triangle asks.
        cut = self.faces[(count == 1) | (count == 2)]
        sides, _ = sides_of(cut)
        sides = sides[inside[sides[:, 0]] != inside[sides[:, 1]]]
        outward = np.where(inside[sides[:, 0]][:, None], sides, sides[:, ::-1])
        rim = on_rim(self.points[outward[:, 0]], self.points[outward[:, 1]], edge)
        points = np.concatenate([self.points, rim])
        codes = _codes(sides)
        faces, owners = [self.faces[count == 3]], [self.owners[count == 3]]
        for kept in (1, 2):
            chosen = np.flatnonzero(count == kept)
            a, b, c = _odd_first(self.faces[chosen], inside, kept == 1).T
            ab, ac = (np.searchsorted(codes, _codes(np.stack([a, z], axis=1))) + len(self.points) for z in (b, c))
            pieces = [(a, ab, ac)] if kept == 1 else [(ab, b, c), (ab, c, ac)]
            faces += [np.stack(piece, axis=1) for piece in pieces]
            owners += [self.owners[chosen]] * len(pieces)
        on_edge = np.arange(len(points)) >= len(self.points)
        on_edge[: len(self.points)] = self.points[:, 2] == edge
        part, marks = _compact(points, np.concatenate(faces), np.concatenate(owners), on_edge)
        return _along_rim(part, marks, edge, tolerance)


def sides_of(faces: Indices) -> tuple[Indices, Indices]:
    """The sides of triangles (k, 2), lower corner first, in order, and the three that each has (m, 3): 01, 12, 20."""
    pairs = np.stack([faces, np.roll(faces, -1, axis=1)], axis=2).reshape(-1, 2)
    codes, which = np.unique(_codes(pairs), return_inverse=True)
    return np.stack([codes >> 32, codes & (2**32 - 1)], axis=1), which.reshape(-1, 3)


def _among(codes: npt.NDArray[np.int64], known: npt.NDArray[np.int64]) -> npt.NDArray[np.bool_]:
    """Which codes are among those known, which are in order: `np.isin` would put both in order again."""
    places = np.searchsorted(known, codes)
    found: npt.NDArray[np.bool_] = np.append(known, -1)[places] == codes
    return found


def _codes(pairs: Indices) -> npt.NDArray[np.int64]:
    """One number for each side (k, 2), whichever way it runs."""
    codes: npt.NDArray[np.int64] = (pairs.min(axis=1) << 32) + pairs.max(axis=1)
    return codes


def _halved(corners: Indices, pattern: npt.NDArray[np.bool_], owners: Indices) -> tuple[Indices, Indices]:
    """Faces with their long sides halved, from corners 0 to 2 and middles 3 to 5; none that had no long side."""
    faces, owner = [corners[:0, :3]], [owners[:0]]
    for sides, parts in PIECES.items():
        chosen = np.flatnonzero((pattern == sides).all(axis=1))
        faces.append(corners[chosen][:, parts].reshape(-1, 3))
        owner.append(np.repeat(owners[chosen], len(parts)))
    return np.concatenate(faces), np.concatenate(owner)


def _odd_first(faces: Indices, inside: npt.NDArray[np.bool_], odd: bool) -> Indices:
    """Faces turned so that the corner that is alone on its side comes first."""
    first = np.argmax(inside[faces] == odd, axis=1)
    turned: Indices = np.take_along_axis(faces, (first[:, None] + np.arange(3)) % 3, axis=1)
    return turned


def _along_rim(
    mesh: Mesh, rim: npt.NDArray[np.bool_], edge: float, tolerance: float
) -> tuple[Mesh, npt.NDArray[np.bool_]]:
    """A mesh whose sides along the rim are cut into pieces so short that they follow it."""
    count = rim[mesh.faces].sum(axis=1)
    chosen = np.flatnonzero(count == 2)
    c, a, b = _odd_first(mesh.faces[chosen], rim, False).T
    # A side that two triangles share runs across the cap and not along the rim.
    _, which, times = np.unique(_codes(np.stack([a, b], axis=1)), return_inverse=True, return_counts=True)
    alone = times[which] == 1
    chosen, a, b, c = chosen[alone], a[alone], b[alone], c[alone]
    u, w = mesh.points[a, :2], mesh.points[b, :2]
    sweep = np.arctan2(u[:, 0] * w[:, 1] - u[:, 1] * w[:, 0], np.sum(u * w, axis=1))
    radius = np.sqrt(1 - edge**2)
    step = 2 * np.arccos(np.clip(1 - tolerance / radius, 0.0, 1.0))
    pieces = np.maximum(1, np.ceil(np.abs(sweep) / step)).astype(np.intp)
    face = np.repeat(np.arange(len(a)), pieces)
    number = np.arange(len(face)) - np.repeat(np.cumsum(pieces) - pieces, pieces)
    first, last = number == 0, number == pieces[face] - 1
    angle = (np.arctan2(u[:, 1], u[:, 0])[face] + sweep[face] * number / pieces[face])[~first]
    added = np.stack([radius * np.cos(angle), radius * np.sin(angle), np.full(len(angle), edge)], axis=1)
    # The corner that begins each piece; the next one ends it.
    begin = np.where(first, a[face], len(mesh.points) + np.cumsum(~first) - 1)
    end = np.where(last, b[face], np.roll(begin, -1))
    fans = np.stack([c[face], begin, end], axis=1)
    kept = np.ones(len(mesh.faces), dtype=bool)
    kept[chosen] = False
    points = np.concatenate([mesh.points, added])
    faces = np.concatenate([mesh.faces[kept], fans])
    owners = np.concatenate([mesh.owners[kept], mesh.owners[chosen][face]])
    return Mesh(points, faces, owners), np.concatenate([rim, np.ones(len(added), dtype=bool)])


def _compact(
    points: FloatArray, faces: Indices, owners: Indices, marks: npt.NDArray[np.bool_]
) -> tuple[Mesh, npt.NDArray[np.bool_]]:
    """A mesh without points that no face uses, and the marks of those left."""
    used = np.zeros(len(points), dtype=bool)
    used[faces] = True
    number = np.cumsum(used) - 1
    return Mesh(points[used], number[faces], owners), marks[used]
