"""Tolerances and stored arrays."""

import numpy as np
import pytest

from tools.baselines import PIXEL_LEVELS, array_differences, compare, load_arrays, save_arrays, summarised


@pytest.fixture
def white():
    return np.full((100, 100, 3), 255, dtype=np.uint8)


def test_one_pixel_in_ten_thousand_may_be_visibly_other(white):
    other = white.copy()
    other[3, 4, 1] = 255 - PIXEL_LEVELS - 1
    assert compare(white, other).visible == 1e-4
    assert compare(white, other).passes
    other[9, 9, 0] = 0
    assert not compare(white, other).passes
    assert compare(white, white[:50]).visible == 1  # another shape differs everywhere


def test_one_pixel_in_a_thousand_may_be_a_little_other(white):
    other = white.copy()
    other[5::25, 25::40, 2] -= PIXEL_LEVELS
    other[95, 90:92, 2] -= PIXEL_LEVELS
    assert compare(white, other).visible == 0
    assert compare(white, other).any == 1e-3
    assert compare(white, other).passes
    other[1, 0, 0] -= 1
    assert not compare(white, other).passes


def blot(large, top, left, size, depth):
    other = large.copy()
    other[top : top + size[0], left : left + size[1]] -= np.uint8(depth)
    return compare(large, other)


@pytest.mark.parametrize(("top", "left"), [(0, 0), (30, 47), (500, 600), (996, 996)])
def test_what_is_lost_in_the_shares_is_seen_in_a_tile(top, left):
    """Whatever it lies on: seams of tiles are the middles of others."""
    large = np.full((1000, 1000, 3), 255, dtype=np.uint8)
    dot = blot(large, top, left, (2, 3), 100)
    assert (dot.visible, dot.tile_visible, dot.tile_any) == (6e-6, 6, 6)
    assert not dot.passes
    assert dot.row <= top < dot.row + 32
    assert dot.column <= left < dot.column + 32
    assert blot(large, top, left, (2, 2), 100).passes
    assert not blot(large, top, left, (3, 3), 1).passes
    assert blot(large, top, left, (2, 4), 1).passes
    assert f"rows {dot.row} to {dot.row + 31}: 6 and 6" in str(dot)


def test_levels_do_not_wrap_around():
    dark, light = (np.full((2, 2, 3), level, dtype=np.uint8) for level in (0, 255))
    assert compare(dark, light).visible == compare(light, dark).visible == 1


STORED = {
    "views": np.arange(18.0).reshape(2, 3, 3) / 7,
    "0001_stroke_path": np.random.default_rng(0).uniform(-1, 1, (5, 4, 2)),
    "faces": np.array([[0, 1, 2], [2, 1, 3]], dtype=np.int32),
    "closed": np.array([True, False]),
    "text": np.array(["$\\phi$", "left"]),
    "none": np.zeros((0, 3)),
    "number": np.array(2.5),
    "again": np.arange(18.0).reshape(2, 3, 3) / 7,
    "special": np.array([np.nan, np.inf, -0.0]),
}


def test_arrays_come_back_as_they_were(tmp_path):
    read = load_arrays(save_arrays(STORED, tmp_path / "a.npz.xz"))
    assert list(read) == list(STORED)
    for name, array in STORED.items():
        assert read[name].dtype == array.dtype
        np.testing.assert_array_equal(read[name], array, strict=True)
    assert array_differences(STORED, read, tolerance=0.0) == {}


@pytest.mark.parametrize(
    ("name", "change", "says"),
    [
        ("views", lambda a: a + 3e-11, "18 of 18 entries differ"),
        ("faces", lambda a: a[:, ::-1], "4 of 6 entries differ, first at (0, 0): 0 expected, 2 found"),
        ("text", lambda a: np.array(["$\\phi$", "right"]), "left expected, right found"),
        ("closed", lambda a: ~a, "2 of 2"),
        ("none", lambda a: np.zeros((1, 3)), "shape (0, 3) expected, (1, 3) found"),
        ("faces", lambda a: a.astype(float), "type int32 expected, float64 found"),
        ("special", lambda a: np.array([0.0, np.inf, 0.0]), "1 of 3"),
    ],
)
def test_each_kind_of_change_is_named(name, change, says):
    found = array_differences(STORED, {**STORED, name: change(STORED[name])})
    assert list(found) == [name]
    assert says in found[name]
    assert array_differences({"a": np.ones(1)}, {"b": np.ones(1)}) == {"a": "missing", "b": "not expected"}


def test_floats_may_differ_by_rounding_relative_to_the_largest():
    large = {"x": np.array([1e6, 1.0])}
    assert array_differences(large, {"x": large["x"] + 5e-7}) == {}
    assert array_differences(large, {"x": large["x"] + 2e-6}) != {}
    small = {"x": np.array([1e-3])}
    assert array_differences(small, {"x": small["x"] + 5e-13}) == {}


def large_page(change=lambda paths: paths):
    """Arrays of a page as many lines make them: too many numbers to store."""
    paths = change(np.random.default_rng(2).random((100, 700, 4, 2)))
    named = {f"{k:04d}_stroke_coast_path": path for k, path in enumerate(paths)}
    return {**named, "0100_label_label_text": np.array(["a"]), "geometry_sites": np.arange(9.0)}


def moved_by(amount):
    def change(paths):
        paths[57, 433, 2, 1] += amount
        return paths

    return change


def test_a_summary_is_small_and_does_not_depend_on_the_order_of_the_lines():
    small = {"0000_stroke_limb_path": np.ones((5, 4, 2)), "0001_label_label_text": np.array(["a"])}
    assert summarised(small) == small
    found = summarised(large_page())
    assert sum(array.size for array in found.values()) < 2100
    assert found["0100_label_label_text"] == ["a"]
    assert array_differences(found, summarised(large_page(lambda paths: paths[::-1]))) == {}


@pytest.mark.parametrize(
    "change", [moved_by(1e-5), lambda paths: paths[:-1], lambda paths: 1.0001 * paths, lambda paths: paths + 1e-9]
)
def test_a_summary_tells_of_one_moved_number_a_missing_line_another_scale_and_a_shift(change):
    assert "stroke_coast_path_totals" in array_differences(summarised(large_page()), summarised(large_page(change)))
