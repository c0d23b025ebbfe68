"""A pytest plugin: SciPy's own tests, with the classes of `stereodel.spatial` in place of SciPy's.

Loaded with ``-p`` in a process of its own (test_scipy_suite.py); writes what became of each test that made an object of
ours, "" or the error, as JSON to the file named by STEREODEL_SCIPY_SUITE.
"""

import functools
import json
import os
from pathlib import Path

import scipy.spatial
import scipy.spatial._qhull

import stereodel.spatial

made = []
errors = {}


def _counted(init):
    @functools.wraps(init)
    def wrapped(self, *arguments, **options):
        made.append(type(self).__name__)
        init(self, *arguments, **options)

    return wrapped


def pytest_configure():
    """Replace SciPy's classes; not at import, which collecting doctests does too."""
    for cls in (stereodel.spatial.Delaunay, stereodel.spatial.Voronoi, stereodel.spatial.SphericalVoronoi):
        cls.__init__ = _counted(cls.__init__)
        setattr(scipy.spatial, cls.__name__, cls)
        if hasattr(scipy.spatial._qhull, cls.__name__):
            setattr(scipy.spatial._qhull, cls.__name__, cls)


def pytest_runtest_setup(item):
    made.clear()


def pytest_runtest_makereport(item, call):
    if call.when == "call" and made:
        name = f"{item.path.name}::{item.nodeid.split('::', 1)[1]}"
        errors[name] = call.excinfo.exconly() if call.excinfo is not None else ""


def pytest_sessionfinish():
    Path(os.environ["STEREODEL_SCIPY_SUITE"]).write_text(json.dumps(errors), encoding="utf-8")
