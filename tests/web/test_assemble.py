"""The page as one file: what stands in it, what may run in it, and what it asks for."""

import json
import re

import numpy as np
import pytest

from stereodel.web import assemble, contents, web

PLACES = ['<meta charset="utf-8" />', '<link rel="stylesheet" href="page.css" />', '<script src="page.js"></script>']
TEMPLATE = """<!doctype html><html lang="en"><head>{}<title>A page</title>{}</head>
<body><p id="said">Nothing yet</p>{}</body></html>
""".format(*PLACES)
SCRIPT = """
const end = "</script><!--<script>";
const inflate = async (id) => {
  const bytes = Uint8Array.from(atob(document.getElementById(id).textContent), (c) => c.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"))).arrayBuffer();
};
const refused = (act) => { try { act(); return "allowed"; } catch { return "refused"; } };
const run = (code) => {
  const element = Object.assign(document.createElement("script"), { given: "before", textContent: code });
  document.head.append(element);
  return element.told;
};
(async () => {
  const module = await WebAssembly.compile(await inflate("block-kernel"));
  const name = document.getElementById("block-given-name");
  window.report = {
    end,
    module: module instanceof WebAssembly.Module,
    name: name && JSON.parse(new TextDecoder().decode(await inflate("block-given-name"))),
    eval: refused(() => eval("1")),
    function: refused(() => new Function("return 1")()),
    second: run(new TextDecoder().decode(await inflate("block-exchange"))),
    third: run("document.currentScript.told = 'allowed';") ?? "refused",
    fetch: await fetch("http://127.0.0.1:9/").then(() => "allowed", () => "refused"),
    colour: getComputedStyle(document.getElementById("said")).color,
  };
})();
"""
BUILT = {
    "page.html": TEMPLATE,
    "page.js": SCRIPT,
    "exchange.js": "document.currentScript.told = `${document.currentScript.given} and after`;",
    "lift.js": "",
    "page.css": '#said { color: rgb(1, 2, 3); } #said::after { content: "</style>"; }',
    "stereodel.wasm": b"\0asm\1\0\0\0",
    "widget.js": "export default {};",
}


@pytest.fixture
def built(monkeypatch):
    """What was built, which a test may change."""
    files = dict(BUILT)

    def read(name):
        content = files[name]
        return content if isinstance(content, bytes) else content.encode()

    for module in (assemble, contents):
        monkeypatch.setattr(module, "built", read)
    monkeypatch.setattr(assemble, "template", lambda: files["page.html"])
    kept = (contents.kernel, assemble.module)
    for each in kept:
        each.cache_clear()
    yield files
    for each in kept:
        each.cache_clear()


def test_a_page_runs_by_itself(built, visit, tmp_path):
    file = web(tmp_path / "page.html", lonlat=[(10, 48.4)], name='</script><script>alert("x")</script>')
    page = visit(file, complaints=("Content Security Policy", "unsafe-eval"))
    page.until("window.report")
    expected = dict.fromkeys(("eval", "function", "third", "fetch"), "refused")
    expected |= {"end": "</script><!--<script>", "module": True, "name": '</script><script>alert("x")</script>'}
    assert page.page.evaluate("report") == expected | {"second": "before and after", "colour": "rgb(1, 2, 3)"}
    assert page.requests == [file.as_uri()]


def test_the_same_page_every_time(built):
    assert assemble.html("110m") == assemble.html("110m")
    given = contents.Given(np.array([(1.0, 2.0)]), "one")
    blocks = set(re.findall('id="block-([^"]+)"', assemble.html("50m", given)))
    expected = {"land-110m", "land-50m", "kernel", "exchange", "lift", "airports", "cities", "stars"}
    assert blocks == expected | {*contents.scattered(), "given", "given-name", "latitude"}
    assert "land-50m" not in assemble.html("110m")
    of_the_widget = assemble.module("110m")
    assert of_the_widget.endswith("export default {};")
    assert set(re.findall('"([a-z0-9-]+)": "', of_the_widget)) == {"kernel", "land-110m"}


@pytest.mark.parametrize("place", PLACES)
def test_a_template_without_a_place_or_with_two_is_an_error(built, place):
    for text in (TEMPLATE.replace(place, ""), TEMPLATE.replace(place, place + place)):
        built["page.html"] = text
        with pytest.raises(ValueError, match="must name its encoding"):
            assemble.html("110m")


def test_names_that_are_missing_or_no_text(built):
    names = ["Ulm", None, float("nan"), 5, "a\ud800b"]
    given = contents.Given(np.zeros((5, 2)), "a", names)
    shown = contents.packed(json.dumps(["Ulm", "", "", "5", "a?b"]).encode())
    assert contents.contents("110m", given, latitude=None)["given-names"] == shown


WRONG = [
    ({"resolution": "10m"}, "resolution is '10m', but must be one of '50m', '110m'"),
    ({"lonlat": [(0, 91)]}, r"lonlat\[0, 1\] is latitude 91"),
    ({"lonlat": [(0, 1), (2, 3)], "names": ["one"]}, "names has 1 entries, but there are 2 points"),
]


@pytest.mark.parametrize(("wrong", "said"), WRONG)
def test_wrong_arguments_and_nothing_written(built, tmp_path, wrong, said):
    with pytest.raises(ValueError, match=said):
        web(tmp_path / "page.html", **wrong)
    assert list(tmp_path.iterdir()) == []
