"""What other libraries do that no picture can use, and how it is mended: nothing else in the library reaches into them.

pyrender, on objects that `stereodel.render.gl` owns:

* its viewer loads a windowing library, which fails on machines without a display;
* it denies that OSMesa has framebuffer objects, and draws without multisampling;
* it asks for four samples a pixel of whatever cannot give them;
* it compiles its shaders for each picture, and keeps them all;
* it reads depths that nobody asks for;
* it draws meshes in the order of a set, those that are transparent by the places of their nodes, which tell nothing.

matplotlib, which sets the type of `stereodel.render.type`:

* it tells where the outlines of characters lie, but not which characters they are.
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
    """Import pyrender without its viewer, which would import pyglet; the variable of PyOpenGL's platform is set."""
    if "pyrender" not in sys.modules:
        viewer: Any = types.ModuleType("pyrender.viewer")
        viewer.Viewer = type("Viewer", (), {})
        sys.modules["pyrender.viewer"] = viewer
    with of_extra("render"):
        import pyrender

    return pyrender


def mend_offscreen(offscreen: Any, opengl: Any, *, multisamples: bool) -> None:
    """Let an `OffscreenRenderer` sample each pixel four times, keep shaders, draw in order, and read colours alone.

    Parameters
    ----------
    offscreen : pyrender.OffscreenRenderer
    opengl : module
        OpenGL.GL.
    multisamples : bool
        Whether OpenGL can sample a pixel four times; else it does so once, in the middle.
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
    """The same shader program for the same names.

    PyOpenGL has another name for OSMesa's context each time that it is asked, and pyrender, which keeps programs by
    that name, compiles them for each picture and keeps them all: 0.9 MB of memory a picture.
    """
    programs: dict[str, Any] = {}

    def program(**names: Any) -> Any:
        key = repr(names)
        if key not in programs:
            programs[key] = make(**names)
        return programs[key]

    return program


def _colors(renderer: Any, gl: Any) -> Pixels:
    """What was drawn last, rows from the top, the samples of each pixel averaged.

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

    Parameters
    ----------
    text : str
    font : matplotlib.ft2font.FT2Font
        With the fonts that stand in for what it lacks.
    """
    with of_extra("draw"):
        from matplotlib import _text_helpers
        from matplotlib.textpath import TextToPath

    item: Any
    for item in _text_helpers.layout(text, font):
        # Before matplotlib 3.11 all characters stood on the line, and the name was another.
        index = item.glyph_index if hasattr(item, "glyph_index") else item.glyph_idx
        x, y = item.x / TextToPath.FONT_SCALE, getattr(item, "y", 0.0) / TextToPath.FONT_SCALE
        yield item.ft_object, index, item.char, x, y


def font_of(properties: Any) -> Any:
    """The font of some properties, at the size of which `characters` gives places."""
    with of_extra("draw"):
        from matplotlib.textpath import text_to_path

    maker: Any = text_to_path
    return maker._get_font(properties)
