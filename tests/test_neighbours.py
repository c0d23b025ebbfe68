"""The pages for users of other libraries (`docs/from`): our lines print what the page says, and so do the neighbour's.

A section has the neighbour's lines, with its name as caption, then ours, then what both print. What differs by design
stands in a section without the neighbour's lines. The lines of a page run in one go, as those of a notebook.
"""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
PAGES = {path.stem: path.read_text(encoding="utf-8") for path in sorted((ROOT / "docs" / "from").glob("*.md"))}
BLOCK = re.compile(r"^```(?:\{code-block\} )?(\w+)\n(?::caption: ([^\n]+)\n\n?)?(.*?)^```$", re.MULTILINE | re.DOTALL)


def sections(page):
    """Title, the neighbour's lines, our lines and what both print, of each section that has our lines."""
    for part in re.split(r"^## ", PAGES[page], flags=re.MULTILINE)[1:]:
        theirs = ours = printed = None
        for language, caption, code in BLOCK.findall(part):
            if caption:
                theirs = (language, code)
            elif language == "text":
                printed = code
            else:
                ours = code
        if ours is not None:
            yield part.partition("\n")[0], theirs, ours, printed


EACH_PAGE = pytest.mark.parametrize("page", PAGES)


@EACH_PAGE
def test_our_lines_print_what_the_page_says(page, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    names = {"__name__": "__main__"}
    for title, _, ours, printed in sections(page):
        exec(compile(ours, f"docs/from/{page}.md, {title}", "exec"), names)
        assert (title, capsys.readouterr().out) == (title, printed)


@EACH_PAGE
def test_a_page_has_the_calls_that_they_know_and_says_what_is_not_here(page):
    assert len([title for title, theirs, _, _ in sections(page) if theirs]) >= 10
    assert {"What differs", "What is not here"} <= set(re.findall(r"^## (.+)$", PAGES[page], re.MULTILINE))
