"""Files, pipes and interruptions: results arrive whole or not at all."""

import contextlib
import os
import signal
import subprocess
import sys
import time

# Whoever runs the tests in the background has SIGINT ignored, and programs inherit that.
PROGRAM = """
import signal
signal.signal(signal.SIGINT, signal.default_int_handler)
from stereodel.cli import app
app()
"""
COMMAND = [sys.executable, "-c", PROGRAM]


def start(*arguments, **streams):
    return subprocess.Popen([*COMMAND, *arguments], stderr=subprocess.PIPE, **streams)


def test_stdin_to_stdout(folder, run, rows):
    text = (folder / "cities.csv").read_text(encoding="utf-8")
    from_file = run("nearest", "cities.csv", "--of", "cities.csv", "-o", "-")
    assert run("nearest", "-", "--of", "cities.csv", "-o", "-", stdin=text) == from_file
    assert run("nearest", "cities.csv", "--of", "-", "-o", "-", stdin=text) == from_file
    assert [row["distance_km"] for row in rows(from_file)] == ["0"] * 5


def test_a_closed_pipe_is_quiet(folder):
    arguments = ["interpolate", "cities.csv", "--value", "people", "--grid", "0.5", "--method", "nearest", "-o", "-"]
    with start(*arguments, stdout=subprocess.PIPE) as writer:
        assert writer.stdout.readline() == b"lon,lat,people\n"
        writer.stdout.close()
        assert writer.stderr.read() == b""
        assert writer.wait() == 1


def opened_for_writing(fifo, reader):
    """The writing end, as soon as the process has opened the other one; an error if it ends before that."""
    while reader.poll() is None:
        with contextlib.suppress(OSError):
            return os.fdopen(os.open(fifo, os.O_WRONLY | os.O_NONBLOCK), "wb")
        time.sleep(0.01)
    raise AssertionError(reader.stderr.read().decode())


def test_interruption_leaves_nothing(folder):
    os.mkfifo(folder / "asking.csv")
    with start("nearest", "cities.csv", "--of", "asking.csv", "-o", "out.csv") as waiting:
        with opened_for_writing(folder / "asking.csv", waiting):
            # It comes out of opening, and goes on to read. A signal between the two would wait for what is read.
            time.sleep(0.5)
            waiting.send_signal(signal.SIGINT)
            assert waiting.communicate(timeout=60)[1] == b"interrupted; nothing was written\n"
        assert waiting.returncode == 130
    assert sorted(path.name for path in folder.iterdir()) == ["asking.csv", "cities.csv"]


def test_a_failure_keeps_the_old_file(folder, run):
    (folder / "old.csv").write_text("kept", encoding="utf-8")
    (folder / "wrong.csv").write_text("lon,lat\n1,2\n3,95.2\n", encoding="utf-8")
    options = ("nearest", "wrong.csv", "--of", "cities.csv", "-o", "old.csv")
    message = run(*options, "--overwrite", code=2)
    assert message.startswith("error: wrong.csv: row 2: latitude 95.2")
    assert message.count("\n") == 1
    assert (folder / "old.csv").read_text(encoding="utf-8") == "kept"
    assert len(list(folder.iterdir())) == 3
