"""The door to OpenGL: which platform, what it says when there is none, and that both draw the same pixels."""

import os
import re
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

from stereodel.render import gl
from stereodel.render.gl import OpenGLError, Triangles, choose, describe, trial

VARIABLES = ("STEREODEL_GL", "PYOPENGL_PLATFORM")
SQUARE = [[-9, -9], [30, -9], [-9, 30]]


@pytest.fixture
def bare_environment(monkeypatch):
    for variable in VARIABLES:
        monkeypatch.delenv(variable, raising=False)
    return monkeypatch


def triangles(corners, colors, slots):
    corners = np.asarray(corners, dtype=float)
    count = len(corners)
    vertex_colors = np.repeat(np.asarray(colors, dtype=float), 3, axis=0)
    faces = np.arange(3 * count, dtype=np.int32).reshape(-1, 3)
    return Triangles(corners.reshape(-1, 2), vertex_colors, np.repeat(np.int32(slots), 3), faces)


def draw(shapes, *size, **options):
    return np.concatenate(list(gl.bands(lambda window: shapes, *size, **options)))


def test_our_variable_comes_before_pyopengls_and_else_osmesa_is_tried_first(bare_environment):
    for usable, expected in (({"osmesa", "egl"}, "osmesa"), ({"egl"}, "egl")):
        bare_environment.setattr(gl, "can_open", usable.__contains__)
        assert choose() == (expected, "found")
    for variable, platform in (("PYOPENGL_PLATFORM", "osmesa"), ("STEREODEL_GL", "egl")):
        bare_environment.setenv(variable, platform)
        assert choose() == (platform, variable)


def test_without_any_library_the_message_names_the_packages(bare_environment):
    bare_environment.setattr(gl, "LIBRARIES", {"osmesa": ("libNothing.so",), "egl": ("libNothing.so",)})
    with pytest.raises(OpenGLError, match=r"libosmesa6 or apt-get install libegl1 libgl1-mesa-dri"):
        choose()
    bare_environment.setattr(gl, "context", gl.context.__wrapped__)
    assert "libosmesa6" in describe().problem


def test_a_platform_with_windows_is_refused(bare_environment):
    for variable in reversed(VARIABLES):
        bare_environment.setenv(variable, "glx")
        with pytest.raises(OpenGLError, match=f"{variable} is 'glx'"):
            choose()


def test_colours_come_out_as_given():
    levels = np.arange(256) / 255
    left = np.arange(256)[:, None, None] * [1, 0] + [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]
    right = np.arange(256)[:, None, None] * [1, 0] + [[0.0, 0.0], [1.0, 1.0], [0.0, 1.0]]
    colors = np.stack([levels, levels[::-1], levels, np.ones(256)], axis=1)
    picture = draw(triangles(np.concatenate([left, right]), np.tile(colors, (2, 1)), np.zeros(512)), 256, 1)
    assert np.array_equal(picture[0, :, 0], np.arange(256))
    assert np.array_equal(picture[0, :, 1], np.arange(256)[::-1])


def test_later_items_cover_earlier_ones_and_blend_over_them():
    black, red = [0.0, 0.0, 0.0, 1.0], [1.0, 0.0, 0.0, 1.0]
    half = [1.0, 1.0, 1.0, 0.5]
    assert draw(triangles([SQUARE, SQUARE], [black, red], [0, 1]), 4, 4)[2, 2].tolist() == [255, 0, 0]
    assert draw(triangles([SQUARE, SQUARE], [red, black], [0, 1]), 4, 4)[2, 2].tolist() == [0, 0, 0]
    assert draw(triangles([SQUARE, SQUARE], [black, half], [0, 1]), 4, 4)[2, 2] == pytest.approx([128] * 3, abs=1)


def test_an_item_whose_triangles_overlap_blends_once():
    once = draw(triangles([SQUARE], [[0, 0, 0, 0.5]], [3]), 4, 4)
    assert np.array_equal(once, draw(triangles([SQUARE] * 5, [[0, 0, 0, 0.5]] * 5, [3] * 5), 4, 4))


def test_the_last_slots_are_told_apart():
    for slot in (0, gl.SLOTS // 2, gl.SLOTS - 2):
        both = triangles([SQUARE, SQUARE], [[0, 0, 0, 1], [1, 1, 1, 1]], [slot, slot + 1])
        assert (draw(both, 2, 2) == 255).all()


def test_too_many_items_are_refused():
    with pytest.raises(ValueError, match="at most"):
        draw(triangles([[[0, 0], [1, 0], [0, 1]]], [[0, 0, 0, 1]], [gl.SLOTS]), 4, 4)


def test_describe_names_platform_and_versions():
    found = describe()
    assert found.problem == ""
    assert found.platform in gl.PLATFORMS
    assert "llvmpipe" in found.renderer
    assert "Mesa " in found.version


@pytest.mark.parametrize("change", [lambda p: p[::-1], lambda p: p[:, ::-1], lambda p: 0 * p, lambda p: p[..., ::-1]])
def test_describe_tells_of_wrong_pixels(monkeypatch, change):
    drawn = gl._OpenGL.draw
    monkeypatch.setattr(gl._OpenGL, "draw", lambda *given: change(drawn(*given)))
    assert re.search("draws wrongly: [0-9]+ of 64 pixels", describe().problem)


@pytest.mark.parametrize("missing", range(4))
def test_describe_tells_of_a_missing_triangle(monkeypatch, missing):
    shapes, expected = trial()
    fewer = replace(shapes, faces=np.delete(shapes.faces, missing, axis=0))
    monkeypatch.setattr(gl, "trial", lambda: (fewer, expected))
    assert "draws wrongly" in describe().problem


def test_describe_tells_of_what_dies_while_it_draws(monkeypatch):
    def dies(*given, **named):
        raise RuntimeError("no\nshader")

    monkeypatch.setattr(gl.context()._offscreen, "render", dies)
    assert describe().problem.endswith("gives an OpenGL context but cannot draw (RuntimeError: no shader)")


def test_shaders_are_compiled_once_and_nothing_else_is_kept_of_a_picture(monkeypatch):
    shape = triangles([[[0, 0], [3, 0], [0, 3]]], [[0, 0, 1, 1]], [0])
    draw(shape, 4, 4)
    from OpenGL.contextdata import storedPointers
    from OpenGL.GL import shaders

    kept = len(storedPointers)
    monkeypatch.setattr(shaders, "compileShader", lambda *source: pytest.fail("a shader is compiled again"))
    draw(shape, 5, 5)
    assert len(storedPointers) == kept


EARLIER = ".*imported OpenGL with OSMesaPlatform and cannot change to egl.*"


@pytest.mark.parametrize(
    ("code", "environment", "said"),
    [
        ("import OpenGL.GL", {"STEREODEL_GL": "egl", "PYOPENGL_PLATFORM": "osmesa"}, EARLIER),
        ("", {"STEREODEL_GL": "osmesa", "GALLIUM_DRIVER": "softpipe"}, "osmesa gives [01] of 4 samples a pixel; .*"),
        ("import atexit, sys; atexit.register(lambda: print('pyglet' in sys.modules))", {}, r"\nFalse"),
    ],
    ids=["an earlier import", "a renderer without multisampling", "the windowing library stays out"],
)
def test_processes_say_one_line_and_nothing_at_the_end(code, environment, said):
    code += "\nfrom stereodel.render.gl import describe; print(describe().problem)"
    environment = {key: value for key, value in os.environ.items() if key not in VARIABLES} | environment
    run = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=False)
    assert re.fullmatch(said + "\n", run.stdout), run.stderr
    assert (run.stderr, run.returncode) == ("", 0)
