"""`scipy.spatial` with exact answers: change the import, keep the script.

`Delaunay`, `Voronoi` and `SphericalVoronoi` have SciPy's signatures, attributes and methods over the exact
triangulations of this library; they are subclasses of SciPy's classes, so that code which asks `isinstance` accepts
them. What is not exact here, as three dimensions, they hand over to SciPy with an `InexactWarning`. `QhullError` and
every other name of `scipy.spatial` are SciPy's own, submodules such as ``stereodel.spatial.distance`` too.
"""

import sys
from importlib import import_module
from typing import Any

from stereodel._extras import of_extra

with of_extra("scipy"):
    import scipy.spatial
    from scipy.spatial import QhullError

    from stereodel.spatial.compatibility import InexactWarning
    from stereodel.spatial.delaunay import Delaunay
    from stereodel.spatial.spherical_voronoi import SphericalVoronoi
    from stereodel.spatial.voronoi import Voronoi

__all__ = ["Delaunay", "InexactWarning", "QhullError", "SphericalVoronoi", "Voronoi"]

for _name in ("distance", "transform"):
    sys.modules[f"{__name__}.{_name}"] = import_module(f"scipy.spatial.{_name}")
# Older names of modules of SciPy, whose classes have moved to the package itself: here they are the package.
for _name in ("ckdtree", "kdtree", "qhull"):
    sys.modules[f"{__name__}.{_name}"] = sys.modules[__name__]


def __getattr__(name: str) -> Any:
    """What this module does not have, from `scipy.spatial`: trees, distances, convex hulls, plots."""
    if name.startswith("__") or not hasattr(scipy.spatial, name):
        raise AttributeError(f"neither {__name__} nor scipy.spatial has {name!r}")
    return getattr(scipy.spatial, name)
