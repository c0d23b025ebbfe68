"""Processes, threads and Dask: whoever computes, the answer is the same."""

import os
import signal
from concurrent.futures import ThreadPoolExecutor

import pytest

from tests.partitioned.answers import differences, in_memory, in_parallel, of_run, rows_of, write_points

COLUMNS, ROWS = rows_of("copied", 1200)


@pytest.fixture(scope="module")
def truth():
    return in_memory(COLUMNS, ROWS)


@pytest.fixture
def points(tmp_path):
    return write_points(tmp_path / "points", COLUMNS, ROWS)


def test_processes_of_this_machine(tmp_path, points, truth):
    assert differences(in_parallel(points, tmp_path / "out", partition=150), truth) == []


def test_threads(tmp_path, points, truth):
    with ThreadPoolExecutor(4) as executor:
        run = in_parallel(points, tmp_path / "out", partition=150, executor=executor)
        assert executor.submit(int).result() == 0  # it is the caller's to end
    assert differences(run, truth) == []


def pid(_):
    return os.getpid()


@pytest.mark.thorough
def test_dask(tmp_path, points, truth):
    """Two workers, one of which is lost; files are equal byte by byte to those of one process."""
    distributed = pytest.importorskip("distributed")
    cluster = distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=None, local_directory=str(tmp_path / "dask")
    )
    with cluster, distributed.Client(cluster) as client:
        executor, killed = client.get_executor(pure=False), []

        def progress(name, done, of):
            if name == "solve" and done == 2 and not killed:
                killed.append(executor.submit(pid, 0).result())
                os.kill(killed[0], signal.SIGKILL)

        run = in_parallel(points, tmp_path / "out", partition=150, executor=executor, progress=progress)
    assert killed
    assert differences(run, truth) == []
    other = in_parallel(points, tmp_path / "other", partition=150, jobs=1)
    files = [path.relative_to(run.folder) for path in run.folder.rglob("*.parquet")]
    assert len(files) > 10
    assert all((run.folder / file).read_bytes() == (other.folder / file).read_bytes() for file in files)
    assert of_run(other)[0].shape == truth[0].shape
