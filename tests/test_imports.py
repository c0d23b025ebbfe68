"""Imports go down only: the order of the packages, no cycles, one door to OpenGL, no graphics in `import stereodel`."""

import ast
import re
import subprocess
import sys
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

import stereodel
from stereodel.drawing.page.page import OUTPUTS, output

ROOT = Path(__file__).resolve().parent.parent
PACKAGE = ROOT / "stereodel"

BASE = {"constants", "earth"}
BASE |= {"_arrays", "_docs", "_extras", "_notebook", "_numbers", "_double_double", "_tasks"}
MATHEMATICS = BASE | {"sphere", "projections", "conformal", "predicates", "triangulation"}
KERNEL = BASE | {"_kernel", "_spaces"}
MAY_IMPORT = {
    "constants": set(),
    "earth": set(),
    "_docs": set(),
    "_extras": set(),
    "_notebook": {"constants"},
    "_kernel": set(),
    "_spaces": {"_arrays", "_kernel", "sphere"},
    "_arrays": BASE,
    "_numbers": BASE,
    "_double_double": BASE,
    "_tasks": BASE,
    "data": BASE,
    "sphere": KERNEL,
    "projections": BASE | {"sphere"},
    "conformal": KERNEL | {"sphere", "projections"},
    "curves": BASE | {"sphere", "conformal"},
    "predicates": KERNEL,
    "triangulation": KERNEL | {"sphere", "projections", "predicates"},
    "interpolation": KERNEL | {"curves", "sphere", "triangulation"},
    "xarray": BASE | {"interpolation", "sphere", "triangulation"},
    "spatial": BASE | {"curves", "triangulation"},
    "graphs": KERNEL | {"sphere", "triangulation"},
    "relaxation": KERNEL | {"curves", "sphere", "triangulation"},
    "io": BASE | {"_spaces", "conformal", "curves", "data", "interpolation", "predicates", "sphere", "triangulation"},
    "partitioned": KERNEL | {"__init__", "curves", "interpolation", "io", "sphere", "triangulation"},
    "__init__": MATHEMATICS,
    "_doctor": {"__init__", "_extras", "_tasks", "render"},
    "__main__": {"__init__", "_doctor", "_extras", "_tasks", "cli"},
    "drawing": MATHEMATICS | {"_spaces", "curves"},
    "render": MATHEMATICS | {"curves", "drawing"},
    "mpl": MATHEMATICS | {"curves", "data", "drawing", "io"},
    "globe": MATHEMATICS | {"_kernel", "curves", "data", "drawing", "io"},
    "web": BASE | {"curves", "data", "drawing", "interpolation", "io", "render", "sphere", "triangulation"},
    "film": MATHEMATICS | {"_kernel", "curves", "drawing", "globe", "render"},
    "cli": MATHEMATICS
    | {"__init__", "curves", "data", "drawing", "earth", "film", "globe", "interpolation", "io"}
    | {"_doctor", "partitioned", "web"},
}
# Whatever the table above says some day: data know nothing of pictures, and drawing is without OpenGL.
NEVER = {("io", "render"), ("io", "globe"), ("io", "film"), ("io", "mpl"), ("drawing", "render"), ("render", "globe")}
MATPLOTLIB_IN_DRAWING = {f"stereodel.drawing.page.{name}" for name in ("colors", "fonts", "labels", "scales")}
GRAPHICS = {"matplotlib", "OpenGL", "pyrender", "trimesh", "PIL", "imageio", "pyglet"}
NEIGHBOURS = {"antimeridian", "av", "geopandas", "netCDF4", "pandas", "pyarrow", "pyproj", "pyvista", "shapely"}
NEIGHBOURS |= {"uxarray", "xarray"}
NOT_IN_CORE = GRAPHICS | NEIGHBOURS | {"scipy", "typer", "rich", "mpmath"}


# Folders of the kernel from the ground: each may include those before it. Files in no folder are the ground floor.
KERNEL_FLOORS = ["", "arithmetic", "coordinates", "predicates", "order", "mesh", "engine", "queries", "voronoi"]
KERNEL_FLOORS += ["graphs", "interpolation", "conformal", "raster", "partitions", "python", "web"]


def module_names():
    """Path of every module of the package by dotted name; a package stands for its `__init__`."""
    names = {}
    # The kernel is compiled; its stub stands for it.
    for path in [*PACKAGE.rglob("*.py"), *PACKAGE.rglob("*.pyi")]:
        parts = path.relative_to(ROOT).with_suffix("").parts
        names[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    return names


MODULES = module_names()


@cache
def parsed(path):
    return ast.parse(path.read_text(encoding="utf-8"))


def imported(path, known=None):
    """Dotted names in every import statement, wherever it stands; `from a import b` is a.b where that is a module."""
    for node in ast.walk(parsed(path)):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}:{node.lineno} imports relatively; write the whole name"
            for alias in node.names:
                inner = f"{node.module}.{alias.name}"
                yield inner if inner in (known or MODULES) else node.module


@cache
def own_imports(name):
    return sorted({target for target in imported(MODULES[name]) if target in MODULES})


def part(name):
    """The part of the library that a module belongs to, a key of MAY_IMPORT."""
    parts = name.split(".")
    return parts[1] if len(parts) > 1 else "__init__"


EDGES = [(source, target) for source in MODULES for target in own_imports(source)]


def test_arrows_go_down_and_each_is_needed():
    """The ground floors may be used as one, needed or not."""
    used = {(part(source), part(target)): (source, target) for source, target in EDGES if part(source) != part(target)}
    allowed = {(room, target) for room, targets in MAY_IMPORT.items() for target in targets}
    assert {part(name) for name in MODULES} <= set(MAY_IMPORT)
    assert [used[pair] for pair in used.keys() - allowed] == []
    assert {(room, target) for room, target in allowed - used.keys() if target not in MATHEMATICS | KERNEL} == set()
    assert [used[pair] for pair in used.keys() & NEVER] == []


def test_drawing_asks_matplotlib_for_type_and_names_of_colours_alone():
    """And nothing in it OpenGL, or what opens it."""
    foreign = {
        (name, target.split(".")[0])
        for name, path in MODULES.items()
        if part(name) == "drawing"
        for target in imported(path)
    }
    assert {name for name, library in foreign if library == "matplotlib"} <= MATPLOTLIB_IN_DRAWING
    assert not {library for _, library in foreign} & {"OpenGL", "pyrender", "trimesh", "imageio"}


def test_pages_and_scenes_are_drawn_by_the_modules_of_their_table_on_use():
    """A module's name stands as text in that table alone, so that no import is hidden from this file."""
    texts = {
        (name, node.value)
        for name, path in MODULES.items()
        for node in ast.walk(parsed(path))
        if isinstance(node, ast.Constant) and isinstance(node.value, str)
    }
    (table,) = {name for name, text in texts if text in MODULES and text.startswith("stereodel.render.")}
    assert table == "stereodel.drawing.page.page"
    assert not loaded_by("import stereodel.drawing") & GRAPHICS
    assert all(callable(output(work)) for work in OUTPUTS)


def test_pages_know_nothing_of_scenes_and_vector_files_nothing_of_pixels():
    assert [edge for edge in EDGES if "drawing.page" in edge[0] and "drawing.scene" in edge[1]] == []
    above = [target for source, target in EDGES if "render.vector." in source and "stereodel.render" in target]
    assert all(target.startswith("stereodel.render.vector.") for target in above)
    within = [edge for edge in EDGES if "render." in edge[0] and "render.space" in edge[1]]
    assert all(source.startswith("stereodel.render.space.") for source, _ in within)


def circle(edges):
    """Modules that import one another in a circle, as text; empty if there is none."""
    try:
        TopologicalSorter(edges).prepare()
    except CycleError as error:
        return " → ".join(error.args[1])
    return ""


def test_no_cycles():
    assert circle({name: own_imports(name) for name in MODULES}) == ""
    assert circle({"a": ["b"], "b": ["c"], "c": ["a"]})


@pytest.mark.parametrize("folder", ["benchmarks", "tools"])
def test_no_cycles_beside_the_package(folder):
    """Imports count wherever they stand, in functions too; tools import one another with and without the folder."""
    paths = {f"{folder}.{path.stem}": path for path in (ROOT / folder).glob("*.py")}
    names = {
        name: {f"{folder}.{target.removeprefix(f'{folder}.')}" for target in imported(path, paths)}
        for name, path in paths.items()
    }
    assert circle({name: targets & set(paths) for name, targets in names.items()}) == ""


def test_opengl_has_one_door():
    doors = {
        name for name, path in MODULES.items() if {t.split(".")[0] for t in imported(path)} & {"OpenGL", "pyrender"}
    }
    assert doors == {"stereodel.render.gl"}


def test_figures_draw_through_the_library():
    for path in (ROOT / "figures").glob("*.py"):
        roots = {target.split(".")[0] for target in imported(path)}
        assert not roots & (GRAPHICS | {"scipy"}), f"{path.name} imports {roots & NOT_IN_CORE}"


def loaded_modules(statement):
    code = f"{statement}\nimport sys; print(*sys.modules)"
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return set(ran.stdout.split())


def loaded_by(statement):
    return {name.split(".")[0] for name in loaded_modules(statement)}


def test_core_and_files_of_text_need_no_other_library():
    read = "; ".join(
        f"stereodel.io.read_points(io.StringIO({text!r}))" for text in ("lon,lat\n1,2", '{"features": []}')
    )
    assert not loaded_by(f"import io, stereodel; dir(stereodel); import stereodel.io; {read}") & NOT_IN_CORE


def test_help_loads_nothing_heavy():
    statement = "import contextlib, io; from stereodel.cli import app\nwith contextlib.redirect_stdout(io.StringIO()):"
    assert not loaded_by(f"{statement} app(['--help'], standalone_mode=False)\n") & (NOT_IN_CORE - {"typer", "rich"})


def test_import_adds_few_modules_to_numpy():
    """A cheap stand-in for the import time."""
    assert len(loaded_by("import stereodel") - loaded_by("import numpy")) < 60


def test_modules_are_loaded_when_they_are_used():
    assert "stereodel.io" not in loaded_modules("import stereodel; dir(stereodel)")
    assert "stereodel.io" in loaded_modules("import stereodel; stereodel.io.read_points")
    modules = {path.stem for path in PACKAGE.iterdir() if re.fullmatch(r"[a-z]\w*(\.py)?", path.name)} - {"kernel"}
    assert modules < set(dir(stereodel))
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        stereodel.nothing  # noqa: B018


def kernel_includes():
    """Pairs of a file of the kernel and a header of the kernel that it includes, as paths below `stereodel/kernel`."""
    kernel = PACKAGE / "kernel"
    for path in [*kernel.rglob("*.hpp"), *kernel.rglob("*.cpp")]:
        for header in re.findall(r'^#include "([^"]+)"', path.read_text(encoding="utf-8"), flags=re.MULTILINE):
            yield path.relative_to(kernel).as_posix(), header


def test_the_kernel_includes_go_down():
    pairs = list(kernel_includes())
    assert len(pairs) > 200
    floors = [(KERNEL_FLOORS.index(file.rpartition("/")[0]) for file in pair) for pair in pairs]
    assert [pair for pair, (file, header) in zip(pairs, floors, strict=True) if header > file] == []


def test_the_doors_of_the_kernel_are_apart():
    """The module of Python has no code of the web's, nor the other way round."""
    doors = {"python", "web"}
    pairs = {(file.partition("/")[0], header.partition("/")[0]) for file, header in kernel_includes()}
    assert {(file, header) for file, header in pairs if header in doors and file != header} == set()


def test_a_folder_of_the_kernel_is_a_namespace():
    for path in (PACKAGE / "kernel").rglob("*.hpp"):
        folder = path.parent.name if path.parent.name != "kernel" else ""
        wanted = "namespace stereodel" + (f"::{folder}" if folder else "")
        names = re.findall(r"^namespace (\S+) \{", path.read_text(encoding="utf-8"), flags=re.MULTILINE)
        assert names, path
        assert all(f"namespace {name}".startswith(wanted) for name in names), path


@pytest.mark.parametrize("folder", KERNEL_FLOORS[1:])
def test_the_main_header_of_a_folder_names_its_files(folder):
    """What the folder is for and in which order to read it, so that no file is overlooked."""
    files = list((PACKAGE / "kernel" / folder).iterdir())
    heads = [re.match(rf"// The folder `{folder}`: (?:.*\n)+?//\n", path.read_text(encoding="utf-8")) for path in files]
    (head,) = filter(None, heads)
    if folder not in ("python", "web"):  # whose files are named after the other folders
        missing = {path.stem for path in files} - set(re.findall(r"\w+", head[0]))
        assert missing - {"moebius"} == set()  # alone there
