"""What notebooks show: outputs of six notebooks that run without a window, their bounds, and both of them as pages."""

import re
import subprocess
import sys
import time
import xml.etree.ElementTree as ET
from base64 import b64decode

import numpy as np
import pypdfium2
import pytest

from stereodel import HullInsertion, PlanarDelaunay, PlanarVoronoi, SphericalDelaunay, SphericalVoronoi, data
from stereodel.constants import MOST_SHOWN_BYTES, MOST_SHOWN_POINTS
from stereodel.drawing import Page, Polylines, Scene, Sketch, View, diagram_page
from stereodel.film import Film
from stereodel.globe import Globe, Raster
from stereodel.interpolation import LinearInterpolator, contours
from stereodel.io import Grid, PointTable
from stereodel.relaxation import lloyd
from tests.tiers import by_day
from tools.browser import ink

PLANE = np.random.default_rng(1).uniform(size=(MOST_SHOWN_POINTS + 1, 2))
DIRECTIONS = np.random.default_rng(1).normal(size=(MOST_SHOWN_POINTS + 1, 3))

PNG, SVG, HTML = "image/png", "image/svg+xml", "text/html"
DRAWN = "from stereodel.globe import Globe; g = Globe(); "
FILM = f"{DRAWN}g.add_graticule()\nfrom stereodel.film import *\n"
WEIGHTS = "LinearInterpolator.from_lonlat([(0, 80), (9, 9), (70, 2)], np.arange(3)).weights(lonlat=g.lonlat)"
NOTEBOOKS = {
    "globe": [
        (PNG, f"{DRAWN}g.add_land(resolution='10m'); g"),
        (SVG, "coarse = Globe(title='R & D'); coarse.add_land(resolution='110m'); coarse.page(width='6cm')"),
    ],
    "diagram": [
        (SVG, "import numpy as np; from stereodel import *; PlanarVoronoi(np.random.random((99, 2)))"),
        (SVG, "PlanarDelaunay(np.random.random((9, 2)))"),
        ("", "PlanarVoronoi(np.random.random((9999, 2)))"),
    ],
    "table": [
        (HTML, "from stereodel import data, io; d = data.airports(); io.PointTable(d.lonlat, {'name': d.name})"),
        ("", "d"),
    ],
    "film": [
        (HTML, f"{FILM}Film.of_globe(g, Spin(seconds=0.5), size=(320, 180), fps=10)"),
        (HTML, "Film.of_globe(g, Spin(seconds=999.0), size=(320, 180))"),
    ],
    "grid": [
        (HTML, "import numpy as np; from stereodel.io import Grid; g = Grid.regular(30); g"),
        (HTML, f"from stereodel.interpolation import *\n{WEIGHTS}"),
    ],
    "spatial": [
        (SVG, "from stereodel import *; SphericalVoronoi.from_lonlat([(0, 80), (9, 9), (70, 20), (-9, -40)])"),
        (SVG, "from stereodel.drawing import *; s = Scene(style='glass'); s.add_label([0, 0, 2], 'é'); s"),
    ],
}
"""Cells, and the richest thing that each shows: of a globe, diagrams, tables, films, grids with weights, and scenes."""


@pytest.fixture
def ran(tmp_path, monkeypatch):
    """Run cells in a kernel of their own: the outputs of each."""
    import nbformat  # takes a second
    from nbclient import NotebookClient

    for name in ("IPYTHONDIR", "JUPYTER_CONFIG_DIR", "JUPYTER_DATA_DIR", "JUPYTER_RUNTIME_DIR"):
        monkeypatch.setenv(name, str(tmp_path / name))

    def run(codes):
        notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(code) for code in codes])
        place = {"metadata": {"path": tmp_path}}
        NotebookClient(notebook, timeout=120, kernel_name="python3", resources=place).execute()
        return notebook

    return run


@pytest.mark.parametrize("kind", by_day(NOTEBOOKS, "table"))
def test_a_notebook_shows_and_prints(kind, ran, browser, patience):
    from nbconvert import HTMLExporter

    start = time.monotonic()
    notebook = ran([code for _, code in NOTEBOOKS[kind]])
    assert time.monotonic() - start < 60 * patience
    for (wanted, code), cell in zip(NOTEBOOKS[kind], notebook.cells, strict=True):
        (output,) = cell.outputs
        assert set(output.data) == {"text/plain", wanted} - {""}, code
        assert len(output.data["text/plain"]) < 500
        assert "\n" not in output.data["text/plain"]
        assert all(len(each) < 6 * MOST_SHOWN_BYTES for each in output.data.values())
        shown = output.data.get(HTML, output.data.get(SVG, ""))
        assert not re.search(r"<script|javascript:|\son\w+=", shown)

    page = browser.new_page()
    page.set_content(HTMLExporter(mathjax_url="", require_js_url="").from_notebook_node(notebook)[0])
    page.wait_for_function("[...document.images].every((image) => image.complete)")
    assert page.evaluate("[...document.images].every((image) => image.naturalWidth > 0)")
    printed = page.pdf(print_background=True)
    page.close()
    with pypdfium2.PdfDocument(printed) as document:
        pictures = [sheet.render(scale=1.0).to_numpy()[..., :3] for sheet in document]
    assert 0.01 < max(map(ink, pictures)) < 0.6


# Without a kernel


def mimes(it):
    data, sizes = it._repr_mimebundle_()
    assert set(sizes) <= set(data)
    return data


def film(frames=3, size=(20, 30)):
    return Film.of_pictures([np.full((*size, 3), k % 256, dtype=np.uint8) for k in range(frames)], fps=10)


EACH = {
    "Globe": Globe,
    "Page": lambda: diagram_page(PlanarDelaunay(PLANE[:500])),
    "Scene": Scene,
    "Sketch": lambda: Sketch().add_circle((0, 0), 1, name="circle"),
    "Solid": lambda: Scene().solid(View(0, 20)),
    "PlacedScene": lambda: Scene().placed(View(0, 20)),
    "Polylines": lambda: Polylines(PLANE[:900], np.array([0, 900]), (0.0, 0.0, 0.0, 1.0), 1.0),
    "PlanarDelaunay": lambda: PlanarDelaunay(PLANE),
    "SphericalVoronoi": lambda: SphericalVoronoi(DIRECTIONS),
    "HullInsertion": lambda: HullInsertion(DIRECTIONS),
    "PointTable": lambda: PointTable(PLANE[:900], {f"column {k}": PLANE[:900, 0] for k in range(99)}),
    "Airports": data.airports,
    "Stars": data.stars,
    "Countries": lambda: data.countries("110m"),
    "Rivers": lambda: data.rivers("110m"),
    "Grid": lambda: Grid(np.arange(30), np.arange(30), {f"value {k}": np.ones((30, 30)) for k in range(99)}),
    "Raster": lambda: Raster(np.zeros((20, 40, 3), dtype=np.uint8)),
    "Weights": lambda: LinearInterpolator(PLANE, PLANE[:, 0]).weights(PLANE[:900]),
    "Relaxation": lambda: lloyd(PLANE[:900], bounds=(0, 0, 1, 1), steps=2),
    "Contour": lambda: contours(PlanarDelaunay(PLANE), PLANE[:, 0], levels=0.5)[0],
    "Film": lambda: film(900),
}


@pytest.mark.parametrize("name", EACH)
def test_a_repr_is_a_line(name):
    text = repr(EACH[name]())
    assert name in text
    assert len(text) < 600
    assert "\n" not in text


def test_fields_of_a_repr_in_their_order():
    table = PointTable([[1.0, 2.0]] * 9, {"name": np.array(["é"] * 9)})
    assert repr(table).startswith(
        "PointTable(places=(9, 2) float64, columns={'name': (9,) <U1}, rows=(9,) int64, surface="
    )
    assert repr(Globe(title="T")).startswith("Globe(latitude='spherical', layers=[Ground(…)], limb=Limb(…), ")
    assert "draw=test_fields" in repr(Film(test_fields_of_a_repr_in_their_order, [1, 2]))


@pytest.mark.parametrize("kind", [PlanarDelaunay, PlanarVoronoi, SphericalDelaunay, SphericalVoronoi])
def test_diagrams_are_drawn_up_to_a_number_of_points(kind):
    points = DIRECTIONS if kind.__name__.startswith("Spherical") else PLANE
    for count in (0, 1, 2, 3, 50):
        (text,) = mimes(kind(points[:count])).values()
        root = ET.fromstring(text)
        assert root.tag.endswith("svg")
        assert float(root.get("width")) <= 576
        found = "".join(path.get("d", "") for path in root.iter() if path.get("id", "").endswith("-sites"))
        assert found.count("M") == count if kind.surface.name == "plane" else found.count("M") <= count
    start = time.process_time()
    assert len(mimes(kind(points[:-1]))[SVG]) < MOST_SHOWN_BYTES
    assert time.process_time() - start < 8
    (said,) = mimes(kind(points)).values()
    assert said.endswith("points are more than 2000; `diagram_page` draws any number")


def test_long_pages_are_pixels_and_longer_ones_a_line(monkeypatch):
    walk = np.cumsum(np.random.default_rng(1).normal(size=(100_000, 2)), axis=0)
    box = tuple(np.stack([walk.min(axis=0), walk.max(axis=0)], axis=1).ravel().tolist())
    page = Page(box, (Polylines(walk, np.array([0, len(walk)]), (0.0, 0.0, 0.0, 1.0), 1.0),))
    data, sizes = page._repr_mimebundle_()
    png, shown = b64decode(data[PNG]), sizes[PNG]
    assert len(png) < MOST_SHOWN_BYTES
    assert max(shown.values()) <= 576
    assert png[16:24] == (2 * shown["width"]).to_bytes(4) + page.pixels_up(2 * shown["width"]).to_bytes(4)
    monkeypatch.setattr("stereodel._notebook.MOST_SHOWN_NUMBERS", 1000)
    assert "more than 1000 coordinates" in mimes(page)["text/plain"]
    globe = Globe()
    globe.add_lines([walk % 90])  # are not even laid out
    monkeypatch.setattr(Globe, "page", None)
    assert "more than 1000 coordinates" in mimes(globe)["text/plain"]


def test_a_table_has_its_first_and_last_rows():
    columns = {f"c{k}": PLANE[:1, 0].repeat(28298) for k in range(30)}
    table = PointTable(data.airports().lonlat, {"<b>": data.airports().name} | columns)
    text, numbers = mimes(table)["text/html"], [str(k) for k in range(1, len(table) + 1)]
    assert re.findall("<tr><td>(.*?)</td>", text) == [*numbers[:5], "…", *numbers[-5:]]
    assert text.count("<th>") == 20
    assert "<th>&lt;b&gt;</th>" in text
    assert f"{len(table)} rows × 34 columns" in text
    assert "…" not in mimes(PointTable([[1.5, 2.5]] * 10))["text/html"]
    assert "0 rows × 3 columns" in mimes(PointTable(np.zeros((0, 2))))["text/html"]


def test_grids_and_weights_are_tables_of_their_nodes_and_entries():
    grid = Grid([10.0, 11.0, 12.0], [5.0, 6.0], {"depth": [[1, 2, 3], [4, np.nan, 6]]})
    cells = re.findall("<td>(.*?)</td>", mimes(grid)["text/html"])
    assert cells == ["10", "5", "1", "11", "5", "2", "12", "5", "3", "10", "6", "4", "11", "6", "nan", "12", "6", "6"]
    weights = LinearInterpolator([[0, 0], [4, 0], [0, 4]], np.zeros(3)).weights([[9, 9], [1, 2]])
    rows = np.array(re.findall("<td>(.*?)</td>", mimes(weights)["text/html"]), dtype=float).reshape(-1, 3)
    assert sorted(rows.tolist()) == [[1, 0, 0.25], [1, 1, 0.25], [1, 2, 0.5]]
    assert len(mimes(Grid.regular(0.05))["text/html"]) < 2000  # 26 million nodes


def test_films_play_or_show_their_first_frame(monkeypatch):
    text = mimes(film())["text/html"]
    assert b64decode(re.search('video/mp4;base64,([^"]+)', text)[1])[4:8] == b"ftyp"
    for limit in ("MOST_FRAME_PIXELS", "MOST_SHOWN_SECONDS"):
        with monkeypatch.context() as less:
            less.setattr(f"stereodel._notebook.{limit}", 0)
            text = mimes(film())["text/html"]
        assert "The first of 3 frames, 0.3 s" in text
        assert "<video" not in text
    large = mimes(film(2, (1000, 1001)))["text/html"]
    assert 'width="576"' in large


def test_pictures_of_one_document_keep_their_names_apart():
    """VS Code puts all into one, so that a name used twice would give one the type or the light of another."""
    title = 'id="a" class="b" url(#c) <title desc">'  # text that looks like a name stays
    pages = []
    for radius, word in ((1.0, "one"), (2.0, "two")):
        scene = Scene(radius=radius)
        scene.add_label([0, 0, 0], word, always=True, size=30.0)
        pages.append(scene.page(View(0, 20), extent=(-2, 2, -2, 2)))
    texts = [mimes(page)[SVG] for page in [*pages, Page((0, 1, 0, 1), title=title, description=title)]]
    names = [re.findall(r'\sid="([^"]+)"', re.sub(">[^<]*<", "><", text)) for text in texts]
    families = [family for text in texts for family in re.findall("@font-face{font-family:'([^']+)'", text)]
    assert len(set(families)) == len(families) > 1
    assert len({name for each in names for name in each}) == sum(map(len, names)) > 6
    for text, known in zip(texts, names, strict=True):
        used = (
            re.findall(r'(?:="url\(|href=")#([^)"]+)', text)
            + " ".join(re.findall('labelledby="([^"]+)"', text)).split()
        )
        assert set(used) <= set(known)
        assert used
    assert [part.text for part in ET.fromstring(texts[2])][:2] == [title, title]


def test_where_what_draws_is_missing_a_line_says_so_and_a_terminal_is_not_made_to_wait():
    code = """
import sys
sys.modules["matplotlib"] = None
from stereodel import PlanarVoronoi
from stereodel.globe import Globe
for it in (Globe(), PlanarVoronoi([[0, 0], [1, 0], [0, 1]])):
    print(it._repr_mimebundle_())
del sys.modules["matplotlib"]
from IPython.core.interactiveshell import InteractiveShell
shell = InteractiveShell.instance()
print(*shell.display_formatter.format(it)[0])
shell.display_formatter.active_types = ["text/plain"]
print(*shell.display_formatter.format(it)[0])
"""
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    *missing, rich, plain = ran.stdout.splitlines()
    assert ["matplotlib is not installed; it comes with the extra 'draw'" in said for said in missing] == [True, True]
    assert (rich, plain) == ("image/svg+xml text/plain", "text/plain")
