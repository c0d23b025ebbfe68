"""Lengths with units."""

import pytest

from stereodel.drawing.lengths import as_length


@pytest.mark.parametrize(
    ("given", "points"),
    [
        (10, 10),
        (2.5, 2.5),
        ("10", 10),
        ("10pt", 10),
        ("1in", 72),
        ("25.4 mm", 72),
        ("2.54CM", 72),
        (" 1e1 mm ", 28.3465),
    ],
)
def test_lengths(given, points):
    assert as_length(given, "width") == pytest.approx(points, rel=1e-5)


@pytest.mark.parametrize(
    "given", ["", "cm", "1 ell", "-1cm", "0mm", "1.2.3cm", "1cm2", 0, -1, float("nan"), float("inf")]
)
def test_what_is_none(given):
    with pytest.raises(ValueError, match=r"^width is "):
        as_length(given, "width")
