"""The machinery of the benchmarks: engines and their limits, rounds, tables; with engines made for the test."""

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
from benchmarks import pages, processes, rounds  # noqa: E402
from benchmarks.engines import stereodel  # noqa: E402
from benchmarks.peers.python_peer import high_water  # noqa: E402
from benchmarks.processes import Engine, StoppedError, Watch  # noqa: E402
from benchmarks.rounds import Entry, take_turns  # noqa: E402

MEASURED = re.compile(r"(<!-- measured: [^>]*-->\n).*?(<!-- end)", re.DOTALL)
ANSWERS = """
import json, sys, time
print("a library greets")
print(json.dumps({"version": "7"}), flush=True)
held = []
for line in sys.stdin:
    word, calls = line.split()
    if word == "fail":
        sys.exit("no such luck in /a/folder/file")
    if word == "hold":
        held.append(bytearray(b"x" * 80_000_000))
    if word == "sleep":
        time.sleep(0.5)
    seconds = [0.5 if word == "sleep" else 0.02] * int(calls)
    print(json.dumps({"seconds": seconds, "points": 3, "triangles": 1, "peak": sum(map(len, held)), "more": 1}))
    sys.stdout.flush()
"""
ENGINE = [sys.executable, "-c", ANSWERS]


def test_an_engine_answers_and_other_words_are_passed_over():
    with Engine(ENGINE) as engine:
        answer = engine.run(4)
    assert (engine.version, answer) == ("7", {"seconds": [0.02] * 4, "points": 3, "triangles": 1, "peak": 0, "more": 1})


@pytest.mark.parametrize(
    ("word", "said"), [("fail", "no such luck in file"), ("sleep", "over 0 s"), ("hold", "over 0 GB")]
)
def test_an_engine_that_fails_or_passes_a_limit_is_stopped(monkeypatch, word, said):
    monkeypatch.setattr(processes, "SECONDS", 0.3)
    monkeypatch.setattr(processes, "BYTES", 50_000_000)
    with Engine(ENGINE) as engine, pytest.raises(StoppedError, match=said):
        engine.run(1, word)


def test_rounds_repeat_short_calls_and_keep_what_stopped(monkeypatch):
    results = take_turns([Entry("a", ENGINE), Entry("b", ENGINE, "fail"), Entry("c", ENGINE)], 3)
    assert results["a"].seconds == [0.02] * 3
    assert results["b"].record() == {"stopped": "no such luck in file", "version": "7"}
    for limit, calls in {"LONG": 3, "SLOW": 1}.items():  # in seconds: those that take longer are called less often
        monkeypatch.setattr(rounds, limit, 0.01)
        assert len(take_turns([Entry("a", ENGINE)], 5)["a"].seconds) == calls


@pytest.mark.parametrize(("space", "dimension"), [pytest.param("plane", 2, marks=pytest.mark.thorough), ("sphere", 3)])
def test_stereodel_takes_part(tmp_path, space, dimension):
    generator = np.random.default_rng(3)
    sets = [tmp_path / "points", tmp_path / "more"]
    for path, n in zip(sets, (4000, 3000), strict=True):
        generator.standard_normal((n, dimension)).tofile(path)
    with Engine([*stereodel(space, 1), *map(str, sets)]) as engine:
        assert engine.run(2)["points"] == engine.run(1, "bare")["points"] == 4000
        for word, points in (("find", 4000), ("nearest", 4000), ("insert", 5000), ("changed", 6000), ("remove", 5000)):
            answer = engine.run(1, word)
            assert (answer["points"], len(answer["seconds"])) == (points, 1)


def test_ratios_pair_the_rounds():
    rounds = {"cgal": [2.0, 6.0, 1.5], "ours 1": [1.0, 2.0, 1.5, 9.0], "scipy": [35.0]}
    record = {name: {"rounds": seconds} for name, seconds in rounds.items()}
    assert pages.faster(record, "cgal", "ours 1") == "2×"
    assert pages.faster(record, "scipy", "ours 1") == "20×"
    assert pages.faster(record | {"cgal": {"stopped": "over 60 s"}}, "cgal", "ours 1") == "–"


def test_memory_is_that_of_each_process_alone(tmp_path):
    """Not of the one that started it, whose memory `getrusage` counts."""
    held = np.ones(50_000_000)
    with Watch(tmp_path) as watch:
        (tmp_path / "file").write_bytes(b"x" * 1000)
        subprocess.run([sys.executable, "-c", "import time; x = b'x' * 20_000_000; time.sleep(0.5)"], check=True)
    found = watch.found()
    assert 20 < found["own_mb"] <= found["rss_mb"] < 300
    assert found["cpu"] > 0
    assert found["scratch_bytes"] == 1000
    assert high_water() > held.nbytes


def test_the_pages_are_written_from_the_results(monkeypatch, tmp_path):
    """Each is what is tracked, and the plots are those that the pages show."""
    docs = tmp_path / "docs"
    (docs / "images").mkdir(parents=True)
    shown = {"../paper/paper.md", *(page for page, _ in pages.PAGES.values())}
    (tmp_path / "paper").mkdir()
    for page in shown:
        text = (ROOT / "docs" / page).read_text(encoding="utf-8")
        (docs / page).write_text(re.sub(MEASURED, r"\1\2", text), encoding="utf-8")
    monkeypatch.setattr(pages, "DOCS", docs)
    for name in pages.PAGES:
        pages.write(name)
    for page in shown:
        assert (docs / page).read_text(encoding="utf-8") == (ROOT / "docs" / page).read_text(encoding="utf-8")
    for plot in (docs / "images").iterdir():
        assert f"images/{plot.name}" in (docs / "benchmarks.md").read_text(encoding="utf-8")
