"""The experiment about flat regions: its bounds hold, and it finds what its page says."""

import pytest

from benchmarks import flat_regions


@pytest.fixture(autouse=True)
def small(monkeypatch):
    monkeypatch.setattr(flat_regions, "CLUSTERS", 2)
    monkeypatch.setattr(flat_regions, "PER_CLUSTER", 500)


@pytest.mark.parametrize("family", flat_regions.FAMILIES)
def test_no_bound_is_broken(family):
    for size in flat_regions.SIZES[2::6]:
        row = flat_regions.measure(family, size)
        assert 990 <= row["tests"] <= 1000
        assert [row[f"{method} proved wrong"] for method in flat_regions.METHODS] == [0] * 4


def share(family, size, name):
    row = flat_regions.measure(family, min(flat_regions.SIZES, key=lambda s: abs(s / size - 1)))
    return row[name] / row["tests"]


def test_the_claim_holds_for_a_region_that_is_small_as_a_whole():
    for size in (1e-8, 1e-14):
        assert share("random", size, "plain open") == 1
        assert share("random", size, "plain wrong") > 0.3
        assert share("random", size, "lifted open") == share("random", size, "curvature open") == 0


def test_the_lift_does_not_help_points_close_together_within_a_larger_region():
    assert share("within", 1e-10, "lifted open") == 1
    assert share("within", 1e-10, "lifted wrong") > 0.4
    assert share("within", 1e-10, "curvature open") == 0


def test_spoilt_ties_are_decided_on_small_circles_only():
    assert share("circle", 1e-6, "plain open") == 1
    assert share("circle", 1e-6, "curvature open") < 0.01
    assert share("circle", 1, "curvature open") > 0.9
