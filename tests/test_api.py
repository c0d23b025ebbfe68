"""The public names: that they are listed, documented and described alike, and keep the rules of the interface."""

import importlib
import inspect
import re
import subprocess
import sys
from pathlib import Path

import pytest

import stereodel
from stereodel._docs import shared
from tools import names

PUBLIC = {name: getattr(stereodel, name) for name in stereodel.__all__}
PACKAGES = {name: importlib.import_module(name) for name in ("stereodel", *names.PACKAGES)}
# Further points, the angle that goes with an axis, the parts of a value: no options, though they may be left out.
NO_OPTIONS = {
    "MoebiusMap.rotation": {"angle"},
    "PlaneCircle": {"outside"},
    "SphereArc": {"angle_rad"},
    "SphereCircle": {"radius"},
    "bubble_to_bubble": {"source_point", "target_point"},
    "check_delaunay": {"simplices"},
}


def test_names_are_listed_once_and_in_order():
    assert stereodel.__all__ == sorted(set(stereodel.__all__))
    shown = {name for name in dir(stereodel) if not name.startswith("_")}
    assert shown == set(stereodel.__all__) | stereodel._MODULES  # nothing that was imported for the package itself


def reference(module):
    """Names that the API reference lists under a module."""
    text = ((Path(__file__).resolve().parent.parent / "docs") / "api" / "index.rst").read_text(encoding="utf-8")
    parts = re.split(r"^\.\. currentmodule:: (\S+)$", text, flags=re.MULTILINE)
    sections = zip(parts[1::2], parts[2::2], strict=True)
    return {
        name for title, body in sections if title == module for name in re.findall(r"^   (\w+)$", body, re.MULTILINE)
    }


# Described where they are used: what triangulations and spheres share, an error of SciPy's.
DESCRIBED_ELSEWHERE = {
    "stereodel.triangulation": set(PUBLIC),
    "stereodel.sphere": set(PUBLIC),
    "stereodel.conformal": set(PUBLIC),
    "stereodel.projections": set(PUBLIC),
    "stereodel.predicates": set(PUBLIC),
    "stereodel.spatial": {"QhullError"},
}


@pytest.mark.parametrize("package", PACKAGES)
def test_reference_lists_exactly_the_public_names(package):
    exported, elsewhere = set(names.public_names(PACKAGES[package])), DESCRIBED_ELSEWHERE.get(package, set())
    assert exported - elsewhere <= reference(package) <= exported | elsewhere


@pytest.mark.parametrize("name", PUBLIC)
def test_docstring_has_an_example(name):
    text = inspect.getdoc(PUBLIC[name])
    assert text
    assert ">>> " in text, f"{name} shows no example"


def documented(owner):
    """Public objects of a package, and the methods and properties that its classes have, by name."""
    for name in getattr(owner, "__all__", []):
        value = getattr(owner, name)
        yield name, value
        if inspect.isclass(value):
            yield from ((f"{name}.{member}", inspect.getattr_static(value, member)) for member in dir(value))


@pytest.mark.parametrize("package", PACKAGES)
def test_no_docstring_has_a_line_left_to_be_filled_in(package):
    texts = {name: inspect.getdoc(value) or "" for name, value in documented(PACKAGES[package])}
    assert [name for name, text in texts.items() if re.search(r"^ *\{\w+\}$", text, re.MULTILINE)] == []


def test_a_part_that_nobody_wrote_is_an_error():
    def described():
        """What it does.

        {nowhere}
        """

    with pytest.raises(KeyError, match="nowhere"):
        shared(elsewhere="Text.")(described)


def test_docstrings_may_be_stripped():
    """As by `python -OO`: decorators that fill them in have nothing to do."""
    code = "from stereodel import data, graphs, interpolation, relaxation; print(graphs.hull.__doc__)"
    ran = subprocess.run([sys.executable, "-OO", "-c", code], check=True, capture_output=True, text=True)
    assert ran.stdout == "None\n"


def signatures():
    for name, value in PUBLIC.items():
        yield name, value
        if inspect.isclass(value):
            for method, function in inspect.getmembers(
                value, lambda member: inspect.isfunction(member) or inspect.ismethod(member)
            ):
                if not method.startswith("_") and getattr(function, "__module__", "").startswith("stereodel"):
                    yield f"{name}.{method}", function


@pytest.mark.parametrize(
    ("name", "value"), list(signatures()), ids=lambda value: value if isinstance(value, str) else ""
)
def test_options_are_keyword_only(name, value):
    """After the first parameter, what has a default is given by name."""
    parameters = [p for p in inspect.signature(value).parameters.values() if p.name != "self"]
    positional = {p.name for p in parameters[1:] if p.kind is p.POSITIONAL_OR_KEYWORD and p.default is not p.empty}
    assert positional == NO_OPTIONS.get(name, set())
