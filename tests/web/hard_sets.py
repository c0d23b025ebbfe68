"""Sets of points that go wrong elsewhere: on them the kernel of the web must give the bits of the one of Python."""

import json
from pathlib import Path

import numpy as np

from stereodel import lonlat_to_xyz
from stereodel.data import cities

FIXTURES = Path(__file__).resolve().parent.parent / "fixtures" / "delaunator"


def plane_sets():
    """Name and points (n, 2) of each."""
    rng = np.random.default_rng(1616)
    grid = np.array(np.meshgrid(np.arange(30.0), np.arange(20.0))).reshape(2, -1).T
    circle = np.array([[3, 4], [4, 3], [5, 0], [-3, 4], [0, -5], [-4, -3], [4, -3], [0, 0], [3, 4]], dtype=float)
    angles = 2 * np.pi * np.arange(500) / 500
    sets = {
        "none": np.zeros((0, 2)),
        "one": [[1.0, 2.0]],
        "all the same": [[1.0, 2.0]] * 4,
        "two": [[1.0, 2.0], [0.0, 7.0]],
        "line": [[k * k, 2.0 * k * k] for k in (3, 1, 0, 2, 4, 1)],
        "long line": np.outer(rng.permutation(300), [3.0, -7.0]),
        "three": [[0.0, 0.0], [2.0, 0.0], [0.0, 3.0]],
        "square": [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0], [2.0, 2.0]],
        "circle of whole numbers": circle,
        "many whole circles": np.vstack([circle * scale + shift for scale in (1, 2, 5) for shift in (0, 11)]),
        "rounded circle": np.column_stack([np.cos(angles), np.sin(angles)]),
        "grid": grid,
        "grid of tenths": grid * 0.1,
        "turned grid": grid @ [[0.8, -0.6], [0.6, 0.8]],
        "uniform": rng.random((3000, 2)),
        "normal": rng.normal(size=(3000, 2)),
        "duplicates": rng.integers(0, 12, size=(900, 2)).astype(float),
        "clusters": (rng.random((20, 1, 2)) + 1e-9 * rng.normal(size=(20, 60, 2))).reshape(-1, 2),
        "cluster of 1e-16": np.vstack([[1.0, 1.0] + 2.0**-52 * rng.integers(0, 9, size=(60, 2)), rng.random((9, 2))]),
        "needles": np.column_stack([np.arange(400.0), 1e-13 * rng.normal(size=400)]),
        "parabola": np.column_stack([np.arange(-150.0, 150.0), np.arange(-150.0, 150.0) ** 2]),
        "1e150": 1e150 * rng.normal(size=(300, 2)),
        "1e-150": 1e-150 * rng.normal(size=(300, 2)),
        "large and small": [[1e150, 0], [0, 1e150], [1e-150, 0], [0, 0], [5e-324, 0], [-1, -1]],
        "all sizes": rng.normal(size=(400, 2)) * 10.0 ** rng.integers(-150, 150, size=(400, 1)),
    }
    for file in sorted(FIXTURES.glob("*.json")):
        sets[file.stem] = json.loads(file.read_text(encoding="utf-8"))
    return {name: np.array(points, dtype=float).reshape(-1, 2) for name, points in sets.items()}


def sphere_sets():
    """Name and directions (n, 3) of each."""
    rng = np.random.default_rng(6161)
    angles = 2 * np.pi * np.arange(200) / 200
    ring = np.column_stack([np.cos(angles), np.sin(angles), np.full(200, 0.25)])
    middle = np.array([0.3, -0.5, 0.8])
    corners = np.array(np.meshgrid([-1.0, 1.0], [-1.0, 1.0], [-1.0, 1.0])).reshape(3, -1).T
    sets = {
        "none": np.zeros((0, 3)),
        "one": [[0, 0, 2]],
        "the same direction": [[1, 2, 3], [2, 4, 6], [0.5, 1, 1.5]],
        "opposite": [[0, 0, 1], [0, 0, -3]],
        "two": [[0, 0, 1], [1, 0, 1], [2, 0, 2]],
        "opposite and one more": [[0, 0, 1], [0, 0, -3], [5, 0, 1]],
        "great circle": [[1, 0, 0], [0, 2, 0], [-1, 0, 0], [1, 1, 0], [2, 2, 0], [0, -1, 0]],
        "long great circle": rng.integers(-9, 10, size=(300, 2)) @ [[1.0, 2.0, -1.0], [0.0, 3.0, 1.0]],
        "arc": [[1, 0, 0], [5, 1, 0], [2, 2, 0], [0, 3, 0], [-1, 7, 0]],
        "half circle": [[1, 0, 0], [5, 1, 0], [-3, 0, 0]],
        "three": [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
        "three close ones": [[1, 1e-13, 0], [1, -1e-13, 0], [1, 0, 2e-13]],
        "small circle": [[3, 4, 1], [4, 3, 1], [5, 0, 1], [-3, 4, 1], [0, -5, 1]],
        "rounded circle": ring,
        "circles and poles": np.vstack([ring, ring * [1, 1, -1], [[0, 0, 1], [0, 0, -1]]]),
        "octahedron": [[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, 0, 0], [0, -1, 0], [0, 0, -1], [0, 0, 7]],
        "cube": corners,
        "cubes": rng.integers(-4, 5, size=(700, 3)).astype(float),
        "hemisphere": [[i, j, 2.0] for i in range(-12, 13) for j in range(-9, 10)],
        "closed hemisphere": [[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [1, 1, 3], [1, 2, 0]],
        "graticule": lonlat_to_xyz(
            np.array(np.meshgrid(np.arange(-180, 180, 10), np.arange(-90, 91, 10))).reshape(2, -1).T
        ),
        "pairs on meridians": lonlat_to_xyz(
            [[lon, s * lat] for lon in range(0, 360, 15) for lat in (1, 5, 89) for s in (1, -1)]
        ),
        "uniform": rng.normal(size=(3000, 3)),
        "normalised": lonlat_to_xyz(np.column_stack([rng.uniform(-180, 180, 3000), rng.uniform(-90, 90, 3000)])),
        "near a great circle": rng.normal(size=(800, 3)) * [1, 1, 1e-9],
        "near a point": middle + 1e-3 * rng.normal(size=(800, 3)),
        "duplicates": rng.integers(-2, 3, size=(600, 3)) * 2.0 ** rng.integers(-40, 40, size=(600, 1)),
        "beside an axis": [
            [1, 0, 0],
            [1, 1e-300, 0],
            [1, 0, 1e-300],
            [1, 1e-300, 1e-300],
            [1, 5e-324, 0],
            [-1, 0, 0],
            [0, 1, 0],
        ],
        "all lengths": rng.normal(size=(400, 3)) * 10.0 ** rng.integers(-150, 150, size=(400, 1)),
        "1e300 and subnormal": np.vstack(
            [1e300 * rng.normal(size=(60, 3)), 1e-320 * rng.integers(-9, 10, size=(60, 3))]
        ),
        "needles": np.column_stack([np.ones(300), np.linspace(0, 1e-6, 300), 1e-20 * rng.normal(size=300)]),
        "cities": lonlat_to_xyz(cities().lonlat[::3]),
        "a hundred thousand": rng.normal(size=(100_000, 3)),
    }
    for size in (1e-2, 1e-4, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-12, 1e-14, 1e-15, 1e-16):
        close = middle + size * rng.normal(size=(200, 3))
        sets[f"cluster of {size:g}"] = np.vstack([close, rng.normal(size=(20, 3))])
    rows = {name: np.array(points, dtype=float).reshape(-1, 3) for name, points in sets.items()}
    return {name: points[points.any(axis=1)] for name, points in rows.items()}


def queries_of(points, count=400):
    """Points and middles of points, rows of a set, and others near them, for questions about the set."""
    rng = np.random.default_rng(len(points))
    if not len(points):
        return points
    chosen = points[rng.integers(0, len(points), size=count)]
    others = points[rng.integers(0, len(points), size=count)]
    rows = np.vstack([chosen, chosen / 2 + others / 2, chosen + 1e-9 * others])
    return rows[rows.any(axis=1) & np.isfinite(rows).all(axis=1)]
