"""The benchmark of files of cells, on a few points."""

import pytest

from benchmarks.map_files import FORMATS, measure, table


@pytest.mark.thorough
@pytest.mark.parametrize("kind", ["parquet", "fgb"])
def test_a_format_is_measured_in_a_process_of_its_own(kind):
    row = measure(kind, 100)
    assert row["seconds"] > 0
    assert row["busy"] > 0
    assert 30e6 < row["peak"] < 4e9  # sanitizers take two
    head, rule, line = table([row]).splitlines()
    assert line.startswith(f"| {FORMATS[kind]} | ")
    assert head.count("|") == rule.count("|") == line.count("|")
