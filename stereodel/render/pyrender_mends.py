"""What pyrender does for each picture without need: shaders compiled, depths read.

`stereodel.render.gl` applies it to its renderer.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from stereodel.render.triangles import Pixels


def mend(renderer: Any, opengl: Any) -> None:
    """Let a renderer compile each shader once, and read colours alone, by the functions of OpenGL."""
    cache = renderer._program_cache
    cache.get_program = _kept(cache.get_program)
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
