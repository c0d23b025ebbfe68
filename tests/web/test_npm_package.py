"""The npm archive: what users of JavaScript install, tried in an empty folder, without a network."""

import json
import re
import subprocess
import sys
import tarfile
from pathlib import Path

import pytest

import stereodel
from tests.web.conftest import NODE, SCRIPT

pytestmark = pytest.mark.thorough  # what is in the archive is asked by the other tests from the sources

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """An empty folder in which the archive is installed."""
    folder = tmp_path_factory.mktemp("npm")
    subprocess.run([ROOT / "tools" / "npm_archive.sh", sys.prefix, folder], check=True, capture_output=True)
    (archive,) = folder.glob("*.tgz")
    with tarfile.open(archive) as members:
        safe = {"filter": "data"} if hasattr(tarfile, "data_filter") else {}  # Debian 12's Python 3.11.2 has none
        members.extractall(folder, **safe)
    (folder / "node_modules").mkdir()
    (folder / "package").rename(folder / "node_modules" / "stereodel")
    return folder


def node(folder, *line):
    """What Node prints in a folder."""
    ran = subprocess.run([NODE, *line], cwd=folder, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stdout + ran.stderr
    return ran.stdout


def run(folder, code):
    return json.loads(node(folder, "--no-warnings", "--input-type=module", "--eval", code))


MODULES = ["index", "inline", "d3", "delaunator", "d3_delaunay"]


def test_what_it_says_of_itself_and_what_bundlers_look_for(installed):
    folder = installed / "node_modules" / "stereodel"
    package = json.loads((folder / "package.json").read_text(encoding="utf-8"))
    assert (package["version"], package["type"]) == (stereodel.__version__, "module")
    modules = {".", "./inline", "./d3", "./delaunator", "./d3-delaunay"}
    assert set(package["exports"]) == modules | {"./stereodel.wasm", "./package.json"}
    files = [package[name] for name in ("main", "types", "unpkg", "jsdelivr")]
    for module in modules:
        files += package["exports"][module].values()
    assert all((folder / file).is_file() for file in files)
    assert not {"private", "scripts", "dependencies", "devDependencies"} & set(package)
    # Webpack, Vite, Rollup and others look for this expression, letter by letter.
    assert 'new URL("stereodel.wasm", import.meta.url)' in (folder / "index.js").read_text(encoding="utf-8")
    for file in folder.glob("*.js"):
        text = file.read_text(encoding="utf-8")
        assert not any(word in text for word in ("eval(", "new Function", "http:", "https:"))
        assert json.loads((folder / f"{file.name}.map").read_text(encoding="utf-8"))["version"] == 3
    readable = [file for file in folder.glob("*.js") if file.name != "inline.js"]
    assert sum(file.stat().st_size for file in readable) < 90_000


def test_errors_name_classes_and_lines_of_the_sources(installed):
    lines = 'import { load, PlanarDelaunay } from "stereodel"; await load(); let said = PlanarDelaunay.name;'
    code = f"{lines} try {{ new PlanarDelaunay([0, NaN]); }} catch (error) {{ said += error.stack; }}"
    said = node(installed, "--enable-source-maps", "--input-type=module", "--eval", f"{code} console.log(said)")
    assert said.startswith("PlanarDelaunay")
    assert re.search(r"at asRows \(.*kernel/checks\.ts:\d+", said)


def test_examples_of_its_readme(installed):
    text = (installed / "node_modules" / "stereodel" / "README.md").read_text(encoding="utf-8")
    for code in re.findall(r"```js\n(.*?)```", text, re.DOTALL):
        run(installed, f"{code}console.log(1)")
    page = re.search(r"```html\n<script[^>]*>\n(.*?)</script>", text, re.DOTALL)[1].replace(
        "./stereodel/", "./node_modules/stereodel/"
    )
    (installed / "page.mjs").write_text(
        f"const document = {{}};\n{page}console.log(JSON.stringify(document.title));", "utf-8"
    )
    assert run(installed, 'await import("./page.mjs")') == "1 triangle"
    triangles = run(
        installed,
        'import { load } from "stereodel"; import Delaunator from "stereodel/delaunator"; await load();'
        "console.log(JSON.stringify([...Delaunator.from([[0, 0], [4, 0], [0, 3]]).triangles]))",
    )
    assert f"Uint32Array {triangles}" in text


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
    """A strict reader of the types finds all of them, without those of a browser's page or of Node beside."""
    (installed / "user.mts").write_text(
        'import { load, MoebiusMap, SphericalDelaunay, type Numbers } from "stereodel";\n'
        'import { load as loadInline } from "stereodel/inline";\n'
        'import { geoVoronoi } from "stereodel/d3";\n'
        'import Delaunator from "stereodel/delaunator";\n'
        'import { Delaunay } from "stereodel/d3-delaunay";\n'
        "const points: Numbers = [1, 0, 0];\n"
        "export const width: 3 = new SphericalDelaunay(points).width;\n"
        "export const images: Float64Array = MoebiusMap.fisheye([0, 40], 4).apply(points);\n"
        "export const found: number | undefined = geoVoronoi([[0, 0], [10, 0]]).find(1, 1);\n"
        "export const triangles: Uint32Array = Delaunator.from([{ u: 1 }], (each) => each.u, () => 2).triangles;\n"
        "export const near: number[] = [...Delaunay.from(new Set([[1, 2]])).voronoi([0, 0, 1, 1]).neighbors(0)];\n"
        "await load(new Uint8Array(1));\nawait loadInline();\n"
        "// @ts-expect-error: names are checked\nnew SphericalDelaunay(points).triangles;\n"
        "// @ts-expect-error: so is what is loaded\nawait load(1);\n",
        encoding="utf-8",
    )
    line = [SCRIPT / "node_modules" / "typescript" / "bin" / "tsc", "user.mts", "--noEmit", "--strict"]
    options = ["--module", "nodenext", "--target", "es2022", "--lib", "es2022", "--skipLibCheck", "false"]
    node(installed, *line, *options, "--types", "")
