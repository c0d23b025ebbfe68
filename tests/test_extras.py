"""A core of NumPy alone: what works without the extras, what each of them brings, and who names them where they lack.

The environments are real ones, made of links to what is installed here: NumPy, what an extra brings, and what that
needs. Nothing else is to be found in them.
"""

import ast
import json
import re
import subprocess
import sys
import tomllib
import venv
from contextlib import suppress
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path

import pytest
import shapely
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

import stereodel
from stereodel import _extras
from stereodel._doctor import COMMANDS
from stereodel._extras import EXTRAS, MissingExtraError, installing, libraries, of_extra
from tests.tiers import by_day
from tools.page_commands import sessions, write_tables, wrong_command

ROOT = Path(__file__).resolve().parent.parent
PACKAGE = Path(stereodel.__file__).parent

PRELUDE = """
import io, os
import numpy as np
from stereodel import *

POINTS = np.random.default_rng(1).normal(size=(20, 3))
MESH = SphericalDelaunay(POINTS)
PICTURES = [np.full((8, 6, 3), level, dtype=np.uint8) for level in (0, 128, 255)]

def picture():
    from stereodel.drawing import Label, Page
    return Page((0.0, 2.0, 0.0, 1.0), (Label("a", (1.0, 0.5)),), width=144.0)

LENS = fisheye((0, 0), magnification=2)
RINGS = [[[0, 0], [10, 0], [0, 10], [0, 0]]]
TABLE = io.StringIO("lon,lat\\n1,2\\n3,4\\n")
"""

GLOBE = "from stereodel.globe import Globe; g = Globe(); g.add_land(); g.add_labels([(0, 0)], ['a']);"

DOORS = {
    "from stereodel.cli import app": ["cli"],
    "import stereodel.mpl": ["draw"],
    "import stereodel.spatial; stereodel.spatial.Delaunay(POINTS[:, :2])": ["scipy"],
    # Pictures
    "from stereodel.drawing import ColorScale; ColorScale('viridis', 0, 1)": ["draw"],
    "from stereodel.drawing.page.labels import label_box; label_box(picture().labels[0], 1.0)": ["draw"],
    "picture().save('page.svg')": ["draw"],
    "picture().save('page.pdf')": ["draw"],
    "picture().save('page.png', size=100, renderer='agg')": ["draw"],
    "picture().save('page.png', size=100)": ["render"],
    "from stereodel.render import Figure; Figure('a', dict, lambda _: picture(), renderer='agg').save('.')": ["draw"],
    "from stereodel.drawing import *; Scene().solid(View(0, 0)).save('ball.glb')": ["render"],
    "from stereodel.drawing import *; Scene().solid(View(0, 0)).save('ball.png', size=50)": ["render"],
    "from stereodel.drawing import *; Scene().solid(View(0, 0)).to_trimesh()": ["render"],
    "from stereodel.data import blue_marble; blue_marble()": ["draw"],
    "from stereodel.globe import Globe; g = Globe(); g.add_polygons([RINGS]); g.save('a.svg')": ["draw"],
    "from stereodel.globe import Globe; Globe().add_raster('file.jpg')": ["draw"],
    # Pages that are made first: what makes them comes with what draws them.
    f"{GLOBE} g.save('a.png', size=200)": ["render"],
    f"{GLOBE} g.save('a.pdf')": ["draw"],
    f"{GLOBE} from stereodel.render import Figure; Figure('a', dict, lambda _: g.page()).pixels(size=200)": ["render"],
    f"{GLOBE} from stereodel.film import *; Film.of_globe(g, Spin(seconds=1), size=(64, 64)).picture(0)": ["render"],
    "from stereodel.film import Film; Film.of_pictures(PICTURES, seconds=0.5).save('a.gif', progress=False)": ["film"],
    "from stereodel.film import Film; Film.of_pictures(PICTURES, seconds=0.5).save('a.webp', progress=False)": ["film"],
    "from stereodel.film import Film; Film.of_pictures(PICTURES, seconds=0.5).save('a.mp4', progress=False)": ["film"],
    # Files and neighbours
    "from stereodel.io import to_geodataframe; to_geodataframe(MESH)": ["geo"],
    "from stereodel.io import write; write('a.gpkg', MESH)": ["geo"],
    "from stereodel.io import write; write('a.geojson', SphericalVoronoi(MESH), clip='land')": ["geo"],
    "from stereodel.io import *; write('a.parquet', read_points(TABLE)); read_points('a.parquet')": ["geo"],
    "from stereodel.io import to_geodataframe, warp; warp(to_geodataframe(MESH), LENS)": ["geo"],
    "from stereodel.io import to_ugrid; to_ugrid(MESH)": ["grid"],
    "import stereodel.xarray": ["grid"],
    "from stereodel.xarray import healpix; healpix(2)": ["grid", "healpix"],
    "from stereodel.interpolation import *; NearestInterpolator(POINTS, POINTS).weights(POINTS).to_scipy()": ["scipy"],
    "from stereodel.io import write; write('a.nc', MESH)": ["grid"],
    "from stereodel.interpolation import *; NearestInterpolator(POINTS, POINTS).weights(POINTS).save('w.nc')": ["grid"],
    "from stereodel.io import write; write('a.glb', MESH)": ["mesh"],
    "from stereodel.io import to_polydata; to_polydata(MESH)": ["vtk"],
    "from stereodel.io import *; write('a.nc', Grid([0], [0], {'z': [[1]]}))": ["grid"],
    "from stereodel.io import *; write('a.tif', Grid([0], [0], {'z': [[1]]}))": ["raster"],
    "from stereodel.web import GlobeWidget; GlobeWidget(lonlat=[(10, 48)])": ["jupyter"],
    "from stereodel.io import Grid; Grid([0], [0]).to_xarray()": ["grid"],
    "from stereodel.partitioned import triangulate; triangulate([], 'out')": ["partitioned"],
    "from stereodel.partitioned import triangulate; triangulate([], 'out', cells=True)": ["geo"],
    "from stereodel.interpolation import contours; from stereodel.io import to_geodataframe; "
    "to_geodataframe(contours(MESH, POINTS[:, 0], 0.1))": ["geo"],
}
"""Calls that need a library, and the extras that they ask for one after the other when there is NumPy alone."""

ROOMS = {
    "stereodel.cli": "cli",
    "stereodel.mpl": "draw",
    "stereodel.spatial": "scipy",
    "stereodel.web.widget": "jupyter",
    "stereodel.xarray": "grid",
}
"""Packages that cannot be imported without an extra; all others can."""

LAZY = "stereodel.render."
"""A package some of whose modules cannot."""


def needed(names):
    """The distributions of these names and all that they need here."""
    found = {name: distribution(name) for name in map(canonicalize_name, names)}
    queue = list(found.values())
    while queue:
        for needs in map(Requirement, queue.pop().requires or []):
            name = canonicalize_name(needs.name)
            if name not in found and (needs.marker is None or needs.marker.evaluate({"extra": ""})):
                with suppress(PackageNotFoundError):
                    found[name] = distribution(name)
                    queue.append(found[name])
    return found.values()


@pytest.fixture(scope="module")
def environment(tmp_path_factory):
    """A function: the Python of an environment with NumPy and some extras alone."""
    made = {}

    def make(*extras):
        if extras not in made:
            folder = tmp_path_factory.mktemp("-".join(("numpy", *extras)))
            venv.create(folder, symlinks=True)
            (site,) = folder.glob("lib/python*/site-packages")
            for wanted in needed(["numpy", *(each.name for extra in extras for each in libraries(extra))]):
                for top in {file.parts[0] for file in wanted.files} - {"..", "__pycache__"}:
                    (site / top).symlink_to(wanted.locate_file(top))
            (site / "stereodel").symlink_to(PACKAGE)
            made[extras] = folder / "bin" / "python"
        return made[extras]

    return make


def run(python, *arguments, cwd, **options):
    environment = {"PATH": "/usr/bin:/bin", "HOME": str(cwd), "MPLBACKEND": "agg"}
    return subprocess.run(
        [python, *arguments], cwd=cwd, env=environment, capture_output=True, text=True, check=False, **options
    )


RUNNER = """
import json, sys
said = {}
for statement in json.load(sys.stdin):
    try:
        exec(statement, dict(globals()))
        said[statement] = ""
    except ImportError as error:
        said[statement] = str(error)
json.dump(said, sys.stdout)
"""


def said(python, statements, cwd):
    """What each statement says where it misses a library; nothing where it works."""
    ran = run(python, "-c", PRELUDE + RUNNER, cwd=cwd, input=json.dumps(list(statements)))
    assert ran.returncode == 0, ran.stderr
    return json.loads(ran.stdout)


def asked_for(message):
    """The extra that a message names."""
    asked = re.fullmatch(r"(\S+) is not installed; it comes with the extra '(\w+)': pip install '.+\[(\w+)\]'", message)
    assert asked, message
    assert asked[2] == asked[3]
    assert asked[1] in {each.name for each in libraries(asked[2])}
    return asked[2]


def test_every_module_is_there_or_names_its_extra(environment, tmp_path):
    files = [path.relative_to(PACKAGE.parent).with_suffix("") for path in PACKAGE.rglob("*.py")]
    modules = [".".join(path.parts).removesuffix(".__init__") for path in files]
    assert len(modules) > 150
    answers = said(environment(), [f"import {module}" for module in modules], tmp_path)
    closed = {module: asked_for(answers[f"import {module}"]) for module in modules if answers[f"import {module}"]}
    # Modules within a room, which those that are open import on use.
    within = {module: closed.pop(module) for module in sorted(closed) if module.startswith(LAZY)}
    assert set(within.values()) == {"draw"}
    assert not within.keys() & {"stereodel.render.gl", "stereodel.io.reading"}
    rooms = {
        module: extra for module in modules for room, extra in ROOMS.items() if f"{module}.".startswith(f"{room}.")
    }
    assert closed == rooms


def test_every_door_names_the_extra_that_opens_it(environment, tmp_path):
    for statement, message in said(environment(), DOORS, tmp_path).items():
        assert asked_for(message) == DOORS[statement][0], statement


def test_every_extra_opens_a_door():
    assert {extra for asked in DOORS.values() for extra in asked} == set(EXTRAS)


@pytest.mark.parametrize("extra", by_day(sorted({asked[0] for asked in DOORS.values()}), "draw", "scipy"))
def test_an_extra_brings_enough(environment, tmp_path, extra):
    """Who does what a message says gets on, with what that extra brings and nothing else."""
    (tmp_path / "file.jpg").symlink_to(PACKAGE / "data" / "blue_marble.jpg")
    doors = [statement for statement, asked in DOORS.items() if asked[0] == extra]
    answers = said(environment(extra), doors, tmp_path)
    assert any(not message for message in answers.values())
    for statement, message in answers.items():
        rest = DOORS[statement][1:]
        assert not message if not rest else asked_for(message) == rest[0], (statement, message)
        if rest:
            assert said(environment(extra, *rest), [statement], tmp_path) == {statement: ""}


MAPS = """
from stereodel.interpolation import contours
from stereodel.io import Grid, read_points, write

def maps():
    yield SphericalVoronoi(MESH)
    yield MESH
    yield PlanarVoronoi(POINTS[:, :2])
    yield PlanarDelaunay(POINTS[:, :2])
    yield SphericalVoronoi(POINTS[:1])
    # A table of the nodes of a grid: cells around poles and along the 180th meridian.
    yield SphericalVoronoi.from_lonlat([(lon, lat) for lon in range(-180, 180, 30) for lat in range(-90, 91, 30)])
    yield contours(MESH, POINTS[:, 0], [-0.2, 0.1])
    yield contours(PlanarDelaunay(POINTS[:, :2]), POINTS[:, 2], 0.1)
    yield read_points(TABLE)

for number, thing in enumerate(maps()):
    write(f"{number}.geojson", thing)
write("edges.geojson", MESH, what="edges")
write("ridges.geojson", PlanarDelaunay(POINTS[:, :2]), what="ridges")
"""

CORE = """
from stereodel.graphs import gabriel_graph
from stereodel.io import read_points
from stereodel.relaxation import lloyd
from stereodel.interpolation import NaturalNeighborInterpolator
from stereodel.data import coastlines
check_delaunay(POINTS, MESH.simplices)
check_delaunay(POINTS[:, :2], PlanarDelaunay(POINTS[:, :2]).simplices)
assert np.isclose(SphericalVoronoi(POINTS).areas().sum(), 4 * np.pi)
assert len(gabriel_graph(POINTS)) > 20
assert np.isclose(NaturalNeighborInterpolator(POINTS, POINTS[:, 0])(POINTS[:1])[0], POINTS[0, 0])
lloyd(POINTS)
assert len(read_points(io.StringIO('lon,lat\\n1,2')).lonlat) == 1
"""


def test_numpy_alone_computes(environment, tmp_path):
    ran = run(environment(), "-c", PRELUDE + CORE, cwd=tmp_path)
    assert ran.returncode == 0, ran.stderr


def test_maps_are_geojson_on_numpy_alone_byte_by_byte(environment, tmp_path):
    """Shapely is asked about what is narrower than the rounding of the map, and about nothing else."""
    for name, python in (("alone", environment()), ("all", sys.executable)):
        (tmp_path / name).mkdir()
        ran = run(python, "-c", f"import sys; sys.path.insert(0, {str(ROOT)!r})" + PRELUDE + MAPS, cwd=tmp_path / name)
        assert ran.returncode == 0, ran.stderr
    written = [{file.name: file.read_bytes() for file in (tmp_path / name).iterdir()} for name in ("alone", "all")]
    assert written[0] == written[1]
    assert len(written[0]) == 11
    for name, content in written[0].items():
        shapes = shapely.from_geojson(content)
        assert shapely.is_valid(shapes), name
        assert len(shapes.geoms) > (name != "4.geojson"), name


def command(python, line, folder):
    ran = run(python, "-m", "stereodel", *line.split(), cwd=folder)
    return ran.returncode, ran.stdout, ran.stderr


def test_the_command_without_its_libraries(environment, tmp_path):
    python = environment()
    code, listed, error = command(python, "doctor", tmp_path)
    assert (code, error) == (1, "")
    for name in EXTRAS:
        (row,) = [line for line in listed.splitlines() if line.startswith(f"  {name} ")]
        assert row.split()[1] == "lacks"
        assert "pip install" in row
    assert command(python, "--version", tmp_path) == (0, f"stereodel {stereodel.__version__}\n", "")
    for line in ("voronoi cities.csv", "voronoi --help", "--verse"):
        code, output, error = command(python, line, tmp_path)
        assert (code, output) == (1, "")
        assert asked_for(error.strip().removeprefix("error: ")) == "cli"
    for line, expected in {"--help": 0, "-h": 0, "": 2}.items():
        code, output, error = command(python, line, tmp_path)
        assert (code, error) == (expected, "")
        assert [row for row in COMMANDS if f"\n  {row} " in output] == [*COMMANDS]
        assert f"pip install '{PACKAGE.resolve().parent}[cli]'" in output


LEAST = {
    "--help": "doctor",
    "--version": stereodel.__version__,
    "voronoi cities.csv -o -": "Ulm",
    "voronoi cities.csv -o - --format geojson": "MultiPolygon",
    "contour cities.csv --value v --interval 1 -o - --format geojson": "LineString",
    "triangulate cities.csv -o - --format geojson": "Polygon",
    "nearest cities.csv --of cities.csv -o - --format geojson": "Point",
}
MISSING = {
    "voronoi cities.csv -o a.gpkg": "geo",
    "voronoi cities.csv -o a.vtp": "vtk",
    "voronoi cities.csv -o a.ply": "mesh",
    "voronoi cities.csv -o a.nc": "grid",
    "interpolate cities.csv --value v --grid 30 -o a.nc": "grid",
    "interpolate cities.csv --value v --grid 30 -o a.tif": "raster",
    "globe cities.csv -o a.svg": "draw",
    "globe cities.csv -o a.png": "render",
    "globe cities.csv -o a.gif": "film",
    "voronoi nowhere.gpkg -o -": "geo",
}


@pytest.mark.thorough
def test_the_command_on_the_least(environment, tmp_path):
    """With its own libraries it writes tables and GeoJSON; for the rest it names one extra, by exit code 1."""
    python = environment("cli")
    (tmp_path / "cities.csv").write_text(
        "name,lon,lat,v\nQuito,-78.5,-0.2,1\nUlm,10,48.4,2\nKyoto,135.8,35,3\nPerth,115.9,-32,4\n"
    )
    (tmp_path / "nowhere.gpkg").write_text("no database")
    for line, output in LEAST.items():
        code, found, error = command(python, line, tmp_path)
        assert code == 0, error
        assert output in found
    for line, extra in MISSING.items():
        code, found, error = command(python, line, tmp_path)
        assert (code, found) == (1, "")
        assert asked_for(error.strip().removeprefix("error: ")) == extra, line
    for line in MISSING:  # NetCDF needs its extra and no more
        if MISSING[line] == "grid":
            assert command(environment("cli", "grid"), line, tmp_path) == (0, "", "")
            (tmp_path / "a.nc").unlink()


@pytest.mark.thorough
def test_the_readme_runs_with_what_its_small_line_installs(environment, tmp_path, monkeypatch):
    monkeypatch.delenv("PYTHONPATH", raising=False)
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    (extras,) = re.findall(r'^\$ pip install "\.\[([\w,]+)\]" .*; what the commands below need$', text, re.MULTILINE)
    shell = f"stereodel() {{ '{environment(*extras.split(','))}' -m stereodel \"$@\"; }}\n"
    write_tables(text, tmp_path)
    shown = sessions(text)
    assert len(shown) >= 5
    for line, printed in shown:
        assert wrong_command(line, printed, tmp_path, shell) == ""


def test_the_outer_door_speaks():
    with pytest.raises(MissingExtraError) as raised, of_extra("render"), of_extra("draw"):
        raise ModuleNotFoundError(name="PIL")
    assert str(raised.value) == f"pillow is not installed; it comes with the extra 'render': {installing('render')}"


@pytest.mark.parametrize("name", ["networkx", "shapely.no_such_module", "stereodel.no_such_module"])
def test_what_no_extra_brings_is_left_as_it_is(name):
    with pytest.raises(ModuleNotFoundError) as raised, of_extra("geo"):
        raise ModuleNotFoundError(name=name)
    assert not isinstance(raised.value, MissingExtraError)


def test_an_environment_made_by_make_grows_by_make(monkeypatch, tmp_path):
    monkeypatch.setattr(sys, "prefix", str(tmp_path))
    assert installing("geo") == f"pip install '{PACKAGE.resolve().parent}[geo]'"
    (tmp_path / "installed-figures").touch()
    assert installing("geo") == f"make -C {PACKAGE.resolve().parent} install"


def test_away_from_a_checkout_the_missing_libraries_are_named(monkeypatch, tmp_path):
    """The index, wheel or folder that the package came from is not known: by its name a stranger's could come."""
    monkeypatch.setattr(_extras, "__file__", str(tmp_path / "site-packages" / "stereodel" / "_extras.py"))
    here, found = {"trimesh"}, _extras.find_spec
    monkeypatch.setattr(_extras, "find_spec", lambda name: found(name) if name in here else None)
    assert installing("scipy") == f'pip install "scipy>={EXTRAS["scipy"].brings[0].least}"'
    assert re.findall(r'"(\w+)>=[\d.a-z]+"', installing("vtk")) == ["pyvista"]
    names = ["matplotlib", "pillow", "mapbox_earcut", "pyrender2", "PyOpenGL"]
    assert re.findall(r'"(\w+)>=[\d.a-z]+"', installing("render")) == names


# Written down once


def test_pyproject_brings_what_the_code_asks_for():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert [Requirement(line).name for line in project["dependencies"]] == ["numpy"]
    optional = {name: [Requirement(line) for line in lines] for name, lines in project["optional-dependencies"].items()}
    own = {name: [r for r in found if r.name == "stereodel"] for name, found in optional.items()}
    for name, extra in EXTRAS.items():
        wanted = [f"{each.name}>={each.least}" for each in extra.brings]
        assert [str(r) for r in optional[name] if r.name != "stereodel"] == wanted
        assert {e for r in own[name] for e in r.extras} == set(extra.includes)
    (everything,) = optional["all"]
    assert everything.extras | {"draw", "render", "vtk"} == set(EXTRAS)  # two come with films, one is too large
    assert set(optional) - set(EXTRAS) == {"all", "test", "docs", "web", "wheels", "dev"}


def called(call):
    """The name of a function that is called with a text first."""
    literal = bool(call.args) and isinstance(call.args[0], ast.Constant)
    return getattr(call.func, "id", "") if literal else ""


def foreign_imports(tree, extra=None):
    """Modules that are imported with the extra of the `with of_extra(...)` around; those for types alone left out."""
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.If) and isinstance(node.test, ast.Name) and node.test.id == "TYPE_CHECKING":
            continue
        within = extra
        if isinstance(node, ast.With):
            calls = [item.context_expr for item in node.items if isinstance(item.context_expr, ast.Call)]
            within = next((call.args[0].value for call in calls if called(call) == "of_extra"), extra)
        if isinstance(node, ast.Import):
            yield from ((alias.name.split(".")[0], within) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield node.module.split(".")[0], within
        elif isinstance(node, ast.Call) and called(node) == "optional":
            yield node.args[0].value.split(".")[0], node.args[1].value
        yield from foreign_imports(node, within)


def known(folder):
    """Pairs of a file and its imports of a module that some extra brings."""
    modules = {each.module for extra in EXTRAS for each in libraries(extra)}
    for path in folder.rglob("*.py"):
        for module, extra in foreign_imports(ast.parse(path.read_text(encoding="utf-8"))):
            if module in modules:
                yield path, module, extra


def test_every_import_stands_behind_a_door():
    wrong = []
    for path, module, extra in known(PACKAGE):
        name = path.relative_to(PACKAGE).as_posix()
        room = name.split("/")[0]
        # Whole packages have their door in `__init__`; gl.py opens its own before anything else there.
        extra = extra or ROOMS.get(f"stereodel.{room}") or ("render" if name == "render/gl.py" else None)
        if extra is None or module not in {each.module for each in libraries(extra)}:
            wrong.append(f"{name} imports {module} for {extra}")
    assert wrong == []


def test_every_library_of_an_extra_is_used():
    used = {module for folder in (PACKAGE, ROOT / "tools") for _, module, _ in known(folder)}
    assert {each.module for extra in EXTRAS for each in libraries(extra)} == used
