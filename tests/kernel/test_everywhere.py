"""What is the same wherever the kernel was compiled and whatever runs it: stored answers, eight threads at once."""

import threading

import pytest

from stereodel._tasks import threads
from tools import try_kernel


def test_the_kernel_answers_as_is_stored():
    assert try_kernel.other_answers() == []


def test_eight_threads_have_equal_answers_and_no_wrong_change():
    assert try_kernel.wrong_threads(rounds=3) == []


@pytest.mark.parametrize("started", [0, 1])
def test_jobs_are_done_where_the_system_gives_no_thread(monkeypatch, started):
    """None at all, or no second one."""
    begun = threading.Thread.start
    given = []

    def start(thread):
        if len(given) == started:
            raise RuntimeError("can't start new thread")
        given.append(thread)
        begun(thread)

    monkeypatch.setattr(threading.Thread, "start", start)
    assert list(threads.in_order(abs, range(-3, 3), threads=3)) == [3, 2, 1, 0, 1, 2]
    assert len(given) == started
