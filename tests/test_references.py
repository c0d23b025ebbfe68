"""The bibliography: the paper's references are all there, so is whatever the source cites, and nothing else."""

import re
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
PAGE = (ROOT / "docs" / "references.md").read_text(encoding="utf-8")
LEDGER = (ROOT / "docs" / "paper.md").read_text(encoding="utf-8")
LEDGER_ROWS = set(re.findall(r"^\| (P\d+) \|", LEDGER, re.MULTILINE))

NAMES = [
    ("Bern", "Triangulations", "1997"),
    ("Conway", "Geometry and the Imagination in Minneapolis", "1991"),
    ("Kodaira", "Introduction to Complex Analysis", "1984"),
    ("Lukatela", "Hipparchus Geopositioning Model: An Overview", "1987"),
    (
        "Mark",
        "The history of Geographic Information Systems: "
        "Invention and reinvention of triangulated irregular networks (TINs)",
        "1997",
    ),
    ("Peucker", "The triangulated irregular network", "1978"),
    ("Renka", "Interpolation of data on the surface of a sphere", "1984"),
]
"""First author, title and year of the paper's references, in its order."""

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


@pytest.mark.parametrize("number", range(len(NAMES)), ids=[author for author, *_ in NAMES])
def test_references_of_the_paper(number):
    author, title, year = NAMES[number]
    entry, cited_for, rows = OF_THE_PAPER[number]
    assert author in entry.split('"')[0]
    assert f'"{title}"' in entry
    assert f"({year})" in entry
    assert cited_for
    assert set(re.findall(r"P\d+", rows))


def test_there_are_no_others():
    assert len(OF_THE_PAPER) == len(NAMES)
    assert [line.split("|")[1].strip() for line in PAGE.splitlines() if re.match(r"\| \d", line)] == list("1234567")


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


@pytest.mark.parametrize("entry", [cells[0] for cells in OF_THE_LIBRARY], ids=lambda entry: entry[:20])
def test_every_entry_is_cited(entry):
    assert any(what in entry and year in entry for _, what, year in cited()), entry


def test_no_work_has_two_entries():
    titles = [re.search(r'"([^"]+)"', entry)[1] for entry in ENTRIES]
    assert len(titles) == len(set(titles)) > 60


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ('B. Delaunay, "Sur la sphère vide", Bull. (1934): locally', [("Sur la sphère vide", "1934")]),
        ("the scan of R. Graham (1972): seen", [("Graham", "1972")]),
        ("(L. P. Chew, 1990; K. Buchin et al., 2013).", [("Chew", "1990"), ("Buchin", "2013")]),
        ("a picture 2008 pixels wide", []),
    ],
)
def test_a_citation_is_seen(text, found):
    assert TITLE.findall(text) + AUTHOR.findall(text) == found
