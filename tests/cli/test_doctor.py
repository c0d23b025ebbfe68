"""The command `stereodel`: what it prints and its exit codes, also where nothing can draw."""

import os
import subprocess
import sys
from importlib.metadata import version

import pytest
from typer.testing import CliRunner

import stereodel
from stereodel import _doctor as doctor
from stereodel import _extras
from stereodel._extras import EXTRAS, installing
from stereodel.cli import app
from stereodel.render import gl

run = CliRunner().invoke


def test_version():
    ran = run(app, ["--version"])
    assert ran.exit_code == 0
    assert ran.stdout.strip() == f"stereodel {stereodel.__version__}"


@pytest.mark.parametrize("platform", ["osmesa", pytest.param("egl", marks=pytest.mark.thorough)])
def test_doctor_tells_what_draws(platform):
    """In a process of its own: a process draws on one platform only."""
    kept = {name: value for name, value in os.environ.items() if name != "PYOPENGL_PLATFORM"}
    line = [sys.executable, "-c", "from stereodel.cli import app; app(['doctor'])"]
    ran = subprocess.run(line, env={**kept, "STEREODEL_GL": platform}, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stdout + ran.stderr
    assert f"{platform} (STEREODEL_GL)" in ran.stdout
    assert "Mesa" in ran.stdout
    rows = [line.split() for line in ran.stdout.splitlines()]
    assert [row for row in rows if row[:1] in (["osmesa"], ["egl"])] == [["osmesa", "draws"], ["egl", "draws"]]
    assert ["numpy", version("numpy")] in rows
    for name, extra in EXTRAS.items():
        (row,) = [row for row in rows if row[:1] == [name]]
        assert row[1] == "works"
        assert " ".join(row[2:]) == ", ".join(f"{each.name} {version(each.name)}" for each in extra.brings)
    assert ran.stdout.splitlines()[-1] == "Ready: globes can be drawn."


@pytest.mark.parametrize(
    ("platform", "opens", "said"),
    [
        ("metal", True, ["STEREODEL_GL is 'metal'", "osmesa draws: set STEREODEL_GL=osmesa"]),
        ("", False, ["nothing", "apt-get install libosmesa6"]),
    ],
)
def test_doctor_says_how_to_get_what_is_missing(monkeypatch, platform, opens, said):
    monkeypatch.setenv("STEREODEL_GL", platform)
    monkeypatch.setattr(gl, "can_open", lambda platform: opens)
    monkeypatch.setattr(doctor, "_tried", lambda name: gl.Description(name, gl.VARIABLE))
    ran = run(app, ["doctor"])
    assert ran.exit_code == 1
    assert all(each in ran.stdout for each in said), ran.stdout


@pytest.mark.parametrize(
    ("trial", "problem"),
    [
        ("import os; os.kill(os.getpid(), 11)", "the process that drew on osmesa ended with code -11"),
        ("raise OSError('no memory')", "the process that drew on osmesa ended with code 1: OSError: no memory"),
        ("import time; time.sleep(60)", "osmesa has drawn nothing in 0.5 seconds"),
    ],
)
def test_doctor_outlives_what_draws(monkeypatch, trial, problem):
    monkeypatch.setattr(doctor, "TRIAL", trial)
    monkeypatch.setattr(doctor, "SECONDS", 0.5 if "sleep" in trial else 60)
    monkeypatch.setenv("STEREODEL_GL", "osmesa")
    ran = run(app, ["doctor"])
    assert ran.exit_code == 1
    assert f"Globes cannot be drawn as PNG: {problem}" in ran.stdout
    assert "osmesa         does not draw\n" in ran.stdout


def test_doctor_names_missing_libraries(monkeypatch):
    """What is not needed for globes is said and no failure."""
    found = _extras.find_spec
    monkeypatch.setattr(_extras, "find_spec", lambda name: None if name == "shapely" else found(name))
    monkeypatch.setattr(doctor, "tried", lambda: {name: gl.Description(name, gl.VARIABLE) for name in gl.PLATFORMS})
    ran = run(app, ["doctor"])
    assert ran.exit_code == 0
    (row,) = [line.strip() for line in ran.stdout.splitlines() if " lacks " in line]
    assert row.startswith("geo ")
    assert row.split("lacks")[1].strip() == f"shapely, for {EXTRAS['geo'].purpose}: {installing('geo')}"
