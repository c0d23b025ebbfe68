"""Ctrl-C at any time: one line, exit code 130, and no trace of the command."""

import os
import signal
import subprocess
import sys
import time

import pytest

from tests.tiers import by_day

# Whoever runs the tests in the background has SIGINT ignored, and programs inherit that.
PROGRAM = """
import signal
signal.signal(signal.SIGINT, signal.default_int_handler)
from stereodel.__main__ import main
import os
os.write(1, b"x")
main()
"""
EVERY = {
    "triangulate": ["triangulate", "many.csv", "-o", "out.gpkg"],
    "voronoi": ["voronoi", "many.csv", "-o", "out.parquet"],
    "interpolate": ["interpolate", "many.csv", "--value", "v", "--grid", "0.25", "--method", "natural", "-o", "out.nc"],
    "contour": ["contour", "many.csv", "--value", "v", "--interval", "0.01", "-o", "out.geojson"],
    "nearest": ["nearest", "many.csv", "--of", "many.csv", "-k", "9", "-o", "out.fgb"],
    "doctor": ["doctor"],
    "globe": ["globe", "many.csv", "--size", "3000", "-o", "out.svg"],
}


@pytest.fixture
def many(folder):
    """Two hundred thousand points, which no command is done with at once."""
    rows = [f"{(k * 137.50776405) % 360 - 180:.6f},{(k * 0.00087 + 3) % 170 - 85:.6f},{k % 97}" for k in range(200_000)]
    (folder / "many.csv").write_text("\n".join(["lon,lat,v", *rows]), encoding="utf-8")
    return folder


def not_ended_before(folder, arguments, seconds):
    """Start a command and interrupt it so long after its own first step, if it was not done before."""
    before = sorted(folder.iterdir())
    program = [sys.executable, "-c", PROGRAM, *arguments]
    with subprocess.Popen(program, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        process.stdout.read(1)
        time.sleep(seconds)
        process.send_signal(signal.SIGINT)
        _, said = process.communicate(timeout=120)
    if process.returncode != 0:
        assert (process.returncode, said) == (130, b"interrupted; nothing was written\n")
        assert sorted(folder.iterdir()) == before
    return process.returncode != 0


TIMES = [(command, seconds) for command in EVERY for seconds in (0.02, 0.9)]


@pytest.mark.parametrize(("command", "seconds"), by_day(TIMES, ("voronoi", 0.9), ("doctor", 0.02)))
def test_every_command(many, command, seconds):
    assert not_ended_before(many, EVERY[command], seconds)


PARSING = """
from stereodel.cli.application import Commands
WHOLE = Commands.make_context
def make_context(self, *arguments, **options):
    os.kill(os.getpid(), signal.SIGINT)
    return WHOLE(self, *arguments, **options)
Commands.make_context = make_context
"""


def test_while_arguments_are_parsed(folder):
    """Typer itself would end without a message."""
    program = PROGRAM.replace('os.write(1, b"x")', PARSING)
    ran = subprocess.run([sys.executable, "-c", program, "doctor"], cwd=folder, capture_output=True, check=False)
    assert (ran.returncode, ran.stdout, ran.stderr) == (130, b"", b"interrupted; nothing was written\n")


@pytest.mark.thorough
def test_temporary_folders_go_too(many, monkeypatch, tmp_path):
    """What a library writes first is elsewhere, and is gone with the command."""
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    monkeypatch.setenv("TMPDIR", str(elsewhere))
    assert not_ended_before(many, EVERY["voronoi"], 2.0)
    assert os.listdir(elsewhere) == []
