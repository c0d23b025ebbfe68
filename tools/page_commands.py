"""The commands and the code that a page shows, run in order: what they print is what the page says.

python -m tools.page_commands PAGE FOLDER    run them in a folder; 1 if something else comes out
"""

from __future__ import annotations

import contextlib
import io
import re
import subprocess
import sys
from pathlib import Path


def sessions(text: str) -> list[tuple[str, str]]:
    """Each command that calls `stereodel`, and what it prints."""
    blocks = re.findall(r"```console\n(.*?)```", text, re.DOTALL)
    lines = [part for block in blocks for part in re.split(r"^\$ ", block, flags=re.MULTILINE)[1:]]
    return [(line[0], line[1]) for line in (part.split("\n", 1) for part in lines if "stereodel " in part)]


def programs(text: str) -> list[tuple[str, str]]:
    """Each piece of Python, and what the page says that it prints."""
    return re.findall(r"```python\n(.*?)```(?:\s+```text\n(.*?)```)?", text, re.DOTALL)


def words(text: str) -> list[list[str]]:
    """Lines of fields, fractions to nine digits: processors differ in the last ones."""
    lines = (re.split(r"([, ])", line) for line in text.splitlines())
    return [[f"{float(word):.9g}" if re.fullmatch(r"-?\d+\.\d+", word) else word for word in line] for line in lines]


def wrong_command(command: str, printed: str, folder: Path, before: str = "") -> str:
    """What a command prints that a page does not say, or the file that it should write and does not; else nothing."""
    line = ["bash", "-c", before + command]
    said = subprocess.run(line, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True).stdout
    if words(said) != words(printed):
        return f"$ {command}\n{said}"
    written = re.search(r"-o ([\w.]+)", command)
    if written and "error:" not in printed and not (folder / written[1]).stat().st_size:
        return f"$ {command}\n{written[1]} is empty"
    return ""


def write_tables(text: str, folder: Path) -> None:
    """Write the files that a page shows: their names, then their contents."""
    for name, content in re.findall(r"`([\w.]+\.csv)`:\n\n```text\n(.*?)```", text, re.DOTALL):
        (folder / name).write_text(content, encoding="utf-8")


def wrong_programs(text: str, folder: Path) -> list[str]:
    """Pieces of Python that print something else."""
    wrong = []
    with contextlib.chdir(folder):
        for code, printed in programs(text):
            said = io.StringIO()
            with contextlib.redirect_stdout(said):
                exec(compile(code, "page", "exec"), {})
            if said.getvalue().split() != printed.split():
                wrong.append(f"{code}\n{said.getvalue()}")
    return wrong


def main(page: str, into: str) -> None:
    """Report; end with 1 where something is wrong."""
    text = Path(page).read_text(encoding="utf-8")
    folder = Path(into)
    folder.mkdir(parents=True, exist_ok=True)
    write_tables(text, folder)
    wrong = [told for command, printed in sessions(text) if (told := wrong_command(command, printed, folder))]
    wrong += wrong_programs(text, folder)
    print(f"{page}: {len(sessions(text))} commands, {len(programs(text))} pieces of Python, {len(wrong)} of them wrong")
    sys.exit("\n".join(wrong) or 0)


if __name__ == "__main__":
    main(*sys.argv[1:])
