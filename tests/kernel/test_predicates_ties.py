"""The kernel's decided tests against the tie rule in Python, and against what makes a displacement consistent."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel import _kernel_probe as probe
from tests import sets
from tests.reference import bubble_ray, bubble_tie, ray, turn_ray
from tests.spaces import SPHERE

SMALL = SPHERE.places(2)


def in_bubble(a, b, c, p, **options):
    return probe.in_bubble(*(np.array([v], dtype=float) for v in (a, b, c, p)), **options)[0]


def distinct(vectors):
    """The vectors of different directions."""
    kept = {}
    for v in vectors:
        x, y, z, _ = ray([float(t) for t in v])
        kept[x, y, z] = [float(t) for t in v]
    return list(kept.values())


PLANES = {
    "x = 0": lambda x, y: (0.0, x, y),
    "y = 0": lambda x, y: (x, 0.0, y),
    "x = y": lambda x, y: (x, x, y),
    "y = -z": lambda x, y: (y, x, -x),
}


def tied_sets():
    """Sets full of exact ties: axes, cube, circles of latitude, a great circle in each kind of plane."""
    great = [(1, 0), (1, 1), (0, 1), (-1, 2), (-1, 0), (2, -1), (1, -3)]
    return {
        "cube and axes": sets.sphere("cube and axes").points,
        "parallels": [(x, y, z) for x, y in sets.CIRCLE[:5] for z in (0, 7)],
        "great circle": [(x, y, 0) for x, y in great],
        "great circle through the pole": [(x, 0, z) for x, z in great],
        "great circle x = y": [(x, x, z) for x, z in great],
        "tilted great circle": [(x + y, x - 2 * y, x + y - 3 * y) for x, y in great],
        **{f"unit vectors, {name}": sets.unit([plane(x, y) for x, y in great]) for name, plane in PLANES.items()},
        "small numbers": [v for v in itertools.product(range(-1, 2), range(-1, 2), range(2)) if any(v)],
    }


SETS = {name: distinct(vectors) for name, vectors in tied_sets().items()}


@pytest.mark.parametrize("name", SETS)
def test_the_rule_of_the_reference(name):
    vectors = SETS[name]
    rays = [ray(v) for v in vectors]
    numbers = np.array(list(itertools.permutations(range(len(vectors)), 4)), dtype=np.int32)
    numbers = numbers[np.random.default_rng(1).permutation(len(numbers))[:700]]
    signs, tally = probe.bubble_numbered(np.array(vectors), numbers, True)
    four = [[rays[k] for k in row] for row in numbers]
    zero = [bubble_ray(*row) == 0 for row in four]
    expected = [(bubble_tie(*row) if tied else bubble_ray(*row)) > 0 for row, tied in zip(four, zero, strict=True)]
    assert signs.astype(bool).tolist() == expected
    assert tally[3] == sum(zero)


@given(st.lists(SMALL, min_size=4, max_size=8))
def test_small_integers(vectors):
    vectors = distinct(vectors)
    for four in itertools.islice(itertools.permutations(vectors, 4), 30):
        rays = [ray(v) for v in four]
        assert in_bubble(*four) == ((bubble_ray(*rays) or bubble_tie(*rays)) > 0)


SIGNS = list(itertools.product((1, -1), repeat=3))
REFLECTIONS = [np.array(rows) * signs for rows in itertools.permutations(np.eye(3)) for signs in SIGNS]
REFLECTIONS = [matrix for matrix in REFLECTIONS if np.array_equal(matrix, matrix.T) and np.trace(matrix) == 1]
ANY = st.tuples(*[st.floats(0.25, 1.0) | st.floats(-1.0, -0.25)] * 3)


@given(ANY, ANY, st.sampled_from(REFLECTIONS), st.permutations(range(4)), st.integers(0, 11), st.booleans())
def test_mirror_images_are_ties_and_their_neighbours_are_not(u, w, mirror, order, entry, unit):
    u, w = np.array(u), np.array(w)
    if unit:
        u, w = u / np.linalg.norm(u), w / np.linalg.norm(w)
    four = np.array([u, mirror @ u, w, mirror @ w])[list(order)]
    if len(distinct(four.tolist())) == 4:
        assert probe.bubble(*four[:, None])[0] == 0
        assert in_bubble(*four) == (bubble_tie(*map(ray, four)) > 0)
    four.ravel()[entry] = np.nextafter(four.ravel()[entry], 2.0)
    if len(distinct(four.tolist())) == 4:
        rays = [ray(v) for v in four]
        assert probe.bubble(*four[:, None])[0] == bubble_ray(*rays)
        assert in_bubble(*four) == ((bubble_ray(*rays) or bubble_tie(*rays)) > 0)


@given(ANY, ANY, ANY, st.sampled_from(REFLECTIONS), st.integers(0, 8))
def test_directions_of_a_mirror_are_on_a_great_circle(u, v, w, mirror, entry):
    three = np.array([(np.array(x) + mirror @ np.array(x)) for x in (u, v, w)])
    if three.any(axis=1).all():
        assert probe.turn(*three[:, None])[0] == 0
        three.ravel()[entry] = np.nextafter(three.ravel()[entry], 4.0)
        assert probe.turn(*three[:, None])[0] == turn_ray(*map(ray, three))


def chirotope(vectors, pole):
    """Signs of all quadruples of numbers, decided; `pole` is the number of the artificial one or None."""
    points = np.array(vectors)
    numbers = np.array(list(itertools.permutations(range(len(vectors)), 4)))
    signs = np.empty(len(numbers), dtype=int)
    where = np.argmax(numbers == pole, axis=1) if pole is not None else np.full(len(numbers), -1)
    where[~(numbers == pole).any(axis=1)] = -1
    for first in range(-1, 4):
        rows = where == first
        columns = [np.ascontiguousarray(points[numbers[rows, k]]) for k in range(4)]
        signs[rows] = 2 * probe.in_bubble(*columns, first=first) - 1
    return {tuple(row): sign for row, sign in zip(numbers.tolist(), signs.tolist(), strict=True)}


def assert_chirotope(signs, count):
    """Antisymmetric, and no three-term Grassmann-Pluecker relation is violated: signs of a set of displaced points."""
    for four in itertools.combinations(range(count), 4):
        for order in itertools.permutations(range(4)):
            inversions = sum(order[i] > order[j] for i in range(4) for j in range(i + 1, 4))
            assert signs[tuple(four[k] for k in order)] == (-1) ** inversions * signs[four]
    for x, y in itertools.combinations(range(count), 2):
        rest = [k for k in range(count) if k not in (x, y)]
        for a, b, c, d in itertools.combinations(rest, 4):
            products = {
                signs[x, y, a, b] * signs[x, y, c, d],
                -signs[x, y, a, c] * signs[x, y, b, d],
                signs[x, y, a, d] * signs[x, y, b, c],
            }
            assert products == {-1, 1}


@pytest.mark.parametrize("name", SETS)
@pytest.mark.parametrize("pole", [None, (0, 0, 1), (0, 0, -1), (-1, 0, 0), (1, 0, 0), (0, 1, 0), (2, 3, 6)])
def test_decided_signs_are_those_of_displaced_points(rng, name, pole):
    """With an artificial pole, that comes before all others, as without one."""
    vectors = SETS[name]
    if pole is not None:
        own = ray([float(t) for t in pole])[:3]
        vectors = [v for v in vectors if ray(v)[:3] != own]
    chosen = [vectors[k] for k in rng.permutation(len(vectors))[:7]]
    number = None
    if pole is not None:
        number = int(rng.integers(len(chosen) + 1))
        chosen.insert(number, [float(t) for t in pole])
    assert_chirotope(chirotope(chosen, number), len(chosen))


@given(st.lists(SMALL, min_size=6, max_size=9), st.integers(0, 5))
def test_random_tied_sets_with_a_pole(vectors, number):
    vectors = distinct(vectors)[:7]
    if len(vectors) >= 6:
        assert_chirotope(chirotope(vectors, number), len(vectors))


def test_the_artificial_pole_takes_precedence():
    """A square whose decision differs when a later corner is called the first."""
    square = [(-1, -1, 3), (1, -1, 3), (1, 1, 3), (-1, 1, 3)]
    signs = [in_bubble(*square, first=k) for k in range(-1, 4)]
    assert signs[0] == signs[1] != signs[2]
    assert signs[2] == signs[4] != signs[3] == signs[1]
