"""Workarounds for other libraries, whose internals no other module touches.

pyrender, on objects that `stereodel.render.gl` owns:

* its viewer loads a windowing library, which fails on machines without a display;
* it denies that OSMesa has framebuffer objects, and draws without multisampling;
* it asks for four samples a pixel of whatever cannot give them;
* it compiles its shaders for each picture, and keeps them all;
* it reads depths that are not needed;
* it draws meshes in the order of a set, and transparent ones by the positions of their nodes, which are meaningless.

matplotlib, which typesets for `stereodel.render.type`:

* it gives the positions of the outlines of characters, but not the characters.
"""

from __future__ import annotations

import sys
import types
from collections.abc import Iterator
from typing import Any

import numpy as np

from stereodel._arrays import Pixels
from stereodel._extras import of_extra


def import_pyrender() -> Any:
    """Import pyrender without its viewer, which would import pyglet; PyOpenGL's platform variable must be set."""
    if "pyrender" not in sys.modules:
        viewer: Any = types.ModuleType("pyrender.viewer")
        viewer.Viewer = type("Viewer", (), {})
        sys.modules["pyrender.viewer"] = viewer
    with of_extra("render"):
        import pyrender

    return pyrender


def mend_offscreen(offscreen: Any, opengl: Any, *, multisamples: bool) -> None:
    """Make an `OffscreenRenderer` sample each pixel four times, cache shaders, draw in order, and read only colours.

    opengl: the module OpenGL.GL.
    multisamples: whether OpenGL can sample a pixel four times; otherwise it takes one sample, at the centre.
    """
    if not multisamples:
        module: Any = sys.modules["pyrender.renderer"]
        module.glRenderbufferStorageMultisample = lambda target, samples, *rest: (
            opengl.glRenderbufferStorageMultisample(target, 0, *rest)
        )
    # OSMesa has framebuffer objects, which multisampling needs.
    offscreen._platform.supports_framebuffers = lambda: True
    renderer = offscreen._renderer
    cache = renderer._program_cache
    cache.get_program = _kept(cache.get_program)
    renderer._sorted_mesh_nodes = lambda scene: sorted(scene.mesh_nodes, key=lambda node: node.name or "")
    renderer._read_main_framebuffer = lambda scene, flags: (_colors(renderer, opengl), None)


def _kept(make: Any) -> Any:
    """A cache of shader programs by names.

    PyOpenGL returns a different handle for OSMesa's context each time, and pyrender, which caches programs by that
    handle, compiles them for each picture and keeps them all: 0.9 MB of memory per picture.
    """
    programs: dict[str, Any] = {}

    def program(**names: Any) -> Any:
        key = repr(names)
        if key not in programs:
            programs[key] = make(**names)
        return programs[key]

    return program


def _colors(renderer: Any, gl: Any) -> Pixels:
    """The last picture drawn, rows from the top, with the samples of each pixel averaged.

    pyrender would also read the depths and turn them into lengths, which takes longer than drawing.
    """
    width, height = renderer._main_fb_dims
    box = (0, 0, width, height)
    gl.glBindFramebuffer(gl.GL_READ_FRAMEBUFFER, renderer._main_fb_ms)
    gl.glBindFramebuffer(gl.GL_DRAW_FRAMEBUFFER, renderer._main_fb)
    gl.glBlitFramebuffer(*box, *box, gl.GL_COLOR_BUFFER_BIT, gl.GL_LINEAR)
    gl.glBindFramebuffer(gl.GL_READ_FRAMEBUFFER, renderer._main_fb)
    data = gl.glReadPixels(*box, gl.GL_RGB, gl.GL_UNSIGNED_BYTE)
    pixels: Pixels = np.frombuffer(data, dtype=np.uint8).reshape(height, width, 3)
    return pixels[::-1]


def characters(text: str, font: Any) -> Iterator[tuple[Any, int, str, float, float]]:
    """Font, number and characters of each glyph of a line of type, and its place in units of the font's size.

    font: with its fallback fonts.
    """
    with of_extra("draw"):
        from matplotlib import _text_helpers
        from matplotlib.textpath import TextToPath

    item: Any
    for item in _text_helpers.layout(text, font):
        # Before matplotlib 3.11 all characters were on the baseline, and the name was different.
        index = item.glyph_index if hasattr(item, "glyph_index") else item.glyph_idx
        x, y = item.x / TextToPath.FONT_SCALE, getattr(item, "y", 0.0) / TextToPath.FONT_SCALE
        yield item.ft_object, index, item.char, x, y


def font_of(properties: Any) -> Any:
    """The font for some properties, at the size to which the places of `characters` refer."""
    with of_extra("draw"):
        from matplotlib.textpath import text_to_path

    maker: Any = text_to_path
    return maker._get_font(properties)
