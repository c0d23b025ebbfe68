"""Settings of all tests."""

import os
import sys
from pathlib import Path

import pytest
from hypothesis import settings

# `benchmarks` and `tools` are folders of the repository and not installed.
sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

# No deadline: the first call of a test may load a library or meet a busy machine. In CI the same examples every time.
settings.register_profile("stereodel", deadline=None, derandomize=bool(os.environ.get("CI")))
settings.load_profile("stereodel")


@pytest.fixture
def patience():
    """By what limits on seconds are multiplied: the kernel with sanitizers is several times as slow."""
    return float(os.environ.get("STEREODEL_TEST_PATIENCE", "1"))


@pytest.fixture
def no_other_fonts(monkeypatch):
    """As if the machine had no fonts but those that matplotlib ships."""
    from stereodel.drawing import fonts

    monkeypatch.setattr(fonts, "_others", list)
    for kept in (fonts._families, fonts._supplements):
        kept.cache_clear()
    yield
    for kept in (fonts._families, fonts._supplements):
        kept.cache_clear()


STORED = Path(__file__).resolve().parent / "images" / "baselines"
"""Pictures of the image tests; the source archive has none."""

REPOSITORY = Path(__file__).resolve().parent.parent / ".git"
"""What git tracks is read as text; the source archive has no repository."""

collect_ignore = []
if not REPOSITORY.exists():
    collect_ignore += ["test_tracked_text.py"]
if not STORED.is_dir():
    collect_ignore += [f"images/test_{name}.py" for name in ("figures", "mutations", "renderer_mutations")]

WEB_SWITCH = "STEREODEL_TEST_WEB"
"""Where this variable of the environment is "off", tests that need a browser or Node are left out."""


def pytest_terminal_summary(terminalreporter):
    """Say what was switched off, so that nobody takes a run without it for a whole one."""
    if os.environ.get(WEB_SWITCH) == "off":
        terminalreporter.section("switched off")
        terminalreporter.line(f"The tests of the interactive page were left out, because {WEB_SWITCH}=off.")
    if not REPOSITORY.exists():
        terminalreporter.section("no repository")
        terminalreporter.line("The text of tracked files was not checked: there is no repository that tracks any.")
    if not STORED.is_dir():
        terminalreporter.section("no stored pictures")
        terminalreporter.line(
            "Pictures were not compared: the source archive has none to compare with, the repository has them."
        )
