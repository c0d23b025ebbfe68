"""Signs of progress: the share that is done, on a terminal alone."""

import io

import pytest

from stereodel.cli.progress import PIECE, bar, in_pieces, say, stage


class Terminal(io.StringIO):
    """What takes stderr for a terminal."""

    def isatty(self):
        return True


def terminal(monkeypatch):
    """A terminal for stderr, which pytest puts in place anew before each test."""
    stream = Terminal()
    monkeypatch.setattr("sys.stderr", stream)
    for name, value in (("TERM", "xterm"), ("COLUMNS", "100")):
        monkeypatch.setenv(name, value)
    for name in ("NO_COLOR", "FORCE_COLOR", "TTY_COMPATIBLE", "TTY_INTERACTIVE"):
        monkeypatch.delenv(name, raising=False)
    return stream


@pytest.mark.parametrize(("share", "said"), [(0.25, "25%"), (1.0, "100%")])
def test_a_bar_tells_the_share(monkeypatch, share, said):
    stream = terminal(monkeypatch)
    with bar("drawing cells") as shown:
        shown(share)
    assert "drawing cells" in stream.getvalue()
    assert said in stream.getvalue()


def test_pieces_make_up_the_whole(monkeypatch):
    stream = terminal(monkeypatch)
    pieces = list(in_pieces(2 * PIECE + 5, "interpolating"))
    assert [(piece.start, piece.stop) for piece in pieces] == [(0, PIECE), (PIECE, 2 * PIECE), (2 * PIECE, 3 * PIECE)]
    assert "100%" in stream.getvalue()


def test_elsewhere_all_is_silent(monkeypatch):
    stream = io.StringIO()
    monkeypatch.setattr("sys.stderr", stream)
    with bar("drawing") as shown, stage("reading"):
        shown(0.5)
    say("done")
    assert len(list(in_pieces(5, "interpolating"))) == 1
    assert stream.getvalue() == ""
