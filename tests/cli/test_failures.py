"""How commands end: exit codes, one line on stderr, and silence where a reader has gone."""

import codecs
import re
import signal

import pytest
import typer
from typer.testing import CliRunner

from stereodel._tasks.interrupts import signals
from stereodel.cli import app
from stereodel.cli.application import Commands, reporting


def of_a_codec():
    """An interruption while text was decoded."""

    def interrupted(*given):
        raise KeyboardInterrupt

    codecs.register(lambda name: codecs.CodecInfo(interrupted, interrupted) if name == "interrupted" else None)
    with pytest.raises(KeyboardInterrupt) as raised:
        codecs.decode(b"", "interrupted")
    return raised.value


def ending(error):
    """What the shell sees of a command that fails with `error`."""
    failing = typer.Typer(cls=Commands, pretty_exceptions_enable=False)

    @failing.callback()
    def _several():
        pass

    @failing.command("fail")
    def _fail():
        raise error

    return CliRunner().invoke(failing, ["fail"])


@pytest.mark.parametrize(
    ("error", "code", "line"),
    [
        (ValueError("row 17: latitude 95.2\nis outside"), 2, "error: row 17: latitude 95.2 is outside"),
        (FileNotFoundError(2, "No such file or directory", "a.csv"), 2, "error: a.csv: No such file or directory"),
        (OSError("no space"), 2, "error: no space"),
        (ModuleNotFoundError("no shapely"), 1, "error: no shapely"),
        (MemoryError(), 2, "error: not enough memory for so many points"),
        (KeyboardInterrupt(), 130, "interrupted; nothing was written"),
        (KeyboardInterrupt("frames are kept"), 130, "frames are kept"),
        (of_a_codec(), 130, "interrupted; nothing was written"),
    ],
)
def test_failures_are_one_line(error, code, line):
    ran = ending(error)
    assert (ran.exit_code, ran.stderr, ran.stdout) == (code, f"{line}\n", "")


def test_a_mistake_of_ours_keeps_its_traceback():
    ran = ending(ZeroDivisionError("ours"))
    assert isinstance(ran.exception, ZeroDivisionError)


@pytest.mark.parametrize("error", [OSError("lost"), TypeError("result array type does not match"), typer.Exit(0)])
def test_an_interruption_that_a_library_turned_into_another_exception(error):
    """NumPy's strings make TypeErrors of it, imports OSErrors."""
    own = signal.getsignal(signal.SIGINT)
    signals.append(signal.SIGINT)
    try:
        ran = ending(error)
    finally:
        signals.clear()
        signal.signal(signal.SIGINT, own)
    assert (ran.exit_code, ran.stderr) == (130, "interrupted; nothing was written\n")


@pytest.mark.parametrize("steps", [0, 1])
def test_an_interruption_that_was_lost_stops_the_work_at_its_next_sign_of_progress(steps):
    """Or at its end, if there is no other sign."""
    done = []

    def work():
        with reporting("work") as told:
            signals.append(signal.SIGINT)
            done.append("begun")
            for _ in range(steps):
                told("work", 1, 2)
                done.append("gone on")

    try:
        with pytest.raises(KeyboardInterrupt):
            work()
    finally:
        signals.clear()
    assert done == ["begun"]


@pytest.mark.parametrize("command", [command.name for command in app.registered_commands])
def test_help_shows_an_example_and_names_what_is_given(command):
    """In capitals or as choices, never as types of Python; at most twenty options, and then those under headings."""
    ran = CliRunner().invoke(app, [command, "--help"], env={"COLUMNS": "100"})
    assert ran.exit_code == 0
    assert "Example: " in ran.stdout
    assert f"stereodel {command}" in ran.stdout
    assert "--help" in ran.stdout
    for said in (ran.output, CliRunner().invoke(app, ["--help"]).output):
        assert re.findall(r"bool|list\[|TEXT,|--[\w-]+,--|[{}<>]|int range|x<=|x>=", said) == []
    _, first, *below = re.split(r"─ (?:Options|Reading|Picture)[^─]* ─", ran.stdout)
    assert 0 < len(re.findall(r"^│ .{3}--\w", first, re.MULTILINE) or re.findall(r"^│ --\w", first, re.MULTILINE)) <= 20
    assert ("--skip-missing" in "".join(below)) == ("--skip-missing" in ran.stdout)
    assert ("--legend" in "".join(below)) == ("--legend" in ran.stdout)


def test_wrong_usage():
    assert CliRunner().invoke(app, ["triangle"]).exit_code == 2
    assert CliRunner().invoke(app, []).exit_code == 2
