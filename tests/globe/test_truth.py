"""Pictures say what is so: renderers agree by layer and view, places of the disc lie in what is drawn there, slivers.

The oracle is `tests/globe/truth.py`. The files are shown by programs of others: SVG by librsvg, PDF by PDFium.
"""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from stereodel import MoebiusMap, data, fisheye
from stereodel.curves.chart import Chart
from stereodel.curves.clip import signed_areas
from stereodel.curves.fill import triangles
from stereodel.curves.ragged import Ragged
from stereodel.drawing import LineStyle, StereographicView, View
from stereodel.drawing.page import Polygons
from stereodel.globe import Globe
from stereodel.globe.outlines_on_sphere import SphereLines, SphereRegions
from stereodel.mpl.transforms import LonLatToPage
from tests.globe import truth
from tests.images.foreign import by_pdfium
from tests.render.test_librsvg import in_blocks, shown
from tests.tiers import by_day

SIZE, BLOCK = 320, 64
BOXES = [[[(w, s), (e, s), (e, n), (w, n)]] for w, s, e, n in ((0, 0, 90, 50), (90, -40, 180, 0), (-90, -60, -60, 60))]
LAYERS = {
    "land": lambda globe, size: globe.add_land(resolution=size, color="black"),
    "ocean": lambda globe, size: globe.add_ocean(resolution=size, color="black"),
    "coastlines": lambda globe, size: globe.add_coastlines(resolution=size, style=LineStyle("black", 1.0)),
    "borders": lambda globe, size: globe.add_borders(resolution=size, style=LineStyle("black", 1.0)),
    "rivers": lambda globe, size: globe.add_rivers(resolution=size, style=LineStyle("black", 1.0)),
    "lakes": lambda globe, size: globe.add_lakes(resolution=size, color="black"),
    "graticule": lambda globe, _: globe.add_graticule(15, style=LineStyle("black", 1.0)),
    "polygons": lambda globe, _: globe.add_polygons(BOXES, color="black", outline=None),
}
VIEWS = [View(90, 0), View(-90, 0), View(0, 90), View(0, 0), View(0, -90), View(180, 0), View(135, -25)]
VIEWS += [StereographicView(90, 0, angular_radius=90), StereographicView(-60, 30, angular_radius=150)]


def globe_of(layer, resolution="110m"):
    globe = Globe(ocean="white", limb=LineStyle("white", 0.1))
    LAYERS[layer](globe, resolution)
    return globe


@pytest.mark.parametrize(
    ("layer", "view"),
    by_day(list(product(LAYERS, VIEWS)), ("ocean", VIEWS[3]), ("land", VIEWS[0]), ("polygons", VIEWS[5])),
)
def test_renderers_show_the_same(tmp_path, layer, view):
    """With holes of the first corner's shell, Africa was sea in OpenGL; by chords, the Indian Ocean was land."""
    resolution = "50m" if layer in ("land", "ocean") else "110m"
    page = globe_of(layer, resolution).page(None, view, width=200)
    # Agg does not shade balls.
    page = replace(page, items=tuple(replace(i, ball=None) if getattr(i, "ball", None) else i for i in page.items))
    ours, agg = (page.pixels(size=SIZE, renderer=name, text=False).astype(float) for name in ("gl", "agg"))
    pdf = by_pdfium(page.save(tmp_path / "page.pdf", text=False), ours.shape, 72 * SIZE / page.width)
    for other in (agg, shown(page.save(tmp_path / "page.svg", text=False), SIZE)[:SIZE], pdf):
        off = np.abs(in_blocks(ours, BLOCK) - in_blocks(other.astype(float), BLOCK)).max()
        assert off < 6, (layer, view, resolution, off)


def covered(page, xy):
    """Which places of a disc the polygons of a page cover, by their triangles as OpenGL draws them."""
    found = np.zeros(len(xy), dtype=bool)
    middle = np.array(page.extent[1::2]) / 2
    for item in page.items:
        if isinstance(item, Polygons):
            (a, b, c) = triangles(item.loops, item.owner)[0].swapaxes(0, 1)
            for k, p in enumerate(xy + middle):
                u, v, w = (
                    (q - o)[:, 0] * (p - o)[:, 1] - (q - o)[:, 1] * (p - o)[:, 0] for o, q in ((a, b), (b, c), (c, a))
                )
                found[k] |= bool(((u >= 0) & (v >= 0) & (w >= 0) | (u <= 0) & (v <= 0) & (w <= 0)).any())
    return found


def assert_places_are_true(rng, layer, sources):
    """Places whose surroundings, a pixel of a picture a thousand across, lie on one side of the source's borders."""
    focus, size = (float(rng.uniform(-180, 180)), float(rng.uniform(-85, 85))), float(10 ** rng.uniform(-0.5, 1.5))
    place = float(rng.uniform(-180, 180)), float(rng.uniform(-85, 85))
    if rng.random() < 0.3:
        place = float(rng.choice([-90, 0, 90, 180])), float(rng.choice([-90, 0, 90]))
        size = 1.0
    view = View(*place) if rng.random() < 0.5 else StereographicView(*place, angular_radius=float(rng.uniform(20, 150)))
    assert_true_at(rng, layer, sources, focus, size, view)


def assert_true_at(rng, layer, sources, focus, size, view, resolution="110m"):
    page = globe_of(layer, resolution).page(fisheye(focus, magnification=size), view)
    angle, far = rng.uniform(0, 2 * np.pi, 40), 0.995 * np.sqrt(rng.uniform(0, 1, 40))
    xy = np.stack([far * np.cos(angle), far * np.sin(angle)], axis=1)
    near = [xy + 2e-3 * np.array(step) for step in ((0, 0), (1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (-1, -1))]
    answers = [truth.inside(sources, truth.degrees(truth.before(focus, size, truth.raised(view, p)))) for p in near]
    clear = np.all(answers, axis=0) | ~np.any(answers, axis=0)
    wanted = answers[0] != (layer == "ocean")
    wrong = clear & (covered(page, xy) != wanted)
    assert not wrong.any(), (layer, focus, size, view, xy[wrong])


SOURCES = {"land": lambda: data.land("110m").polygons(), "polygons": lambda: BOXES}
SOURCES["ocean"] = SOURCES["land"]


@pytest.mark.parametrize("layer", SOURCES)
@pytest.mark.parametrize("seeds", by_day([range(3), range(3, 100)], range(3)))
def test_places_lie_in_what_is_drawn(layer, seeds):
    for seed in seeds:
        assert_places_are_true(np.random.default_rng(seed), layer, SOURCES[layer]())


@pytest.mark.parametrize("lon", by_day([90, 90 + 1e-9], 90))
def test_the_limb_may_be_the_meridian_of_the_cut(lon):
    """Two islands of a few kilometres, with sides on the limb, had all the disc be land."""
    sources = data.land("50m").polygons()
    assert_true_at(np.random.default_rng(4), "land", sources, (0.0, 0.0), 1.0, View(lon, 0), "50m")


def test_coincident_sides_cross_the_rim_at_one_place():
    """The sea's two sides along the 180th meridian: where rounding put one after the other, all the disc was sea."""
    assert_places_are_true(np.random.default_rng(22), "ocean", SOURCES["ocean"]())


SIGHTS = [
    (MoebiusMap.identity(), View(20, 20)),
    (MoebiusMap.identity(), View(90, 0)),
    (MoebiusMap.identity(), StereographicView(10, 10, angular_radius=150)),
    (fisheye((20, 30), magnification=6.0), View(20, 30)),
    (fisheye((0, 20), magnification=2.0), View(0, 20)),
    (fisheye((20, 30), magnification=0.1), View(-150, -20)),
]


@pytest.mark.parametrize("count", by_day([200, 10_000], 200))
@pytest.mark.parametrize("sight", SIGHTS)
def test_slivers(sight, count):
    """In globes and in axes of matplotlib they are thin; and all the rest of the sphere is the disc."""
    rings, (lens, view), owner = truth.slivers(np.random.default_rng(1), count), sight, np.arange(count)
    regions = SphereRegions.of_lonlat([[ring] for ring in rings])
    sides = Ragged(~regions.rings.values[::-1], regions.rings.offsets[-1] - regions.rings.offsets[::-1])
    rest = SphereRegions(regions.edges, sides, regions.owner[::-1], regions.everywhere)
    closed = Ragged.of([np.concatenate([ring, ring[:1]]) for ring in rings])
    chart = Chart(lens, view)
    drawn = [regions.on(chart), LonLatToPage(lens, view, "straight").regions(closed, owner, count)]
    for (loops, region), wanted in [*((found, 0.0) for found in drawn), (rest.on(chart), np.pi)]:
        area = np.bincount(region, signed_areas(loops)[0], minlength=count)
        assert np.flatnonzero(np.abs(area - wanted) > 0.5).tolist() == [], (lens.magnification, view)


def chord(a, b):
    """Length of the part of a segment in the unit disc."""
    way = b - a
    size = np.hypot(*way)
    middle = -(a @ way) / size
    half = np.sqrt(max(0.0, 1 - (a @ a - middle**2)))
    return max(0.0, min(size, middle + half) - max(0.0, middle - half))


@pytest.mark.parametrize("magnification", [1.0, 1e3])
@pytest.mark.parametrize("radius", [1e-3, 1e-5, 1e-6])
@pytest.mark.parametrize("seed", by_day(range(3), 0))
def test_tiny_caps_show_what_lies_in_them(radius, magnification, seed):
    """Such a cap is flat. By cosines, two radii of 1e-6 degrees beyond the rim were within it."""
    rng = np.random.default_rng(seed)
    focus = float(rng.uniform(-180, 180)), float(rng.uniform(-75, 75))
    chart = Chart(fisheye(focus, magnification=magnification), StereographicView(*focus, angular_radius=radius))
    off = chart.tolerance

    def places(xy):
        return truth.before(focus, magnification, truth.raised(chart.view, xy))

    xy = rng.uniform(-1.5, 1.5, (300, 2))
    found, seen = chart.points(places(xy))
    far = np.hypot(*xy.T)
    np.testing.assert_allclose(found, xy, atol=off)
    np.testing.assert_array_equal(seen[np.abs(far - 1) > off], far[np.abs(far - 1) > off] < 1)
    for start, end, third in rng.uniform(-2, 2, (30, 3, 2)):
        lines, _ = SphereLines.great(places(start[None]), places(end[None])).on(chart)
        assert np.hypot(*lines.values.T).max(initial=0) < 1 + off
        length = sum(np.hypot(*np.diff(line, axis=0).T).sum() for line in lines)
        assert length == pytest.approx(chord(start, end), abs=2 * np.sqrt(2 * off))
        corners = np.array([start, end, third])
        loops, _ = SphereRegions.of_lonlat([[truth.degrees(places(corners))]]).on(chart)
        assert np.hypot(*loops.values.T).max(initial=0) < 1 + off
        inner = xy[far < 1 - 10 * off]
        near = [inner + 10 * off * np.array(step) for step in ((0, 0), (1, 0), (-1, 0), (0, 1), (0, -1))]
        answers = [truth.inside([[corners]], place) for place in near]
        clear = np.all(answers, axis=0) | ~np.any(answers, axis=0)
        drawn = truth.inside([list(loops)], inner) if len(loops) else np.zeros(len(inner), dtype=bool)
        np.testing.assert_array_equal(drawn[clear], answers[0][clear])
