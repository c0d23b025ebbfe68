"""Tables as people have them, opened on the page: at once, with one click, or with the reason why not."""

import csv
import io
import json
import re

import pytest
from PIL import Image

from stereodel.io import read_points
from tests.tiers import by_day

from .rooms import downloaded, said
from .test_files_of_points import WRONG

EXACT = [0.1 + 0.2, -1e-7, 5e-324, -0.0, 1 / 3, 89.99999999999999, -179.99999999999997, 45.0]
ALERT = "[role=alert]"


def put(page, room, path):
    page.page.evaluate("document.querySelector('#messages').replaceChildren()")
    page.page.set_input_files(f"#room-{room} input[type=file]", str(path))


def table_of(page):
    """The file that the button CSV gives, which is pressed by its key: the page may still be moving it."""
    page.page.focus("[data-export=csv]")
    with page.page.expect_download() as download:
        page.page.keyboard.press("Enter")
    return download.value.suggested_filename, download.value.path().read_bytes()


READ_BY_PYTHON = ["no_rows.csv", "no_features.geojson", "cyrillic.csv", "walk.gpx", "packed.csv.gz"]


@pytest.mark.filterwarnings("ignore::stereodel.io.DataWarning")
@pytest.mark.parametrize("names", by_day([[*WRONG][::2], [*WRONG][1::2]], [*WRONG][::2]), ids=len)
def test_a_broken_table_opens_with_one_click_or_says_why_not(room, tmp_path, names):
    page = room("sphere")
    for name in names:
        content, answer = WRONG[name]
        path = tmp_path / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        before = said(page, "sphere", "count")
        put(page, "sphere", path)
        page.until("document.querySelector('[role=alert]')?.checkVisibility()")
        told = " ".join(page.page.inner_text(f"{ALERT} p").split())
        assert told.startswith(f"{name}: "), name
        assert told.endswith("Nothing has changed."), told
        assert not re.search(r"\w=|skip_", told), told
        assert answer in told, told
        assert said(page, "sphere", "count") == before, name
        if name not in READ_BY_PYTHON + ["cities.xyz", "my book.xlsx"]:
            with pytest.raises(ValueError):
                read_points(path)
        buttons = page.page.locator(f"{ALERT} button").all_inner_texts()
        assert buttons[-1] == "Close"
        if len(buttons) == 1:
            continue
        kept = read_points(path, skip_invalid=True)
        rows = int(re.search(r"(\d+) of", told)[1])
        assert f"{rows} of {len(kept) + rows} rows cannot be placed. Row " in told
        assert buttons[0] == ("Open without this row" if rows == 1 else f"Open without these {rows} rows")
        page.page.click(f"{ALERT} button >> nth=0")
        page.until(f"document.querySelector('#room-sphere select').selectedOptions[0].text === '{name}'")
        assert said(page, "sphere", "count") == (f"The {len(kept)} sites" if len(kept) > 1 else "The site"), name


DIALECTS = [
    (",", ".", "utf-8-sig", csv.QUOTE_ALL, "\r\n"),
    (";", ",", "cp1252", csv.QUOTE_NONE, "\n"),
    ("\t", ".", "utf-16", csv.QUOTE_NONNUMERIC, "\r"),
    ("|", ",", "utf-16-le", csv.QUOTE_MINIMAL, "\n"),
]
"""Mark, decimal mark, encoding, what stands in quotation marks, end of lines."""


def dialect(mark, decimal, encoding, quoting, end):
    stream = io.StringIO()
    write = csv.writer(stream, delimiter=mark, quoting=quoting, lineterminator=end)
    write.writerow(["name", "Länge", "Breite", "height"])
    for k, (lon, lat) in enumerate(zip(EXACT[::-1], EXACT, strict=True)):
        numbers = [repr(each).replace(".", decimal) for each in (lon, lat / 2, k + 0.5)]
        write.writerow(
            [f'Ort {k}, "ü"\n' if quoting in (csv.QUOTE_ALL, csv.QUOTE_NONNUMERIC) else f"Ort {k}", *numbers]
        )
    return stream.getvalue().encode(encoding)


@pytest.mark.filterwarnings("ignore::stereodel.io.DataWarning")
def test_dialects_of_python_open_with_the_same_bits_and_come_back_as_csv(room, tmp_path):
    page = room("sphere")
    for k, how in enumerate(DIALECTS):
        path = tmp_path / f"{k}.csv"
        path.write_bytes(dialect(*how))
        put(page, "sphere", path)
        page.until(f"document.querySelector('#room-sphere select').selectedOptions[0].text === '{k}.csv'")
        (name, content), table = table_of(page), read_points(path)
        assert name == "sites.csv"
        back = tmp_path / f"{k} again.csv"
        back.write_bytes(content)
        again = read_points(back)
        assert again.lonlat.tobytes() == table.lonlat.tobytes(), how
        assert again.columns["name"].tolist() == table.columns["name"].tolist()
        assert again.columns["height"].tolist() == [k + 0.5 for k in range(len(EXACT))]
        put(page, "sphere", back)
        page.until(f"document.querySelector('#room-sphere select').selectedOptions[0].text === '{back.name}'")
        assert table_of(page)[1] == content  # Chromium gives no more than ten files away within ten seconds


POINT = b'{"type":"Feature","geometry":{"type":"Point","coordinates":[10,48]},"properties":{"name":"Ulm"}}'
ELSEWHERE = [
    ("sphere", "pano.png", None, "globe", "picture", "pano.png"),
    ("lift", "ulm.geojson", POINT, "globe", "name", "ulm.geojson"),
    ("lift", "ulm.csv", b"name,lon,lat\nUlm,10,48\nKiel,10,54\n", "globe", "name", "ulm.csv"),
    ("sphere", "grid.csv", b"n,x,y\n1,3500,5400\n2,3501,5400\n3,3500,5401.5\n", "lift", "sites", "3500,5400,3501,"),
    ("globe", "own.csv", b"3500,5400\n3501,5400\n3500,5401.5\n", "lift", "sites", "3500,5400,3501,5400,3500,5401.5"),
]


def test_a_file_goes_to_the_room_that_can_show_it(room, tmp_path):
    page = room("sphere")
    Image.new("RGB", (64, 32), "navy").save(tmp_path / "pano.png")
    for begin, name, content, end, key, value in ELSEWHERE:
        page.page.evaluate(f"location.hash = '{begin}'")
        page.until(f"!document.querySelector('#room-{begin}').hidden")
        if content is not None:
            (tmp_path / name).write_bytes(content)
        put(page, begin, tmp_path / name)
        page.until(f"!document.querySelector('#room-{end}').hidden && location.hash.includes('{key}=')")
        assert f"&{key}={value}" in page.link, name
        assert page.page.locator(ALERT).count() == 0


def test_a_step_of_the_insertion_is_taken_along_as_its_triangles(room):
    page = room("v=1&room=sphere&step=9")
    features = json.loads(downloaded(page, "geojson")[1])["features"]
    assert {each["properties"]["kind"] for each in features} == {"triangle"}
    assert {each["properties"][corner] for each in features for corner in "abc"} == set(range(9))
