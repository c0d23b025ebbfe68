"""The only door to OpenGL: triangles in, pixels out.

Everything goes through pyrender (the distribution pyrender2) on a software renderer, without a window: OSMesa first,
EGL on a software device as its equal; both are Mesa's llvmpipe and give the same pixels. PyOpenGL fixes its platform
when it is first imported, so a process has one `Door`, `DOOR`, which chooses before that and opens when it is needed.

Each pixel has four samples. Renderers that take one alone, like Mesa's softpipe, draw a picture four times, each time
with another of the four in the middle of the pixels.

A picture is drawn in windows, so that memory does not grow with it. They lie on one grid, counted from its upper left
corner, whatever part is asked for: where OpenGL cuts a triangle at the edge of a window it rounds the new corners, and
so a picture drawn at once and one written row by row are the same bits.

All triangles of a window go into one mesh, in painter's order, with a colour at each vertex and one depth per item.
OpenGL draws the triangles of a mesh in their order, so see-through items blend back to front; and since a fragment at
the depth of what is already there is refused, an item whose triangles overlap blends once, as the union of them. An
item with a texture is a part of the mesh for itself; a texel is a pixel of the window. An item on a ball is lit in the
fragment shader, where the place of the pixel tells the normal.
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
from stereodel.drawing.colors import Color
from stereodel.render import trial
from stereodel.render.mends import import_pyrender, mend_offscreen
from stereodel.render.pieces import Triangles, Window

VARIABLE: Final = "STEREODEL_GL"
"""Environment variable that chooses the platform."""

PLATFORMS: Final = ("osmesa", "egl")
"""In the order in which they are tried."""

LIBRARIES: Final = {"osmesa": ("libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"), "egl": ("libEGL.so.1", "libEGL.so")}
"""Shared libraries, any one of which a platform needs."""

PACKAGES: Final = {"osmesa": "libosmesa6", "egl": "libegl1 libgl1-mesa-dri"}
"""Debian packages that hold them."""

SLOTS: Final = 2**18
"""Items that a picture may have: neighbours are 64 steps of a 24-bit depth buffer apart, and 16 of float32."""

BAND: Final = 1024
"""Rows drawn at once."""

COLUMNS: Final = 4096
"""Pixels across that are drawn at once; even. The multisampled buffers of a window take 32 bytes a pixel, 134 MB."""

SUBPIXELS: Final = 256
"""Parts of a pixel to which llvmpipe rounds corners."""

STRIDE: Final = 8192
"""Coordinates lose whole multiples of it, pixels, so that those in a window keep `SUBPIXELS` as float32 of 24 bits."""

FAR: Final = 100.0
"""Distance of the camera from bodies in space, in sides of the picture: light is reflected as to a viewer far away."""

SAMPLES: Final = ((0.375, 0.125), (0.875, 0.375), (0.125, 0.625), (0.625, 0.875))
"""Where in a pixel llvmpipe takes its four samples, from the lower left corner; Direct3D's standard pattern too."""

NEAREST: Final = 0x2600
CLAMP_TO_EDGE: Final = 0x812F
"""How texels are looked up: names of OpenGL's C header."""

SHADERS: Final = os.path.join(os.path.dirname(__file__), "shaders")
"""Our own, under the names by which pyrender asks for them."""

EGL_EXTENSIONS: Final = 0x3055
"""Name of the extension string in EGL's C header."""


class OpenGLError(OSError):
    """There is no usable OpenGL, or it was set up before in another way; the message says what to do."""


@dataclass(frozen=True)
class Description:
    """What would draw, for `stereodel doctor`; `problem` is empty when it works.

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
    """The platform to use and what decided it.

    Parameters
    ----------
    platform : {"osmesa", "egl"}, optional
        Overrides the environment.

    Returns
    -------
    tuple of str
        "osmesa" or "egl"; "argument", the environment variable, or "found".

    Raises
    ------
    ValueError
        For another `platform`.
    OpenGLError
        If the environment asks for something else, or nothing can be opened.
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
    """Draw triangles with 4 samples a pixel.

    Colours are drawn as given, without light but that of `Triangles.balls`; those of a triangle's corners are mixed
    linearly. What is farther back in the order is covered or shows through.

    Parameters
    ----------
    triangles : Triangles
    width, height : int
        In pixels.
    background : Color
        Opaque; its opacity is ignored.
    platform : {"osmesa", "egl"}, optional

    Returns
    -------
    (height, width, 3) uint8 array
        sRGB, rows from the top.

    Raises
    ------
    OpenGLError
        If there is no usable OpenGL; if this process draws on another platform already.
    ValueError
        For a picture without pixels, or with too many items for the depth buffer.
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
    """Draw a picture from the top, `BAND` rows at a time; memory is that of a band and of the triangles of a window.

    Parameters
    ----------
    part : callable
        (window) → at least those triangles of the picture that touch a window, in their order. Others change nothing.
    width, height, background, platform
        As for `draw`, which raises the same errors.
    finish : callable, optional
        (pixels of a window) → those that are kept of them.

    Yields
    ------
    (rows, width, 3) uint8 array
        Or what `finish` makes of it.
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
    """Draw bodies in space from the top, `BAND` rows at a time: pyrender's own light, and its depth test.

    Parameters
    ----------
    make : callable
        (module pyrender) → a scene of it without a camera. Its meshes are drawn in the order of their nodes' names, see
        `node_name`, which counts where something is transparent.
    box : tuple of float
        Left, right, bottom, top, and the least and largest z of what is shown; it is seen along −z, from far away.
    width, height : int
        In pixels.
    numbered : bool
        Instead of light, each mesh in the colour that is its number from 1 on in 24 bits, red first, on black; without
        multisampling: what is seen in the middle of each pixel.
    platform, finish
        As for `bands`, which raises the same errors.

    Yields
    ------
    (rows, width, 3) uint8 array
        Or what `finish` makes of it.
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
    """Of the mesh that is drawn as one of that number, from 0."""
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
    """Put a camera before a window of a picture of a box."""
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
    """What would draw in this process and with which versions; a failure is the `problem`, never an exception.

    A small picture is drawn and compared with what it must be.

    Examples
    --------
    >>> describe("osmesa").platform
    'osmesa'
    """
    return DOOR.describe(platform)


class Door:
    """OpenGL as a process has it: one platform, chosen once, and a context that all its pictures share.

    The context is made when something is drawn or described, given back at the end, and made anew after `close`.
    """

    def __init__(self) -> None:
        self._context: _Context | None = None
        self._chosen: tuple[str, str] | None = None

    def context(self, platform: str | None = None) -> _Context:
        """The context; an `OpenGLError` if there can be none, or another platform was chosen before."""
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
        """Give the context back."""
        if self._context is not None:
            self._context.close()
            self._context = None

    def _choice(self, platform: str | None) -> tuple[str, str]:
        # What a process began with stays.
        return self._chosen if platform is None and self._chosen is not None else choose(platform)


DOOR: Final = Door()
"""That of this process."""


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
                # pyrender and PyOpenGL raise anything from AssertionError to AttributeError where a context fails.
                raise OpenGLError(_missing(f"{platform} gives no OpenGL context ({_told(error)})", platform)) from error

    def draw(self, triangles: Triangles, window: Window, background: Color) -> Pixels:
        """What a window shows of triangles, rows from the top."""
        scene = _scene(self.pyrender, triangles, window, background)
        flags = self.pyrender.RenderFlags.FLAT | self.pyrender.RenderFlags.SKIP_CULL_FACES
        return self._drawn(scene, window, own=True, flags=flags)

    def draw_space(self, scene: Any, window: Window, *, numbered: bool) -> Pixels:
        """What a window shows of a scene of pyrender with a camera, rows from the top."""
        if not numbered:
            return self._drawn(scene, window, own=False, flags=self.pyrender.RenderFlags.NONE)
        nodes = sorted(scene.mesh_nodes, key=lambda node: node.name)
        colors = {node: [k >> 16 & 255, k >> 8 & 255, k & 255] for k, node in enumerate(nodes, start=1)}
        return self._drawn(scene, window, own=False, flags=self.pyrender.RenderFlags.SEG, seg_node_map=colors)

    def _drawn(self, scene: Any, window: Window, *, own: bool, flags: int, **more: Any) -> Pixels:
        """By our own shaders or by those of pyrender; what is numbered with one sample a pixel."""
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

    def trial_problem(self) -> str:
        """What is wrong with a small picture whose pixels are known; empty if nothing is."""
        whole = Window(0, 0, trial.SIDE, trial.SIDE)
        wrong = trial.trial_problem(self.draw(trial.trial_triangles(), whole, (1.0, 1.0, 1.0, 1.0)))
        return wrong and f"{self.platform} draws wrongly: {wrong}"

    def _rendered(self, scene: Any, options: dict[str, Any]) -> Pixels:
        color, _ = self._offscreen.render(scene, **options)
        return color

    def _sample_by_sample(self, scene: Any, options: dict[str, Any]) -> Pixels:
        """The scene drawn once for each sample of a pixel, that lying in the middle, and averaged, rounded half up."""
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
        """Give everything back."""
        # A context in which something failed fails again here, and so do those of drivers at the end of a process.
        with suppress(Exception):
            self._offscreen.delete()


def _scene(pyrender: Any, triangles: Triangles, window: Window, background: Color) -> Any:
    """All triangles as one mesh before an orthographic camera, a unit of the scene being a pixel."""
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
    """Some of the triangles: those of one item with a texture, or of any without."""
    # Without indices, which pyrender would pass through float32.
    corners = faces.ravel()
    depth = -3 + 2 * (triangles.slots[corners] + 0.5) / SLOTS
    # Rounded here as llvmpipe would, so that the rounding of its transformations has nothing to decide.
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
    """For each corner the ball that its item is on, in pixels of the window, as `shaders/flat.frag` wants it."""
    found = np.zeros((len(slots), 4))
    for number, ball in triangles.balls.items():
        found[np.searchsorted(slots, number) : np.searchsorted(slots, number + 1)] = ball
    lit = found[:, 2] > 0
    found[lit, :2] -= [window.left, window.bottom]
    return found if lit.any() else None


@contextmanager
def _environment(**variables: str) -> Iterator[None]:
    """Variables that pyrender and PyOpenGL look at while they are imported and make a context, and no longer.

    What a process chose for itself is no order to those that it starts.
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
    """Import pyrender on a platform, without its windows."""
    _require_platform(platform)
    # Mesa must not take a graphics card: its pixels differ.
    os.environ.setdefault("LIBGL_ALWAYS_SOFTWARE", "1")
    try:
        return import_pyrender()
    except MissingExtraError:
        raise
    except (ImportError, OSError, AttributeError) as error:
        raise OpenGLError(_missing(f"pyrender cannot be imported for {platform}: {error}", platform)) from error


def _require_platform(platform: str) -> None:
    """Refuse if PyOpenGL was imported for another platform."""
    module = sys.modules.get("OpenGL.platform")
    loaded = type(getattr(module, "PLATFORM", None)).__name__
    if module is not None and loaded.removesuffix("Platform").lower() != platform:
        raise OpenGLError(
            f"this process has imported OpenGL with {loaded} and cannot change to {platform}; "
            f'draw before anything else imports it, or set PYOPENGL_PLATFORM="{platform}" before the program starts'
        )


def _software_device() -> int:
    """Number of the EGL device that is Mesa's software renderer."""
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
    """An error in a line; PyOpenGL's own are short as `repr` alone."""
    text = repr(error) if hasattr(error, "err") else f"{type(error).__name__}: {error}"
    return " ".join(text.split())


def _missing(what: str, *platforms: str) -> str:
    packages = " or ".join(f"apt-get install {PACKAGES[name]}" for name in platforms)
    return f"{what}; install it, on Debian: {packages}"
