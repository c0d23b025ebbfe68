"""The interpolators by their names, a function that is known everywhere, and its slopes."""

import numpy as np

from stereodel import interpolation

NAMES = {"nearest": "Nearest", "linear": "Linear", "natural": "NaturalNeighbor", "smooth": "Smooth"}
KINDS = {method: getattr(interpolation, f"{name}Interpolator") for method, name in NAMES.items()}


def known(x):
    """A smooth function of the plane, or of directions through their unit vectors."""
    if x.shape[-1] == 3:
        x = x / np.linalg.norm(x, axis=-1, keepdims=True)
        return np.exp(x[..., 0]) * np.sin(2 * x[..., 1]) + x[..., 2] ** 2
    return np.exp(x[..., 0]) * np.sin(3 * x[..., 1])


def slopes(function, queries, step):
    """Central differences along the axes, on the sphere of the function of directions: (..., d)."""
    sides = [(queries + step * e, queries - step * e) for e in np.eye(queries.shape[-1])]
    return np.stack([(function(ahead) - function(behind)) / (2 * step) for ahead, behind in sides], axis=-1)
