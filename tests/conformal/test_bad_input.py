"""What the maps refuse: the message names the argument, its value and what it should be."""

import numpy as np
import pytest

from stereodel.conformal import MoebiusMap, bubble_to_bubble, fisheye, flight, three_points
from stereodel.sphere import SphereCircle

IDENTITY, LENS, CAP = MoebiusMap.identity(), fisheye((10, 20), magnification=3), SphereCircle.around((20, 50), 10)
TINY = SphereCircle.around((3.0, 4.0), 1e-30)
XYZ = np.eye(3)
MANY = np.ones((300, 3))
MATRICES = [
    (np.eye(3), r"shape \(4, 4\)"),
    ([[1, 2], [2, 4]], "singular"),
    ([[0, 0], [0, 0]], "singular"),
    ([[2e6, 0], [0, 1]], r"magnification 2e\+06, above 1e\+06"),
    ([[np.nan, 0], [0, 1]], "nan"),
    ([[1j, 0], [0, complex(0, np.inf)]], "inf"),
    (np.diag([1.0, 1, 1, -1]), "orthochronous"),
    (np.diag([1.0, 1, -1, 1]), "is a reflection"),
    (np.eye(4) + 1e-3, "Lorentz"),
    (1.001 * LENS.matrix, "Lorentz"),
    (fisheye((10, 20), magnification=1e7).matrix, "magnification"),
]


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: fisheye((0, 0, 0), magnification=2), "focus is the zero vector"),
        (lambda: fisheye((0, 91), magnification=2), "latitude 91"),
        (lambda: IDENTITY([0, 0, 0]), "xyz is the zero vector"),
        (lambda: LENS.lonlat([(0, 90.5)]), r"lonlat\[0, 1\] is latitude 90.5"),
        (lambda: LENS.lonlat([(np.inf, 0)]), r"lonlat\[0, 0\] is inf"),
        (lambda: IDENTITY.power(np.nan), "exponent is nan"),
        (lambda: IDENTITY.power(2e6), "exponent is 2000000.0, outside"),
        (lambda: fisheye((0, 0), magnification=1e9).power(20), "magnification above 1e"),
        (lambda: IDENTITY.fixed_points, "fixed point of the identity"),
        (lambda: three_points(XYZ[:2], XYZ), "sources must be three points, got 2"),
        (lambda: three_points(XYZ, XYZ[[0, 1, 1]]), r"targets\[1\] and targets\[2\] are the same"),
        (lambda: flight((0, 0), (1, 1), magnification=0.0), "magnification is 0"),
        (lambda: flight((0, 0), (1, 95), magnification=2.0), "latitude 95"),
        (lambda: flight((0, 0), (1, 1), magnification=2.0)(1.01), "t is 1.01, outside"),
        (lambda: flight((0, 0), (1, 1), magnification=2.0, arrival=np.inf), "inf"),
        (
            lambda: bubble_to_bubble(CAP, CAP, source_point=(20.0, 60.1)),
            "source_point must lie strictly inside",
        ),
        (lambda: bubble_to_bubble(CAP, CAP, source_point=(200.0, -50.0)), "source_point must lie strictly inside"),
        (lambda: bubble_to_bubble(CAP, CAP, target_point=(20.0, 60.0)), "target_point must lie strictly inside"),
        (lambda: bubble_to_bubble(TINY, CAP), "source has the radius .* cannot be told from a point"),
        (lambda: bubble_to_bubble(CAP, TINY.complement), "target has the radius .* cannot be told from a point"),
        (lambda: IDENTITY @ 3, "unsupported operand"),
        *(
            (lambda size=size: fisheye((0, 0), magnification=size), "magnification")
            for size in (0.0, -2.0, np.nan, np.inf, 1e200, 1e-200, "two")
        ),
        *((lambda matrix=matrix: MoebiusMap.from_matrix(matrix), message) for matrix, message in MATRICES),
    ],
)
def test_bad_input(call, message):
    with pytest.raises((TypeError, ValueError), match=message):
        call()


@pytest.mark.parametrize("row", [[0, 0, 0], [1, np.nan, 0], [1, 0, -np.inf], [np.nan, 0, 1]])
def test_directions_that_are_none(row):
    for function in (LENS, LENS.scale_factor):
        with pytest.raises(ValueError, match=r"xyz\[300"):
            function(np.concatenate([MANY, [row]]))
