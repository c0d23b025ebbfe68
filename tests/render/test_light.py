"""The gradient that stands for the light of a ball in vector files: near to that of pixels, which is the shader's."""

import re
from pathlib import Path

import numpy as np
import pytest

from stereodel import render
from stereodel.drawing.page import Ball, Fill, Page
from stereodel.render.light import LIGHT, SHADE, ball_gradient, brightness
from tests.render.test_pages import circle

SHADER = (Path(render.__file__).parent / "shaders" / "flat.frag").read_text(encoding="utf-8")


def disc(size):
    """Middles of pixels in the unit disc; x right, y up."""
    x, y = np.meshgrid(*2 * [(np.arange(size) + 0.5) * 2 / size - 1])
    inside = x**2 + y**2 < 1
    return x[inside], -y[inside], inside


def gradient_level(x, y):
    """What the gradient shows at places of the disc: of the circles through each the largest, by its equation."""
    light = ball_gradient()
    place = np.stack([x, y], axis=-1) - light.focus
    step = np.subtract(light.center, light.focus)
    a, b, c = step @ step - light.radius**2, place @ step, (place**2).sum(axis=-1)
    share = (b - np.sqrt(b**2 - a * c)) / a
    assert np.abs(np.linalg.norm(place - share[:, None] * step, axis=1) - share * light.radius).max() < 1e-9
    return np.interp(share, light.offsets, light.brightness)


def test_the_light_is_that_of_the_shader():
    direction = [float(n) for n in re.search(r"LIGHT = normalize\(vec3\(([^)]*)\)\)", SHADER)[1].split(",")]
    assert pytest.approx(direction / np.linalg.norm(direction), abs=1e-15) == LIGHT
    assert float(re.search(r"SHADE = ([\d.]+);", SHADER)[1]) == SHADE


def test_the_gradient_of_files_is_near_to_the_light_of_pixels():
    """In levels of 1/255 of white: 0.8 in the mean and 4 at most, at the edge; flat, it would be 7 and 57."""
    x, y, inside = disc(300)
    apart = 255 * np.abs(gradient_level(x, y) - brightness(x, y))
    assert apart.mean() < 0.9
    assert apart.max() < 4.1
    assert 255 * (1 - brightness(x, y)).mean() > 7
    # The pixels themselves, with their edge left out: there they are mixed with the ground.
    ball = Ball((1.0, 1.0), 0.9)
    page = Page((0.0, 2.0, 0.0, 2.0), (Fill((circle(ball.center, 0.9),), (1.0, 1.0, 1.0, 1.0), ball=ball),))
    side = page.pixels(size=1000)[50:950:3, 50:950:3, 0]
    assert np.abs(side[inside] - 255 * brightness(x, y))[x**2 + y**2 < 0.98].max() < 2


def test_offsets_grow_and_the_lit_place_is_bright():
    gradient = ball_gradient()
    assert (gradient.offsets[0], gradient.offsets[-1]) == (0.0, 1.0)
    assert (np.diff(gradient.offsets) > 0).all()
    assert (np.diff(gradient.brightness) < 1e-3).all()
    assert max(gradient.brightness) == pytest.approx(1.0, abs=1e-3)
    # Toward the light, and within the last circle, without which there is no focus.
    assert gradient.focus[0] * LIGHT[1] == pytest.approx(gradient.focus[1] * LIGHT[0])
    assert np.linalg.norm(np.subtract(gradient.focus, gradient.center)) < gradient.radius
