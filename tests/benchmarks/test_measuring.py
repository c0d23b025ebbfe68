"""The machinery of the benchmarks: engines and their limits, rounds, tables; with engines made for the test."""

import json
import re
import sys
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
from benchmarks import benchmark_asked, benchmark_page, pages, processes, rounds  # noqa: E402
from benchmarks.engines import stereodel  # noqa: E402
from benchmarks.processes import Engine, StoppedError  # noqa: E402
from benchmarks.rounds import Entry, take_turns  # noqa: E402

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
    assert (engine.version, answer.seconds, answer.points, answer.triangles) == ("7", [0.02] * 4, 3, 1)
    assert answer.extra == {"more": 1}


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
    assert rounds.ratios(results["a"], results["c"]) == [1.0] * 3
    assert rounds.ratios(results["a"], results["b"]) == []
    for limit, calls in {"LONG": 3, "SLOW": 1}.items():  # in seconds: those that take longer are called less often
        monkeypatch.setattr(rounds, limit, 0.01)
        assert len(take_turns([Entry("a", ENGINE)], 5)["a"].seconds) == calls


@pytest.mark.parametrize(("space", "dimension"), [pytest.param("plane", 2, marks=pytest.mark.thorough), ("sphere", 3)])
def test_stereodel_takes_part(tmp_path, space, dimension):
    generator = np.random.default_rng(3)
    sets = [tmp_path / "points", tmp_path / "more"]
    for path, n in zip(sets, (4000, 3000), strict=True):
        generator.standard_normal((n, dimension)).tofile(path)
    with Engine(stereodel(space, 1, str(sets[1]))(str(sets[0]))) as engine:
        assert engine.run(2).points == engine.run(1, "bare").points == 4000
        for word, points in (("find", 4000), ("nearest", 4000), ("insert", 5000), ("changed", 6000), ("remove", 5000)):
            answer = engine.run(1, word)
            assert (answer.points, len(answer.seconds)) == (points, 1)


def test_figures_know_whether_they_are_reached():
    fast = benchmark_asked.Figure("speed", 2.0, [1.5, 2.5, 3.0], "×", at_least=True)
    small = benchmark_asked.Figure("memory", 200, [201.0], " bytes")
    assert fast.row() == ["speed", "≥ 2×", "2.5× (1.5–3)", "yes"]
    assert small.row() == ["memory", "≤ 200 bytes", "201 bytes", "**no**"]
    assert benchmark_asked.Figure("speed", 2.0, [], "×").row()[2] == "not measured"


def test_ratios_pair_the_rounds():
    record = {
        "cgal": {"rounds": [2.0, 6.0, 1.5]},
        "ours 1": {"rounds": [1.0, 2.0, 1.5, 9.0]},
        "scipy": {"rounds": [35.0]},
    }
    assert benchmark_asked.faster(record, "cgal", "ours 1") == [2.0, 3.0, 1.0]
    assert benchmark_asked.faster(record, "scipy", "ours 1") == [20.0]
    assert benchmark_asked.faster(record | {"cgal": {"stopped": "over 60 s"}}, "cgal", "ours 1") == []


def test_the_page_is_written_from_the_results(monkeypatch, tmp_path):
    docs = tmp_path / "docs"
    (docs / "images").mkdir(parents=True)
    page = docs / "benchmarks.md"
    paper = tmp_path / "paper" / "paper.md"
    paper.parent.mkdir()
    paper.write_bytes((ROOT / "paper" / "paper.md").read_bytes())
    text = (ROOT / "docs" / "benchmarks.md").read_text(encoding="utf-8")
    page.write_text(
        re.sub(r"(<!-- measured: [^>]*-->\n).*?(<!-- end)", r"\1\2", text, flags=re.DOTALL), encoding="utf-8"
    )
    monkeypatch.setattr(pages, "DOCS", docs)
    benchmark_page.write(json.loads((ROOT / "benchmarks" / "results.json").read_text(encoding="utf-8")))
    written = page.read_text(encoding="utf-8")
    assert not re.search(r"<!-- measured: [^>]*-->\n<!-- end", written)
    assert "| stereodel, one thread |" in written
    assert paper.read_bytes() == (ROOT / "paper" / "paper.md").read_bytes()
    assert {path.name for path in (docs / "images").iterdir()} == set(re.findall(r"\{image\} images/(\S+)", text))
