"""The searches that must find their pages, tried on a small index in Sphinx's form."""

import pytest

from tools import searches

INDEX = {
    "docnames": ["files", "graphs", "api/generated/stereodel.io.write"],
    "titleterms": {"shapefil": [0], "writ": [0, 2]},
    "terms": {"alpha": 1, "shap": [0, 1], "shapefil": [0, 1, 2], "tre": 1},
}


def stem(word):
    return word.removesuffix("s").removesuffix("e")


@pytest.mark.parametrize(
    ("query", "pages"),
    [
        ("Shapefiles", ["files", "graphs"]),
        ("alpha shape", ["graphs"]),
        ("tree", ["graphs"]),
        ("write", ["files"]),
        ("dask", []),
        ("alpha write", []),
    ],
)
def test_pages_with_all_words_come_in_the_order_of_their_scores(query, pages):
    assert searches.pages_found(INDEX, query, stem) == pages


def test_a_search_that_misses_its_page_is_named(monkeypatch):
    monkeypatch.setattr(searches, "SEARCHES", {"shapefile": "files", "dask": "files", "tree": "graphs"})
    assert searches.missed(INDEX, stem) == ["a search for 'dask' finds nothing, but should find 'files'"]
