"""What tests/sets.py says of its sets is true, and all that is true is said."""

import numpy as np
import pytest

from stereodel import PlanarVoronoi, SphericalVoronoi
from tests import sets


def shape_of(points, simplices):
    """By the sides and angles of the triangles: whether a set has clusters, and needles."""
    scaled = points / np.abs(points).max(axis=None if points.shape[1] == 2 else 1, keepdims=True)
    corners = (scaled if points.shape[1] == 2 else sets.unit(scaled))[simplices]
    sides = corners - np.roll(corners, 1, axis=1)
    long = np.sort(np.linalg.norm(sides, axis=2), axis=1)
    gram = [np.cross(sides[:, 0], sides[:, 1])] if points.shape[1] == 3 else [np.linalg.det(sides[:, :2])[:, None]]
    area = np.linalg.norm(gram[0], axis=1)
    return {
        "cluster": long[:, 0].min() < 1e-6 * long.max(),
        "needle": (area <= 1e-5 * long[:, 1] * long[:, 2]).any(),
    }


@pytest.mark.parametrize("one", sets.of())
def test_traits_and_answers_are_true(one):
    points = one.points
    diagram = (PlanarVoronoi if one.space == "plane" else SphericalVoronoi)(points)
    delaunay, size = diagram.delaunay(), np.abs(points[points != 0])
    flat = len(delaunay.simplices) == 0
    traits = {
        one.space: True,
        "few": "grows" not in one.traits and len(points) <= 30,
        "flat": flat,
        "hemisphere": one.space == "sphere" and (flat or delaunay.closing.any()),
        "ties": len(diagram.vertices) < len(delaunay.simplices),
        "duplicates": len(delaunay.duplicates) > 0,
        "sizes": len(size) and max(size.max(), 1) > 1e100 * min(size.min(), 1),
    }
    traits |= {} if flat else shape_of(points, delaunay.simplices)
    traits["random"] = not (flat or traits["ties"] or traits["duplicates"]) and "random" in one.traits
    assert {name for name, true in traits.items() if true} == one.traits - {"grows"}
    assert one.triangles in (None, len(delaunay.simplices))
    assert one.hull in (None, len(delaunay.convex_hull))
