"""Modules that other processes find, whether those are gone, and waiting for it."""

import sys
import time
from contextlib import contextmanager
from importlib import import_module
from pathlib import Path


@contextmanager
def importable(folder, name, code, monkeypatch):
    """A module of this code in a folder of the path, which other processes have from this one."""
    folder.mkdir(exist_ok=True)
    (folder / f"{name}.py").write_text(code)
    monkeypatch.syspath_prepend(str(folder))
    monkeypatch.delitem(sys.modules, name, raising=False)
    yield import_module(name)
    sys.modules.pop(name, None)


def ended(pid):
    """Whether a process is gone, or waits for nobody to ask after it."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] == "Z"
    except OSError:
        return True


def wait_until(condition, seconds=60):
    limit = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < limit
        time.sleep(0.02)
