"""The point sets of the benchmarks, seeded: plane (n, 2) and sphere (n, 3), in random order.

`PLANE` and `SPHERE` map names to functions of (n, generator). Sets with a structure of their own (grids, graticules,
real data) return the size next to n that fits them. Points of the sphere are unit vectors, rounded.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from stereodel import data, lonlat_to_xyz
from stereodel._arrays import FloatArray

Distribution = Callable[[int, np.random.Generator], FloatArray]

CLUSTERS = 100
GOLDEN_ANGLE = np.pi * (3.0 - 5.0**0.5)
CIRCLE_LATITUDE = 60.0

# Squared radius of the exact circle. Each prime is a sum of two squares, so that the product has 4·∏(exponent + 1)
# representations as x² + y²: 1 179 648 exactly cocircular points. The product is below 2¹⁰⁵: doubles hold x and y.
CIRCLE_PRIMES = (5, 5, 13, 13, 17, 29, 37, 41, 53, 61, 73, 89, 97, 101, 109, 113, 137, 149, 157)


def make(space: str, name: str, n: int, seed: int = 1) -> FloatArray:
    """About n points of a distribution of `PLANE` or `SPHERE` in random order; the same for the same arguments."""
    generator = np.random.Generator(np.random.PCG64([seed, n]))
    points = {"plane": PLANE, "sphere": SPHERE}[space][name](n, generator)
    return np.ascontiguousarray(generator.permutation(points))


def uniform_lonlat(n: int, generator: np.random.Generator) -> FloatArray:
    """Longitude and latitude in degrees, all over the sphere."""
    return np.column_stack([generator.uniform(-180, 180, n), np.degrees(np.arcsin(generator.uniform(-1, 1, n)))])


def _unit(vectors: FloatArray) -> FloatArray:
    return vectors / np.sqrt((vectors * vectors).sum(axis=1, keepdims=True))


def plane_uniform(n: int, generator: np.random.Generator) -> FloatArray:
    """Independent in the unit square."""
    return generator.random((n, 2))


def sphere_uniform(n: int, generator: np.random.Generator) -> FloatArray:
    """Independent on the sphere: normalised normal vectors."""
    return _unit(generator.standard_normal((n, 3)))


def clusters(uniform: Distribution, sigma: float) -> Distribution:
    """Clusters of normal deviation `sigma` about centres of a uniform distribution, on the sphere in radians."""

    def points(n: int, generator: np.random.Generator) -> FloatArray:
        centers = uniform(CLUSTERS, generator)[generator.integers(CLUSTERS, size=n)]
        found = centers + sigma * generator.standard_normal(centers.shape)
        return _unit(found) if uniform is sphere_uniform else found

    return points


def integer_grid(n: int, _: np.random.Generator) -> FloatArray:
    """All (i, j) with 0 ≤ i, j < √n: exact ties everywhere."""
    side = np.arange(round(n**0.5), dtype=np.float64)
    return np.stack(np.meshgrid(side, side), axis=-1).reshape(-1, 2)


def sunflower(n: int, _: np.random.Generator) -> FloatArray:
    """Fibonacci's lattice in the disc of radius 1."""
    i = np.arange(n) + 0.5
    radius, angle = np.sqrt(i / n), GOLDEN_ANGLE * i
    return np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)


def plane_circle(n: int, generator: np.random.Generator) -> FloatArray:
    """Uniform on the unit circle, rounded: no two are exactly as far from the centre."""
    angle = generator.uniform(0.0, 2.0 * np.pi, n)
    return np.stack([np.cos(angle), np.sin(angle)], axis=1)


def exact_circle(n: int, generator: np.random.Generator) -> FloatArray:
    """Integer points of one circle about the origin, all exactly cocircular.

    They are integers x + iy of one norm: all products of one factor a + ib or its conjugate for each prime.
    """
    points = np.array([[1, 0], [0, 1], [-1, 0], [0, -1]], dtype=np.int64)
    for prime in CIRCLE_PRIMES:
        if len(points) >= n:
            break
        a, b = next((a, b) for a in range(1, prime) for b in range(a, prime) if a * a + b * b == prime)
        x, y = points.T
        both = [np.stack([a * x - s * b * y, a * y + s * b * x], axis=1) for s in (1, -1)]
        points = np.unique(np.concatenate(both), axis=0)  # a prime and its repetition give some points twice
    if len(points) < n:
        raise ValueError(f"n is {n}: the exact circle holds {len(points)} points")
    return generator.permutation(points.astype(np.float64))[:n]


def lattice(n: int, _: np.random.Generator) -> FloatArray:
    """Fibonacci's lattice on the sphere."""
    i = np.arange(n)
    z, angle = 1.0 - (2.0 * i + 1.0) / n, GOLDEN_ANGLE * i
    radius = np.sqrt(1.0 - z * z)
    return _unit(np.stack([radius * np.cos(angle), radius * np.sin(angle), z], axis=1))


def cube_grid(n: int, _: np.random.Generator) -> FloatArray:
    """The integer points on the surface of a cube about the origin as they are: directions of all lengths; ties."""
    half = max(1, round((n / 24) ** 0.5))
    side = np.arange(-half, half + 1, dtype=np.float64)
    u, v = (grid.ravel() for grid in np.meshgrid(side, side))
    ends = [np.full_like(u, end) for end in (-half, half)]
    faces = [np.roll(np.stack([w, u, v], axis=1), turn, axis=1) for w in ends for turn in range(3)]
    return np.unique(np.concatenate(faces), axis=0)


def graticule(n: int, _: np.random.Generator) -> FloatArray:
    """Crossings of k + 1 parallels and 2k + 1 meridians: every pole 2k + 1 times, ±180° twice."""
    k = max(2, round((n / 2) ** 0.5))
    lon, lat = np.meshgrid(180.0 * np.arange(-k, k + 1) / k, 90.0 * np.arange(-k, k + 1, 2) / k)
    return lonlat_to_xyz(np.stack([lon, lat], axis=-1).reshape(-1, 2))


def sphere_circle(n: int, generator: np.random.Generator) -> FloatArray:
    """Uniform on the parallel of 60°, rounded."""
    lon = generator.uniform(-180.0, 180.0, n)
    return lonlat_to_xyz(np.stack([lon, np.full(n, CIRCLE_LATITUDE)], axis=1))


PLANE: dict[str, Distribution] = {
    "uniform": plane_uniform,
    "clusters 1e-3": clusters(plane_uniform, 1e-3),
    "clusters 1e-6": clusters(plane_uniform, 1e-6),
    "integer grid": integer_grid,
    "grid × 0.1": lambda n, generator: 0.1 * integer_grid(n, generator),  # every tie is spoilt by rounding
    "Fibonacci": sunflower,
    "circle": plane_circle,
    "exact circle": exact_circle,
    "airports": lambda *_: data.airports().lonlat,  # whatever n; repetitions included
    "stars": lambda *_: data.stars().lonlat,
}

SPHERE: dict[str, Distribution] = {
    "uniform": sphere_uniform,
    "clusters 1e-3": clusters(sphere_uniform, 1e-3),
    "clusters 1e-6": clusters(sphere_uniform, 1e-6),
    "integer cube": cube_grid,
    "unit cube": lambda n, generator: _unit(cube_grid(n, generator)),  # every tie is spoilt by rounding
    "graticule": graticule,
    "Fibonacci": lattice,
    "circle": sphere_circle,
    "airports": lambda *_: lonlat_to_xyz(data.airports().lonlat),
    "stars": lambda *_: lonlat_to_xyz(data.stars().lonlat),
}

REAL = ("airports", "stars")
FOR_DIRECTIONS = ("integer cube",)
