"""The page docs/spatial.md: its example prints what it says, its import works."""

import doctest
import re
from pathlib import Path

PAGE = Path(__file__).resolve().parent.parent.parent / "docs" / "spatial.md"


def test_examples_run():
    blocks = re.findall(r"```pycon\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    examples = doctest.DocTestParser().get_doctest("\n".join(blocks), {}, PAGE.name, str(PAGE), 0)
    assert len(examples.examples) >= 6
    failures = []
    doctest.DocTestRunner().run(examples, out=failures.append)
    assert failures == []


def test_imports_work():
    (code,) = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    names = {}
    exec(code, names)
    assert {"Delaunay", "KDTree", "SphericalVoronoi", "Voronoi", "voronoi_plot_2d"} <= set(names)


def test_submodules_of_scipy_are_imported_by_their_paths():
    """A script changes `scipy.spatial` to `stereodel.spatial` wherever that stands."""
    import scipy.spatial

    import stereodel.spatial.distance
    from stereodel.spatial.distance import cdist
    from stereodel.spatial.kdtree import KDTree
    from stereodel.spatial.qhull import ConvexHull, Delaunay
    from stereodel.spatial.transform import Rotation, Slerp

    assert cdist is scipy.spatial.distance.cdist is stereodel.spatial.distance.cdist
    assert (KDTree, ConvexHull) == (scipy.spatial.KDTree, scipy.spatial.ConvexHull)
    assert (Rotation, Slerp) == (scipy.spatial.transform.Rotation, scipy.spatial.transform.Slerp)
    assert Delaunay is stereodel.spatial.Delaunay
