"""What the sphere's functions refuse: the message names the argument, its value and what it should be."""

import numpy as np
import pytest

from stereodel.sphere import (
    Rotation,
    SphereArc,
    SphereCircle,
    as_direction,
    graticule,
    graticule_patch,
    great_circle_points,
    lonlat_to_xyz,
    xyz_to_lonlat,
)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: lonlat_to_xyz([0, 91]), r"lonlat\[1\] is latitude 91"),
        (lambda: lonlat_to_xyz([np.nan, 0]), r"lonlat\[0\] is nan"),
        (lambda: xyz_to_lonlat([[1, 0, 0], [0, 0, 0]]), r"xyz\[1\] is the zero vector"),
        (lambda: lonlat_to_xyz([0, 0], latitude="flat"), "latitude is 'flat', but must be one of 'spherical', 'geod"),
        (lambda: xyz_to_lonlat([1, 0, 0], latitude="flat"), "latitude is 'flat', but must be one of 'spherical', 'geo"),
        (lambda: as_direction([1, 2, 3, 4], "focus"), r"focus must be \(lon, lat\)"),
        (lambda: as_direction([0, 0, 0], "focus"), "focus is the zero vector"),
        (lambda: SphereArc.great((1, 0, 0), (3, 0, 0)), "equal or antipodal"),
        (lambda: SphereArc.great((1, 0, 0), (-2, 0, 0)), "equal or antipodal"),
        (lambda: graticule(7), "spacing is 7, but 180 must be a whole multiple"),
        (lambda: graticule(0), "spacing is 0.0"),
        (lambda: graticule_patch((0, 85), 5, 1), "half_width is 5.0, outside"),
        (lambda: graticule_patch((0, 40), 8, 3), "spacing is 3, but 16"),
        (lambda: great_circle_points([1, 0, 0], [-1, 0, 0], 3), "antipodal"),
        (lambda: great_circle_points([1, 0, 0], [0, 1, 0], 1), "n is 1"),
        (lambda: SphereCircle((1, 0, 0), 1.0), "offset is 1.0: the circle is a point"),
        (lambda: SphereCircle((1, 0, 0), 1.5), r"offset is 1.5, outside \[-1, 1\]"),
        (lambda: SphereCircle((1, 0, 0), 0.5, 0.5), "radius is 0.5, but offset 0.5 belongs to radius 0.866"),
        (lambda: SphereCircle((0, 0, 0), 0.5), "normal is the zero vector"),
        (lambda: SphereCircle.around((0, 0), 0.0), "angular_radius is 0.0"),
        (lambda: SphereCircle.around((0, 0), 180.0), "angular_radius is 180.0"),
        (lambda: SphereCircle.through((1, 0, 0), (3, 0, 0), (0, 1, 0)), "two of them are the same point"),
        (lambda: SphereCircle((1, 0, 0), 0.0).contains([0, 0, 0]), "xyz is the zero vector"),
        (lambda: SphereCircle((1, 0, 0), 0.0).sample(0), "n is 0"),
        (lambda: Rotation((0, 0, 0, 0)), "zero quaternion"),
        (lambda: Rotation((1, 0, 0)), "four numbers"),
        (lambda: Rotation.from_matrix(np.diag([1, 1, -1])), "not a rotation"),
        (lambda: Rotation.from_matrix(np.diag([1, 1, 2])), "not a rotation"),
        (lambda: Rotation.from_matrix(np.eye(4)), r"shape \(3, 3\)"),
        (lambda: Rotation.about((0, 0, 0), 3), "axis is the zero vector"),
        (lambda: Rotation.about((0, 0), np.inf), "angle"),
    ],
)
def test_bad_input(call, message):
    with pytest.raises(ValueError, match=message):
        call()


def test_what_is_of_another_type():
    with pytest.raises(TypeError):
        Rotation.identity() @ 3.0
