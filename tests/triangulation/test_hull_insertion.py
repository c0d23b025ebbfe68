"""The paper's pseudo-code, step by step."""

import itertools

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from stereodel import RectangleLift
from stereodel.predicates import in_bubble
from stereodel.triangulation import HullInsertion, SphericalDelaunay, check_delaunay
from stereodel.triangulation.sites import GHOST
from tests import sets
from tests.spaces import asked, canonical, space_of

SOME = [
    *sets.named("sphere", "unit", "cap", "octahedron", "cube", "rim and pole", "rim and poles", "closed hemisphere"),
    *sets.named("plane", "random", "lattice", "line and a point", "circle and center"),
]
FEW = sets.named("sphere", "octahedron", "cube", "rim and pole", "rim and poles", "tilted rim and pole", "two circles")


def rows(facets):
    return {tuple(row) for row in canonical(np.asarray(facets)).tolist()}


@pytest.mark.parametrize("one", SOME)
def test_each_step_replaces_what_the_point_sees(one):
    """Visible facets by asking every facet; the horizon is one cycle; the fan closes the surface again."""
    points = one.drawn(60)
    engine, sites = HullInsertion(points), asked(points)
    sites.begin(*engine.start)
    before = rows(engine.facets)
    for step in engine:
        assert rows(step.visible) == {f for f in before if sites.sees(*f, step.inserted)}
        assert step.horizon[:, 1].tolist() == np.roll(step.horizon[:, 0], -1).tolist()
        assert len(set(step.horizon[:, 0].tolist())) == len(step.horizon) == len(step.visible) + 2
        assert step.new.tolist() == [[u, v, step.inserted] for u, v in step.horizon.tolist()]
        after = rows(engine.facets)
        assert after == before - rows(step.visible) | rows(step.new)
        before = after
    ghosts = (engine.facets == GHOST).any(axis=1)
    check_delaunay(points, engine.facets[~ghosts])


def inserted(points):
    engine = HullInsertion(points)
    engine.run()
    return engine.simplices


@pytest.mark.parametrize("one", FEW)
def test_against_all_triples(one):
    """The facets are the triples that no other point sees: closed, 2n − 4, without any engine."""
    points = one.drawn(60)
    points = points[np.unique(space_of(points).names(points), return_index=True)[1]]
    sites, numbers = asked(points), range(len(points))
    facets = [
        triple
        for a, b, c in itertools.combinations(numbers, 3)
        for triple in ((a, b, c), (a, c, b))
        if not any(sites.sees(*triple, p) for p in set(numbers) - {a, b, c})
    ]
    assert len(facets) == 2 * len(points) - 4
    assert rows(facets) == rows(inserted(points))


def naive_hull(points, sees):
    """The pseudo-code with a given test, all facets asked, horizon by cancellation of edges."""
    facets = [(0, 1, 2), (0, 2, 1)]
    for p in range(3, len(points)):
        visible = [f for f in facets if sees(points, f, p)]
        edges = {(f[k], f[k - 2]) for f in visible for k in range(3)}
        facets = [f for f in facets if f not in visible] + [(u, v, p) for u, v in edges if (v, u) not in edges]
    return facets


def seen_from_outside(points, facet, p):
    return in_bubble(*points[list(facet)], points[p]) > 0


def papers_rule(points, facet, p):
    """Other side of the plane Ax + By + Cz + D = 0 than the centre, whose value is D."""
    a, b, c = points[list(facet)]
    normal = np.cross(b - a, c - a)
    return (normal @ points[p] - normal @ a) * (-normal @ a) < 0


def test_the_sign_of_d_is_not_enough(rng):
    """Row P14: a rectangle lifted to a hemisphere leaves the centre outside the hull; the paper's test goes wrong."""
    points = RectangleLift(3.0, 2.0).forward(rng.uniform([-1.5, -1.0], [1.5, 1.0], size=(40, 2)))
    expected = {frozenset(f) for f in ConvexHull(points).simplices.tolist()}
    assert {frozenset(f) for f in naive_hull(points, seen_from_outside)} == expected
    assert {frozenset(f) for f in naive_hull(points, papers_rule)} != expected
    assert SphericalDelaunay(points).closing.any()


def test_iterating_may_stop_and_go_on():
    points = sets.sphere("unit").drawn(60)
    engine = HullInsertion(points)
    steps = list(itertools.islice(engine, 10))
    engine.extend(points[:5] * [[0.5, 0.25, 2.0]])
    steps += engine
    assert [s.inserted for s in steps] == list(range(3, 65))
    both = np.vstack([points, points[:5] * [[0.5, 0.25, 2.0]]])
    assert engine.simplices.tolist() == inserted(both).tolist()
    assert list(engine) == []


def test_extending_until_three_points_span():
    engine = HullInsertion([[0.0, 0.0], [1.0, 1.0]])
    engine.run()
    assert (engine.dimension, engine.facets.shape) == (1, (0, 3))
    engine.extend([[2.0, 2.0], [1.0, 1.0]])
    engine.run()
    assert (engine.dimension, engine.duplicates.tolist()) == (1, [[3, 1]])
    engine.extend([[0.0, 1.0]])
    engine.run()
    assert engine.simplices.tolist() == [[0, 1, 4], [1, 2, 4]]
