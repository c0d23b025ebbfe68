"""Points whose runs have several tasks in each pass."""

import pytest

from tests.partitioned.answers import Points


@pytest.fixture
def points(tmp_path, monkeypatch):
    monkeypatch.setattr("stereodel.partitioned.plan.LEAST_SHARE", 1)
    return Points(tmp_path)
