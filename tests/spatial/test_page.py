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
