"""Images of many great-circle arcs at once, as polylines that stay close to them.

The image of an arc is an arc of a circle (claim P19 of the paper), known exactly by its ends, its axis and the angle
that it sweeps; points are spread evenly over the image, so that their number depends on how the line looks after the
map and not before it. Nothing is sampled in between: a meridian is as smooth at magnification 1000 as at 1.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray
from stereodel.conformal.moebius import MoebiusMap
from stereodel.sphere.vectors import turned

Indices = npt.NDArray[np.intp]


def image_of_polylines(
    lens: MoebiusMap, points: FloatArray, offsets: Indices, *, tolerance: float
) -> tuple[FloatArray, Indices]:
    """Polylines near the images of lines of great-circle arcs.

    Parameters
    ----------
    lens : MoebiusMap
    points : (n, 3) array
        Unit vectors; neighbours on a line are joined by the shorter great-circle arc and are not opposite.
    offsets : (m + 1,) int array
        Line i is ``points[offsets[i]:offsets[i + 1]]``.
    tolerance : float
        How far the chords of the result may be from the images, as a share of the sphere's radius.

    Returns
    -------
    points : (k, 3) array
        Unit vectors; the images of the given points are among them.
    offsets : (m + 1,) int array

    Examples
    --------
    >>> from stereodel import fisheye
    >>> equator = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    >>> lens = fisheye((45.0, 0.0), magnification=100.0)
    >>> found, ends = image_of_polylines(lens, equator, np.array([0, 2]), tolerance=1e-4)
    >>> len(found), float(np.abs(found[:, 2]).max()) < 1e-14
    (221, True)
    """
    points, offsets = _cut_at_apsides(lens, points, offsets)
    images = lens(points)
    if len(points) < 2:
        return images, offsets
    joined = np.ones(len(points), dtype=bool)
    joined[offsets[1:] - 1] = False
    first = np.flatnonzero(joined)
    center, u, v, sweep = _image_circles(lens, points[first], points[first + 1], images[first], images[first + 1])
    radius = np.sqrt(np.sum(u**2, axis=1))
    # A chord of the angle a is off its arc by r(1 − cos(a/2)).
    with np.errstate(divide="ignore", invalid="ignore"):
        step = 2 * np.arccos(np.clip(1 - tolerance / radius, -1.0, 1.0))
    pieces = np.maximum(1, np.ceil(np.where(radius > tolerance, sweep / step, 1.0))).astype(np.intp)
    arc = np.repeat(np.arange(len(first)), pieces - 1)
    number = np.arange(len(arc)) - np.repeat(np.cumsum(pieces - 1) - (pieces - 1), pieces - 1) + 1
    angle = (sweep[arc] * number / pieces[arc])[:, None]
    between = center[arc] + np.cos(angle) * u[arc] + np.sin(angle) * v[arc]
    return np.insert(images, first[arc] + 1, between, axis=0), _after_insertion(offsets, first[arc] + 1)


def largest_scale(lens: MoebiusMap, points: FloatArray, radius: FloatArray) -> FloatArray:
    """The largest local scale within angular distances `radius` (n,) of unit vectors (n, 3), radians."""
    there = turned(points, lens.right.matrix)
    size = lens.magnification
    height = there[:, 2] if size >= 1 else -there[:, 2]
    across = np.sqrt(there[:, 0] ** 2 + there[:, 1] ** 2)
    # Nearest to the point of largest scale: the focus, or its antipode where the map shrinks.
    half = np.maximum(np.arctan2(across, height) - radius, 0.0) / 2
    larger = max(size, 1 / size)
    scale: FloatArray = larger / (np.cos(half) ** 2 + (larger * np.sin(half)) ** 2)
    return scale


def great_circle_radii(lens: MoebiusMap, start: FloatArray, end: FloatArray) -> FloatArray:
    """Radii in space of the circles that are the images of great circles through two points each, (n,)."""
    _, _, radius = _image_axes(lens, _normals(start, end))
    return radius


def _image_circles(
    lens: MoebiusMap, start: FloatArray, end: FloatArray, start_image: FloatArray, end_image: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Centre, two perpendicular radii, the first to the start, and angle swept, of the images of great-circle arcs."""
    axis, offset, _ = _image_axes(lens, _normals(start, end))
    center = axis * offset[:, None]
    u, w = start_image - center, end_image - center
    v = np.cross(axis, u)
    # At most half a turn, after `_cut_at_apsides`; what rounding makes negative is nothing.
    sweep = np.maximum(np.arctan2(np.sum(v * w, axis=1), np.sum(u * w, axis=1)), 0.0)
    return center, u, v, sweep


def _normals(start: FloatArray, end: FloatArray) -> FloatArray:
    """Unit normals of the great circles from start to end; zero where these agree."""
    # a × b = (a − b) × (a + b) / 2, whose first factor is exact for close points.
    normal = np.cross(start - end, start + end)
    length = np.sqrt(np.sum(normal**2, axis=1, keepdims=True))
    unit: FloatArray = np.divide(normal, length, out=np.zeros_like(normal), where=length > 0)
    return unit


def _image_axes(lens: MoebiusMap, normals: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Unit normals, offsets and radii of the images of great circles: `boost_circle` in plain doubles."""
    across = turned(normals, lens.right.matrix)
    size = lens.magnification
    height, offset = across[:, 2] * (1 / size + size) / 2, across[:, 2] * (1 / size - size) / 2
    across[:, 2] = height
    length = np.sqrt(1 + offset**2)
    axes: FloatArray = turned(across, lens.left.matrix) / length[:, None]
    return axes, offset / length, 1 / length


def _cut_at_apsides(lens: MoebiusMap, points: FloatArray, offsets: Indices) -> tuple[FloatArray, Indices]:
    """Lines with a point added where an arc is nearest to the focus or farthest from it.

    The images of these two points of a great circle are opposite on its image, by symmetry: between them an image
    sweeps half a turn at most, and its ends alone tell how far.
    """
    if lens.magnification == 1 or len(points) < 2:
        return points, offsets
    joined = np.ones(len(points) - 1, dtype=bool)
    joined[offsets[1:-1] - 1] = False
    first = np.flatnonzero(joined)
    start, end = points[first], points[first + 1]
    focus = lens.focus
    normal = _normals(start, end)
    apsis = focus - normal * (normal @ focus)[:, None]
    ahead = np.sum(np.cross(normal, start) * apsis, axis=1)
    behind = -np.sum(np.cross(normal, end) * apsis, axis=1)
    cut = np.flatnonzero(ahead * behind > 0)
    size = np.sqrt(np.sum(apsis[cut] ** 2, axis=1)) * np.sign(ahead[cut])
    where = first[cut] + 1
    return np.insert(points, where, apsis[cut] / size[:, None], axis=0), _after_insertion(offsets, where)


def _after_insertion(offsets: Indices, where: Indices) -> Indices:
    """Offsets of lines once points were inserted before the given places, in order, inside lines."""
    shifted: Indices = offsets + np.searchsorted(where, offsets)
    return shifted
