"""Threads at the same time, for tests."""

import threading
import time


def at_once(*works):
    """Call all in threads of their own; raises what the first of them raised."""
    errors = []

    def run(work):
        try:
            work()
        except BaseException as error:  # raised below
            errors.append(error)

    threads = [threading.Thread(target=run, args=(work,)) for work in works]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(60)
    assert not any(thread.is_alive() for thread in threads)
    if errors:
        raise errors[0]


def until(seconds, work):
    """`work`, again and again for a while."""
    end = time.monotonic() + seconds

    def run():
        while time.monotonic() < end:
            work()

    return run


def begun(change, mesh):
    """The thread that makes a change of a kernel's mesh, once it does: then who asks the mesh must wait."""
    changer = threading.Thread(target=change)
    changer.start()
    asks, asker = threading.Event(), threading.Thread()
    while changer.is_alive() and not asker.is_alive():
        asks.clear()
        asker = threading.Thread(target=lambda: (asks.set(), mesh.size))
        asker.start()
        asks.wait()
        asker.join(0.02)
    return changer
