"""`stereodel partition`: points in files, results in a folder; and signs of progress, on a terminal alone."""

import io
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from stereodel import SphericalVoronoi
from stereodel.cli import app, interpolate
from stereodel.cli.application import reporting, say
from stereodel.partitioned import Run


@pytest.fixture
def points(rng, folder):
    """Two files of points and one of the plane; the places of the first two."""
    (folder / "points").mkdir()
    lonlat = np.column_stack([rng.uniform(-180, 180, 300), rng.uniform(-80, 80, 300)])
    for number, rows in enumerate((slice(0, 200), slice(200, 300))):
        lon, lat = lonlat[rows].T
        pq.write_table(pa.table({"lon": lon, "lat": lat, "id": lon.argsort()}), folder / "points" / f"{number}.parquet")
    pq.write_table(pa.table({"east": rng.normal(size=60), "north": rng.normal(size=60)}), folder / "plane.parquet")
    return lonlat


FILES = ["points/0.parquet", "points/1.parquet"]


@pytest.mark.parametrize("given", [FILES, ["points"], ["points/*.parquet"]])
def test_areas_are_those_of_all_points(folder, points, run, given):
    assert run("partition", *given, "-o", "cells/", "--partition", 100) == ""
    table = Run(folder / "cells").rows().to_table()
    assert table.column_names == ["area", "degree", "nearest", "distance", "kept"]
    assert table["area"].to_pylist() == SphericalVoronoi.from_lonlat(points, latitude="authalic").areas().tolist()
    assert sorted(path.name for path in (folder / "cells").iterdir() ) == [
        ".lock", "files.parquet", "plan.json", "rows", "run.json"
    ]  # fmt: skip


def test_options_of_a_folder(folder, points, run):
    run("partition", *FILES, "-o", "cells/", "--keep", "id", "--shapes", "--latitude", "spherical")
    found = Run(folder / "cells")
    assert found.rows().schema.names[0] == "id"
    assert found.cells().count_rows() == 300
    run("partition", "plane.parquet", "--plane", "east", "north", "-o", "plane/")
    assert Run(folder / "plane").statistics["triangles"] > 60
    run("partition", *FILES, "--lon", "lon", "--lat", "lat", "-o", "named/")


def test_another_input_is_not_mixed_with_what_is_there(folder, points, run):
    run("partition", FILES[0], "-o", "cells/")
    message = run("partition", FILES[1], "-o", "cells/", code=2)
    assert "has a run of other files or arguments" in message
    assert message.endswith("take another folder, or begin anew with --overwrite\n")
    run("partition", FILES[1], "-o", "cells/", "--overwrite")
    assert Run(folder / "cells").statistics["points"] == 100


def test_an_interruption_keeps_what_is_done(folder, points, run, monkeypatch):
    """The same command goes on, with what was solved."""
    from stereodel.partitioned import passes
    from stereodel.partitioned import run as running

    with monkeypatch.context() as patch:
        patch.setattr(passes, "_write_files", lambda store: (_ for _ in ()).throw(KeyboardInterrupt))
        message = run("partition", *FILES, "-o", "cells/", "--partition", 100, code=130)
    assert message == "interrupted; what is done is kept, and the same command goes on from there\n"
    solved = []
    monkeypatch.setattr(running, "solve", lambda *arguments, **options: solved.append(arguments))
    run("partition", *FILES, "-o", "cells/", "--partition", 100)
    assert solved == []
    assert Run(folder / "cells").statistics["points"] == 300


class Terminal(io.StringIO):
    """What takes stderr for a terminal."""

    def isatty(self):
        return True


def terminal(monkeypatch):
    """A terminal for stderr, which pytest puts in place anew before each test."""
    stream = Terminal()
    monkeypatch.setattr("sys.stderr", stream)
    for name, value in (("TERM", "xterm"), ("COLUMNS", "100")):
        monkeypatch.setenv(name, value)
    for name in ("NO_COLOR", "FORCE_COLOR", "TTY_COMPATIBLE", "TTY_INTERACTIVE"):
        monkeypatch.delenv(name, raising=False)
    return stream


@pytest.mark.parametrize(
    ("stages", "done", "of", "said"),
    [(["drawing cells"], 100, 400, "25%"), (["drawing cells"], 400, 400, "100%"), ([], 12, 12, "12/12")],
)
def test_a_bar_tells_the_share_and_passes_are_counted(monkeypatch, stages, done, of, said):
    stream = terminal(monkeypatch)
    with reporting(*stages) as told:
        told("solve", 0, of)
        told("solve", done, of)
    assert (*stages, "solve")[0] in stream.getvalue()
    assert said in stream.getvalue()


@pytest.mark.parametrize("piece", [2, 5, 7])
def test_values_come_in_pieces(monkeypatch, tmp_path, piece):
    """Of the same values as all at once, the last piece shorter than the others."""
    monkeypatch.setattr(interpolate, "PIECE", piece)
    stream = terminal(monkeypatch)
    names = [str(tmp_path / name) for name in ("three.csv", "at.csv", "out.csv")]
    Path(names[0]).write_text("x,y,t\n0,0,0\n1,0,1\n0,1,2\n", encoding="utf-8")
    queries = np.linspace(0.0, 0.4, 10).reshape(5, 2)
    np.savetxt(names[1], queries, delimiter=",", header="x,y", comments="")
    table = ["--plane", "x", "y", "--value", "t"]
    app(["interpolate", names[0], *table, "--at", names[1], "-o", names[2]], standalone_mode=False)
    assert np.loadtxt(names[2], delimiter=",", skiprows=1)[:, 2] == pytest.approx(queries @ [1, 2])
    assert "interpolating" in stream.getvalue()
    assert "100%" in stream.getvalue()


def test_elsewhere_all_is_silent(monkeypatch):
    stream = io.StringIO()
    monkeypatch.setattr("sys.stderr", stream)
    with reporting("reading") as shown, reporting() as told:
        shown("reading", 1, 2)
        told("solve", 1, 12)
    say("done")
    assert stream.getvalue() == ""
