"""Rules of the source that its syntax tree can hold: where tolerances, names of array types and private names stand."""

import ast
from pathlib import Path

import pytest

from tools import tracked_text as tracked

ROOT = Path(__file__).resolve().parent.parent
PACKAGE = ROOT / "stereodel"
TREES = {
    path.relative_to(PACKAGE).as_posix(): ast.parse(path.read_text(encoding="utf-8")) for path in PACKAGE.rglob("*.py")
}

TOLERANCE = 1e-3
"""A number below it decides something, as nothing that is drawn or measured in degrees or pixels is so small."""

# Bounds of errors stand beside the arithmetic that they bound; the threshold of SciPy's signature beside that.
MAY_HOLD_SMALL_NUMBERS = ("constants.py", "spatial/spherical_voronoi.py")


def value_of(node):
    """The value of a literal, or of a power of two literals; None for anything else."""
    match node:
        case ast.Constant(value=float() | int() as value) if not isinstance(value, bool):
            return value
        case ast.UnaryOp(op=ast.USub(), operand=operand) if (value := value_of(operand)) is not None:
            return -value
        case ast.BinOp(left=left, op=ast.Pow(), right=right):
            base, exponent = value_of(left), value_of(right)
            return None if base is None or exponent is None or abs(exponent) > 2000 else float(base) ** exponent
    return None


def small_numbers(tree):
    """Lines with a float below TOLERANCE that is not zero."""
    values = ((node, value_of(node)) for node in ast.walk(tree) if isinstance(node, ast.Constant | ast.BinOp))
    return sorted({node.lineno for node, value in values if isinstance(value, float) and 0 < abs(value) < TOLERANCE})


def test_tolerances_stand_in_one_file():
    found = {file for file, tree in TREES.items() if small_numbers(tree)}
    wrong = {file for file in found if not file.startswith(MAY_HOLD_SMALL_NUMBERS)}
    assert {file: small_numbers(TREES[file]) for file in wrong} == {}


def taken(tree):
    """Names that a module takes from the file of tolerances, or reads."""
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.module == "stereodel.constants":
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load):
            yield node.id


def test_each_tolerance_is_used():
    names = {node.target.id for node in TREES["constants.py"].body if isinstance(node, ast.AnnAssign)}
    assert len(names) > 40
    assert names - {name for tree in TREES.values() for name in taken(tree)} == set()


def array_names(tree):
    """Names that a module gives to types of arrays."""
    return [
        target.id
        for node in tree.body
        if isinstance(node, ast.Assign) and ast.unparse(node.value).startswith(("npt.NDArray[", "NDArray["))
        for target in node.targets
    ]


def test_types_of_arrays_have_their_names_in_one_file():
    assert {file for file, tree in TREES.items() if array_names(tree)} == {"_arrays.py"}


def part(file):
    """The package or module that a file belongs to."""
    return file.partition("/")[0].removesuffix(".py")


def private(name):
    return name.startswith("_") and not name.startswith("__")


def defined(tree):
    """Private names that a module defines: of functions, classes, values and attributes."""
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef | ast.ClassDef) and private(node.name):
            yield node.name
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store) and private(node.id):
            yield node.id
        elif isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store) and private(node.attr):
            yield node.attr


def used(tree):
    """Private names that are imported, and those of attributes of anything but the object or class itself."""
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and str(node.module).startswith("stereodel."):
            yield from (alias.name for alias in node.names if private(alias.name))
        elif isinstance(node, ast.Attribute) and private(node.attr) and ast.unparse(node.value) not in {"self", "cls"}:
            yield node.attr


def foreign_names(trees):
    """Uses of names that another package defines and the own one does not."""
    own: dict[str, set[str]] = {}
    for file, tree in trees.items():
        own.setdefault(part(file), set()).update(defined(tree))
    found = set()
    for file, tree in trees.items():
        others = set().union(*(names for name, names in own.items() if name != part(file)))
        found |= {f"{file} uses {name}" for name in used(tree) if name in others - own[part(file)]}
    return found


def test_private_names_stay_in_their_package():
    assert foreign_names(TREES) == set()


# The text checks of `make check`: what they see.


@pytest.mark.parametrize("line", ["x" * 121, "\tx", "x "])
def test_lines_of_cpp_are_seen(line):
    (found,) = tracked.problems("k.cpp", "x" * 120 + "\n" + line)
    assert found.startswith("k.cpp:2: ")
    assert tracked.problems("k.md", line) == []


@pytest.mark.parametrize(
    ("name", "text", "what"),
    [
        ("a.md", "see /ho" + "me/me/file", "absolute path"),
        ("a.toml", "index = 'https://py" + "pi.org/simple'", "package index"),
        ("a.py", "x = 1  # TO" + "DO later", "unfinished"),
        ("constraints.txt", "numpy>=2", "name==version"),
    ],
)
def test_text_checks_see(name, text, what):
    (found,) = tracked.problems(name, text)
    assert what in found


def test_text_checks_let_pass():
    assert tracked.problems("constraints.txt", "numpy==2.4.6\nruff==0.17.5") == []
    assert tracked.problems("a.py", "#!/usr/bin/env bash\nPath('/usr/lib')\n'out/home/x'") == []
