"""How sharp the bounds of the kernel's filters are: points for which a fifth of a bound would give the wrong sign.

Found by a search that moved nearly degenerate points by last digits, toward the largest computed value that has the
wrong sign, relative to what the bound is a multiple of. Of random points, cocircular ones among them, those of
incircle, of turns and of bubbles never come near: their other tests pass at a fifth of the bounds.
"""

import re
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

import stereodel
from stereodel import _kernel_probe as probe
from tests.exact import dot, minus
from tests.reference import bubble_ray, det3, ray, turn_ray

OPEN = 2
PREDICATES = Path(stereodel.__file__).parent / "kernel" / "predicates"
ROUNDOFF = 2.0**-53

WORST = """
orient2d 0x1.0e55e9a389994p-3 0x1.02977cc297c5ap-2
orient2d 0x1.2b2d68c6638b5p+0 -0x1.432de6b9c8366p-4
orient2d 0x1.3b94f3a550a44p+0 -0x1.971823f654702p-4
incircle -0x1.30ee694694a93p-3 0x1.d71b727b30c49p-2
incircle -0x1.331a1cf84d23cp-4 0x1.edf1f3a751afbp-2
incircle -0x1.e8b36d90fc489p-2 0x1.266ef4d945181p+0
incircle -0x1.d2d603016c05bp-5 0x1.3413b3d04f8f2p+0
orient3d -0x1.65eda37748dabp+1 0x1.0153b0bdd0446p-1 0x1.85f700e72c6e4p-4
orient3d 0x1.34d5ffec538fcp+0 -0x1.c160ac2b61f7cp+0 0x1.67cf3a18c64e1p-1
orient3d 0x1.5d33e803e79c0p+0 -0x1.0e8c69fe200bbp-1 -0x1.429e746d95decp+1
orient3d -0x1.d3a0e29c029a4p+1 0x1.4f0249485b650p+1 -0x1.03d76af24797cp+2
turn 0x1.e656dbbaaba88p-1 -0x1.e7de27213e65ap-3 0x1.9e93d9ef27136p-3
turn 0x1.cef72df5cde58p-1 0x1.30f6c16469cd4p-2 -0x1.396879de9b514p-2
turn 0x1.cc36ffc59a36ap-1 0x1.3959b3b1133d2p-2 -0x1.413e133117f02p-2
bubble 0x1.6a3f96bd649c6p-4 -0x1.f80f914d0ce13p-1 0x1.3642891d17b9dp-3
bubble -0x1.1b454b3a9e107p-2 -0x1.e31b0ed1a277dp-1 0x1.74ee2f5988d81p-3
bubble -0x1.1c8b3b253dbf8p-2 -0x1.e27b53ab6842cp-1 0x1.7dded12827120p-3
bubble 0x1.7158022941bd5p-4 -0x1.e0b23ce2a47e2p-1 0x1.5441b1c47dbf6p-2
"""


def points(name):
    rows = [line.split()[1:] for line in WORST.splitlines() if line.startswith(f"{name} ")]
    return [list(map(float.fromhex, row)) for row in rows]


def constant(file, name):
    """A bound's number of roundings, as the source has it."""
    (found,) = re.findall(rf"\b{name} = ([\d.]+)[,;]", (PREDICATES / file).read_text(encoding="utf-8"))
    return float(found)


def cross(a, b):
    return a[0] * b[1] - a[1] * b[0]


def orient2d(a, b, c):
    """The value in the numbers given, in the kernel's order of operations, and the permanent."""
    u, v = minus(b, a), minus(c, a)
    return cross(u, v), abs(u[0] * v[1]) + abs(u[1] * v[0])


def incircle(a, b, c, d):
    a, b, c = (minus(p, d) for p in (a, b, c))
    aa, bb, cc = dot(a, a), dot(b, b), dot(c, c)
    return aa * cross(b, c) + bb * cross(c, a) + cc * cross(a, b), aa * (bb + cc) + bb * cc


def orient3d(a, b, c, d):
    u, v, w = minus(b, a), minus(c, a), minus(d, a)
    turns = ((0, 1, 2), (1, 2, 0), (2, 0, 1))
    return det3(u, v, w), sum(abs(u[i]) * (abs(v[j] * w[k]) + abs(v[k] * w[j])) for i, j, k in turns)


def turn(a, b, c):
    u, v = minus(b, a), minus(c, a)
    return det3(a, u, v), float(dot(a, a) * (dot(u, u) * dot(v, v))) ** 0.5


def bubble(a, b, c, p):
    u, v, w = minus(b, a), minus(c, a), minus(p, a)
    bb, cc, pp = dot(u, u), dot(v, v), dot(w, w)
    value = bb * det3(a, v, w) + cc * det3(a, w, u) + pp * det3(a, u, v)
    return -value, bb * (cc + pp) + cc * pp


FILTERS = {
    "orient2d": (orient2d, constant("plane_stages.hpp", "ORIENT_ROUNDING")),
    "incircle": (incircle, constant("plane_stages.hpp", "INCIRCLE_ROUNDING")),
    "orient3d": (orient3d, constant("space_predicates.cpp", "ROUNDING")),
    "turn": (turn, constant("ray_stages.hpp", "TURN_ROUNDING")),
    "bubble": (bubble, constant("ray_stages.hpp", "BUBBLE_ROUNDING")),
}


def truth(name):
    """The exact sign: of rays, or of fractions."""
    if name in ("turn", "bubble"):
        return {"turn": turn_ray, "bubble": bubble_ray}[name](*map(ray, points(name)))
    value, _ = FILTERS[name][0](*[list(map(Fraction, row)) for row in points(name)])
    return (value > 0) - (value < 0)


@pytest.mark.parametrize("name", FILTERS)
def test_the_filter_leaves_it_open(name):
    """As it must: the value in doubles has the wrong sign; it is larger than a fifth of the bound, which is enough."""
    form, roundings = FILTERS[name]
    value, permanent = form(*points(name))
    assert np.sign(value) == -truth(name) != 0
    assert roundings / 5 < abs(value) / (ROUNDOFF * permanent) < roundings
    rows = [np.array([row]) for row in points(name)]
    options = {"unit": True} if name in ("turn", "bubble") else {}
    function = getattr(probe, name)
    assert function(*rows, stage="filter", **options).tolist() == [OPEN]
    assert function(*rows, **options).tolist() == [truth(name)]
