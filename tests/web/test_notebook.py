"""The widget, alone and in JupyterLab: drawn, turned, set from both sides, ten at once, opened again as it was."""

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
from functools import partial

import numpy as np
import pytest

from stereodel import fisheye
from stereodel.drawing import View
from stereodel.io import PointTable
from stereodel.web import GlobeWidget
from tools.browser import Visit

from .test_globe_room import Globe

FIRST = """
from pathlib import Path
from stereodel.web import GlobeWidget

places = [(10.0, 48.4), (-78.5, -0.2), (3.4, 6.5)]
globe = GlobeWidget(places, focus=(10, 48.4), magnification=3, view=(10, 30), layout={"width": "700px"})
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
    assert first.bounding_box()["width"] == pytest.approx(700, abs=20)  # as its layout says, and not 640
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


# The widget alone, with a model that keeps what it is told

ALONE = """<!doctype html><meta charset="utf-8"><style>%s</style><div id="here"></div><script type="module">
const read = (_, value) => (value?.doubles ? new DataView(Float64Array.from(value.doubles).buffer) : value);
const [state, heard] = [JSON.parse(%s, read), {}];
const set = (name, value) => { state[name] = value; heard["change:" + name]?.(); };
window.model = { get: (name) => state[name], set, save_changes() {}, on: (name, act) => (heard[name] = act), off() {} };
const script = URL.createObjectURL(new Blob([%s], { type: "text/javascript" }));
const { default: widget } = await import(script);
await widget.render({ model, el: document.querySelector("#here") });
window.isShown = true;
</script>"""


def alone(visit, tmp_path, widget):
    """A page of a widget's traits, and where places of the Earth are on it."""
    state = {name: getattr(widget, name) for name in ("sites", "names", "look", "layers", "lens", "view", "selection")}
    text = json.dumps(state, default=lambda value: {"doubles": np.frombuffer(value).tolist()})
    file = tmp_path / "alone.html"
    file.write_text(ALONE % (widget._css, json.dumps(text), json.dumps(widget._esm)), encoding="utf-8")
    page = visit(file, height=1000)
    page.until("window.isShown")
    page.rest()
    return page, partial(Globe(page, "canvas").seen_at, lens=fisheye(**widget.lens), view=View(**widget.view))


def test_places_layers_and_the_hand(visit, tmp_path):
    globe = GlobeWidget(
        PLACES, names=["Quito", "Lagos", "Ulm"], values=[2.5, 15.5, 0.1], legend="people, M", view=(10, 20)
    )
    box = [[-20, 0], [20, 0], [20, 20], [-20, 20], [-20, 0]]
    hole = [[-5, 5], [-5, 15], [5, 15], [5, 5], [-5, 5]]
    globe.add_layer({"type": "Polygon", "coordinates": [box, hole]}, color="#ff0000", legend="a region")
    globe.add_layer({"type": "LineString", "coordinates": [[-40, 60], [60, 60]]}, color="#00ff00")
    page, at = alone(visit, tmp_path, globe)
    pixels = page.picture().astype(int)

    def redness(*place):
        x, y = np.rint(at(place)).astype(int)
        return (pixels[y, x] - pixels[y, x].mean()).tolist()[0]

    assert redness(-12, 10) > 100 < redness(12, 3)
    assert redness(0, 10) < 40 > redness(30, 10)
    x, y = np.rint(at((30, 60))).astype(int)  # on the parallel and not on the great circle
    assert (pixels[y - 2 : y + 3, x, 1] - pixels[y - 2 : y + 3, x, 0]).max() > 60
    assert "a region" in page.page.locator(".legend").inner_text()

    page.page.mouse.move(*at((3.4, 6.5)))
    said = page.page.locator("[role=status]").inner_text().replace("\u202f", " ")
    assert said.startswith("Lagos, 6.50° N 3.40° E, people 15.5 M")
    page.page.mouse.click(*at((3.4, 6.5)))
    assert page.page.evaluate("model.get('selection')") == [1]
    page.page.mouse.wheel(0, -100)
    page.until("model.get('lens').magnification > 1.1")
    page.page.evaluate("model.set('lens', { focus: [10, 48], magnification: 500 })")
    page.page.mouse.wheel(0, -100)
    page.rest()
    assert page.page.evaluate("model.get('lens').magnification") == 500  # what Python asks for is no less by hand


# The Python side

PLACES = [(-78.5, -0.2), (3.4, 6.5), (10.0, 48.4)]


def test_tables_and_frames_give_places_names_and_values():
    table = PointTable(PLACES, {"name": ["Quito", "Lagos", "Ulm"], "people": [2.5, 15.5, np.nan]})
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame({"lat": [p[1] for p in PLACES], "lon": [p[0] for p in PLACES], **table.columns})
    for given in (table, frame):
        globe = GlobeWidget(given, values="people")
        assert globe.lonlat.tolist() == [list(place) for place in PLACES]
        assert globe.names == ["Quito", "Lagos", "Ulm"]
        assert globe.look["columns"] == [("people", [2.5, 15.5, None])]
        assert json.dumps(globe.look, allow_nan=False)
    globe.lonlat = PLACES[:2]
    assert (globe.names, globe.look) == ([], {"legend": ""})


def test_properties_set_the_lens_and_nothing_is_taken_silently():
    globe = GlobeWidget(lonlat=PLACES, layout={"width": "900px"})
    globe.magnification, globe.focus = 5, (10, 48)
    assert globe.lens == {"focus": (10.0, 48.0), "magnification": 5.0}
    assert globe.layout.width == "900px"
    for name in ("lens", "view"):
        with pytest.raises(TypeError, match="set widget"):
            getattr(globe, name)["magnification"] = 9
    with pytest.raises(TypeError, match="no argument magnifcation; did you mean magnification"):
        GlobeWidget(lonlat=PLACES, magnifcation=9)
    with pytest.raises(ValueError, match="names has 1 entries, but there are 3 places"):
        GlobeWidget(PLACES, names=["Quito"])
    with pytest.raises(ValueError, match="there is no column 'size'"):
        GlobeWidget(PLACES, values="size")


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
