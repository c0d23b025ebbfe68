"""Progress elsewhere than on a terminal; bars are tested with the command, `tests/cli/test_partition.py`."""

import pytest

from stereodel._tasks import progress


def test_lines_are_said_now_and_then_and_at_the_end_of_each_stage(monkeypatch, capsys):
    now = iter(range(0, 1000, 3))
    monkeypatch.setattr(progress.time, "monotonic", lambda: next(now))
    with progress.reporting(lines=True) as told:
        for stage, count in (("drawing", 7), ("writing", 2)):
            for done in range(1, count + 1):
                told(stage, done, count)
    assert capsys.readouterr().err.splitlines() == ["drawing 4/7 (12 s)", "drawing 7/7 (21 s)", "writing 2/2 (27 s)"]


@pytest.mark.parametrize("wanted", [{}, {"shown": False}, {"shown": False, "lines": True}])
def test_nothing_is_said_where_nothing_is_wanted(capsys, wanted):
    with progress.reporting(**wanted) as told:
        told("drawing", 1, 1)
    assert capsys.readouterr().err == ""
