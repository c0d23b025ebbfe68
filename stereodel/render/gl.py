"""The only interface to OpenGL: triangles in, pixels out.

Everything goes through pyrender (the distribution pyrender2) on a software renderer, without a window: OSMesa first,
EGL on a software device as its equal; both are Mesa's llvmpipe and give the same pixels. PyOpenGL fixes its platform
when it is first imported, so a process has one `Door`, `DOOR`, which chooses before that and opens when it is needed.

Each pixel has four samples. Renderers with a single sample, such as Mesa's softpipe, draw a picture four times, each
time with another of the four sample positions at the pixel centres.

A picture is drawn in windows, so that memory does not grow with it. The windows lie on a fixed grid, counted from the
upper left corner of the picture, whatever part is requested: where OpenGL clips a triangle at the edge of a window it
rounds the new corners, so only with fixed windows is a picture drawn at once bitwise equal to one written row by row.

All triangles of a window go into one mesh, in painter's order, with a colour at each vertex and one depth per item.
OpenGL draws the triangles of a mesh in their order, so transparent items blend back to front; and since a fragment at
an already drawn depth is rejected, an item whose triangles overlap blends once, as their union. An item with a texture
is a separate part of the mesh, with one texel per pixel of the window. An item on a ball is shaded in the fragment
shader, where the position of the pixel determines the normal.
"""

from __future__ import annotations

import atexit
import ctypes
import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any, Final

import numpy as np

from stereodel._arrays import FloatArray, IntArray, Pixels
from stereodel._extras import MissingExtraError
from stereodel.drawing.page.colors import Color
from stereodel.render import trial
from stereodel.render.mends import import_pyrender, mend_offscreen
from stereodel.render.pieces import Triangles, Window

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

SAMPLES: Final = ((0.375, 0.125), (0.875, 0.375), (0.125, 0.625), (0.625, 0.875))
"""Sample positions of llvmpipe in a pixel, from the lower left corner, which are also Direct3D's standard pattern."""

NEAREST: Final = 0x2600
CLAMP_TO_EDGE: Final = 0x812F
"""Texture filters: constants of OpenGL's C header."""

SHADERS: Final = os.path.join(os.path.dirname(__file__), "shaders")
"""Our own shaders, under the names that pyrender requests."""

EGL_EXTENSIONS: Final = 0x3055
"""Name of the extension string in EGL's C header."""


class OpenGLError(OSError):
    """There is no usable OpenGL, or it was set up differently before; the message says what to do."""


@dataclass(frozen=True)
class Description:
    """The renderer that would be used, for `stereodel doctor`; `problem` is empty if it works.

    Without `multisamples` each picture is drawn four times.
    """

    platform: str
    chosen_by: str
    version: str = ""
    renderer: str = ""
    problem: str = ""
    multisamples: bool = True

    @property
    def mesa(self) -> str:
        """Version of Mesa, e.g. 22.3.6; empty if it is not Mesa."""
        _, found, rest = self.version.partition("Mesa ")
        return rest.split()[0] if found else ""


def choose(platform: str | None = None) -> tuple[str, str]:
    """The platform to use, and the reason: "argument", the name of the environment variable, or "found".

    ValueError if `platform` is unknown; OpenGLError if the environment requests an unknown one, or none can be opened.
    """
    if platform is not None:
        if platform not in PLATFORMS:
            raise ValueError(f'platform must be "osmesa" or "egl", got {platform!r}')
        return platform, "argument"
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
    return any(_loads(name) for name in LIBRARIES[platform])


def draw(
    triangles: Triangles,
    width: int,
    height: int,
    *,
    background: Color = (1.0, 1.0, 1.0, 1.0),
    platform: str | None = None,
) -> Pixels:
    """Draw triangles with 4 samples per pixel: (height, width, 3) uint8, sRGB, rows from the top.

    Colours are drawn as given, shaded only by `Triangles.balls`; those of a triangle's corners are interpolated
    linearly. Earlier items are covered or show through. The opacity of the background is ignored.

    OpenGLError if there is no usable OpenGL, or this process already draws on another platform; ValueError if the
    picture has no pixels, or too many items for the depth buffer.
    """
    return np.concatenate(
        list(bands(lambda window: triangles, width, height, background=background, platform=platform))
    )


def bands(
    part: Callable[[Window], Triangles],
    width: int,
    height: int,
    *,
    background: Color = (1.0, 1.0, 1.0, 1.0),
    platform: str | None = None,
    finish: Callable[[Pixels], Pixels] = lambda pixels: pixels,
) -> Iterator[Pixels]:
    """Draw a picture from the top, `BAND` rows at a time, in the memory of a band and the triangles of a window.

    Yields (rows, width, 3) uint8; errors are those of `draw`.

    part: function of a window that returns all triangles of the picture that touch it, in order; others have no effect.
    finish: function of the pixels of a window that returns those to yield.
    """
    if min(width, height) < 1:
        raise ValueError(f"a picture has at least one pixel each way, got {width} by {height}")
    context = DOOR.context(platform)
    for windows in _windows(width, height):
        yield np.concatenate([finish(context.draw(part(w), w, background)) for w in windows], axis=1)


def space_bands(
    make: Callable[[Any], Any],
    box: tuple[float, float, float, float, float, float],
    width: int,
    height: int,
    *,
    numbered: bool = False,
    platform: str | None = None,
    finish: Callable[[Pixels], Pixels] = lambda pixels: pixels,
) -> Iterator[Pixels]:
    """Draw bodies in space from the top, `BAND` rows at a time, with pyrender's own lighting and depth test.

    make: function of the module pyrender that returns a scene without a camera. Its meshes are drawn in the order of
        their nodes' names, see `node_name`, which matters for transparent ones.
    box: left, right, bottom, top, and the smallest and largest z of the scene, which is viewed along −z from far away.
    numbered: whether to draw each mesh, without lighting, in the colour of its number, from 1, in 24 bits, red first,
        on black; without multisampling, so that each pixel shows the mesh at its centre.
    finish: as for `bands`, which yields the same and raises the same errors.
    """
    context = DOOR.context(platform)
    scene, camera = make(context.pyrender), None
    for windows in _windows(width, height):
        parts = []
        for window in windows:
            if camera is not None:
                scene.remove_node(camera)
            camera = _aim(context.pyrender, scene, box, width, height, window)
            parts.append(finish(context.draw_space(scene, window, numbered=numbered)))
        yield np.concatenate(parts, axis=1)


def node_name(number: int) -> str:
    """Node name of the mesh that is drawn at this position, from 0."""
    return f"{number:08d}"


def _windows(width: int, height: int) -> Iterator[list[Window]]:
    """The windows of a picture, row by row from the top."""
    for top in range(0, height, BAND):
        rows = min(BAND, height - top)
        lefts = range(0, width, COLUMNS)
        yield [Window(left, height - top - rows, min(COLUMNS, width - left), rows) for left in lefts]


def _aim(
    pyrender: Any,
    scene: Any,
    box: tuple[float, float, float, float, float, float],
    width: int,
    height: int,
    window: Window,
) -> Any:
    """Add a camera for a window of a picture of a box."""
    left, right, bottom, top, low, high = box
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


def describe(platform: str | None = None) -> Description:
    """The renderer of this process and its versions; a failure is reported as `problem`, never as an exception.

    A small test picture is drawn and compared with the expected pixels.

    >>> describe("osmesa").platform
    'osmesa'
    """
    return DOOR.describe(platform)


class Door:
    """The OpenGL of a process: one platform, chosen once, and a context shared by all pictures.

    The context is created on first use, released at exit, and created again after `close`.
    """

    def __init__(self) -> None:
        self._context: _Context | None = None
        self._chosen: tuple[str, str] | None = None

    def context(self, platform: str | None = None) -> _Context:
        """The context; OpenGLError if there can be none, or another platform was chosen before."""
        name, reason = self._choice(platform)
        if self._context is None:
            self._context = _Context(name)
            self._chosen = name, reason
            atexit.register(self.close)
        if self._context.platform != name:
            raise OpenGLError(f"this process draws on {self._context.platform} already; use {name} in a new process")
        return self._context

    def describe(self, platform: str | None = None) -> Description:
        """See `describe` of this module."""
        found = Description("", "")
        try:
            found = Description(*self._choice(platform))
            context = self.context(platform)
            version, renderer = context.strings()
            found = replace(found, version=version, renderer=renderer, multisamples=context.multisamples)
            return replace(found, problem=context.trial_problem())
        except (OpenGLError, MissingExtraError, ValueError) as error:
            return replace(found, problem=str(error))

    def close(self) -> None:
        """Release the context."""
        if self._context is not None:
            self._context.close()
            self._context = None

    def _choice(self, platform: str | None) -> tuple[str, str]:
        # The first choice of a process is kept.
        return self._chosen if platform is None and self._chosen is not None else choose(platform)


DOOR: Final = Door()
"""The instance of this process."""


class _Context:
    """A pyrender renderer on a platform."""

    def __init__(self, platform: str) -> None:
        self.platform = platform
        with _environment(PYOPENGL_PLATFORM=platform):
            self.pyrender = _import_pyrender(platform)
            from OpenGL import GL

            self._gl = GL
            try:
                device = str(_software_device()) if platform == "egl" else "0"
                with _environment(EGL_DEVICE_ID=device):
                    self._offscreen = self.pyrender.OffscreenRenderer(16, 16)
                self._shaders = {True: SHADERS, False: self._offscreen._renderer._program_cache.shader_dir}
                self.multisamples = int(GL.glGetIntegerv(GL.GL_MAX_SAMPLES)) >= len(SAMPLES)
                mend_offscreen(self._offscreen, GL, multisamples=self.multisamples)
            except OpenGLError:
                raise
            except Exception as error:
                # pyrender and PyOpenGL raise anything from AssertionError to AttributeError if a context fails.
                raise OpenGLError(_missing(f"{platform} gives no OpenGL context ({_told(error)})", platform)) from error

    def draw(self, triangles: Triangles, window: Window, background: Color) -> Pixels:
        """The pixels of a window of triangles, rows from the top."""
        scene = _scene(self.pyrender, triangles, window, background)
        flags = self.pyrender.RenderFlags.FLAT | self.pyrender.RenderFlags.SKIP_CULL_FACES
        return self._drawn(scene, window, own=True, flags=flags)

    def draw_space(self, scene: Any, window: Window, *, numbered: bool) -> Pixels:
        """The pixels of a window of a pyrender scene with a camera, rows from the top."""
        if not numbered:
            return self._drawn(scene, window, own=False, flags=self.pyrender.RenderFlags.NONE)
        nodes = sorted(scene.mesh_nodes, key=lambda node: node.name)
        colors = {node: [k >> 16 & 255, k >> 8 & 255, k & 255] for k, node in enumerate(nodes, start=1)}
        return self._drawn(scene, window, own=False, flags=self.pyrender.RenderFlags.SEG, seg_node_map=colors)

    def _drawn(self, scene: Any, window: Window, *, own: bool, flags: int, **more: Any) -> Pixels:
        """Draw with our own shaders or those of pyrender; numbered scenes with one sample per pixel."""
        self._offscreen.viewport_width, self._offscreen.viewport_height = window.width, window.height
        self._offscreen._renderer._program_cache.shader_dir = self._shaders[own]
        once = self.multisamples or bool(flags & self.pyrender.RenderFlags.SEG)
        try:
            options = {"flags": flags, **more}
            return self._rendered(scene, options) if once else self._sample_by_sample(scene, options)
        except MemoryError:
            raise
        except Exception as error:  # pyrender and PyOpenGL raise anything here too
            raise OpenGLError(f"{self.platform} gives an OpenGL context but cannot draw ({_told(error)})") from error
        finally:
            # pyrender would keep what it drew, here and in OpenGL, until it draws something else.
            with suppress(Exception):
                self._offscreen._renderer._update_context(self.pyrender.Scene(), flags)

    def trial_problem(self) -> str:
        """A description of errors in a test picture with known pixels; empty if there are none."""
        whole = Window(0, 0, trial.SIDE, trial.SIDE)
        wrong = trial.trial_problem(self.draw(trial.trial_triangles(), whole, (1.0, 1.0, 1.0, 1.0)))
        return wrong and f"{self.platform} draws wrongly: {wrong}"

    def _rendered(self, scene: Any, options: dict[str, Any]) -> Pixels:
        color, _ = self._offscreen.render(scene, **options)
        return color

    def _sample_by_sample(self, scene: Any, options: dict[str, Any]) -> Pixels:
        """The average, rounded half up, of the scene drawn once for each sample position, moved to the pixel centre."""
        camera = scene.main_camera_node
        pose, pixel = camera.matrix, 2 * camera.camera.xmag / self._offscreen.viewport_width
        total = np.full((self._offscreen.viewport_height, self._offscreen.viewport_width, 3), 2, dtype=np.uint16)
        for sample in SAMPLES:
            aside = np.eye(4)
            aside[:2, 3] = pixel * (np.array(sample) - 0.5)
            scene.set_pose(camera, aside @ pose)
            total += self._rendered(scene, options)
        return (total // 4).astype(np.uint8)

    def strings(self) -> tuple[str, str]:
        """GL_VERSION and GL_RENDERER."""
        self._offscreen._platform.make_current()
        return self._gl.glGetString(self._gl.GL_VERSION).decode(), self._gl.glGetString(self._gl.GL_RENDERER).decode()

    def close(self) -> None:
        """Release all resources."""
        # A context that failed before fails again here, as do some drivers at the end of a process.
        with suppress(Exception):
            self._offscreen.delete()


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
    before = {name: os.environ.get(name) for name in variables}
    os.environ.update(variables)
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


def _import_pyrender(platform: str) -> Any:
    """Import pyrender on a platform, without its viewer."""
    _require_platform(platform)
    # Mesa must not use a graphics card, whose pixels differ.
    os.environ.setdefault("LIBGL_ALWAYS_SOFTWARE", "1")
    try:
        return import_pyrender()
    except MissingExtraError:
        raise
    except (ImportError, OSError, AttributeError) as error:
        raise OpenGLError(_missing(f"pyrender cannot be imported for {platform}: {error}", platform)) from error


def _require_platform(platform: str) -> None:
    """Raise OpenGLError if PyOpenGL was imported for another platform."""
    module = sys.modules.get("OpenGL.platform")
    loaded = type(getattr(module, "PLATFORM", None)).__name__
    if module is not None and loaded.removesuffix("Platform").lower() != platform:
        raise OpenGLError(
            f"this process has imported OpenGL with {loaded} and cannot change to {platform}; "
            f'draw before anything else imports it, or set PYOPENGL_PLATFORM="{platform}" before the program starts'
        )


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


def _loads(library: str) -> bool:
    try:
        ctypes.CDLL(library)
    except OSError:
        return False
    return True


def _told(error: Exception) -> str:
    """An error in one line; PyOpenGL's own errors are short only as `repr`."""
    text = repr(error) if hasattr(error, "err") else f"{type(error).__name__}: {error}"
    return " ".join(text.split())


def _missing(what: str, *platforms: str) -> str:
    packages = " or ".join(f"apt-get install {PACKAGES[name]}" for name in platforms)
    return f"{what}; install it, on Debian: {packages}"
