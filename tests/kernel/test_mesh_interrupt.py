"""Ctrl-C in the middle of a long change."""

import signal

import numpy as np
import pytest

from stereodel import _kernel


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="no timers on this platform")
def test_an_interrupted_change_ends_soon_and_is_not_used():
    points = np.random.default_rng(0).random((400_000, 2))
    simplices, neighbors, duplicates, _, _ = _kernel.triangulate_plane(points[:1000])
    mesh = _kernel.PlaneMesh(points[:1000], simplices, neighbors, duplicates)
    previous = signal.signal(signal.SIGALRM, signal.default_int_handler)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.02)
        with pytest.raises(KeyboardInterrupt):
            mesh.insert(points[1000:])
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, previous)
    for use in (mesh.arrays, lambda: mesh.insert(points[:1]), lambda: mesh.remove(np.zeros(1, dtype=np.int32))):
        with pytest.raises(ValueError, match="did not come to its end"):
            use()
