"""The bibliography: whatever the source cites is there, and nothing else; its rows of the ledger exist."""

import re
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAGE = (ROOT / "docs" / "references.md").read_text(encoding="utf-8")
LEDGER = (ROOT / "docs" / "paper.md").read_text(encoding="utf-8")
LEDGER_ROWS = set(re.findall(r"^\| (P\d+) \|", LEDGER, re.MULTILINE))

YEAR = r"(?:1[89]\d\d|20[0-2]\d)"
TITLE = re.compile(rf'"([A-Z][^"]{{9,170}})"[^"]{{0,110}}?\b({YEAR})\b')
AUTHOR = re.compile(rf"\b([A-Z][a-zé]+)(?:,| et al\.,?)? \(?({YEAR})\b")
NO_AUTHORS = {"Data", "Geometry", "October", "System", "Vis"}
"""Last words before a year of what is no author: of titles, of books, of conferences and of dates."""


def table_rows(text):
    """Cells of the rows of all tables of a page, without the heads."""
    for line in text.splitlines():
        if line.startswith("| ") and not line.startswith(("| reference", "| | reference")):
            yield [cell.strip() for cell in line.strip().strip("|").split("|")]


OF_THE_PAPER = [cells[1:] for cells in table_rows(PAGE) if len(cells) == 4]
OF_THE_LIBRARY = [cells for cells in table_rows(PAGE) if len(cells) == 3]
ENTRIES = [cells[0] for cells in OF_THE_PAPER + OF_THE_LIBRARY]


@cache
def sources():
    """Texts of the package, the kernel, the figures and the pages, each on one line, without the marks of comments."""
    files = [*ROOT.glob("stereodel/**/*.py"), *ROOT.glob("stereodel/kernel/**/*.[hc]pp"), *ROOT.glob("figures/*.py")]
    files += [path for path in ROOT.glob("docs/*.md") if path.stem not in ("references", "paper", "changelog")]
    return {
        path.relative_to(ROOT).as_posix(): re.sub(r"\s*\n\s*(?://|#)?\s*", " ", path.read_text(encoding="utf-8"))
        for path in files
    }


def cited():
    """(file, what is cited by title or author, year)."""
    for file, text in sources().items():
        for title, year in TITLE.findall(text):
            yield file, '"' + title[:40], year  # a comment may set the rest in columns
        for author, year in AUTHOR.findall(text):
            if author not in NO_AUTHORS:
                yield file, author, year


def test_rows_exist():
    named = {row for *_, rows in OF_THE_PAPER + OF_THE_LIBRARY for row in re.findall(r"P\d+", rows)}
    assert len(named) > 12
    assert named <= LEDGER_ROWS


def test_every_citation_of_the_source_has_its_entry():
    missing = {
        (file, what, year)
        for file, what, year in cited()
        if not any(what in entry and year in entry for entry in ENTRIES)
    }
    assert missing == set(), "add them to docs/references.md, with what they are used for and the rows of the ledger"


def test_every_entry_is_cited():
    citations = {(what, year) for _, what, year in cited()}
    entries = [cells[0] for cells in OF_THE_LIBRARY]
    assert [entry for entry in entries if not any(what in entry and year in entry for what, year in citations)] == []


def test_no_work_has_two_entries():
    titles = [re.search(r'"([^"]+)"', entry)[1] for entry in ENTRIES]
    assert len(titles) == len(set(titles)) > 60
