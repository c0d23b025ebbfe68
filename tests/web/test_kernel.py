"""The kernel's classes in the script: wrong input is refused, and no failure harms the next call."""

import re

import numpy as np
import pytest

import stereodel
from stereodel.drawing import View
from stereodel.globe import Raster
from stereodel.sphere import Rotation
from tests.web.conftest import LOADED, SCRIPT

KERNEL = f"""{LOADED}
import * as api from "{SCRIPT}/kernel/api.ts";
import {{ run, unsigned, Kept, KEPT_BYTES }} from "{SCRIPT}/kernel/instance.ts";
const refused = (call) => {{
  try {{ call(); return null; }} catch (error) {{ return [error.name, error.message]; }}
}};
"""

WRONG = {
    "new api.SphericalDelaunay([1, 0, 0, 0, 0, 0])": ("RangeError", r"points\[1\] is the zero vector"),
    "api.lonlatToXyz([0, 1, 2, 90.5])": ("RangeError", r"lonlat\[1, 1\] is latitude 90.5, outside \[-90, 90\]"),
    "new api.PlanarDelaunay([0, 1]).nearest([0, 0], 2)": ("RangeError", "k is 2, but must be at most 1"),
    "new api.PlanarDelaunay([0, 1]).nearest([0, 0], 0)": ("RangeError", "k is 0, but must be at least 1"),
    "new api.PlanarDelaunay([]).nearest([0, 0])": ("RangeError", "nearest needs at least one point"),
    "new api.PlanarDelaunay([0, 1]).remove([1])": ("RangeError", r"indices\[0\] is 1, but there are 1 points"),
    "api.MoebiusMap.fisheye([0, 0, 0], 2)": ("RangeError", "focus is the zero vector"),
    "new api.PlanarDelaunay([0, 1, 2, NaN])": ("RangeError", r"points\[1, 1\] is NaN; every value must be a finite"),
    "new api.SphericalDelaunay([0, -Infinity, 1])": ("RangeError", r"points\[0, 1\] is -Infinity; every value must be"),
    "new api.SphericalDelaunay([1, 2, 3, 4])": ("RangeError", r"points must have shape \(n, 3\).* got 4 numbers"),
    "new api.PlanarDelaunay([0, 0, 1])": ("RangeError", r"points must have shape \(n, 2\).* got 3 numbers"),
    "new api.PlanarDelaunay([0, 0, '1', 2])": ("TypeError", r"points\[1, 0\] is of type string"),
    "new api.PlanarDelaunay([[0, 0], [1, 2]])": ("TypeError", r"points\[0, 0\] is an array.* one flat array"),
    "new api.PlanarDelaunay([0, , 1, 2])": ("TypeError", r"points\[0, 1\] is of type undefined"),
    "new api.PlanarDelaunay(null)": ("TypeError", "points must be an array of numbers, row after row, but is null"),
    "new api.PlanarDelaunay('0,1')": ("TypeError", "points must be an array of numbers.* but is of type string"),
    "new api.PlanarDelaunay(new BigInt64Array(2))": ("TypeError", r"points\[0, 0\] is of type bigint"),
    "new api.SphericalDelaunay({ length: 48000003 })": ("RangeError", "points has 16000001 rows, more than the 16"),
    "new api.PlanarDelaunay([0, 1]).insert([3, NaN])": ("RangeError", r"points\[0, 1\] is NaN"),
    "new api.PlanarDelaunay([0, 1]).remove([0.5])": ("TypeError", r"indices must be integers, but indices\[0\] is 0.5"),
    "new api.PlanarDelaunay([0, 1]).nearest([0, 1, 2])": ("RangeError", r"xy must have shape \(n, 2\)"),
    "new api.PlanarDelaunay([0, 1]).nearest([0, 1], 1.5)": ("TypeError", "k must be one integer, got 1.5"),
    "new api.SphericalDelaunay([1, 0, 0]).findSimplex([0, 0, 0])": ("RangeError", r"xyz\[0\] is the zero vector"),
    "new api.PlanarVoronoi([0, 1]).areas(0)": ("RangeError", "radius is 0, outside \\(0, inf]"),
    "api.inBubble([1, 0, 0], [0, 1, 0], [0, 0, 1, 1, 1, 1], [1, 0, 0, 1, 0, 0, 1, 0, 0])": ("RangeError", "c has 2"),
    "api.MoebiusMap.fisheye([0, 0], 1e101)": ("RangeError", "magnification is 1e.101, outside the range"),
    "api.MoebiusMap.fisheye([0, 0], -1)": ("RangeError", "magnification is -1, outside \\(0, inf]"),
    "api.MoebiusMap.fisheye([0], 2)": ("RangeError", r"focus must be \(lon, lat\).* got 1 numbers"),
    "api.MoebiusMap.identity().apply([1, 0, 0, 0, 0, 0])": ("RangeError", r"xyz\[1\] is the zero vector"),
    "new api.Rotation([0, 0, 0, 0])": ("RangeError", "quaternion is the zero quaternion"),
    "new api.Raster(new Uint8Array(30), 4)": ("RangeError", "pixels has 30 numbers"),
}


@pytest.mark.parametrize("call", WRONG)
def test_wrong_input(call, node):
    """It is refused in words that name it, and the kernel triangulates as ever afterwards."""
    kind, words = WRONG[call]
    square = "new api.PlanarDelaunay([0, 0, 2, 0, 2, 2, 0, 2, 1, 1]).simplices.length"
    (name, message), triangles = node(f"{KERNEL} export default [refused(() => {call}), {square}];")
    assert (name, triangles) == (kind, 12)
    assert re.search(words, message), message


def test_input_is_never_written_to_nor_kept(node):
    same = node(
        f"{KERNEL} const points = Float64Array.of(0, 0, 2, 0, 2, 2, 0, 2); const copy = points.slice();"
        "const made = new api.PlanarDelaunay(points); made.insert([1, 1]); made.remove([0]);"
        "export default [points.join() === copy.join(), made.points.buffer !== points.buffer, made.size];"
    )
    assert same == [True, True, 4]


def test_a_failure_drops_the_instance_and_nothing_else(fresh_node):
    """Out of memory, a hundred times: the next call works, and old objects answer as before."""
    errors, before, after, answer, again = fresh_node(
        f"{KERNEL} const points = Float64Array.from({{ length: 3000 }}, (_, k) => Math.sin(k * k + 1));"
        "const made = new api.SphericalDelaunay(points); const answer = made.nearest([1, 2, 3])[0];"
        "const before = run((session) => session.memory.buffer.byteLength); const errors = new Set();"
        "for (let k = 0; k < 100; ++k) {"
        "  const failure = refused(() => run((session) => session.call('allocate', 2 ** 32 - 2 ** 16)));"
        "  errors.add(failure.join(': ')); new api.PlanarDelaunay([0, 0, 1, 0, 0, 1]);"
        "}"
        "const after = run((session) => session.memory.buffer.byteLength);"
        "export default [[...errors], before, after, answer, made.nearest([1, 2, 3])[0]];"
    )
    assert errors == ["KernelError: out of memory: the kernel has 4 GiB at most; give fewer points"]
    assert after <= before
    assert answer == again


def test_an_error_of_the_kernel_comes_with_its_message(node):
    """Checks come first, so it takes a call around them; the message is that of the C++ exception."""
    rows = "Float64Array.of(NaN, 0), 1, Float64Array.of(0, 0), 1, Float64Array.of(1, 0), 1"
    call = f"run((session) => session.call('plane_turn', {rows}, session.place(1)))"
    said = node(f"{KERNEL} export default refused(() => {call});")
    assert said == ["KernelError", "a[0, 0] is nan, not a finite number"]


@pytest.mark.thorough
def test_addresses_above_two_gigabytes(fresh_node):
    """Memory that is asked for and not touched costs nothing: what comes after it lies above 2 GiB."""
    numbers, equal, above = fresh_node(
        f"{KERNEL} const points = Float64Array.from({{ length: 60000 }}, (_, k) => Math.sin(k * k + 1));"
        "const all = () => { const made = new api.SphericalDelaunay(points), cells = new api.SphericalVoronoi(made);"
        "  return [made.simplices, made.nearest([1, 2, 3], 9), cells.areas(), cells.ridgePoints].map(String).join(); };"
        "const before = all(); refused(() => run(() => { throw Error(); }));"
        "for (let k = 0; k < 5; ++k) run((session) => session.call('allocate', 2 ** 29 - 2 ** 16));"
        "export default [[-1, -(2 ** 31), 5].map(unsigned), all() === before,"
        "  run((session) => session.place(8e6))];"
    )
    assert (numbers, equal) == ([2**32 - 1, 2**31, 5], True)
    assert above > 2**31


@pytest.mark.thorough
def test_arrays_that_stay_are_given_back(fresh_node):
    """What may stay in the module is bounded: the array that was not used for longest goes first."""
    grown, bound = fresh_node(
        f"{KERNEL} const keep = (session) => session.call('xyz_to_lonlat', new Kept(new Float64Array(2 ** 20)), 0, 0);"
        "for (let k = 0; k < 100; ++k) run(keep);"
        "export default [run((session) => session.memory.buffer.byteLength), KEPT_BYTES];"
    )
    assert bound < grown < 2.2 * bound  # memory is given out in powers of two


def test_without_the_module(fresh_node):
    said = fresh_node(
        f'import {{ PlanarDelaunay }} from "{SCRIPT}/kernel/api.ts";'
        f'import {{ load }} from "{SCRIPT}/kernel/instance.ts";'
        "const said = []; try { new PlanarDelaunay([0, 1]); } catch (error) { said.push(error.message); }"
        "try { await load(new Uint8Array(3)); } catch (error) { said.push(error.name); }"
        f'const {{ readFileSync }} = await import("node:fs");'
        f'await load(readFileSync("{SCRIPT.parent}/built/stereodel.wasm"));'
        "said.push(new PlanarDelaunay([0, 1]).size); export default said;"
    )
    assert said == ["the kernel is not loaded: await load() first", "CompileError", 1]


@pytest.mark.parametrize("opaque", [True, False])
def test_a_raster_is_that_of_python(node, rng, opaque):
    """A picture of noise through a lens: every pixel, with and without opacity."""
    lens = stereodel.MoebiusMap.rotation((10, 20), 70) @ stereodel.fisheye((10, 50), magnification=4)
    view = View(0.0, 90.0)
    picture = rng.integers(0, 256, size=(60, 120, 4), dtype=np.uint8)
    picture[..., 3] |= 255 * opaque
    made = node(
        f"{KERNEL} const turned = api.MoebiusMap.rotation(api.Rotation.about([10, 20], 70));"
        "const lens = turned.after(api.MoebiusMap.fisheye([10, 50], 4));"
        "const view = api.MoebiusMap.rotation(new api.Rotation(given.turned));"
        "export default [...new api.Raster(Uint8Array.from(given.pixels), 120).warp(view.after(lens), 50)];",
        {"pixels": picture.ravel().tolist(), "turned": Rotation.nearest(view.matrix).quaternion.tolist()},
    )
    warped = Raster(picture).warp(lens, view, 50)
    assert np.abs(np.array(made).reshape(50, 50, 4) - warped).max() <= 1  # the rotations are multiplied otherwise
    assert len(np.unique(warped)) > 200
