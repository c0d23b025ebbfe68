"""What other libraries do that no picture can use, and how it is mended: nothing else in the library reaches into them.

pyrender, on objects that `stereodel.render.gl` owns:

* its viewer loads a windowing library, which fails on machines without a display;
* it denies that OSMesa has framebuffer objects, and draws without multisampling;
* it asks for four samples a pixel of whatever cannot give them;
* it compiles its shaders for each picture, and keeps them all;
* it reads depths that nobody asks for;
* it draws meshes in the order of a set, those that are transparent by the places of their nodes, which tell nothing.

matplotlib, while `stereodel.render.vector` writes a file:

* it rounds the sizes of formulas that are set as outlines.
"""

from __future__ import annotations

import sys
import types
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, Final

import numpy as np

from stereodel._arrays import Pixels
from stereodel._extras import of_extra

FINER: Final = 64
"""By how much the pixels are smaller to which the size of a formula is rounded up: then it is 1/64 of a point."""


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


@contextmanager
def exact_mathtext() -> Iterator[None]:
    """Set formulas in their place.

    The size of a formula is rounded up to whole pixels, those of PDF being points, and its letters are moved up by what
    was added: by three quarters of a point beside the same label in SVG and PNG. So it is set with finer pixels.
    """
    with of_extra("draw"):
        from matplotlib.mathtext import MathTextParser, VectorParse

    parser: Any = MathTextParser
    parse = parser.parse

    def reduced(width: float, height: float, depth: float, glyphs: list[Any], rectangles: list[Any]) -> VectorParse:
        return VectorParse(
            width / FINER,
            height / FINER,
            depth / FINER,
            [(*what, x / FINER, y / FINER) for *what, x, y in glyphs],
            [tuple(side / FINER for side in rectangle) for rectangle in rectangles],
        )

    def finer(self: Any, text: str, dpi: float = 72, *options: Any, **named: Any) -> Any:
        parsed = parse(self, text, FINER * dpi, *options, **named)
        return reduced(*parsed) if isinstance(parsed, VectorParse) else parse(self, text, dpi, *options, **named)

    parser.parse = finer
    try:
        yield
    finally:
        parser.parse = parse
