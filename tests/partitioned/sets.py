"""Sets of points that partitions may go wrong on: columns of their files, and rows of about a given number."""

import numpy as np

from stereodel import lonlat_to_xyz
from stereodel.data import airports


def directions(rng, n):
    v = rng.normal(size=(n, 3))
    return v / np.linalg.norm(v, axis=1)[:, None]


def near(rng, centre, radius, n):
    v = centre + radius * rng.normal(size=(n, 3))
    return v / np.linalg.norm(v, axis=1)[:, None]


def gaia_like(rng, n):
    """A disc, clusters down to 1e-7 rad, and points everywhere."""
    disc = [rng.uniform(0, 360, n // 2), np.clip(np.degrees(rng.laplace(0, 0.1, n // 2)), -89, 89)]
    clusters = [near(rng, centre, 10.0 ** rng.uniform(-7, -2), n // 50) for centre in directions(rng, 20)]
    return np.concatenate([lonlat_to_xyz(np.column_stack(disc)), *clusters, directions(rng, n // 10)])


def graticule(rng, n):
    step = 360 / np.sqrt(2 * n)
    lon, lat = np.meshgrid(np.arange(-180, 180, step), np.arange(-90, 90.1, step))
    return rng.permutation(np.column_stack([lon.ravel(), np.minimum(lat.ravel(), 90.0)]))


def hemisphere(rng, n):
    half = directions(rng, n)
    half[:, 0] = np.abs(half[:, 0])
    return half


def duplicates(rng, n):
    u = directions(rng, n)
    u[rng.permutation(n)[: 3 * n // 10]] = u[rng.integers(0, n, 3 * n // 10)]
    return u


def a_metre_and_far(rng, n):
    tiny = near(rng, directions(rng, 1)[0], 4e-8, n)
    return np.concatenate([directions(rng, 8), tiny])


def airports_of_the_world(rng, n):
    lonlat = np.asarray(airports().lonlat, float)
    return lonlat[:: max(1, len(lonlat) // n)]


def integer_directions(rng, n):
    size = max(2, round(n ** (1 / 3) / 2))
    cube = np.stack(np.meshgrid(*[np.arange(-size, size + 1)] * 3), -1).reshape(-1, 3)
    return rng.permutation(cube[np.abs(cube).max(axis=1) > 0]).astype(float)


def lengths(rng, n):
    big = np.ldexp(directions(rng, 4 * n // 5), rng.integers(-1000, 1000, (4 * n // 5, 1)))
    return np.concatenate([big, np.ldexp(big[: n // 5], 1)])


def great_circle(rng, n):
    s = rng.uniform(0, 2 * np.pi, n)
    return np.column_stack([np.cos(s), np.sin(s), 0 * s])


def near_axis(rng, n):
    return np.column_stack([np.ones(n), 10.0 ** rng.uniform(-200, -2, (n, 2))])


def lattice(rng, n):
    side = np.arange(round(n**0.5), dtype=float)
    return rng.permutation(np.stack(np.meshgrid(side, side), -1).reshape(-1, 2))


def line(rng, n):
    return np.column_stack([np.arange(n), 3 * np.arange(n)]).astype(float)


def scales(rng, n):
    return rng.normal(size=(n, 2)) * 10.0 ** rng.uniform(-60, 60, (n, 1))


def plane_duplicates(rng, n):
    w = rng.uniform(size=(n, 2))
    w[: n // 3] = w[rng.integers(n // 3, n, n // 3)]
    return w


def thin(rng, n):
    """A strip whose hull has many long edges, with points just beyond those of a part of it."""
    return rng.uniform(size=(n, 2)) * [1.0, 1e-4]


XYZ, LONLAT, XY = ("x", "y", "z"), ("lon", "lat"), ("x", "y")

SETS = {
    "uniform": (XYZ, directions),
    "gaia-like": (XYZ, gaia_like),
    "graticule": (LONLAT, graticule),
    "hemisphere": (XYZ, hemisphere),
    "cap of 1 degree": (XYZ, lambda rng, n: near(rng, np.array([0.6, 0.0, 0.8]), 0.005, n)),
    "30 % duplicates": (XYZ, duplicates),
    "1 m and 8 far": (XYZ, a_metre_and_far),
    "airports": (LONLAT, airports_of_the_world),
    "integer directions": (XYZ, integer_directions),
    "lengths 2^-1000 to 2^1000": (XYZ, lengths),
    "great circle": (XYZ, great_circle),
    "great circle and a pole": (XYZ, lambda rng, n: np.concatenate([great_circle(rng, n // 4), [[0, 0, 1.0]]])),
    "great circle and both poles": (
        XYZ,
        lambda rng, n: np.concatenate([great_circle(rng, n // 4), [[0, 0, 1.0], [0, 0, -1.0]]]),
    ),
    "1e-200 apart": (XYZ, lambda rng, n: near_axis(rng, min(n, 120))),
    "no point": (XYZ, lambda rng, n: directions(rng, 0)),
    "one point": (XYZ, lambda rng, n: directions(rng, 1)),
    "2 points": (XYZ, lambda rng, n: directions(rng, 2)),
    "3 points": (XYZ, lambda rng, n: directions(rng, 3)),
    "4 points": (XYZ, lambda rng, n: directions(rng, 4)),
    "5 points": (XYZ, lambda rng, n: directions(rng, 5)),
    "plane: lattice": (XY, lattice),
    "plane: uniform": (XY, lambda rng, n: rng.uniform(size=(n, 2))),
    "plane: line": (XY, line),
    "plane: line and one": (XY, lambda rng, n: np.concatenate([line(rng, n // 4), [[5.0, 7.0]]])),
    "plane: 1e-60 and 1e60": (XY, scales),
    "plane: 1e-120 times": (XY, lambda rng, n: rng.normal(size=(n, 2)) * 1e-120),
    "plane: duplicates": (XY, plane_duplicates),
    "plane: thin strip": (XY, thin),
}


def rows_of(name, n):
    """Columns and rows of a set."""
    columns, make = SETS[name]
    return columns, make(np.random.default_rng(20261122), n)
