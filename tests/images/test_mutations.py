"""The nets catch what they must in scripts: each small change of a figure fails T0 and T2, a moved label T0."""

import sys
from dataclasses import replace

import numpy as np
import pytest

from stereodel.drawing import View
from stereodel.drawing.page import Dots, Label, Page, Stroke
from tests.images.scripts import ROOT, STORE
from tools.baselines import Case
from tools.build import load_drawing
from tools.image import compare, read_picture

pytestmark = pytest.mark.images

FIGURES = ROOT / "figures"


def module(name):
    load_drawing(FIGURES / f"{name}.py")
    return sys.modules[name]


def case(name, page, geometry):
    return Case(name, page, geometry, "gl")


def caught_by_t0(mutant):
    return bool(STORE.drawn_otherwise(mutant))


def caught_by_t2(mutant):
    return not compare(read_picture(STORE.folder / f"{mutant.name}.png"), mutant.picture).passes


@pytest.fixture(scope="module")
def sphere():
    return module("fig01_sphere")


@pytest.fixture(scope="module")
def edges_seen(sphere):
    """The shortest edge of Figure 1 that is whole on the near side: the change that shows least."""
    g = sphere.geometry()
    ends = g["sites"][g["edges"]]
    depth = sphere.VIEW.depth(ends).min(axis=1)
    length = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)
    return g, int(np.argmin(np.where(depth > 0.3, length, np.inf)))


def test_unchanged_figures_pass(sphere):
    g = sphere.geometry()
    same = case("fig01_sphere", sphere.draw(g), g)
    assert STORE.drawn_otherwise(same) == []
    assert STORE.looks_otherwise(same) == []
    assert not caught_by_t2(same)


def test_a_missing_edge(sphere, edges_seen):
    g, shortest = edges_seen
    without = {**g, "edges": np.delete(g["edges"], shortest, axis=0)}
    mutant = case("fig01_sphere", sphere.draw(without), g)
    assert caught_by_t0(mutant)
    assert caught_by_t2(mutant)


def test_another_magnification():
    figure = module("fig11_fisheye4")
    panels = replace(figure.PANELS, magnification=4.05)
    geometry = panels.geometry()
    mutant = case("fig11_fisheye4", panels.draw(geometry), figure.PANELS.geometry())
    assert caught_by_t0(mutant)
    assert caught_by_t2(mutant)
    assert caught_by_t0(case("fig11_fisheye4", figure.PANELS.draw(figure.PANELS.geometry()), geometry))


def test_a_missing_site(sphere):
    """The one nearest to the viewer."""
    g = sphere.geometry()
    nearest = int(np.argmax(sphere.VIEW.depth(g["sites"])))
    page = sphere.draw(g)
    dots = {id(item) for item in page.items if isinstance(item, Dots) and len(item.centers) > 1}
    at = sphere.VIEW.project(g["sites"][nearest])
    items = [replace(i, centers=without(i.centers, at)) if id(i) in dots else i for i in page.items]
    mutant = case("fig01_sphere", replace(page, items=tuple(items)), g)
    assert caught_by_t0(mutant)
    assert caught_by_t2(mutant)


def without(centers, place):
    return np.delete(centers, np.argmin(np.linalg.norm(centers - place, axis=1)), axis=0)


@pytest.mark.parametrize("role", ["delaunay", "voronoi", "limb"])
def test_lines_a_tenth_wider(sphere, role):
    g = sphere.geometry()
    items = [
        replace(i, width=1.1 * i.width) if isinstance(i, Stroke) and i.name == role else i for i in sphere.draw(g).items
    ]
    mutant = case("fig01_sphere", replace(sphere.draw(g), items=tuple(items)), g)
    assert caught_by_t0(mutant)
    assert caught_by_t2(mutant)


@pytest.mark.parametrize("turn", [(0.3, 0.0, 0.0), (0.0, 0.3, 0.0), (0.0, -0.3, 0.0), (0.0, 0.0, 0.3)])
def test_a_view_turned_a_little(sphere, monkeypatch, turn):
    g, view = sphere.geometry(), sphere.VIEW
    monkeypatch.setattr(sphere, "VIEW", View(*np.add((view.lon, view.lat, view.roll), turn)))
    mutant = case("fig01_sphere", sphere.draw(g), g)
    assert caught_by_t0(mutant)
    assert caught_by_t2(mutant)


def recoloured(page: Page, role: str, color) -> Page:
    items = [replace(i, color=color) if isinstance(i, Stroke) and i.name == role else i for i in page.items]
    return replace(page, items=tuple(items))


@pytest.mark.parametrize("role", ["delaunay", "voronoi", "limb"])
def test_another_colour(sphere, role):
    g = sphere.geometry()
    page = sphere.draw(g)
    (color, *_) = [item.color for item in page.items if item.name == role]
    # Two levels of 255, which nobody sees.
    mutant = case("fig01_sphere", recoloured(page, role, (*color[:2], color[2] + 2 / 255, color[3])), g)
    assert caught_by_t0(mutant)
    assert caught_by_t2(mutant)


def test_a_moved_label():
    figure = module("fig03_bubbles")
    g = figure.geometry()
    page = figure.draw(g)
    for at, item in enumerate(page.items):
        if isinstance(item, Label):
            moved = replace(item, offset=(item.offset[0] + 0.5, item.offset[1]))
            mutant = case("fig03_bubbles", replace(page, items=(*page.items[:at], moved, *page.items[at + 1 :])), g)
            assert caught_by_t0(mutant)
            assert STORE.looks_otherwise(mutant) == []
    assert page.labels


def test_another_order_of_drawing(sphere):
    g = sphere.geometry()
    page = sphere.draw(g)
    mutant = case("fig01_sphere", replace(page, items=page.items[::-1]), g)
    assert caught_by_t0(mutant)
    assert caught_by_t2(mutant)


def test_rounding_passes(sphere):
    g = sphere.geometry()
    page = sphere.draw(g)
    shifted = [replace(i, path=i.path + 4e-16) if isinstance(i, Stroke) else i for i in page.items]
    same = case("fig01_sphere", replace(page, items=tuple(shifted)), g)
    assert STORE.drawn_otherwise(same) == []
    assert STORE.looks_otherwise(same) == []
