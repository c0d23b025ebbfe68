"""Scales of colours and sizes: where numbers stand, classes, round ticks and how they are written, what is refused."""

from fractions import Fraction
from functools import partial
from itertools import combinations
from typing import get_args

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib import colormaps
from matplotlib.colors import LogNorm, PowerNorm, to_rgba

from stereodel.drawing import ColorScale, Page, SizeScale, with_legend
from stereodel.drawing.page.labels import label_box
from stereodel.drawing.page.placing import meets
from stereodel.drawing.page.scales import KINDS
from stereodel.drawing.page.ticks import MOST_TICKS, Scheme, natural_breaks, written
from tests.refused import refused

NBSP = "\N{NO-BREAK SPACE}"
SYMLOG = {"kind": "symlog", "threshold": 10.0}


@pytest.mark.parametrize(
    ("scale", "texts"),
    [
        (ColorScale("viridis", 0, 20e6), "0, 5 M, 10 M, 15 M, 20 M"),
        (ColorScale("viridis", 5.3e6, 21e6), "10 M, 15 M, 20 M"),
        (ColorScale("viridis", 500, 1e5, "log"), "500, 1 000, 5 000, 10 000, 50 000, 100 000"),
        (ColorScale("viridis", 0.02, 1, "log"), "0.02, 0.05, 0.1, 0.2, 0.5, 1"),
        (ColorScale("viridis", 1, 1e18, "log"), "1, 1 000, 1 M, 1 bn, 1 tn, 10¹⁵, 10¹⁸"),
        (ColorScale("viridis", 3, 4, "log"), "3, 3.2, 3.4, 3.6, 3.8, 4"),
        (ColorScale("RdBu", -1e3, 1e5, "symlog", threshold=10), "−100, 0, 100, 10 000"),
        (ColorScale("viridis", 0, 100, "sqrt"), "0, 20, 40, 60, 80, 100"),
        (ColorScale("viridis", 0, 1.5e6), "0, 0.5 M, 1 M, 1.5 M"),
        (ColorScale("RdBu", -1, 1, center=0.09), "−1, −0.5, 0.09, 0.5, 1"),
        (ColorScale("viridis", 1e-7, 3e-7), "10⁻⁷, 1.5·10⁻⁷, 2·10⁻⁷, 2.5·10⁻⁷, 3·10⁻⁷"),
        (ColorScale.of([5.3e6, 21e6, np.nan]), "5 M, 10 M, 15 M, 20 M, 25 M"),
        (ColorScale.of([7.0, 7.0]), "6, 8, 10, 12, 14"),
        (ColorScale.of([-1.0, 0.0, 30.0, 4000.0], kind="log"), "50, 100, 500, 1 000, 5 000"),
        (ColorScale.classes([1, 2, 3, 4, 5, 6000], [0, 3, 2500.5, 1e6]), "0, 3, 2 500, 1 M"),
        (SizeScale(24.9e6), "20 M, 5 M, 1 M"),
        (SizeScale(9.9e-3), "0.005, 0.001, 0.0002"),
    ],
)
def test_ticks_are_round_and_grouped(scale, texts):
    assert ", ".join(scale.ticks.values()).replace(NBSP, " ") == texts


@given(st.sampled_from(list(KINDS)), st.floats(1e-6, 1e9), st.floats(1e-3, 1e6))
def test_ticks_are_few_round_and_on_the_scale(kind, low, width):
    """Each is 1, 2 or 5 times a power of ten, or a multiple of their common step, which is."""
    scale = ColorScale("viridis", low, low + width, kind, threshold=1.0 if kind == "symlog" else None)
    numbers = list(scale.ticks)
    assert 1 <= len(numbers) <= MOST_TICKS + 1
    assert numbers == sorted(set(numbers))
    assert low <= numbers[0] <= numbers[-1] <= low + width
    leading = {f"{number:.15e}"[0] for number in numbers if number}
    if kind in ("linear", "sqrt") and len(numbers) > 1:
        steps = np.diff(numbers)
        assert np.ptp(steps) <= 1e-9 * max(numbers)
        assert f"{steps[0]:.1e}"[:3] in ("1.0", "2.0", "5.0") or steps[0] < 1e-9 * max(numbers)
    elif kind == "log" and width > 9 * low:
        assert leading <= set("125")


@given(st.floats(-1e20, 1e20).filter(bool), st.sampled_from(list(KINDS)))
def test_what_is_written_is_the_number(number, kind):
    (text,) = written([number], kind)
    plain = text.replace(NBSP, "").replace("\N{MINUS SIGN}", "-").replace("·10", "e").translate(UNRAISED)
    for word, power in {"tn": 12, "bn": 9, "M": 6}.items():
        plain = plain.replace(word, f"e{power}")
    mantissa, _, power = plain.partition("e")
    if text.lstrip("\N{MINUS SIGN}")[:2] == "10" and text[-1] in RAISED:
        mantissa, power = plain[: plain.index("10")] + "1", plain[plain.index("10") + 2 :]
    assert float(f"{mantissa}e{power or 0}") == number


RAISED = "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"
UNRAISED = str.maketrans(RAISED, "-0123456789")


def test_numbers_stand_where_their_kind_says():
    """As matplotlib's norms have them; a symmetric logarithm is odd, linear up to its threshold, and has no kink."""
    np.testing.assert_allclose(ColorScale("magma", 0, 1000).place([0, 250, 2000, -1]), [0, 0.25, 1, 0])
    values = np.linspace(-1, 1, 20).reshape(4, 5)
    np.testing.assert_array_equal(ColorScale("magma", -1, 1)(values), colormaps["magma"](values / 2 + 0.5))
    assert np.array_equal(ColorScale("magma", 1, 10, "log")(0.0), colormaps["magma"](0.0))
    numbers = np.geomspace(2.0, 300.0, 50)
    np.testing.assert_allclose(ColorScale("magma", 2, 300, "log").place(numbers), LogNorm(2, 300)(numbers))
    np.testing.assert_allclose(ColorScale("magma", 0, 300, "sqrt").place(numbers), PowerNorm(0.5, 0, 300)(numbers))
    scale = ColorScale("magma", -1e4, 1e4, **SYMLOG)
    np.testing.assert_allclose(scale.place(numbers) + scale.place(-numbers), 1)
    np.testing.assert_allclose(np.diff(scale.place(np.linspace(-10, 10, 21))), np.diff(scale.place([0, 1]))[0])
    np.testing.assert_allclose(np.diff(scale.place([10, 100, 1000, 10000]), 2), 0, atol=1e-15)
    slopes = [np.diff(scale.place([at, at + 1e-6]))[0] for at in (10 - 2e-6, 10 + 1e-6)]
    assert slopes[0] == pytest.approx(slopes[1], rel=1e-6)


def test_colours_beside_a_centre_are_as_strong_on_both_sides():
    for scale, middle, one, other in (
        (ColorScale("RdBu_r", -2, 10, center=0), 0.0, 2.0, -2.0),
        (ColorScale("RdBu_r", 0.5, 8, "log", center=1), 1.0, 2.0, 0.5),
    ):
        np.testing.assert_allclose(scale(middle), colormaps["RdBu_r"](0.5))
        np.testing.assert_array_equal(scale(scale.high), colormaps["RdBu_r"](1.0))
        share = 0.5 * float(scale.place(one) - scale.place(middle)) / float(1 - scale.place(middle))
        np.testing.assert_allclose(scale([one, other]), colormaps["RdBu_r"]([0.5 + share, 0.5 - share]), atol=0.02)


def test_own_colours_and_missing_values():
    scale = ColorScale(["red", ("white", 0.5), "#0000ff"], 0, 2, missing="tan")
    np.testing.assert_allclose(
        scale([0, 1, 2, np.nan]), [to_rgba(c) for c in ("red", ("white", 0.5), "blue", "tan")], atol=0.01
    )
    np.testing.assert_array_equal(scale([[np.nan]]), [[to_rgba("tan")]])
    three = ColorScale.classes([1, 2, 3], [0, 1.5, 2.5, 4], colors=["tab:red", "tab:blue", "tab:green"])
    np.testing.assert_array_equal(
        three([1, 2, 3, -9, 9]), [to_rgba(f"tab:{c}") for c in ("red", "blue", "green", "red", "green")]
    )
    assert ColorScale(["red"], 0, 1)([0.3]).tolist() == [[1, 0, 0, 1]]


def spread(runs):
    """The sum of squared deviations from the means, exactly."""
    exact = [[Fraction(float(value)) for value in run] for run in runs]
    return sum(sum((value - sum(run) / len(run)) ** 2 for value in run) for run in exact)


@given(st.lists(st.integers(-30, 30) | st.sampled_from([0, 7]), min_size=3, max_size=9), st.integers(2, 5))
def test_natural_breaks_are_the_best_of_all_divisions(values, count):
    ordered = np.sort(np.array(values, dtype=float))
    count = min(count, len(set(values)))
    if count < 2:
        return
    begins = np.unique(ordered)[natural_breaks(ordered, count)]
    runs = np.split(ordered, np.searchsorted(ordered, begins))
    assert len(runs) == count
    assert all(map(len, runs))
    others = (np.split(ordered, ends) for ends in combinations(range(1, len(ordered)), count - 1))
    assert spread(runs) == min(map(spread, others))


@given(st.lists(st.floats(-1e6, 1e6), min_size=2, max_size=40), st.sampled_from(get_args(Scheme)), st.integers(1, 8))
def test_rounded_limits_leave_every_value_in_its_class(values, scheme, count):
    """Classes of quantiles are those of NumPy's quantiles, and no limit has more digits than it needs to be there."""
    numbers = np.array(values)
    if len(np.unique(numbers)) < 2 or np.ptp(numbers) < 1e-9 * np.abs(numbers).max():
        return
    scale = ColorScale.classes(numbers, scheme, count)
    edges = np.array(scale.edges)
    assert (edges[0], edges[-1]) == (numbers.min(), numbers.max())
    found = np.clip(np.searchsorted(edges, numbers, "right") - 1, 0, len(edges) - 2)
    if scheme == "quantiles":
        exact = np.unique(np.quantile(numbers, np.arange(1, count) / count))
        wanted = np.searchsorted(exact, numbers, "right")
        assert all(
            (found[a] < found[b]) == (wanted[a] < wanted[b]) for a in range(len(numbers)) for b in range(len(numbers))
        )
    if scheme == "equal":
        np.testing.assert_allclose(np.diff(edges), np.ptp(numbers) / count)
    else:
        assert set(found) == set(range(len(edges) - 1))
    np.testing.assert_array_equal(scale(numbers), scale((edges[:-1] + edges[1:])[found] / 2))


def test_classes_beside_a_centre():
    """Those that it parts have colours of its two sides, and one around it the middle colour."""
    shares = {(-3, -2, -1, 0, 5, 9): [1 / 14, 3 / 14, 5 / 14, 9 / 14, 11 / 14], (-4, -1, 1, 4, 9): [0.3, 0.5, 0.7, 0.9]}
    for limits, wanted in shares.items():
        scale = ColorScale.classes([], limits, colors="RdBu_r", center=0)
        middles = np.add(limits[1:], limits[:-1]) / 2
        np.testing.assert_array_equal(scale(middles), colormaps["RdBu_r"](wanted))


@given(st.lists(st.floats(1e-9, 1e12) | st.just(0.0), min_size=1), st.floats(1, 1e9))
def test_areas_are_true_to_amounts(amounts, high):
    scale = SizeScale(high, "8mm")
    np.testing.assert_allclose(scale(amounts) ** 2 * high, np.array(amounts) * (8 / 25.4 * 72) ** 2, rtol=1e-12)


def test_descriptions():
    classes = ColorScale.classes([1.0, 2.0, 3.0, 40.0], "quantiles", 2)
    assert classes.description == "colours of 2 classes (quantiles) with the limits 1, 3, 40"
    assert ColorScale("magma", 1, 2e6, "log").description == f"colours, logarithmic from 1 to 2{NBSP}M"
    assert "linear up to 10" in ColorScale("magma", -100, 100, **SYMLOG).description
    assert ColorScale("RdBu", -1, 1, center=0).description.endswith("centred on 0")
    assert ColorScale("magma", 0, 1, missing_key="none").description.endswith("; none in gray")


@pytest.mark.parametrize("width", [150.0, 240.0, 480.0])
def test_numbers_have_room_beside_each_other(width):
    """Whatever the width of the page: fewer are written below a bar that is too short."""
    values = np.geomspace(2.1e6, 19.3e6, 40)
    many = ColorScale.classes(values, "quantiles", 9)
    log = ColorScale("magma", 1e-3, 1e6, "log", missing_key="no value")
    page = with_legend(Page((0.0, 1.0, 0.0, 0.1), width=width), {"a": many, "b": log, "c": SizeScale(2e6, "3mm")})
    boxes = np.array([label_box(label, page.points_per_unit) for label in page.labels])
    assert len(boxes) > 12
    assert not any(meets(box, np.delete(boxes, k, axis=0)) for k, box in enumerate(boxes))


test_what_makes_no_scale_is_refused = refused(
    (ColorScale, ("viridis", 0.0, 1.0, "cubic"), "kind is 'cubic'"),
    (ColorScale, ("viridis", 0.0, 1.0, "symlog"), "kind is 'symlog' and threshold None; 'symlog' alone"),
    (ColorScale, ([], 0.0, 1.0), "colors is empty"),
    (ColorScale, (["red", "sky"], 0.0, 1.0), "colors is 'sky', which is not a colour"),
    (partial(ColorScale, "viridis", 0, 1), {"center": 2.0}, r"center is 2.0, outside \[0, 1\]"),
    (partial(ColorScale, "viridis", 0, 1), {"edges": [0, 1, 2]}, "edges lead from 0.0 to 2.0, not from 0 to 1"),
    (ColorScale.classes, ([1, 2], [3, 3]), "limits of classes are two or more numbers that increase"),
    (ColorScale.classes, ([1, 2], "jenks"), "scheme is 'jenks'"),
    (ColorScale.classes, ([1, 1, np.nan], "natural"), "values has no two different numbers"),
    (ColorScale.classes, ([1, 2], "equal", 0), "count is 0"),
    (ColorScale.of, ([-1, 0], None, "log"), "values has no positive number for a scale; give limits"),
    (partial(ColorScale.of, [1, 2]), {"kind": "log", "center": 0.0}, "center is 0.0, outside"),
    (SizeScale, (0.0,), "high is 0.0"),
    (SizeScale, (1.0, "2 km"), "largest is '2 km'; give a length"),
    (SizeScale(1.0), ([-1.0],), "amounts has -1; an area cannot be negative"),
    call=lambda make, arguments: make(**arguments) if isinstance(arguments, dict) else make(*arguments),
)
