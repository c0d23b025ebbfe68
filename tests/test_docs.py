"""What the documentation names exists: the ledger's functions, tests and figures, and the README's example runs."""

import ast
import doctest
import importlib
import importlib.util
import re
import sys
from functools import cache
from pathlib import Path

import pytest

from stereodel._doctor import COMMANDS
from stereodel._extras import EXTRAS
from tests.tiers import by_day
from tools.page_commands import sessions, write_tables, wrong_command

ROOT = Path(__file__).resolve().parent.parent
LEDGER = (ROOT / "docs" / "paper.md").read_text(encoding="utf-8")
README = (ROOT / "README.md").read_text(encoding="utf-8")
ROWS = dict(re.findall(r"^\| (P\d+) \|(.*)$", LEDGER, re.MULTILINE))
FIGURES = sorted(set(re.findall(r"gallery/(\w+)", LEDGER)))


def test_ledger_has_every_row():
    assert list(ROWS) == [f"P{number}" for number in range(1, 26)]


@pytest.mark.parametrize("row", ROWS)
def test_row_names_function_test_and_figure_or_says_why_not(row):
    claim, holds, functions, tests, figures = (cell.strip() for cell in ROWS[row].rstrip("| ").split("|"))
    assert claim
    assert holds
    assert "{py:" in functions
    assert "tests/" in tests
    assert "later" not in ROWS[row]
    assert figures


@pytest.mark.parametrize("name", sorted(set(re.findall(r"\{py:\w+\}`~([\w.]+)`", LEDGER))))
def test_named_object_exists(name):
    parts = name.split(".")
    for split in range(len(parts), 0, -1):
        try:
            found = importlib.import_module(".".join(parts[:split]))
        except ModuleNotFoundError:
            continue
        break
    for part in parts[split:]:
        found = getattr(found, part)


@pytest.mark.parametrize(("path", "name"), sorted(set(re.findall(r"`(tests/[\w/.]+\.py)(?:::(\w+))?`", LEDGER))))
def test_named_test_exists(path, name):
    tree = ast.parse((ROOT / path).read_text(encoding="utf-8"))
    defined = {node.name for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)}
    assert not name or name in defined


@pytest.mark.parametrize("name", FIGURES)
def test_named_figure_exists(name):
    assert (ROOT / "figures" / f"{name}.py").is_file()


def test_every_figure_is_in_the_ledger():
    of_the_paper = {name for name in FIGURES if not name.startswith("globe_")}
    kinds = ("fig", "claim_", "anim_")
    assert {path.stem for path in (ROOT / "figures").glob("*.py") if path.stem.startswith(kinds)} == of_the_paper


def test_readme_example_prints_what_it_says(capsys):
    code, printed = re.search(r"```python\n(.*?)```\s+```text\n(.*?)```", README, re.DOTALL).groups()
    exec(compile(code, "README.md", "exec"), {})
    assert capsys.readouterr().out.split() == printed.split()


PAGES = ["start", "graphs", "tour", "files", "partitioned", "earth", "interpolation", "spatial", "recipes"]


@pytest.mark.parametrize("page", by_day(PAGES, "start", "graphs", "spatial"))
def test_a_page_runs_cell_by_cell(page, tmp_path, monkeypatch, capsys):
    """As a notebook does: one namespace, one folder, and after each cell what the page says that it prints."""
    monkeypatch.chdir(tmp_path)
    text = (ROOT / "docs" / f"{page}.md").read_text(encoding="utf-8")
    write_tables(text, tmp_path)
    cells = re.findall(r"```python\n(.*?)```(?:\s+```text\n(.*?)```)?", text, re.DOTALL)
    assert cells
    names = {"__name__": "__main__"}
    for code, printed in cells:
        exec(compile(code, f"docs/{page}.md", "exec"), names)
        assert capsys.readouterr().out == printed or page == "interpolation"  # which does not show it


def toctree(page):
    """The pages below a page, and what the navigation calls them."""
    text = (ROOT / "docs" / f"{page}.md").read_text(encoding="utf-8")
    (entries,) = re.findall(r"```\{toctree\}\n:hidden:\n\n(.*?)```", text, re.DOTALL)
    return dict(reversed(re.fullmatch(r"(.*) <(.*)>", line).groups()) for line in entries.splitlines())


GROUPS = ["start", "guides", "reference", "background"]


def test_every_page_is_in_one_group():
    pages = sorted(path.stem for path in (ROOT / "docs").glob("*.md") if path.stem not in ("index", *GROUPS))
    below = [page for group in GROUPS for page in toctree(group) if "/" not in page]
    assert sorted(below) == pages
    assert list(toctree("index")) == [*GROUPS[:2], "gallery/index", *GROUPS[2:]]


def test_the_start_page_lists_every_extra():
    text = (ROOT / "docs" / "start.md").read_text(encoding="utf-8")
    table = re.search(r"\| extra \|.*?\n\n", text, re.DOTALL)[0]
    assert re.findall(r"^\| `(\w+)` \|", table, re.MULTILINE) == list(EXTRAS)


THEOREM = (ROOT / "docs" / "theorem.md").read_text(encoding="utf-8")


@pytest.mark.parametrize(("page", "least"), [("theorem", 21), ("spatial", 6)])
def test_dialogues_of_a_page_are_true(page, least):
    """With the interpreter, as one."""
    text = (ROOT / "docs" / f"{page}.md").read_text(encoding="utf-8")
    dialogue = "\n".join(re.findall(r"```pycon\n(.*?)```", text, re.DOTALL))
    test = doctest.DocTestParser().get_doctest(dialogue, {}, page, f"docs/{page}.md", 0)
    assert len(test.examples) >= least
    report: list[str] = []
    doctest.DocTestRunner().run(test, out=report.append)
    assert "".join(report) == ""


def test_tests_and_figures_that_the_page_of_the_theorem_names_exist():
    named = re.findall(r"`(?:(tests/[\w/]+\.py)(?:::)?)?(test_\w+)?`", THEOREM)
    named = [(path, name) for path, name in named if path or name]
    assert named
    path = ""
    for given, name in named:
        path = given or path  # a name alone is of the file before it
        test_named_test_exists(path, name)
    for figure in re.findall(r"gallery/(\w+)", THEOREM):
        test_named_figure_exists(figure)


@pytest.mark.parametrize("page", ["README.md", "docs/index.md"])
def test_pictures_are_there(page):
    path = ROOT / page
    text = path.read_text(encoding="utf-8")
    shown = re.findall(r'(?:!\[[^]]*\]\(|\{image\} |src=")([^)\s"]+)', text)
    assert shown
    assert [name for name in shown if not (path.parent / name).is_file()] == []


def test_the_gallery_runs_every_script():
    """What its pattern leaves out is shown without a picture."""
    (pattern,) = re.findall(r'"filename_pattern": r"(.*)"', (ROOT / "docs" / "conf.py").read_text(encoding="utf-8"))
    scripts = [path.as_posix() for path in (ROOT / "figures").glob("[!_]*.py")]
    assert len(scripts) >= 20
    assert [script for script in scripts if not re.search(pattern, script)] == []


# Commands that pages show run, and print what is said.

BY_DAY = [
    ("README.md", "stereodel voronoi cities.csv -o -"),
    ("docs/recipes.md", "stereodel voronoi stations.csv -o - | cut -d, -f3,5 | head -4"),
    ("docs/recipes.md", "stereodel nearest stations.csv --of places.csv --keep station -o -"),
    ("docs/recipes.md", "stereodel interpolate stations.csv --value celsius --at places.csv -o -"),
]
"""The others draw pictures, or ask of one command more what tests/cli asks of it."""

SHELL = f"stereodel() {{ '{sys.executable}' -c 'from stereodel.cli import app; app()' \"$@\"; }}\n"


def pages():
    for page in ["docs/command_line.md", "docs/recipes.md", "docs/start.md", "README.md"]:
        for command, printed in sessions((ROOT / page).read_text(encoding="utf-8")):
            day = (page, command) in BY_DAY
            yield pytest.param(page, command, printed, id=command, marks=[] if day else pytest.mark.thorough)


@pytest.mark.parametrize(("page", "command", "printed"), list(pages()))
def test_commands_print_what_the_page_says(tmp_path, monkeypatch, page, command, printed):
    write_tables((ROOT / page).read_text(encoding="utf-8"), tmp_path)
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    assert wrong_command(command, printed, tmp_path, SHELL) == ""


def test_recipes_are_many_and_short_and_found_by_the_words_of_those_who_ask():
    text = (ROOT / "docs" / "recipes.md").read_text(encoding="utf-8")
    _, *recipes = re.split(r"^### ", re.sub(r"```text\n.*?```", "", text, flags=re.DOTALL), flags=re.MULTILINE)
    assert len(recipes) >= 45
    for recipe in recipes:
        codes = re.findall(r"```(?:python|console)\n(.*?)```", recipe, re.DOTALL)
        lines = [line for code in codes for line in code.splitlines() if line.startswith("$") or "$ " not in code]
        assert 1 <= len(lines) <= 10, recipe
    words = "Thiessen, proximity polygons, true km², equal-area, antimeridian, date line, nearest hub, k nearest, "
    words += "isotherms, contour lines, regrid, TIN, raster, GeoTIFF, choropleth, fisheye, UTM, duplicates, "
    words += "spatial join, griddata"
    assert [word for word in words.split(", ") if word.lower() not in text.lower()] == []
    newer = "DMS, degrees, minutes and seconds, −9999, umlauts, German Excel, sheets, dissolve, points in polygon, "
    newer += "coast, zonal statistics, country, reverse geocoding, Dataset, NEMO, nside, Jupyter, pandas, polars, "
    newer += "DuckDB, xESMF, LinearNDInterpolator, 3-D, ConvexHull"
    assert [word for word in newer.split(", ") if word.lower() not in text.lower()] == []


def test_the_page_shows_every_command():
    from stereodel.cli import app

    text = (ROOT / "docs" / "command_line.md").read_text(encoding="utf-8")
    shown = re.findall(r"^\| `(\w+)` \| (.*) \|$", text, re.MULTILINE)
    assert [*COMMANDS.items()] == shown
    assert [command.name for command in app.registered_commands] == [*COMMANDS]


# The bibliography: whatever the source cites is there, and nothing else; its rows of the ledger exist.

REFERENCES = (ROOT / "docs" / "references.md").read_text(encoding="utf-8")
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


OF_THE_PAPER = [cells[1:] for cells in table_rows(REFERENCES) if len(cells) == 4]
OF_THE_LIBRARY = [cells for cells in table_rows(REFERENCES) if len(cells) == 3]
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
    assert named <= set(ROWS)


def test_every_citation_of_the_source_has_its_entry():
    missing = {each for each in cited() if not any(each[1] in entry and each[2] in entry for entry in ENTRIES)}
    assert missing == set(), "add them to docs/references.md, with what they are used for and the rows of the ledger"


def test_every_entry_is_cited():
    citations = {(what, year) for _, what, year in cited()}
    entries = [cells[0] for cells in OF_THE_LIBRARY]
    assert [entry for entry in entries if not any(what in entry and year in entry for what, year in citations)] == []


def test_no_work_has_two_entries():
    titles = [re.search(r'"([^"]+)"', entry)[1] for entry in ENTRIES]
    assert len(titles) == len(set(titles)) > 60


def test_every_name_of_the_npm_package_has_its_place():
    place = importlib.util.spec_from_file_location("javascript_api", ROOT / "docs" / "javascript_api.py")
    place.loader.exec_module(made := importlib.util.module_from_spec(place))
    sources = {
        file: (made.KERNEL / file).read_text(encoding="utf-8").replace("/** @internal */\nexport ", "")
        for files in made.MODULES.values()
        for file in files
    }
    exported = re.findall(
        r"^export .*?(?:class|function|interface|type) (\w+)", "\n".join(sources.values()), re.MULTILINE
    )
    listed = re.findall(r"\w+(?=,| \})", " ".join(re.findall(r"^export .*from", sources["api.ts"], re.MULTILINE)))
    page = made.javascript_api()
    assert {*exported, *listed} <= set(re.findall(r"^### (\w+)$", page, re.MULTILINE))
    assert len({*exported, *listed}) > 30
    assert "`*neighbors(i: number): Generator<number>`\n: The sites around one" in page
    assert "Kept" not in page
