"""The only interface to OpenGL: triangles in, pixels out, through pyrender (the distribution pyrender2), windowless.

PyOpenGL fixes its platform when it is first imported, so a process has one `context`, chosen before that: OSMesa,
or EGL on a software device as its equal; both are Mesa's llvmpipe and give the same pixels. Windows lie on a fixed grid
from the upper left corner: OpenGL rounds where it clips triangles, so only then is a picture written row by row bitwise
that drawn at once. All triangles of a window are one mesh in painter's order with one depth per item: transparent items
blend back to front, and an item whose triangles overlap blends once. Balls are shaded in the fragment shader.
"""

from __future__ import annotations

import atexit
import ctypes
import os
import sys
import types
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field, replace
from functools import cache
from itertools import pairwise
from typing import Any, Final

import numpy as np

from stereodel._arrays import FloatArray, IntArray, Pixels
from stereodel._extras import MissingExtraError, of_extra
from stereodel.drawing.page.colors import Color

VARIABLE: Final = "STEREODEL_GL"
"""Environment variable that chooses the platform."""

PLATFORMS: Final = ("osmesa", "egl")
"""Platforms in the order in which they are tried."""

LIBRARIES: Final = {"osmesa": ("libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"), "egl": ("libEGL.so.1", "libEGL.so")}
"""Shared libraries, of which a platform needs any one."""

PACKAGES: Final = {"osmesa": "libosmesa6", "egl": "libegl1 libgl1-mesa-dri"}
"""Debian packages with these libraries."""

SLOTS: Final = 2**18
"""Largest number of items: adjacent ones are 64 steps of a 24-bit depth buffer apart, and 16 of float32."""

BAND: Final = 1024
"""Rows drawn at once."""

COLUMNS: Final = 4096
"""Width in pixels drawn at once, even. The multisampled buffers of a window take 32 bytes per pixel, 134 MB."""

SUBPIXELS: Final = 256
"""Fractions of a pixel to which llvmpipe rounds corners."""

STRIDE: Final = 8192
"""Pixels, multiples of which are subtracted from coordinates, so that float32 preserves `SUBPIXELS` in a window."""

FAR: Final = 100.0
"""Distance of the camera from bodies in space, in sides of the picture: reflections are those for a distant viewer."""

SAMPLES: Final = 4
"""Samples of a pixel, which pyrender asks for."""

NEAREST: Final = 0x2600
CLAMP_TO_EDGE: Final = 0x812F
EGL_EXTENSIONS: Final = 0x3055
"""Constants of the C headers: filters of textures, and the name of the extension string."""

SHADERS: Final = os.path.join(os.path.dirname(__file__), "shaders")
"""Our own shaders, under the names that pyrender requests."""

TRIAL: Final = 8
"""Pixels across and down of the picture that `describe` draws."""

Disc = tuple[float, float, float, float]
"""Centre x, y and radius along x and y, in pixels, which may differ slightly."""


class OpenGLError(OSError):
    """There is no usable OpenGL, or it was set up differently before; the message says what to do."""


@dataclass(frozen=True, eq=False)
class Triangles:
    """Coloured triangles in painter's order.

    points: (n, 2), pixels from the lower left corner, x right, y up.
    colors: (n, 4), sRGB and opacity in [0, 1].
    slots: (n,), index of the item of each vertex; must not decrease along `faces`.
    faces: (m, 3), either orientation.
    textures: by index of an item, an image of the window, (h, w, 4) from the top, that multiplies the item's colours.
    balls: by index of an item, the ball that shades it, see `stereodel.drawing.page.Ball`.
    """

    points: FloatArray
    colors: FloatArray
    slots: IntArray
    faces: IntArray
    textures: Mapping[int, Pixels] = field(default_factory=dict)
    balls: Mapping[int, Disc] = field(default_factory=dict)


@dataclass(frozen=True)
class Window:
    """A part of a picture, in pixels from its lower left corner, x right, y up."""

    left: int
    bottom: int
    width: int
    height: int


@dataclass(frozen=True)
class Description:
    """The renderer that would be used, for `stereodel doctor`; `problem` is empty if it works."""

    platform: str
    chosen_by: str
    version: str = ""
    renderer: str = ""
    problem: str = ""


def choose() -> tuple[str, str]:
    """The platform to use, and the reason: the name of the environment variable, or "found".

    OpenGLError if the environment requests an unknown one, or none can be opened.
    """
    for variable in (VARIABLE, "PYOPENGL_PLATFORM"):
        value = os.environ.get(variable, "")
        if value in PLATFORMS:
            return value, variable
        if value:
            raise OpenGLError(f'{variable} is {value!r}; set {VARIABLE} to "osmesa" or "egl", or unset {variable}')
    for candidate in PLATFORMS:
        if can_open(candidate):
            return candidate, "found"
    raise OpenGLError(_missing("neither OSMesa nor EGL can be opened", *PLATFORMS))


def can_open(platform: str) -> bool:
    """Whether a shared library of the platform can be loaded."""
    for name in LIBRARIES[platform]:
        with suppress(OSError):
            ctypes.CDLL(name)
            return True
    return False


def bands(
    part: Callable[[Window], Triangles],
    width: int,
    height: int,
    *,
    background: Color = (1.0, 1.0, 1.0, 1.0),
    finish: Callable[[Pixels], Pixels] = lambda pixels: pixels,
) -> Iterator[Pixels]:
    """A picture from the top, `BAND` rows (k, width, 3) at a time; ValueError for too many items for the depth buffer.

    part: function of a window that returns all triangles of the picture that touch it, in order; others have no effect.
    background: its opacity is ignored.
    finish: function of the pixels of a window that returns those to yield.
    """
    opengl = context()
    return _bands(lambda window: finish(opengl.draw(part(window), window, background)), width, height)


def space_bands(
    make: Callable[[Any], Any],
    box: Sequence[Sequence[float]],
    width: int,
    height: int,
    *,
    finish: Callable[[Pixels], Pixels],
) -> Iterator[Pixels]:
    """As `bands`, bodies in space with pyrender's own lighting and depth test.

    make: function of the module pyrender that returns a scene without a camera. Its meshes are drawn in the order of
        their nodes' names, see `node_name`, which matters for transparent ones.
    box: left and right, bottom and top, smallest and largest z of the scene, viewed along −z from far away.
    """
    opengl = context()
    scene = make(opengl.pyrender)

    def drawn(window: Window) -> Pixels:
        camera = aim(opengl.pyrender, scene, box, width, height, window)
        pixels = opengl.draw_scene(scene, window, opengl.pyrender.RenderFlags.NONE)
        scene.remove_node(camera)
        return finish(pixels)

    return _bands(drawn, width, height)


def node_name(number: int) -> str:
    """Node name of the mesh that is drawn at this position, from 0."""
    return f"{number:08d}"


def _bands(drawn: Callable[[Window], Pixels], width: int, height: int) -> Iterator[Pixels]:
    for top in range(0, height, BAND):
        rows = min(BAND, height - top)
        lefts = range(0, width, COLUMNS)
        windows = [Window(left, height - top - rows, min(COLUMNS, width - left), rows) for left in lefts]
        yield np.concatenate([drawn(window) for window in windows], axis=1)


def aim(pyrender: Any, scene: Any, box: Sequence[Sequence[float]], width: int, height: int, window: Window) -> Any:
    """Add a camera for a window of a picture of a box; its node."""
    (left, right), (bottom, top), (low, high) = box
    across, up = (right - left) / width, (top - bottom) / height
    distance = FAR * max(right - left, top - bottom)
    pose = np.eye(4)
    pose[0, 3] = left + across * (window.left + window.width / 2)
    pose[1, 3] = bottom + up * (window.bottom + window.height / 2)
    pose[2, 3] = high + distance
    camera = pyrender.OrthographicCamera(
        xmag=across * window.width / 2, ymag=up * window.height / 2, znear=distance, zfar=distance + high - low
    )
    return scene.add(camera, pose=pose)


def describe() -> Description:
    """The renderer of this process and its versions; a failure is reported as `problem`, never as an exception.

    A small test picture is drawn and compared with the expected pixels.
    """
    found = Description("", "")
    try:
        found = Description(*choose())
        opengl = context()
        found = Description(opengl.platform, opengl.chosen_by, *opengl.strings())
        shapes, expected = trial()
        picture = opengl.draw(shapes, Window(0, 0, TRIAL, TRIAL), (1.0, 1.0, 1.0, 1.0))
        # Blending is rounded once, and the average of the samples once.
        wrong = (np.abs(expected.astype(np.int16) - picture) > 2).any(axis=-1)
        said = f"{opengl.platform} draws wrongly: {np.count_nonzero(wrong)} of {wrong.size} pixels of a trial picture"
        return replace(found, problem=said if wrong.any() else "")
    except (OpenGLError, MissingExtraError, ValueError) as error:
        return replace(found, problem=str(error))


def trial() -> tuple[Triangles, Pixels]:
    """A texture of distinct colours behind a translucent rectangle of two triangles, and the pixels of that.

    So a misplaced texel, a missing triangle, an edge without four samples and a seam along the diagonal are detected.
    """
    corners = np.array([(0, 0), (8, 0), (8, 8), (0, 8), (1.25, 2), (6.5, 2), (6.5, 7), (1.25, 7)], dtype=float)
    colors = np.repeat([[1.0, 1.0, 1.0, 1.0], [0.0, 0.0, 0.0, 0.5]], 4, axis=0)
    faces = np.array([[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]], dtype=np.int32)
    row, column = np.indices((TRIAL, TRIAL))
    texels = np.stack([32 * column, 32 * row, 0 * row + 90, 0 * row + 255], axis=-1).astype(np.uint8)
    share = np.zeros((TRIAL, TRIAL, 1))
    share[1:6, :, 0] = [0.0, 0.75, 1.0, 1.0, 1.0, 1.0, 0.5, 0.0]  # of the samples of each column, in the veil's rows
    expected = np.rint(texels[..., :3] * (1 - share / 2)).astype(np.uint8)
    return Triangles(corners, colors, np.repeat(np.arange(2, dtype=np.int32), 4), faces, {0: texels}), expected


@cache
def context() -> _OpenGL:
    """The context of this process, created on first use and released at its end; OpenGLError if there can be none."""
    made = _OpenGL(*choose())
    atexit.register(made.close)
    return made


class _OpenGL:
    """A pyrender renderer on a platform."""

    def __init__(self, platform: str, chosen_by: str) -> None:
        self.platform, self.chosen_by = platform, chosen_by
        with _environment(PYOPENGL_PLATFORM=platform):
            self.pyrender = _import_pyrender(platform)
            from OpenGL import GL

            self._gl = GL
            try:
                device = str(_software_device()) if platform == "egl" else "0"
                with _environment(EGL_DEVICE_ID=device):
                    self._offscreen = self.pyrender.OffscreenRenderer(16, 16)
                self._shaders = {True: SHADERS, False: self._offscreen._renderer._program_cache.shader_dir}
                samples = int(GL.glGetIntegerv(GL.GL_MAX_SAMPLES))
                if samples < SAMPLES:
                    raise OpenGLError(f"{platform} gives {samples} of {SAMPLES} samples a pixel; use Mesa's llvmpipe")
                mend_offscreen(self._offscreen, GL)
            except OpenGLError:
                raise
            except Exception as error:
                # pyrender and PyOpenGL raise anything from AssertionError to AttributeError if a context fails.
                raise OpenGLError(_missing(f"{platform} gives no OpenGL context ({_told(error)})", platform)) from error

    def draw(self, triangles: Triangles, window: Window, background: Color) -> Pixels:
        """The pixels of a window of triangles, rows from the top."""
        scene = _scene(self.pyrender, triangles, window, background)
        flags = self.pyrender.RenderFlags.FLAT | self.pyrender.RenderFlags.SKIP_CULL_FACES
        return self.draw_scene(scene, window, flags, own=True)

    def draw_scene(self, scene: Any, window: Window, flags: int, *, own: bool = False, **more: Any) -> Pixels:
        """The pixels of a window of a pyrender scene with a camera, rows from the top, with our own shaders or not.

        flags, more: as for pyrender's renderer.
        """
        self._offscreen.viewport_width, self._offscreen.viewport_height = window.width, window.height
        self._offscreen._renderer._program_cache.shader_dir = self._shaders[own]
        try:
            return self._offscreen.render(scene, flags=flags, **more)[0]
        except MemoryError:
            raise
        except Exception as error:  # pyrender and PyOpenGL raise anything here too
            raise OpenGLError(f"{self.platform} gives an OpenGL context but cannot draw ({_told(error)})") from error
        finally:
            # pyrender would keep what it drew, here and in OpenGL, until it draws something else.
            with suppress(Exception):
                self._offscreen._renderer._update_context(self.pyrender.Scene(), flags)

    def strings(self) -> list[str]:
        """GL_VERSION and GL_RENDERER."""
        self._offscreen._platform.make_current()
        return [self._gl.glGetString(name).decode() for name in (self._gl.GL_VERSION, self._gl.GL_RENDERER)]

    def close(self) -> None:
        """Release all resources."""
        # A context that failed before fails again here, as do some drivers at the end of a process.
        with suppress(Exception):
            self._offscreen.delete()


def mend_offscreen(offscreen: Any, opengl: Any) -> None:
    """Make an `OffscreenRenderer` sample each pixel four times, cache shaders, draw in order, and read only colours."""
    # OSMesa has framebuffer objects, which multisampling needs, though pyrender denies it.
    offscreen._platform.supports_framebuffers = lambda: True
    renderer = offscreen._renderer
    from OpenGL.raw.osmesa import _types

    # PyOpenGL makes a new handle of OSMesa's context each time, equal to no other, and keeps what is bound to a context
    # by its handle: 5 kB per picture, for ever. By that handle pyrender caches programs, which it would compile anew.
    _types.OSMesaContext.__eq__ = lambda one, other: one.address == other.address

    def colors(scene: Any, flags: int) -> tuple[Pixels, None]:
        # pyrender would also read the depths and turn them into lengths, which takes longer than drawing.
        width, height = renderer._main_fb_dims
        box = (0, 0, width, height)
        opengl.glBindFramebuffer(opengl.GL_READ_FRAMEBUFFER, renderer._main_fb_ms)
        opengl.glBindFramebuffer(opengl.GL_DRAW_FRAMEBUFFER, renderer._main_fb)
        opengl.glBlitFramebuffer(*box, *box, opengl.GL_COLOR_BUFFER_BIT, opengl.GL_LINEAR)
        opengl.glBindFramebuffer(opengl.GL_READ_FRAMEBUFFER, renderer._main_fb)
        data = opengl.glReadPixels(*box, opengl.GL_RGB, opengl.GL_UNSIGNED_BYTE)
        return np.frombuffer(data, dtype=np.uint8).reshape(height, width, 3)[::-1], None

    renderer._read_main_framebuffer = colors
    # pyrender draws meshes in the order of a set, and transparent ones by the positions of their nodes.
    renderer._sorted_mesh_nodes = lambda scene: sorted(scene.mesh_nodes, key=lambda node: node.name or "")


def _scene(pyrender: Any, triangles: Triangles, window: Window, background: Color) -> Any:
    """All triangles as one mesh with an orthographic camera, in units of pixels."""
    if triangles.slots.size and int(triangles.slots.max()) >= SLOTS:
        raise ValueError(f"a picture has at most {SLOTS} items, got {int(triangles.slots.max()) + 1}")
    scene = pyrender.Scene(bg_color=[*map(float, background[:3]), 1.0])
    origin = np.array([window.left, window.bottom]) // STRIDE * STRIDE
    # The camera sees depths from -1 to -3 and the last item is nearest.
    camera = pyrender.OrthographicCamera(xmag=window.width / 2, ymag=window.height / 2, znear=1.0, zfar=3.0)
    pose = np.eye(4)
    pose[:2, 3] = window.left + window.width / 2, window.bottom + window.height / 2
    pose[:2, 3] -= origin
    scene.add(camera, pose=pose)
    if len(triangles.faces):
        slots = triangles.slots[triangles.faces[:, 0]]
        ends = sorted({0, len(slots), *np.searchsorted(slots, [s + k for s in triangles.textures for k in (0, 1)])})
        runs = [triangles.faces[begin:end] for begin, end in pairwise(ends)]
        scene.add(pyrender.Mesh([_primitive(pyrender, triangles, run, window, origin) for run in runs]))
    return scene


def _primitive(pyrender: Any, triangles: Triangles, faces: IntArray, window: Window, origin: IntArray) -> Any:
    """Some of the triangles: those of one item with a texture, or those of items without."""
    # Without indices, which pyrender would pass through float32.
    corners = faces.ravel()
    depth = -3 + 2 * (triangles.slots[corners] + 0.5) / SLOTS
    # Rounded here as llvmpipe would, so that the rounding of its transformations has no effect.
    points = np.round(SUBPIXELS * triangles.points[corners]) / SUBPIXELS
    material = pyrender.MetallicRoughnessMaterial(alphaMode="BLEND", baseColorFactor=[1.0] * 4)
    texture = triangles.textures.get(int(triangles.slots[corners[0]]))
    texels = None
    if texture is not None:
        texels = (points - [window.left, window.bottom]) / [window.width, window.height]
        sampler = pyrender.Sampler(magFilter=NEAREST, minFilter=NEAREST, wrapS=CLAMP_TO_EDGE, wrapT=CLAMP_TO_EDGE)
        material.baseColorTexture = pyrender.Texture(sampler=sampler, source=texture, source_channels="RGBA")
    return pyrender.Primitive(
        np.column_stack([points - origin, depth]),
        tangents=_balls(triangles, triangles.slots[corners], window),
        texcoord_0=texels,
        color_0=triangles.colors[corners],
        material=material,
    )


def _balls(triangles: Triangles, slots: IntArray, window: Window) -> FloatArray | None:
    """For each corner, the ball of its item in pixels of the window, as expected by `shaders/flat.frag`."""
    found = np.zeros((len(slots), 4))
    for number, ball in triangles.balls.items():
        found[np.searchsorted(slots, number) : np.searchsorted(slots, number + 1)] = ball
    lit = found[:, 2] > 0
    found[lit, :2] -= [window.left, window.bottom]
    return found if lit.any() else None


@contextmanager
def _environment(**variables: str) -> Iterator[None]:
    """Environment variables for pyrender and PyOpenGL, set only while they are imported and create a context.

    Child processes must not inherit the choice of this process.
    """
    before = {name: os.environ[name] for name in variables if name in os.environ}
    os.environ.update(variables)
    try:
        yield
    finally:
        for name in variables:
            del os.environ[name]
        os.environ.update(before)


def _import_pyrender(platform: str) -> Any:
    """Import pyrender on a platform, without its viewer, whose windowing library fails without a display."""
    module = sys.modules.get("OpenGL.platform")
    loaded = type(getattr(module, "PLATFORM", None)).__name__
    if module is not None and loaded.removesuffix("Platform").lower() != platform:
        raise OpenGLError(
            f"this process has imported OpenGL with {loaded} and cannot change to {platform}; "
            f'draw before anything else imports it, or set PYOPENGL_PLATFORM="{platform}" before the program starts'
        )
    # Mesa must not use a graphics card, whose pixels differ.
    os.environ.setdefault("LIBGL_ALWAYS_SOFTWARE", "1")
    if "pyrender" not in sys.modules:
        viewer: Any = types.ModuleType("pyrender.viewer")
        viewer.Viewer = type("Viewer", (), {})
        sys.modules["pyrender.viewer"] = viewer
    try:
        with of_extra("render"):
            import pyrender
    except MissingExtraError:
        raise
    except (ImportError, OSError, AttributeError) as error:
        raise OpenGLError(_missing(f"pyrender cannot be imported for {platform}: {error}", platform)) from error
    return pyrender


def _software_device() -> int:
    """Index of the EGL device of Mesa's software renderer."""
    from OpenGL import EGL
    from pyrender.platforms import egl

    query = egl._eglQueryDeviceStringEXT
    for number, device in enumerate(egl.query_devices()):
        extensions = query(device._display, EGL.EGLint(EGL_EXTENSIONS)) or b""
        if b"EGL_MESA_device_software" in extensions:
            return number
    raise OpenGLError(_missing("EGL has no software device", "egl"))


def _told(error: Exception) -> str:
    """An error in one line; PyOpenGL's own errors are short only as `repr`."""
    text = repr(error) if hasattr(error, "err") else f"{type(error).__name__}: {error}"
    return " ".join(text.split())


def _missing(what: str, *platforms: str) -> str:
    packages = " or ".join(f"apt-get install {PACKAGES[name]}" for name in platforms)
    return f"{what}; install it, on Debian: {packages}"
