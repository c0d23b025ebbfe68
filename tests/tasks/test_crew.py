"""The crew: outcomes by number, errors as they were, one process for another, and none left over."""

import os
import pickle
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from functools import partial

import pytest

from stereodel._tasks.crew import ATTEMPTS, Crew, TaskError
from tests.tasks.processes import ended, importable, wait_until

WORK = """
import os, signal, time
from pathlib import Path

def double(x):
    if x == "error":
        raise KeyError("no such thing")
    if isinstance(x, Path) and x.name == "slow":
        time.sleep(3)
        return x.touch()
    if isinstance(x, Path):  # killed the first time
        if not x.exists():
            x.touch()
            os.kill(os.getpid(), signal.SIGKILL)
        return x.name
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
    with Crew(2) as crew:
        found = dict(crew.each(double, list(range(7))))
        assert [found[k].value()[0] for k in range(7)] == [0, 2, 4, 6, 8, 10, 12]
        processes = {done.result[1] for done in found.values()}
        assert len(processes) == 2
        assert os.getpid() not in processes
        again = {done.result[1] for _, done in crew.each(partial(double), [1, 2])}
        assert again == processes  # they live on, and take up other work
    assert all(map(ended, processes))


def test_one_task_and_one_job_need_no_process(double):
    with Crew(2) as crew:
        assert list(crew.each(double, [])) == []
        assert next(crew.each(double, [4]))[1].value() == (8, os.getpid())
    with Crew(1) as crew:
        assert [done.value() for _, done in crew.each(double, [1, 2])] == [(2, os.getpid()), (4, os.getpid())]
        assert [done.message for _, done in crew.each(double, ["error"])] == ["KeyError: 'no such thing'"]


def test_a_process_makes_room_for_another(double):
    with Crew(2, lifetime=2) as crew:
        processes = [done.value()[1] for _, done in crew.each(double, list(range(9)))]
    assert len(set(processes)) >= 5
    assert max(map(processes.count, processes)) == 2


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
    with Crew(2) as crew:
        found = dict(crew.each(double, [1, wrong, 2, 3, 4]))
    assert found[1].message == message
    with pytest.raises(KeyError if wrong == "error" else TaskError) as caught:
        found[1].value()
    traced = getattr(caught.value, "__notes__", [""])
    assert ("in double" in traced[0]) == message.startswith(("KeyError", "Own"))
    assert [found[k].value()[0] for k in (0, 2, 3, 4)] == [2, 4, 6, 8]


def test_a_task_whose_process_was_killed_is_begun_again(double, tmp_path):
    with Crew(2) as crew:
        found = dict(crew.each(double, [1, tmp_path / "once", 2]))
    assert [found[k].value() for k in range(3)][1] == "once"
    assert ATTEMPTS == 3


def test_processes_that_were_killed_while_they_waited_or_began(double):
    with Crew(2) as crew:
        waiting = {done.value()[1] for _, done in crew.each(double, [1, 2])}
        for process in waiting:
            os.kill(process, signal.SIGKILL)
        assert {done.value()[0] for _, done in crew.each(double, [3, 4])} == {6, 8}


def test_a_system_without_room_for_processes(double, monkeypatch):
    """An error of the task, after as many attempts."""
    begun = []

    def full(*_):
        begun.append(1)
        raise BlockingIOError(11, "Resource temporarily unavailable")

    monkeypatch.setattr("multiprocessing.context.SpawnProcess.start", full)
    with Crew(2) as crew:
        found = [done.message for _, done in crew.each(double, [1, 2])]
    assert found == ["its process could not begin: [Errno 11] Resource temporarily unavailable"] * 2
    assert len(begun) == 2 * ATTEMPTS


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
    with Crew(2) as crew:
        found = dict(crew.each(double, ["killed", 1]))
    assert found[0].message == "its process ended with code -9"


@pytest.mark.parametrize("error", [KeyboardInterrupt, ValueError])
def test_what_runs_at_the_end_is_interrupted_or_finished(double, error, tmp_path):
    """Ctrl-C ends all at once; after an error, what was begun leaves nothing half."""

    def use(crew):
        for _, done in crew.each(double, [1, tmp_path / "slow", 2, 3]):
            assert ended(done.value()[1]) is False
            raise error

    with pytest.raises(error), Crew(2) as crew:
        use(crew)
    assert (tmp_path / "slow").exists() == (error is ValueError)


def test_what_cannot_be_loaded_elsewhere_is_the_answer_to_each_task(double):
    class Broken:
        def __reduce__(self):
            return int, ("no number",)

    with Crew(2) as crew:
        found = list(crew.each(Broken(), [1, 2]))
    assert [done.message for _, done in found] == [
        "ValueError: invalid literal for int() with base 10: 'no number'"
    ] * 2


def test_an_executor_of_the_caller(double):
    with ThreadPoolExecutor(2) as executor:
        with Crew(executor=executor) as crew:
            found = dict(crew.each(double, [1, "error", 3]))
        assert executor.submit(int).result() == 0  # it is the caller's to end
    assert (found[0].value()[0], found[1].message, found[2].value()[0]) == (2, "KeyError: 'no such thing'", 6)


def test_processes_end_with_the_one_that_started_them(double, tmp_path):
    """Killed, it can end nobody: they must see it themselves, in the middle of a task too."""
    code = """
import os, sys, time
from work_of_a_test import double
from stereodel._tasks.crew import Crew
results = Crew(2).each(double, [1, 2, "sleep", "sleep"])
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
    with Crew(2) as crew:
        list(crew.each(double, [1, 2]))
    assert (getattr(main, "__file__", None), main.__spec__) == before
    assert pickle.loads(pickle.dumps(double)) is double
