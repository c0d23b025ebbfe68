"""The widget in JupyterLab: drawn, turned, set from both sides, ten at once, and as it was when it is opened again."""

import json
import os
import secrets
import socket
import subprocess
import sys
import time
import urllib.error
import urllib.request
from contextlib import suppress

import pytest

from stereodel import fisheye
from stereodel.drawing import View
from stereodel.web import GlobeWidget
from tools.browser import Visit

FIRST = """
from pathlib import Path
from stereodel.web import GlobeWidget

globe = GlobeWidget(lonlat=[(10.0, 48.4), (-78.5, -0.2), (3.4, 6.5)], focus=(10, 48.4), magnification=3, view=(10, 30))
said = lambda change: Path(f"{change['name']}.txt").write_text(str(change["new"]))
globe.observe(said, ["lens", "view", "selection"])
globe
"""

TEN = """
from IPython.display import display
others = [GlobeWidget(view=(36 * k, 0)) for k in range(10)]
display(*others)
"""

SET = """
globe.lens = {"focus": (139.7, 35.7), "magnification": 8}
"""

READY = """(() => {
  const app = window.jupyterapp, panel = app?.shell.currentWidget;
  return panel?.context?.isReady && panel.sessionContext.session?.kernel?.status === "idle";
})()"""

RUN = "(code) => jupyterapp.shell.currentWidget.sessionContext.session.kernel.requestExecute({ code }).done"

PIXELS = "document.querySelector('.stereodel-globe canvas').toDataURL()"

DRAWN = "document.querySelectorAll('.stereodel-globe[data-frames]').length"

FRAMES = """[...document.querySelectorAll(".stereodel-globe")]
  .reduce((sum, globe) => sum + Number(globe.dataset.frames), 0)"""

COMPILED = """(() => {
  window.compiled = 0;
  const compile = WebAssembly.compile;
  WebAssembly.compile = (...given) => { window.compiled += 1; return compile(...given); };
})()"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """The folder of the notebook, where the widgets' state is saved with it."""
    import nbformat  # takes a second

    folder = tmp_path_factory.mktemp("lab")
    settings = folder / "settings" / "@jupyter-widgets" / "jupyterlab-manager"
    settings.mkdir(parents=True)
    (settings / "plugin.jupyterlab-settings").write_text('{"saveState": true}')
    quiet = folder / "settings" / "@jupyterlab" / "apputils-extension"
    quiet.mkdir(parents=True)
    (quiet / "notification.jupyterlab-settings").write_text('{"fetchNews": "false"}')
    cells = [nbformat.v4.new_code_cell(code) for code in (FIRST, TEN)]
    notebook = nbformat.v4.new_notebook(cells=cells)
    notebook.metadata["kernelspec"] = {"name": "python3", "display_name": "Python 3", "language": "python"}
    nbformat.write(notebook, folder / "globe.ipynb")
    return folder


@pytest.fixture(scope="module")
def lab(folder):
    """The address of the notebook in a JupyterLab of its own, which asks for nothing beyond this machine."""
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        port = found.getsockname()[1]
    token = secrets.token_hex(16)
    options = {
        "ServerApp.ip": "127.0.0.1",
        "ServerApp.port": port,
        "ServerApp.root_dir": folder,
        "IdentityProvider.token": token,
        "LabApp.expose_app_in_browser": True,
        "LabApp.news_url": None,
        "LabApp.check_for_updates_class": "jupyterlab.NeverCheckForUpdate",
        "LabApp.extension_manager": "readonly",
    }
    folders = {f"JUPYTER_{name}_DIR": name.lower() for name in ("CONFIG", "DATA", "RUNTIME")}
    folders |= {"JUPYTERLAB_SETTINGS_DIR": "settings", "IPYTHONDIR": "ipython", "HOME": ""}
    line = [sys.executable, "-m", "jupyterlab", "--no-browser", "--allow-root"]
    line += [f"--{name}={value}" for name, value in options.items()]
    environment = os.environ | {name: str(folder / part) for name, part in folders.items()}
    with (folder / "log").open("w") as log:
        server = subprocess.Popen(line, env=environment, stdout=log, stderr=subprocess.STDOUT)
    try:
        for _ in range(600):
            assert server.poll() is None, (folder / "log").read_text()
            with suppress(urllib.error.URLError, ConnectionError):
                urllib.request.urlopen(f"http://127.0.0.1:{port}/api?token={token}", timeout=5).close()
                break
            time.sleep(0.1)
        yield f"http://127.0.0.1:{port}/lab/tree/globe.ipynb?token={token}"
    finally:
        server.terminate()
        server.wait(30)


@pytest.fixture(scope="module")
def notebook(browser, lab):
    """The notebook, open."""
    visit = Visit(browser, lab, height=1400)
    visit.page.evaluate(COMPILED)
    visit.until(READY, seconds=120)
    yield visit
    assert {address.split("/")[2] for address in visit.requests} == {lab.split("/")[2]}
    visit.close()


def came_back(folder, name, seconds):
    """What the kernel was told of a trait, within so many seconds."""
    path, end = folder / f"{name}.txt", time.monotonic() + seconds
    while not path.exists() or not path.read_text():
        assert time.monotonic() < end, f"{name} did not come back"
        time.sleep(0.02)
    return path.read_text()


def test_a_notebook_from_the_first_run_to_the_next_time(notebook, folder, lab, browser, patience):
    page = notebook.page
    page.evaluate("void jupyterapp.commands.execute('notebook:run-all-cells')")
    notebook.until(f"{DRAWN} >= 1", seconds=3 * patience)
    notebook.until(f"{DRAWN} === 11", seconds=10 * patience)
    notebook.rest()
    assert page.evaluate("compiled") == 1  # one module for all of them
    assert notebook.ink(".stereodel-globe canvas") > 0.2
    drawn = page.evaluate(FRAMES)
    page.wait_for_timeout(500)
    assert page.evaluate(FRAMES) == drawn  # JupyterLab itself draws now and then, such as its list of files

    first = page.locator(".stereodel-globe canvas").first
    first.focus()
    first.press("+")
    lens = came_back(folder, "lens", 1 * patience)
    assert "3.75" in lens
    first.press("ArrowLeft")
    assert "'lon': 5" in came_back(folder, "view", 1 * patience)

    # Sites are selected by keys, and by a click: the one in the middle, once it has been walked to.
    for key in (".", "Enter"):
        first.press(key)
    assert came_back(folder, "selection", 1 * patience) == "[0]"
    (folder / "selection.txt").unlink()
    first.press(".")
    page.wait_for_timeout(300)
    box = first.bounding_box()
    page.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    assert came_back(folder, "selection", 1 * patience) == "[0, 1]"
    assert "selected: 0, 1" in first.get_attribute("aria-label")
    (folder / "selection.txt").unlink()
    first.press("Escape")
    assert came_back(folder, "selection", 1 * patience) == "[]"

    # The hand turns the globe: what it holds stays under the pointer.
    (folder / "view.txt").unlink()
    x, y = notebook.middle(".stereodel-globe canvas")
    notebook.drag((x, y), (x + 40, y))
    assert came_back(folder, "view", 1 * patience)
    (folder / "lens.txt").unlink()
    page.mouse.dblclick(x, y)
    assert "focus" in came_back(folder, "lens", 1 * patience)
    assert not (folder / "selection.txt").exists() or (folder / "selection.txt").read_text() == "[]"

    # Set from Python: the picture follows.
    before = page.evaluate(PIXELS)
    page.evaluate("jupyterapp.shell.currentWidget.content.activeCellIndex = 1")
    page.evaluate(RUN, SET)
    page.wait_for_timeout(500)
    notebook.rest()
    assert page.evaluate(PIXELS) != before

    page.evaluate("jupyterapp.commands.execute('docmanager:save')")
    page.wait_for_timeout(1000)
    saved = json.loads((folder / "globe.ipynb").read_text())["metadata"]["widgets"]
    (state,) = saved.values()
    lenses = [model["state"]["lens"] for model in state["state"].values() if "lens" in model["state"]]
    assert len(lenses) == 11
    assert {"focus": [139.7, 35.7], "magnification": 8.0} in lenses

    # Without its kernel: what was saved is shown.
    still = page.evaluate(PIXELS)
    page.evaluate("jupyterapp.serviceManager.sessions.shutdownAll()")
    again = reopened(browser, lab, patience)
    again.rest()
    assert again.page.evaluate(PIXELS) == still
    again.close()


def reopened(browser, lab, patience):
    """The notebook with widgets drawn, as JupyterLab opens it.

    Where the new kernel connects before the notebook's own models are loaded, JupyterLab's manager of widgets takes
    what the kernel has, which is nothing, for all that will come: each says "widget model not found", and stays so.
    A reader loads the page again.
    """
    for workspace in ("again", "once-more", "and-once-more"):
        visit = Visit(browser, lab.replace("/lab/tree", f"/lab/workspaces/{workspace}/tree"), height=1400)
        lost = "document.body.innerText.includes('model not found')"
        visit.until(f"{DRAWN} >= 1 || {lost}", seconds=60 * patience)
        if not visit.page.evaluate(lost):
            break
        visit.close()
    return visit


# The Python side


def test_arguments_are_checked_and_results_are_arguments():
    globe = GlobeWidget(lonlat=[(10.0, 48.4), (-78.5, -0.2)], magnification=2, view=(20, 30))
    assert globe.lonlat.tolist() == [[10.0, 48.4], [-78.5, -0.2]]
    assert globe.lens == {"focus": (20.0, 30.0), "magnification": 2.0}
    assert View(**globe.view) == View(20.0, 30.0)
    assert fisheye(**globe.lens).magnification == pytest.approx(2.0)
    globe.selection = [1]
    globe.lonlat = [(0, 0)]
    assert globe.selection == []
    globe.lonlat = []
    assert globe.lonlat.shape == (0, 2)
    assert len(globe._esm) < 400_000  # is sent and stored for every widget


@pytest.mark.parametrize(
    ("name", "value", "said"),
    [
        ("lens", {"focus": (0, 91), "magnification": 2}, "latitude 91"),
        ("lens", {"focus": (0, 0), "magnification": 0}, r"magnification is 0\.0, outside \(0"),
        ("lens", {"focus": (0, 0)}, "lens has the entries 'focus', but must have focus and magnification"),
        ("view", {"lon": 0, "lat": -91, "roll": 0}, "latitude -91"),
        ("view", {"lon": 0}, "view has the entries 'lon', but must have lon, lat and roll"),
        ("selection", [2], "selection has site 2, but the numbers of 2 sites are below 2"),
        ("lonlat", [(0, 99)], "latitude 99"),
    ],
)
def test_wrong_values_are_refused_and_change_nothing(name, value, said):
    globe = GlobeWidget(lonlat=[(0, 0), (1, 1)])
    before = getattr(globe, name)
    with pytest.raises(ValueError, match=said):
        setattr(globe, name, value)
    assert str(getattr(globe, name)) == str(before)
