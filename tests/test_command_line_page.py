"""The page on the command line and the README: their commands run, and print what they say."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
PAGES = ["docs/command_line.md", "docs/start.md", "README.md"]
SHELL = f"stereodel() {{ '{sys.executable}' -c 'from stereodel.cli import app; app()' \"$@\"; }}\n"


def tables(text):
    """The files that a page shows: their names, then their contents."""
    return dict(re.findall(r"`([\w.]+\.csv)`:\n\n```text\n(.*?)```", text, re.DOTALL))


def sessions(text):
    """Each command that calls `stereodel`, and what it prints."""
    blocks = re.findall(r"```console\n(.*?)```", text, re.DOTALL)
    lines = [part for block in blocks for part in re.split(r"^\$ ", block, flags=re.MULTILINE)[1:]]
    return [line.split("\n", 1) for line in lines if "stereodel " in line]


def words(text):
    """Lines of fields, fractions to nine digits: processors differ in the last ones."""
    lines = (re.split(r"([, ])", line) for line in text.splitlines())
    return [[f"{float(word):.9g}" if re.fullmatch(r"-?\d+\.\d+", word) else word for word in line] for line in lines]


def pages():
    for page in PAGES:
        for command, printed in sessions((ROOT / page).read_text(encoding="utf-8")):
            yield pytest.param(page, command, printed, id=command)


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
    out = re.search(r"-o ([\w.]+)", command)
    assert "error:" in printed or out is None or (tmp_path / out[1]).stat().st_size > 0


def test_the_page_shows_every_command():
    from stereodel.cli import app

    text = (ROOT / "docs" / "command_line.md").read_text(encoding="utf-8")
    assert [command.name for command in app.registered_commands] == re.findall(r"^\| `(\w+)` \|", text, re.MULTILINE)
