"""Runs that are killed: nothing of them stays, and whatever is begun after them, at once, is right."""

import json
import os
import random
import signal
import subprocess
import sys
import time
from collections import Counter
from contextlib import suppress
from pathlib import Path

import pytest

import stereodel
from stereodel.partitioned import Run
from tests.partitioned.answers import clean, differences, in_memory, rows_of, write_points
from tests.tiers import by_day

SECONDS = 10
"""In which the processes of a run that was killed end, on a machine that does much else."""

SOAKS, KILLS = int(os.environ.get("STEREODEL_TEST_SOAKS", "5")), 20
"""A hundred kills in tests of less than a minute, or of some minutes on a machine that does much else."""

SIGNALS = (signal.SIGTERM, signal.SIGKILL, signal.SIGINT)

DRIVER = """
import json, signal, sys
from stereodel.partitioned import Execution, plan, triangulate
if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.default_int_handler)
    plan.LEAST_SHARE = 1
    points, out, options = map(json.loads, sys.argv[1:])
    triangulate(points, out, execution=Execution(progress=lambda *told: print(*told, flush=True), **options))
"""


@pytest.fixture
def points(tmp_path):
    columns, rows = rows_of("random", 3000)
    (tmp_path / "driver.py").write_text(DRIVER)
    return write_points(tmp_path / "points", columns, rows), in_memory(columns, rows)


def driver(folder, points, out, **options):
    """A process in a session of its own, by which those that it starts are known."""
    environment = os.environ | {"PYTHONPATH": str(Path(stereodel.__file__).parents[1])}
    command = [sys.executable, "driver.py", *map(json.dumps, (str(points), str(out), options))]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True}
    return subprocess.Popen(command, cwd=folder, env=environment, start_new_session=True, **pipes)


def processes(session):
    """Processes of a session that have not ended."""
    found = set()
    for path in Path("/proc").glob("[0-9]*"):
        try:
            fields = (path / "stat").read_text().rpartition(")")[2].split()
        except OSError:  # it has ended meanwhile
            continue
        if int(fields[3]) == session and fields[0] not in "ZX":
            found.add(int(path.name))
    return found


def is_helper(pid):
    """Whether a process does no tasks: it frees what those that end leave in the system."""
    try:
        return b"resource_tracker" in (Path("/proc") / str(pid) / "cmdline").read_bytes()
    except OSError:  # it has ended meanwhile
        return False


def left(session):
    """Processes that have not ended in time."""
    end = time.monotonic() + SECONDS
    while (found := processes(session)) and time.monotonic() < end:
        time.sleep(0.05)
    return found


def reached(process, name, done):
    """Wait until so many tasks of a pass are done."""
    for line in process.stdout:
        said, count, _ = line.split()
        if said == name and int(count) >= done:
            return
    raise AssertionError(f"{name} {done} was not reached")


WHEN = [(name, number) for name in ("spread", "solve", "align") for number in SIGNALS]


@pytest.mark.parametrize(("name", "number"), by_day(WHEN, ("solve", signal.SIGKILL)))
def test_a_driver_that_is_killed(tmp_path, points, name, number):
    """Its workers end with it, and so does a pipe behind it; what is begun at once with other arguments is right."""
    folder, truth = points
    process = driver(tmp_path, folder, tmp_path / "out", partition=100)
    reached(process, name, 2)
    assert len(processes(process.pid)) > 2  # or the test has nothing to show
    process.send_signal(number)
    process.wait(timeout=SECONDS)
    with driver(tmp_path, folder, tmp_path / "out", partition=170, resume=False) as second:
        said = second.communicate(timeout=120)[0]
    assert second.returncode == 0, said
    process.communicate(timeout=SECONDS)
    assert left(process.pid) == set()
    assert left(second.pid) == set()
    assert differences(Run(tmp_path / "out"), truth) == []
    assert clean(tmp_path / "out")


@pytest.mark.thorough
@pytest.mark.parametrize("seed", range(SOAKS))
def test_soak(tmp_path, points, seed):
    """Random processes of runs are killed at random times, with new runs begun at once."""
    (folder, truth), chance, counts, out, runs = points, random.Random(seed), Counter(), tmp_path / "out", []
    before = {path: (path.read_bytes(), path.stat().st_mtime_ns) for path in folder.iterdir()}
    began = time.monotonic()
    with driver(tmp_path, folder, out, partition=100) as process:
        process.communicate()
    usual = time.monotonic() - began
    while counts["killed"] < KILLS:
        begun = json.loads((out / "plan.json").read_text())["partition"] if (out / "plan.json").exists() else None
        resume = begun is not None and not (out / "run.json").exists() and chance.random() < 0.7
        partition = begun if resume else chance.choice([each for each in (100, 140, 230) if each != begun])
        process = driver(tmp_path, folder, out, partition=partition, resume=resume)
        runs.append(process)
        began = time.monotonic()
        with suppress(subprocess.TimeoutExpired):
            process.wait(timeout=chance.uniform(0, usual))
            if not resume:
                usual = min(usual, time.monotonic() - began)  # the machine may do less than it did
        victims = {"driver": [process.pid], "worker": [], "helper": []}
        for pid in sorted(processes(process.pid) - {process.pid}):
            victims["helper" if is_helper(pid) else "worker"].append(pid)
        there = [name for name in ("driver", "driver", "driver", "worker", "worker", "helper") if victims[name]]
        name, number = chance.choice(there), chance.choice(SIGNALS)
        if process.poll() is None:
            with suppress(ProcessLookupError):  # it has ended meanwhile
                os.kill(chance.choice(victims[name]), number)
                counts.update(["killed", f"{name} {number.name}", "resumed" if resume else "begun anew"])
        if name == "driver" and process.wait(timeout=120):
            continue  # at once: its workers may be there still
        said = process.communicate(timeout=120)[0]
        assert process.returncode == 0, (name, number, said[-2000:])
        counts["ended"] += 1
        assert differences(Run(out), truth) == []
        assert clean(out)
    with driver(tmp_path, folder, out, partition=300, resume=False) as process:
        assert process.communicate()[0]
    assert process.returncode == 0
    assert differences(Run(out), truth) == []
    assert clean(out)
    assert [left(process.pid) for process in runs] == [set()] * len(runs)
    for process in runs:
        process.communicate(timeout=SECONDS)
    assert {path: (path.read_bytes(), path.stat().st_mtime_ns) for path in folder.iterdir()} == before
    print(dict(counts))
