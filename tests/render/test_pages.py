"""Pages through OpenGL: exact colours, order, widths, agreement with the same page through Agg, and the light of balls.

In vector files a gradient stands for that light: near to that of pixels, which is the shader's.
"""

import re
from functools import partial
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from stereodel import render as rendering
from stereodel.drawing.page import Ball, Dots, Fill, Page, Polylines, Stroke
from stereodel.render.vector import paper

render, rasterize = Page.pixels, partial(Page.pixels, renderer="agg")


BLACK = (0.0, 0.0, 0.0, 1.0)
EXTENT = (0.0, 4.0, 0.0, 2.0)
SHADER = (Path(rendering.__file__).parent / "shaders" / "flat.frag").read_text(encoding="utf-8")
LIGHT = np.array([float(n) for n in re.search(r"LIGHT = normalize\(vec3\(([^)]*)\)\)", SHADER)[1].split(",")])
LIGHT /= np.linalg.norm(LIGHT)
SHADE = float(re.search(r"SHADE = ([\d.]+);", SHADER)[1])


def brightness(x, y):
    """Factor on the colour of pixels at a place of the unit disc."""
    normal = np.stack([x, y, np.sqrt(np.maximum(0.0, 1 - x**2 - y**2))], axis=-1)
    return 1 - SHADE * ((1 - normal @ LIGHT) / 2) ** 2


def lines(*points):
    ends = np.array(points, dtype=float)
    a, b = ends[:-1], ends[1:]
    return np.stack([a, a + (b - a) / 3, a + 2 * (b - a) / 3, b], axis=1)


def circle(center, radius):
    t = np.arange(9) * np.pi / 4
    ends = np.stack([np.cos(t), np.sin(t)], axis=1)
    reach = 4 / 3 * np.tan(np.pi / 16) * np.stack([-ends[:, 1], ends[:, 0]], axis=1)
    return center + radius * np.stack([ends[:-1], ends[:-1] + reach[:-1], ends[1:] - reach[1:], ends[1:]], axis=1)


def box(left, right, bottom, top):
    return lines((left, bottom), (right, bottom), (right, top), (left, top), (left, bottom))


def test_an_empty_page_is_its_ground_laid_over_white():
    assert (render(Page(EXTENT, background=(0.0, 0.0, 0.0, 0.5)), size=10) == 128).all()
    assert (render(Page(EXTENT, background=(0.0, 0.0, 1.0, 1.0)), size=20) == [0, 0, 255]).all()


@pytest.mark.parametrize("width", [0.3, 1.0, 4.0])
@pytest.mark.parametrize("end", [(3.9, 0.1), (3.9, 1.9), (0.1, 1.9)])
def test_ink_is_width_times_length_whatever_the_direction(width, end):
    page = Page(EXTENT, (Stroke(lines((0.1, 0.1), end), BLACK, width, cap="butt"),), width=400.0)
    picture = render(page, size=800)
    length = np.hypot(end[0] - 0.1, end[1] - 0.1) * 200
    ink = (255 - picture[..., 0].astype(float)).sum() / 255
    # Eight rows of samples in a pixel: a level line has its width to an eighth, a sloping one far better.
    assert ink / length == pytest.approx(2 * width, abs=0.03 * width if end == (3.9, 1.9) else 0.125)


def test_opengl_and_agg_draw_the_same():
    """Something of everything, as a figure has it."""
    items = (
        Fill((circle((1.0, 1.0), 0.9), circle((1.0, 1.0), 0.4)), (0.2, 0.5, 0.8, 1.0)),
        Fill((box(2.2, 3.8, 0.3, 1.7),), (0.9, 0.6, 0.1, 0.4)),
        Stroke(lines((0.2, 0.2), (1.8, 0.3), (0.3, 0.5), (1.9, 1.6)), (0.0, 0.0, 0.0, 0.5), 5.0),
        Stroke(circle((3.0, 1.0), 0.9), (0.0, 0.5, 0.0, 1.0), 1.0, dash=(6.0, 3.0), cap="butt"),
        Stroke(circle((3.0, 1.0), 0.5), BLACK, 0.6, closed=True),
        Dots(np.array([[0.5, 1.5], [2.0, 1.0], [2.05, 1.02]]), 4.0, (0.8, 0.0, 0.0, 1.0), rim_width=1.0),
    )
    ours, agg = (draw(Page(EXTENT, items), size=800, text=False).astype(float) for draw in (render, rasterize))
    # They agree inside shapes exactly, and along edges up to antialiasing.
    different = np.abs(ours - agg).max(axis=-1)
    assert (different > 96).mean() < 2e-4
    assert (different > 1).mean() < 0.08
    assert np.abs(ours.mean(axis=(0, 1)) - agg.mean(axis=(0, 1))).max() < 0.3


@pytest.mark.parametrize("draw", [render, rasterize])
@pytest.mark.parametrize("width", [0.5, 1.0, 2.0])
def test_dashes_are_in_points_whatever_the_width(draw, width):
    page = Page(EXTENT, (Stroke(lines((0.0, 1.0), (4.0, 1.0)), BLACK, width, dash=(6.0, 4.0), cap="butt"),), width=50.0)
    inked = draw(page, size=500)[125, :, 0] < 128
    assert np.array_equal(inked, np.arange(500) % 100 < 60)


def test_rim_and_disc_part_a_dot_between_them():
    dot = Dots(np.array([[2.0, 1.0]]), 20.0, (1.0, 0.0, 0.0, 0.5), rim=BLACK, rim_width=5.0)
    picture = render(Page(EXTENT, (dot,), width=200.0), size=200)
    assert picture[50, 100] == pytest.approx([255, 127, 127], abs=1)
    assert picture[50, 100 + 17].tolist() == [0, 0, 0]
    assert picture[50, 100 + 22].tolist() == [255, 255, 255]


@pytest.mark.parametrize("shape", ["a disc", "a rectangle", "needles"])
def test_the_light_of_a_ball_is_that_of_its_normals(shape):
    """Whatever shows it; what is not lit stays as it is, whatever is drawn with it."""
    color = (0.9, 0.3, 0.55, 1.0)
    ball = Ball((1.7, 0.9), 0.8)
    cuts = np.linspace(0, 4, 401)
    paths = {
        "a disc": [circle(ball.center, 0.8)],
        "a rectangle": [box(0, 4, 0, 2)],
        "needles": [box(a, b, 0, 2) for a, b in pairwise(cuts)],
    }[shape]
    plain = Fill((box(3.5, 4, 0, 2),), (0.5, 0.5, 0.5, 1.0))
    picture = render(Page(EXTENT, (*(Fill((path,), color, ball=ball) for path in paths), plain)), size=401)
    assert (picture[:, 360:] == 128).all()
    height, width = picture.shape[:2]
    x, y = np.meshgrid((np.arange(width) + 0.5) * 4 / width, 2 - (np.arange(height) + 0.5) * 2 / height)
    x, y = (x - ball.center[0]) / ball.radius, (y - ball.center[1]) / ball.radius
    inside = x**2 + y**2 < 0.97
    exact = 255 * np.array(color[:3]) * brightness(x, y)[..., None]
    # Four samples are rounded, and so is their mean.
    apart = (picture - exact)[inside]
    assert np.abs(apart).max() < 1
    assert np.abs(apart.mean(axis=0)).max() < 0.2


@pytest.mark.parametrize("radius", [0.05, 0.5, 1.0, 3.0])
def test_closed_lines_smaller_than_their_width_are_not_hollow(radius):
    path = circle(np.array([20.0, 20.0]), radius)
    points = np.concatenate([path[:, 0], path[:1, 0]])
    line = Polylines(points, np.array([0, len(points)]), BLACK, 10.0, "coast")
    for item in (line, Stroke(path, BLACK, 10.0, closed=True)):
        page = Page((0.0, 40.0, 0.0, 40.0), (item,), width=40.0)
        ink = [np.sum(255 - draw(page, size=40).astype(float)) / 765 for draw in (render, rasterize)]
        np.testing.assert_allclose(ink[1], ink[0], rtol=0.05)
        assert ink[0] >= 0.98 * np.pi * 5**2


def disc(size):
    """Middles of pixels in the unit disc; x right, y up."""
    x, y = np.meshgrid(*2 * [(np.arange(size) + 0.5) * 2 / size - 1])
    inside = x**2 + y**2 < 1
    return x[inside], -y[inside], inside


def gradient_level(x, y):
    """What the gradient shows at places of the disc: of the circles through each the largest, by its equation."""
    place = np.stack([x, y], axis=-1) - paper.FOCUS
    step = np.subtract(paper.CENTER, paper.FOCUS)
    a, b, c = step @ step - paper.RADIUS**2, place @ step, (place**2).sum(axis=-1)
    share = (b - np.sqrt(b**2 - a * c)) / a
    assert np.abs(np.linalg.norm(place - share[:, None] * step, axis=1) - share * paper.RADIUS).max() < 1e-9
    return np.interp(share, paper.OFFSETS, paper.BRIGHTNESS)


def test_the_gradient_of_files_is_near_to_the_light_of_pixels():
    """In levels of 1/255 of white: 0.8 in the mean and 4 at most, at the edge; flat, it would be 7 and 57."""
    x, y, _ = disc(300)
    apart = 255 * np.abs(gradient_level(x, y) - brightness(x, y))
    assert apart.mean() < 0.9
    assert apart.max() < 4.1
    assert 255 * (1 - brightness(x, y)).mean() > 7
