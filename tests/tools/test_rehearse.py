"""What ends a rehearsal of a release before anything is compiled: versions, tags and notes that do not fit."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

pytestmark = pytest.mark.thorough  # what only a release needs

ROOT = Path(__file__).resolve().parents[2]
FILES = [
    *("tools/rehearse.sh", "tools/shell.sh", "tools/release_notes.sh", "stereodel/__init__.py", "CHANGELOG.md"),
    *("CITATION.cff", "conda/recipe.yaml", "stereodel/web/script/package.json"),
]


@pytest.mark.parametrize(
    ("file", "tag", "said"),
    [
        (None, "v9.8.7", "the tag is v9.8.7, but the version of stereodel/__init__.py is "),
        *((name, None, f"the version of {name} is not ") for name in FILES[5:]),
        ("CHANGELOG.md", None, "CHANGELOG.md has nothing under the heading [Unreleased]"),
    ],
)
def test_what_does_not_fit_is_said(tmp_path, file, tag, said):
    for name in FILES:
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, tmp_path / name)
    if file:
        text = (tmp_path / file).read_text(encoding="utf-8")
        (tmp_path / file).write_text(text.replace("ersion", "").replace("[Unreleased]", "[1.0]"), encoding="utf-8")
    git = ("git", "-c", "user.name=a", "-c", "user.email=a")
    for line in (["init", "-q"], ["commit", "-q", "--allow-empty", "-m", "a"], *([["tag", tag]] if tag else [])):
        subprocess.run([*git, *line], cwd=tmp_path, check=True)
    line = [tmp_path / "tools" / "rehearse.sh", "."]
    ran = subprocess.run(line, env={**os.environ, "HOME": str(tmp_path)}, capture_output=True, text=True, check=False)
    assert ran.returncode == 1
    assert said in ran.stderr
