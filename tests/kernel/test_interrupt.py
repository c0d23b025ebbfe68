"""Ctrl-C in the middle of long calls: they end soon, and what they worked on is what it was; calls without threads.

Each in a process of its own: a signal that comes late must not hit the test runner.
"""

import subprocess
import sys

import pytest


def printed(program, *command):
    command = command or (sys.executable, "-c")
    ran = subprocess.run([*command, program], capture_output=True, text=True, check=False, timeout=120)
    assert ran.returncode == 0, ran.stderr
    return ran.stdout


PROGRAM = """
import signal, time
import numpy as np
from stereodel import PlanarDelaunay, SphericalDelaunay, check_delaunay

rng = np.random.default_rng(0)
cluster = np.array([0.6, 0.5, 0.3]) + 1e-14 * rng.normal(size=(400_000, 3))  # every sign takes long
few = SphericalDelaunay(rng.normal(size=(500, 3)))
signal.signal(signal.SIGALRM, signal.default_int_handler)
started = []

def interrupt_after(seconds):
    signal.setitimer(signal.ITIMER_REAL, seconds)
    started.append(time.perf_counter() + seconds)

try:
    {call}
except KeyboardInterrupt:
    print(time.perf_counter() - started[-1])
else:
    print("ended")
assert len(few.points) == 500
check_delaunay(few)
check_delaunay(SphericalDelaunay(cluster[:100]))
"""
CALLS = {
    "build": "interrupt_after(0.1); SphericalDelaunay(cluster, workers=1)",
    "build on two threads": "interrupt_after(0.1); SphericalDelaunay(cluster, workers=2)",
    "insert": "interrupt_after(0.1); few.insert(cluster)",
    "find_simplex": "interrupt_after(0.05); few.find_simplex(np.repeat(few.points, 20_000, axis=0), workers=1)",
}


@pytest.mark.skipif(sys.platform == "win32", reason="no timers there")
@pytest.mark.parametrize(
    "call",
    [pytest.param(c, marks=pytest.mark.thorough if c in ("insert", "build on two threads") else ()) for c in CALLS],
)
def test_an_interrupted_call_ends_soon_and_harms_nothing(call, patience):
    program = PROGRAM.format(call=CALLS[call])
    assert float(printed(program)) < 2.0 * patience  # half a second on a quiet machine


INTERRUPTED = """
import signal
import numpy as np
from stereodel import _kernel, check_delaunay

points = np.random.default_rng(0).random((400_000, 2))
mesh = _kernel.plane.Mesh(points[:{size}], *_kernel.plane.triangulate(points[:{size}])[:3])
before = mesh.read()
signal.signal(signal.SIGALRM, signal.default_int_handler)
for k, change in enumerate(({changes})):
    signal.setitimer(signal.ITIMER_REAL, 0.01)
    try:
        change()
    except KeyboardInterrupt:
        print("interrupted")
    after = mesh.read()
    check_delaunay(after[1], after[2], duplicates=after[4], neighbors=after[3])
    if after[0] == before[0]:  # else it came at the very end
        print("undone")
        assert np.array_equal(after[1], before[1])
        assert after[5:] == before[5:]
    size = len(after[1])
    assert mesh.insert(points[:1]) == size
    check_delaunay(mesh.read()[1], mesh.read()[2])
    assert mesh.remove(np.array([size], dtype=np.int32)).tolist()[-1] == -1
    before = mesh.read()
"""
CHANGES = {
    "insert": (1000, "lambda: mesh.insert(points[1000:]), lambda: mesh.insert(points[1000:], 1, 3)"),
    "remove": (100_000, "lambda: mesh.remove(np.arange(95_000, dtype=np.int32))"),
}


@pytest.mark.skipif(sys.platform == "win32", reason="no timers there")
@pytest.mark.parametrize("change", CHANGES)
def test_a_change_that_was_interrupted_leaves_what_was_before(change):
    """Unless it came to its end all the same."""
    size, changes = CHANGES[change]
    program = INTERRUPTED.format(size=size, changes=f"{changes},")
    words = printed(program).split()
    assert words.count("interrupted") == changes.count("lambda")
    assert "undone" in words


ALONE = """
import threading
import numpy as np
from stereodel import PlanarDelaunay, SphericalDelaunay

try:
    threading.Thread(target=print).start()
except RuntimeError:
    print("no thread")
rng = np.random.default_rng(0)
for cls, points in ((PlanarDelaunay, rng.random((50_000, 2))), (SphericalDelaunay, rng.normal(size=(50_000, 3)))):
    for workers in (1, 2):
        made = cls(points, workers=workers)
        print(len(made.simplices), int(made.simplices[::7].sum()))
        print(int(made.find_simplex(points[::2] + 1e-3, workers=workers).sum()))
    made.insert(points[:3000] + 1e-3)
    print(len(made.simplices), int(made.simplices[::7].sum()))
"""


@pytest.mark.thorough
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="limits of stacks are Linux's")
def test_where_no_thread_is_to_be_had_long_calls_work_without():
    """A limit of 2^47 bytes is also the size of each thread's stack: it leaves room for none."""
    limited = 'ulimit -s 137438953472 && OPENBLAS_NUM_THREADS=1 exec "$0" -c "$1"'
    alone = printed(ALONE, "bash", "-c", limited, sys.executable).splitlines()
    assert alone[0] == "no thread"
    assert alone[1:] == printed(ALONE).splitlines()[-10:]
