"""The page on the command line and the README: their commands run, and print what they say."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from tools.page_commands import sessions, tables, words, written

ROOT = Path(__file__).resolve().parent.parent
PAGES = ["docs/command_line.md", "docs/start.md", "README.md"]
BY_DAY = ["stereodel voronoi cities.csv -o -"]
"""The others draw pictures, or ask of one command more what tests/cli asks of it."""

SHELL = f"stereodel() {{ '{sys.executable}' -c 'from stereodel.cli import app; app()' \"$@\"; }}\n"


def pages():
    for page in PAGES:
        for command, printed in sessions((ROOT / page).read_text(encoding="utf-8")):
            day = command in BY_DAY and page == "README.md"
            yield pytest.param(page, command, printed, id=command, marks=[] if day else pytest.mark.thorough)


@pytest.mark.parametrize(("page", "command", "printed"), list(pages()))
def test_commands_print_what_the_page_says(tmp_path, page, command, printed):
    for name, content in tables((ROOT / page).read_text(encoding="utf-8")).items():
        (tmp_path / name).write_text(content, encoding="utf-8")
    ran = subprocess.run(
        ["bash", "-c", SHELL + command],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )
    assert words(ran.stdout) == words(printed)
    out = written(command)
    assert "error:" in printed or out is None or (tmp_path / out).stat().st_size > 0


def test_the_page_shows_every_command():
    from stereodel.cli import app

    text = (ROOT / "docs" / "command_line.md").read_text(encoding="utf-8")
    assert [command.name for command in app.registered_commands] == re.findall(r"^\| `(\w+)` \|", text, re.MULTILINE)
