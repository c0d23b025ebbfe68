"""The comparison of two kernels: in turn, by least times, and only if they answer the same."""

from pathlib import Path

import pytest

from benchmarks import compilers


def said(bits, seconds):
    return {"bits": bits, "triangulation": seconds}


def test_least_times_are_taken_in_turn(monkeypatch):
    asked = []

    def run(folder, points):
        asked.append(folder.name)
        return said("0", 2.0 - 0.1 * len(asked))

    monkeypatch.setattr(compilers, "run", run)
    least = compilers.measure({"own": Path("own"), "zig": Path("zig")}, points=10, rounds=2)
    assert asked == ["own", "zig", "zig", "own"]
    assert least == {"own": {"triangulation": pytest.approx(1.6)}, "zig": {"triangulation": pytest.approx(1.7)}}


def test_other_bits_are_an_error(monkeypatch):
    monkeypatch.setattr(compilers, "run", lambda folder, points: said(folder.name, 1.0))
    with pytest.raises(RuntimeError, match="same to the last bit"):
        compilers.measure({"own": Path("own"), "zig": Path("zig")}, rounds=1)


@pytest.mark.thorough
def test_a_process_imports_the_package_that_it_is_given(tmp_path):
    assert {"triangulation, sphere", "triangulation, plane", "bits"} <= compilers.run(
        compilers.HERE.parent, 1000
    ).keys()
    with pytest.raises(RuntimeError, match="not the one that was imported"):
        compilers.run(tmp_path, 1000)
