"""Notes of tasks: they count while what they tell of is there."""

import os

import pytest

from stereodel._tasks.kept import Kept


@pytest.fixture
def kept(tmp_path):
    """A folder with a note of one task and of its two files, in the folder and elsewhere."""
    kept, other = Kept(tmp_path / "kept"), tmp_path / "elsewhere.txt"
    kept.folder.mkdir()
    (kept.folder / "a.txt").write_text("aaa")
    other.write_text("bb")
    assert kept.note("pass", 3) is None
    kept.keep("pass", {"points": 5}, ["a.txt", other], task=3)
    return kept


def test_a_note_says_what_was_said(kept, tmp_path):
    files = {"a.txt": 3, str(tmp_path / "elsewhere.txt"): 2}
    assert kept.note("pass", 3) == {"points": 5, "task": 3, "files": files}
    assert kept.note("pass", 4) is None
    assert kept.note("pass") is None
    (tmp_path / "kept").rename(tmp_path / "moved")
    assert Kept(tmp_path / "moved").note("pass", 3)["points"] == 5


@pytest.mark.parametrize("name", ["kept/a.txt", "elsewhere.txt", "kept/pass/3.json"])
@pytest.mark.parametrize("harm", [os.unlink, lambda path: os.truncate(path, 1)])
def test_nothing_counts_that_is_not_there_as_it_was(kept, tmp_path, name, harm):
    harm(tmp_path / name)
    assert kept.note("pass", 3) is None


def test_once(kept):
    told = []
    for number in range(2):
        note = kept.once("layout", lambda number=number: told.append(number) or {"number": number})
        assert note["number"] == 0
    assert told == [0]
