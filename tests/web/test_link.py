"""The state of the page as a link: what is written is read back, and what is hostile is refused as a whole."""

import random
import string

import numpy as np

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
PACKED = "given.map((places) => tableValues({ places: Float64Array.from(places) }, true).sites)"
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


def test_hostile_links_are_refused(node):
    assert ask(node, READ, HOSTILE) == ["refused"] * len(HOSTILE)


def test_numbers_out_of_range_and_what_is_none_are_refused(node):
    wrong = ["NaN", "Infinity", "1e999", "0x10", "", " 5", "5 ", "--5", "1e5e5", "91", "-90.0001", "<b>", "null"]
    wrong += ["1" * 40]
    number = "given.map((lat) => attempt(() => number('lat', -90, 90).read(new Map([['lat', lat]]), 0)))"
    assert ask(node, number, wrong) == ["refused"] * len(wrong)


def test_numbers_and_words_are_read_and_numbers_written_short(node):
    read = "[number('lat', -90, 90).read(new Map(given), 7), number('no', 0, 1).read(new Map(given), 0.5)]"
    assert ask(node, read, [["lat", "-53.125"]]) == [-53.125, 0.5]
    assert ask(node, "attempt(() => whole('k', 9).read(new Map(given), null))", [["k", "2.5"]]) == "refused"
    words = "given.map((each) => attempt(() => word('click', ['keep', 'add']).read(new Map(each), 'keep')))"
    assert ask(node, words, [[["click", "add"]], [], [["click", "toString"]]]) == ["add", "keep", "refused"]
    written = ask(
        node, "given.map((each) => writeNumber(...each))", [[5, 4], [-0.00001, 3], [1.25, 1], [100, 0], [-2.5, 4]]
    )
    assert written == ["5", "0", "1.3", "100", "-2.5"]


def test_sites_come_back_to_the_bit(node, rng):
    decimals = np.round(rng.uniform((-180, -90), (180, 90), size=(2000, 2)), 7)
    sets = [[], [0.0, 0.0], decimals.ravel().tolist(), rng.normal(scale=50, size=200).tolist()]
    sets += [[4.5e6 + 0.123, 5.3e6 - 1.001, 4.5e6, -5.3e6], [1 / 3, 1e-12]]
    packed = ask(node, PACKED, sets)
    assert packed[:2] == ["", "0,0"]
    assert len(packed[2]) < 26 * 2000
    assert ask(node, UNPACKED, packed) == sets


def test_sites_that_are_none_are_refused(node):
    hostile = ["x", "1", "1,", ",", "1,2,3", "1;2", "1,0x2", "1, 2", "1,NaN", "1,1e999", "1,Infinity", "1,2," * 5000]
    assert ask(node, UNPACKED, hostile) == ["refused"] * len(hostile)


def test_random_letters_are_refused_or_read_and_never_anything_else(node):
    letters = random.Random(7)
    hashes = []
    for _ in range(2000):
        kind = letters.randrange(3)
        noise = "".join(letters.choices(string.printable + "äß∂\u2028%&=#", k=letters.randrange(60)))
        hashes.append(["#", "#v=1&room=sphere&", "#v=1&room=lift&sites="][kind] + noise)
    for answer in ask(node, READ, hashes):
        assert answer == "refused" or answer[0] in ("sphere", "lift", "globe")
    packed = ["".join(letters.choices(string.digits + ",,.-e", k=letters.randrange(9))) for _ in range(2000)]
    for answer in ask(node, UNPACKED, packed):
        assert answer == "refused" or (len(answer) % 2 == 0 and None not in answer)
