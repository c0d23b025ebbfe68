"""The nets catch what they must in the renderers: pages stay as they are, and what draws them is changed a little."""

from dataclasses import replace

import numpy as np
import pytest

from stereodel.drawing.page import Fill, Label, Polygons, Polylines, Stroke
from stereodel.render import canvas, rows, svg, triangles
from stereodel.render import pdf as pdf_files
from stereodel.render import rows as labels
from stereodel.render.triangles import discs, ribbon, ribbons
from tests.images.scripts import STORE, case
from tests.images.test_vector_files import wrong_in_files
from tools.baselines import SIZE


def nets(name):
    """Which of the nets find anything, by the first word of what they say; T0 sees pages alone."""
    drawn = replace(case(name))
    assert STORE.drawn_otherwise(drawn) == []
    return {message.split(":")[0] for message in STORE.otherwise(drawn)}


def paler(color):
    """Two levels lighter, or darker where it is white."""
    return (*(value + 2 / 255 if value < 0.99 else value - 2 / 255 for value in color[:3]), color[3])


def with_items(change):
    """A change of pages, item by item."""
    return lambda page: replace(page, items=tuple(change(item) for item in page.items))


def of(kinds, change):
    """A change of some fields of all items of some kinds, each a function of the item."""
    return with_items(lambda item: replace(item, **change(item)) if isinstance(item, kinds) else item)


def with_lines(role, change):
    """A change of the lines of a page that have a role."""
    return with_items(lambda item: change(item) if isinstance(item, Stroke | Polylines) and item.name == role else item)


def before(function, change):
    """A function of a page that draws it changed."""
    return lambda page, *options, **named: function(change(page), *options, **named)


@pytest.mark.parametrize(
    "name", ["fig03_bubbles", "fig08_hemisphere", "globe_europe", "fig09_scale", "anim_flight_first"]
)
def test_without_a_change_all_nets_are_empty(name):
    assert nets(name) == set()


@pytest.mark.parametrize("name", ["fig08_hemisphere", "globe_europe"])
def test_lines_a_tenth_wider_in_opengl(name, monkeypatch):
    monkeypatch.setattr(triangles, "ribbon", lambda points, width, **named: ribbon(points, 1.1 * width, **named))
    monkeypatch.setattr(triangles, "ribbons", lambda points, offsets, width: ribbons(points, offsets, 1.1 * width))
    assert nets(name) == {"T2"}


@pytest.mark.parametrize("name", ["fig09_scale", "fig06_sphere_size"])
def test_lines_a_tenth_wider_in_agg(name, monkeypatch):
    patch = canvas.PathPatch
    monkeypatch.setattr(canvas, "PathPatch", lambda *a, linewidth, **k: patch(*a, linewidth=1.1 * linewidth, **k))
    assert nets(name) == {"T2"}


@pytest.mark.parametrize("name", ["fig08_hemisphere", "globe_europe"])
def test_one_site_missing_in_opengl(name, monkeypatch):
    monkeypatch.setattr(triangles, "discs", lambda centers, radius: discs(centers[1:], radius))
    assert nets(name) == {"T2"}


@pytest.mark.parametrize(
    ("name", "role"),
    [
        *(("fig08_hemisphere", role) for role in ("delaunay", "voronoi", "chord", "limb", "plane")),
        *(("globe_europe", role) for role in ("borders", "limb")),
        *(("fig10_earth", role) for role in ("graticule", "fine")),
    ],
)
def test_lines_of_one_style_two_levels_paler_in_opengl(name, role, monkeypatch):
    """The thinnest, of a quarter of a point and see-through, cover less than a hundredth of their picture."""
    change = with_lines(role, lambda line: replace(line, color=paler(line.color)))
    monkeypatch.setattr(rows, "triangulate", before(rows.triangulate, change))
    assert nets(name) == {"T2"}


@pytest.mark.parametrize("role", ["axis", "construction", "ray", "frame"])
def test_lines_of_one_style_two_levels_paler_in_agg(role, monkeypatch):
    change = with_lines(role, lambda line: replace(line, color=paler(line.color)))
    monkeypatch.setattr(rows, "drawn", before(rows.drawn, change))
    assert nets("fig09_scale") == {"T2"}


def aside(page):
    """All labels two pixels of the stored picture to the right."""
    return with_items(lambda item: moved(item, page.width) if isinstance(item, Label) else item)(page)


def moved(label, width):
    return replace(label, offset=(label.offset[0] + 2 * width / SIZE, label.offset[1]))


def test_labels_two_pixels_aside_in_pictures(monkeypatch, tmp_path):
    monkeypatch.setattr(labels, "drawn", before(labels.drawn, aside))
    name = "fig03_bubbles"
    assert nets(name) == {"T3"}
    # The files stay as they were, so they differ from the picture too.
    wrong = wrong_in_files(case(name).page, replace(case(name)).ink, tmp_path)
    assert wrong
    assert all(message.startswith("svg: ") and "elsewhere" in message for message in wrong)


TYPE_CHANGES = {
    "paler": lambda label: {"color": paler(label.color)},
    "a fiftieth more see-through": lambda label: {"color": (*label.color[:3], 0.98)},
    "a twentieth larger": lambda label: {"size": 1.05 * label.size},
    "without halo": lambda label: {"halo": 0.0},
    "with another halo": lambda label: {"halo_color": paler(label.halo_color)},
    "half a pixel aside": lambda label: {"offset": (label.offset[0] + 0.15, label.offset[1])},
}


@pytest.mark.parametrize("change", TYPE_CHANGES)
def test_type_that_is_set_otherwise_in_pictures(change, monkeypatch):
    monkeypatch.setattr(labels, "drawn", before(labels.drawn, of(Label, TYPE_CHANGES[change])))
    assert nets("anim_flight_first") == {"T3"}


def test_labels_two_pixels_aside_everywhere(monkeypatch):
    name, draw = "fig03_bubbles", canvas._draw_label
    monkeypatch.setattr(canvas, "_draw_label", lambda axes, label: draw(axes, moved(label, case(name).page.width)))
    assert nets(name) == {"T3"}


def test_rows_of_labels_that_slip(monkeypatch):
    draw = labels.LabelLayer._drawn
    monkeypatch.setattr(
        labels.LabelLayer, "_drawn", lambda self, *span: np.roll(draw(self, *span), self.width // 300, 0)
    )
    assert nets("fig03_bubbles") == {"T3"}


FILE_CHANGES = {
    "polygons red": of(Polygons, lambda item: {"colors": 0 * item.colors + [1.0, 0.0, 0.0, 1.0]}),
    "lines twice as wide": of(Polylines, lambda item: {"width": 2 * item.width}),
    "type a twentieth larger": of(Label, lambda item: {"size": 1.05 * item.size}),
    "labels two pixels aside": aside,
    "fills two levels paler": of(Fill, lambda item: {"color": paler(item.color)}),
    "polygons two levels paler": of(Polygons, lambda item: {"colors": np.array([paler(c) for c in item.colors])}),
    "lines two levels paler": of(Stroke | Polylines, lambda item: {"color": paler(item.color)}),
    "lines a tenth wider": of(Stroke, lambda item: {"width": 1.1 * item.width}),
}


@pytest.mark.parametrize("change", FILE_CHANGES)
@pytest.mark.parametrize("kind", ["svg", "pdf"])
def test_files_that_are_drawn_otherwise(kind, change, monkeypatch, tmp_path):
    """One of the two files; the picture stays as it was."""
    module = {"svg": svg, "pdf": pdf_files}[kind]
    monkeypatch.setattr(module, "_Sheet", before(module._Sheet, FILE_CHANGES[change]))
    name = "anim_flight_first"
    wrong = wrong_in_files(case(name).page, case(name).ink, tmp_path)
    assert wrong
    # The type of the PDF is compared with that of the SVG, so where that is wrong both are named, it first.
    assert wrong[0].startswith(kind)
    assert nets(name) == set()
