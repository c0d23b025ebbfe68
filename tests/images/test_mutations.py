"""The nets catch what they must in scripts: each small change of a figure fails T0 and T2, a moved label T0."""

import sys
from dataclasses import replace

import numpy as np
import pytest

from stereodel.drawing import View
from stereodel.drawing.page import Label, Page, Stroke
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


@pytest.mark.parametrize(("lon", "lat"), [(20.5, 25), (20, 25.5), (20, 24.5)])
def test_a_view_turned_by_half_a_degree(sphere, monkeypatch, lon, lat):
    g = sphere.geometry()
    monkeypatch.setattr(sphere, "VIEW", View(lon, lat))
    mutant = case("fig01_sphere", sphere.draw(g), g)
    assert caught_by_t0(mutant)
    assert caught_by_t2(mutant)


def recoloured(page: Page, role: str, color) -> Page:
    items = [replace(i, color=color) if isinstance(i, Stroke) and i.name == role else i for i in page.items]
    return replace(page, items=tuple(items))


@pytest.mark.parametrize("role", ["delaunay", "voronoi", "limb"])
def test_another_colour(sphere, role):
    g = sphere.geometry()
    mutant = case("fig01_sphere", recoloured(sphere.draw(g), role, (0.3, 0.2, 0.2, 1.0)), g)
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
