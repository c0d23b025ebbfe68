"""The state of the page as a link: what is written is read back, and what is hostile is refused as a whole."""

import numpy as np
import pytest

from .conftest import SCRIPT, asking

ask = asking(f"""
import {{ number, whole, word }} from "{SCRIPT}/fields.ts";
import {{ LinkError, readLink, writeLink, writeNumber }} from "{SCRIPT}/link.ts";
import {{ tableOf, tableValues }} from "{SCRIPT}/rooms/site_room.ts";
const attempt = (body) => {{
  try {{ return body(); }} catch (error) {{ return error instanceof LinkError ? "refused" : String(error); }}
}};
""")


READ = "given.map((hash) => attempt(() => { const { room, values } = readLink(hash); return [room, [...values]]; }))"
UNPACKED = "given.map((sites) => attempt(() => [...tableOf(new Map([['sites', sites]]), 'plane').places]))"


def test_a_state_comes_back(node):
    values = {"lat": "20", "set": "gap", "file": "Orte & Städte=1 #2.csv", "sites": "1,-2.5", "note": "a+b%c d"}
    hash = ask(node, "writeLink('lift', given)", values)
    assert ask(node, READ, ["#" + hash, hash]) == [["lift", [list(pair) for pair in values.items()]]] * 2
    assert set("# ").isdisjoint(hash)
    assert ask(node, READ, ["", "#", "#lift", "globe"]) == [["sphere", []], ["sphere", []], ["lift", []], ["globe", []]]


HOSTILE = ["#cellar", "#v=2&room=sphere", "#room=sphere", "#v=1", "#v=1&room=__proto__", "#v=1&room=sphere&lat", "#&"]
HOSTILE += ["#v=1&room=sphere&lat=1&lat=2", "#v=1&room=sphere&lat=%E0%A4%A", "#<script>alert(1)</script>"]
HOSTILE += ["#v=1&room=<img src=x onerror=alert(1)>", "#v=1&room=sphere&sites=" + "A" * 1_000_000, "#v=1&&room=sphere"]
NUMBER = "given.map((lat) => attempt(() => number('lat', -90, 90).read(new Map([['lat', lat]]), 0)))"
NO_NUMBERS = ["NaN", "Infinity", "1e999", "0x10", "", " 5", "5 ", "--5", "1e5e5", "91", "-90.0001", "<b>", "1" * 40]
NO_SITES = ["x", "1", "1,", ",", "1,2,3", "1;2", "1,0x2", "1, 2", "1,NaN", "1,1e999", "1,Infinity", "1,2," * 5000]
REFUSED = {"links": (READ, HOSTILE), "numbers": (NUMBER, NO_NUMBERS), "sites": (UNPACKED, NO_SITES)}


@pytest.mark.parametrize(("read", "hostile"), REFUSED.values(), ids=REFUSED)
def test_what_is_hostile_out_of_range_or_none_is_refused(node, read, hostile):
    assert ask(node, read, hostile) == ["refused"] * len(hostile)


def test_numbers_and_words_are_read_and_numbers_written_short(node):
    read = "[number('lat', -90, 90).read(new Map(given), 7), number('no', 0, 1).read(new Map(given), 0.5)]"
    assert ask(node, read, [["lat", "-53.125"]]) == [-53.125, 0.5]
    assert ask(node, "attempt(() => whole('k', 9).read(new Map(given), null))", [["k", "2.5"]]) == "refused"
    words = "given.map((each) => attempt(() => word('click', ['keep', 'add']).read(new Map(each), 'keep')))"
    assert ask(node, words, [[["click", "add"]], [], [["click", "toString"]]]) == ["add", "keep", "refused"]
    numbers = [[5, 4], [-0.00001, 3], [1.25, 1], [100, 0], [-2.5, 4]]
    assert ask(node, "given.map((each) => writeNumber(...each))", numbers) == ["5", "0", "1.3", "100", "-2.5"]


def test_sites_come_back_to_the_bit(node, rng):
    decimals = np.round(rng.uniform((-180, -90), (180, 90), size=(2000, 2)), 7)
    sets = [[], [0.0, 0.0], decimals.ravel().tolist(), rng.normal(scale=50, size=200).tolist()]
    sets += [[4.5e6 + 0.123, 5.3e6 - 1.001, 4.5e6, -5.3e6], [1 / 3, 1e-12]]
    packed = ask(node, "given.map((places) => tableValues({ places: Float64Array.from(places) }, true).sites)", sets)
    assert packed[:2] == ["", "0,0"]
    assert len(packed[2]) < 26 * 2000
    assert ask(node, UNPACKED, packed) == sets
