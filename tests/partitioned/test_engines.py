"""Processes, threads and Dask: whoever computes, the answer is the same."""

import os
import signal
from concurrent.futures import ThreadPoolExecutor

import pytest

from tests.partitioned.answers import differences


def test_processes_of_this_machine(points):
    points.check(jobs=None)


def test_threads(points):
    with ThreadPoolExecutor(4) as executor:
        points.check(jobs=None, executor=executor)
        assert executor.submit(int).result() == 0  # it is the caller's to end


@pytest.mark.thorough
def test_dask(tmp_path, points):
    """Two workers, one of which is lost; files are equal byte by byte to those of one process."""
    distributed = pytest.importorskip("distributed")
    cluster = distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=None, local_directory=str(tmp_path / "dask")
    )
    with cluster, distributed.Client(cluster) as client:
        executor, killed = client.get_executor(pure=False), []

        def progress(name, done, of):
            if name == "solve" and done == 2 and not killed:
                killed.append(executor.submit(os.getpid).result())
                os.kill(killed[0], signal.SIGKILL)

        run = points.run(jobs=None, executor=executor, progress=progress)
    assert killed
    assert differences(run, points.truth) == []
    other = points.run("other")
    files = [path.relative_to(run.folder) for path in run.folder.rglob("*.parquet")]
    assert len(files) > 10
    assert all((run.folder / file).read_bytes() == (other.folder / file).read_bytes() for file in files)
