"""The pool: results by number, errors in words, one process for another, and none left over."""

import os
import pickle
import signal
import subprocess
import sys
import threading
import time

import pytest

from stereodel.film.pool import in_processes
from tests.film.processes import ended, importable, wait_until

WORK = """
import os, signal, time

def double(x):
    if x == "error":
        raise KeyError("no such thing")
    if x == "own":
        class Own(Exception):
            def __init__(self, a, b): super().__init__(a)
        raise Own(1, 2)  # which cannot be sent
    if x == "die":
        os._exit(3)
    if x == "killed":
        os.kill(os.getpid(), signal.SIGKILL)
    if x == "sleep":
        time.sleep(600)
    return 2 * x, os.getpid()
"""


@pytest.fixture
def double(tmp_path, monkeypatch):
    with importable(tmp_path, "work_of_a_test", WORK, monkeypatch) as module:
        yield module.double


def test_each_task_is_done_once_by_as_many_processes_as_wanted(double):
    found = dict(in_processes(double, list(range(7)), jobs=2))
    assert [found[k].result[0] for k in range(7)] == [0, 2, 4, 6, 8, 10, 12]
    processes = {done.result[1] for done in found.values()}
    assert len(processes) == 2
    assert os.getpid() not in processes
    assert all(map(ended, processes))


def test_no_tasks_need_no_process(double):
    assert list(in_processes(double, [], jobs=2)) == []


def test_a_process_makes_room_for_another(double):
    processes = [done.result[1] for _, done in in_processes(double, list(range(7)), jobs=1, lifetime=2)]
    assert [processes.count(pid) for pid in dict.fromkeys(processes)] == [2, 2, 2, 1]


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ("error", "KeyError: 'no such thing'"),
        ("own", "Own: 1"),
        ("die", "its process ended with code 3"),
        ("killed", "its process ended with code -9"),
    ],
)
def test_an_error_is_that_of_its_task_alone(double, wrong, message):
    found = dict(in_processes(double, [1, wrong, 2, 3, 4], jobs=2))
    assert found[1].error == message
    assert (found[1].trace != "") == message.startswith(("KeyError", "Own"))
    assert [found[k].result[0] for k in (0, 2, 3, 4)] == [2, 4, 6, 8]


def test_an_exit_code_is_known_to_the_thread_that_did_not_ask_for_it(double, monkeypatch):
    """The system tells it once. Here the executor's thread asks first, and stores it late."""
    ask = os.waitpid

    def slow(*args):
        here = threading.current_thread() is threading.main_thread()
        time.sleep(0.2 * here)
        pid, status = ask(*args)
        time.sleep(0.6 * (pid != 0 and not here))
        return pid, status

    monkeypatch.setattr(os, "waitpid", slow)
    assert [done.error for _, done in in_processes(double, ["killed"], jobs=1)] == ["its process ended with code -9"]


def test_an_iterator_that_is_closed_ends_what_runs(double):
    results = in_processes(double, [1, "sleep", 2], jobs=2)
    _, done = next(results)
    begin = time.monotonic()
    results.close()
    assert time.monotonic() - begin < 10
    assert ended(done.result[1])


def test_what_cannot_be_loaded_elsewhere_is_the_answer_to_each_task(double):
    class Broken:
        def __reduce__(self):
            return int, ("no number",)

    found = list(in_processes(Broken(), [1, 2], jobs=1))
    assert [done.error for _, done in found] == ["ValueError: invalid literal for int() with base 10: 'no number'"] * 2


def test_processes_end_with_the_one_that_started_them(double, tmp_path):
    """Killed, it can end nobody: they must see it themselves, in the middle of a task too."""
    code = """
import os, sys, time
from work_of_a_test import double
from stereodel.film.pool import in_processes
results = in_processes(double, [1, 2, "sleep", "sleep"], jobs=2)
print(next(results)[1].result[1], next(results)[1].result[1], flush=True)
next(results)
"""
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(tmp_path), *filter(None, sys.path)])}
    with subprocess.Popen([sys.executable, "-c", code], env=environment, stdout=subprocess.PIPE, text=True) as process:
        processes = [int(word) for word in process.stdout.readline().split()]
        assert len(set(processes)) >= 1
        assert not any(map(ended, processes))
        process.send_signal(signal.SIGKILL)
    wait_until(lambda: all(map(ended, processes)), 20)


def test_threads_of_this_process_see_the_main_module_as_it_is(double):
    main = sys.modules["__main__"]
    before = getattr(main, "__file__", None), main.__spec__
    list(in_processes(double, [1], jobs=1))
    assert (getattr(main, "__file__", None), main.__spec__) == before
    assert pickle.loads(pickle.dumps(double)) is double
