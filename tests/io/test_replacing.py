"""Files are written whole or not at all, to the place that was named, and to no other."""

import errno
import os
import stat
import threading

import pytest

from stereodel._tasks.whole_files import replacing


@pytest.fixture
def target(tmp_path):
    path = tmp_path / "note.txt"
    path.write_text("old", encoding="utf-8")
    return path


def write(path, text="new"):
    with replacing(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


def test_an_error_leaves_the_old_file_and_nothing_else(target):
    with pytest.raises(ZeroDivisionError), replacing(target) as temporary:
        temporary.write_text(f"half {1 / 0}", encoding="utf-8")
    assert [(path.name, path.read_text(encoding="utf-8")) for path in target.parent.iterdir()] == [("note.txt", "old")]


def test_what_was_laid_under_the_temporary_name_is_not_written_to(target, monkeypatch):
    victim = target.with_name("victim.txt")
    victim.write_text("mine", encoding="utf-8")
    monkeypatch.setattr("stereodel._tasks.whole_files.secrets.token_hex", lambda size: "known")
    trap = target.with_name(".note.txt.known.tmp")
    trap.symlink_to(victim)
    with pytest.raises(FileExistsError):
        write(target)
    assert victim.read_text(encoding="utf-8") == "mine"
    assert target.read_text(encoding="utf-8") == "old"


@pytest.mark.parametrize("mode", [0o600, 0o640, 0o444])
def test_the_mode_stays(target, mode):
    target.chmod(mode)
    write(target)
    assert stat.S_IMODE(target.stat().st_mode) == mode
    assert target.read_text(encoding="utf-8") == "new"


def test_a_new_file_has_the_mode_that_the_process_gives(tmp_path):
    (tmp_path / "plain").write_text("", encoding="utf-8")
    write(tmp_path / "ours")
    assert (tmp_path / "ours").stat().st_mode == (tmp_path / "plain").stat().st_mode


@pytest.mark.parametrize("there", [True, False])
def test_links_are_followed(target, there):
    if not there:
        target.unlink()
    link = target.with_name("link.txt")
    link.symlink_to(target.name)
    write(link)
    assert link.is_symlink()
    assert target.read_text(encoding="utf-8") == "new"
    assert sorted(path.name for path in target.parent.iterdir()) == ["link.txt", "note.txt"]


def test_pipes_are_written_to(tmp_path):
    fifo, read = tmp_path / "pipe", []
    os.mkfifo(fifo)
    reader = threading.Thread(target=lambda: read.append(fifo.read_text(encoding="utf-8")))
    reader.start()
    write(fifo)
    reader.join(timeout=60)
    assert read == ["new"]
    assert stat.S_ISFIFO(fifo.stat().st_mode)


def test_a_full_disk_is_said_of_the_target():
    with pytest.raises(OSError, match="/dev/full") as raised:
        write("/dev/full")
    assert raised.value.errno == errno.ENOSPC


@pytest.mark.parametrize("code", [errno.ENOSPC, errno.EIO])
def test_errors_name_the_target(target, code):
    with pytest.raises(OSError, match=r"note\.txt") as raised, replacing(target):
        raise OSError(code, os.strerror(code))
    assert raised.value.filename == str(target)
    assert str(raised.value).endswith(f"{os.strerror(code)}: {str(target)!r}")  # and no second name
    with pytest.raises(OSError, match=r"other\.txt"), replacing(target):
        raise OSError(code, os.strerror(code), "other.txt")


def test_folders(tmp_path):
    with pytest.raises(IsADirectoryError, match=tmp_path.name):
        write(tmp_path)
    with pytest.raises(FileNotFoundError) as raised:
        write(tmp_path / "none" / "note.txt")
    assert raised.value.filename == str(tmp_path / "none" / "note.txt")


def test_two_threads_write_one_file(target):
    texts = [str(number) * 10_000 for number in range(8)]
    threads = [threading.Thread(target=write, args=(target, text)) for text in texts]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(timeout=60)
    assert target.read_text(encoding="utf-8") in texts
    assert len(list(target.parent.iterdir())) == 1
