"""Fonts of labels: which one sets which character, in all files, and one warning for those that none has."""

import base64
import io
import re
import warnings
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pypdf
import pytest
from fontTools.pens.areaPen import AreaPen
from fontTools.pens.boundsPen import BoundsPen
from fontTools.ttLib import TTFont

from stereodel.drawing import Label, Page, Sketch, styled
from stereodel.drawing.page.fonts import FACES, MissingCharactersWarning, as_font, families_of
from stereodel.drawing.page.labels import label_box
from stereodel.globe import Globe
from stereodel.globe.pages import Panel, panels
from stereodel.render.vector.svg import svg
from stereodel.render.vector.type import lines_of
from tests.render.test_vector import SVG

STIX, SHIPPED = "STIXGeneral", "DejaVu Sans"
CJK = str(Path(__file__).resolve().parents[1] / "fixtures" / "fonts" / "noto-sans-cjk-subset.otf")
"""東京한국港 in the outlines of Noto Sans CJK TC; see tests/fixtures/README.md."""
ARABIC, HEBREW, MARKED = "العربية", "עברית", "q\u0323\u0302"


def page(*texts, **options):
    """A page with a label on each line."""
    options = {"size": 12.0, **options}
    labels = (Label(text, (50.0, 20.0 * (k + 0.5)), **options) for k, text in enumerate(texts))
    return Page((0.0, 100.0, 0.0, 20.0 * len(texts)), tuple(labels), width=200.0)


def glyphs(text, **options):
    ((_, lines),) = lines_of(page(text, **options))
    return [glyph for line in lines for glyph in line.glyphs]


@pytest.mark.parametrize(
    ("text", "font", "families"),
    [
        ("Zürich – φ", (), [STIX]),
        (f"Zürich {HEBREW}", (), [STIX, SHIPPED]),
        (HEBREW, (SHIPPED,), [SHIPPED, STIX]),
        ("東京", (CJK,), [CJK, STIX]),
        ("東京", ("Nowhere", CJK), [CJK, STIX]),
        (f"東 {ARABIC} x", (CJK,), [CJK, STIX, SHIPPED]),
        ("a\u200d\n\ufe0f", (), [STIX]),  # what is not seen needs no font
    ],
)
def test_each_character_has_the_first_font_that_has_it(text, font, families):
    assert families_of(Label(text, (0.0, 0.0), font=font)) == families


def test_the_fonts_of_the_machine_stand_in(monkeypatch, no_other_fonts):
    assert families_of(Label("東京", (0.0, 0.0))) == [STIX]
    from stereodel.drawing.page import fonts

    monkeypatch.setattr(fonts, "_others", lambda: ["DejaVu Serif", CJK])
    fonts._families.cache_clear()
    assert families_of(Label(f"東京 {HEBREW}", (0.0, 0.0))) == [STIX, SHIPPED, CJK]


def test_fonts_that_are_none(tmp_path):
    (tmp_path / "a.ttf").write_text("no font")
    with pytest.raises(ValueError, match="not a font that can be read"):
        as_font(tmp_path / "a.ttf")
    with pytest.raises(ValueError, match=r"'DejaVu Sanz', which this machine does not have"):
        as_font("DejaVu Sanz")
    with pytest.raises(FileNotFoundError, match=r"nowhere\.ttf is not there"):
        Globe(font="nowhere.ttf")
    with pytest.raises(TypeError, match="font is 5; give a family, the path of a font's file"):
        as_font(5)
    assert as_font(["Nowhere", Path(CJK)]) == ("Nowhere", CJK)


def test_one_warning_a_file_names_the_characters(tmp_path, no_other_fonts):
    shown = page("東京", "東 a", "港 $x$")
    for name in ("a.svg", "a.pdf", "a.png"):
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            shown.save(tmp_path / name, size=50, renderer="agg")
        assert [warning.category for warning in told] == [MissingCharactersWarning]
        assert re.findall(r"U\+(\w+)", str(told[0].message)) == ["4EAC", "6771", "6E2F"]
    shown.save(tmp_path / "b.svg", text=False)  # no type, no warning
    page("東京", font=(CJK,)).save(tmp_path / "c.svg")
    with pytest.warns(MissingCharactersWarning, match=r"U\+4E0B .* and 8 more; boxes"):
        page("".join(chr(0x4E00 + k) for k in range(20))).save(tmp_path / "a.svg")


def embedded(text):
    """The fonts that an SVG brings along, by their names."""
    found = re.findall(r"font-family:'([^']+)';[^}]*url\(data:font/woff;base64,([^)]+)\)", text)
    return {name: TTFont(io.BytesIO(base64.b64decode(data))) for name, data in found}


def test_characters_stay_text_with_the_glyphs_of_their_font(tmp_path):
    """Of a font with cubic outlines, as most of Chinese and Japanese are."""
    shown = page("東京", font=(CJK,))
    text = shown.save(tmp_path / "a.svg").read_text(encoding="utf-8")
    assert "".join(ET.fromstring(text).find(f".//{SVG}text").itertext()) == "東京"
    (font,) = embedded(text).values()
    assert {chr(code) for code in font.getBestCmap()} == {"東", "京"}
    (sheet,) = pypdf.PdfReader(shown.save(tmp_path / "a.pdf")).pages
    assert sheet.extract_text() == "東京"
    whole = TTFont(CJK)
    for sign in "東京":
        # Outlines of TrueType run the other way round.
        assert measured(font, sign) == pytest.approx(measured(whole, sign) * [1, 1, 1, 1, -1, 1], abs=1e-3)


def measured(font, sign):
    """Bounds, area and width of a character, in terms of the type's size."""
    drawn, name = font.getGlyphSet(), font.getBestCmap()[ord(sign)]
    bounds, area = BoundsPen(drawn), AreaPen(drawn)
    drawn[name].draw(bounds)
    drawn[name].draw(area)
    size = font["head"].unitsPerEm
    return np.array([*bounds.bounds, area.value / size, font["hmtx"][name][0]]) / size


def test_arabic_letters_join_from_right_to_left():
    places = glyphs("\u0628\u0628\u0628", font=(SHIPPED,))  # beh thrice: initial, medial, final
    assert len({glyph.index for glyph in places}) == 3
    alone = glyphs("\u0628", font=(SHIPPED,))[0].index
    assert alone not in {glyph.index for glyph in places}
    assert places[0].x < places[1].x < places[2].x
    initial = glyphs("\u0628\u200d", font=(SHIPPED,))  # a joiner behind it
    assert initial[-1].index == places[-1].index  # the first letter stands on the right


def test_right_to_left_words_stay_words_and_programs_can_join_them(tmp_path):
    shown = page(ARABIC, f"{HEBREW} (x)", f"x {HEBREW}", MARKED, font=(SHIPPED,))
    text = shown.save(tmp_path / "a.svg").read_text(encoding="utf-8")
    found = {"".join(element.itertext()): element for element in ET.fromstring(text).iter(f"{SVG}text")}
    assert set(found) == {ARABIC, f"{HEBREW} (x)", f"x {HEBREW}", MARKED}
    ways = [(element.get("direction"), element.get("text-anchor")) for element in found.values()]
    assert ways == [("rtl", "middle"), ("rtl", "middle"), (None, "middle"), (None, "middle")]
    for element in found.values():  # to a glyph's sides
        assert float(element.get("x")) == pytest.approx(100, abs=1)
    for align, anchors in {"left": ("end", None), "right": (None, "end")}.items():  # from the right, and from the left
        sides = ET.fromstring(svg(page(ARABIC, MARKED, align=align)))
        assert tuple(element.get("text-anchor") for element in sides.iter(f"{SVG}text")) == anchors
    (font,) = embedded(text).values()
    features = {record.FeatureTag for record in font["GSUB"].table.FeatureList.FeatureRecord}
    assert {"init", "medi", "fina"} <= features
    assert set(map(ord, ARABIC)) <= set(font.getBestCmap())


def test_pdf_holds_words_in_marks_and_letters_that_join(tmp_path):
    shown = page(MARKED, ARABIC, font=(SHIPPED,))
    (sheet,) = pypdf.PdfReader(shown.save(tmp_path / "a.pdf")).pages
    marks = re.findall(rb"/ActualText <(\w+)>", sheet.get_contents().get_data())
    assert [bytes.fromhex(mark.decode()).decode("utf-16") for mark in marks] == [MARKED]
    assert sheet.extract_text().splitlines()[-1] in {ARABIC, ARABIC[::-1]}  # as programs put them in order


@pytest.mark.parametrize("family", ["", SHIPPED])
def test_each_face_is_another_font(family, tmp_path):
    """In boxes, pixels and files; characters that the face lacks come from where there are some, as in the upright."""
    boxes, pictures = [], []
    for face in ("", *FACES):
        font = as_font(f"{face} {family}".strip() or None)
        assert font == tuple(filter(None, (face, family)))
        shown = page("Zürich", "Київ", HEBREW, font=font)
        style, word = ("Bold" if "bold" in face else ""), re.compile("Italic|Oblique" if "italic" in face else "")
        assert {glyph.text for glyph in glyphs("Zürich", font=font)} == set("Zürich")
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            shown.save(tmp_path / "a.pdf")
        (sheet,) = pypdf.PdfReader(tmp_path / "a.pdf").pages
        used = [each.get_object()["/BaseFont"] for each in sheet["/Resources"]["/Font"].values()]
        assert all(style in name for name in used)
        assert any(word.search(name) for name in used)
        boxes.append(label_box(Label("mmmm Zürich", (0.0, 0.0), font=font), 1.0)[1, 0])
        pictures.append(shown.pixels(size=200, renderer="agg").tobytes())
    assert len(set(pictures)) == 4
    assert len({round(float(width), 6) for width in boxes}) >= (2 if family else 4)


def test_a_face_alone_is_one_of_the_font_of_the_page():
    globe = Globe(font=["bold DejaVu Serif", SHIPPED])
    for font in (None, "italic", STIX, "bold italic STIXGeneral"):
        globe.add_labels([(0.0, 0.0)], ["a"], font=font)
    own = ("DejaVu Serif", SHIPPED)
    found = [layer.labels[0].font for layer in globe.layers[1:]]
    assert found == [("bold", *own), ("italic", *own), (STIX,), ("bold italic", STIX)]
    labels = [Label("a", (0.0, 0.0), font=font) for font in ((), ("italic",), (STIX,))]
    (bare, face, family) = styled(Page((0.0, 1.0, 0.0, 1.0), tuple(labels)), font=SHIPPED).labels
    assert (bare.font, face.font, family.font) == ((SHIPPED,), ("italic", SHIPPED), (STIX,))
    with pytest.raises(ValueError, match="font is 'heavy'"):
        globe.add_labels([(0.0, 0.0)], ["a"], font="heavy")


def test_dollars_are_formulas_only_where_asked():
    assert "".join(glyph.text for glyph in glyphs("$5 to $6", formulas=False)) == "$5 to $6"
    assert "".join(glyph.text for glyph in glyphs(r"\$5", formulas=False)) == r"\$5"
    assert "".join(glyph.text for glyph in glyphs(r"\$5")) == "$5"
    assert "".join(glyph.text for glyph in glyphs("only $5")) == "only $5"
    assert "$" not in "".join(glyph.text for glyph in glyphs("$5 to $6"))


def test_where_a_font_is_said():
    globe = Globe(font=SHIPPED)
    globe.add_labels([(0.0, 0.0)], ["one"])
    globe.add_labels([(30.0, 30.0)], ["two"], font=["DejaVu Serif", SHIPPED])
    assert [label.font for label in globe.page().labels] == [(SHIPPED,), ("DejaVu Serif", SHIPPED)]
    titled = styled(panels([Panel(globe, title="above")]), font="DejaVu Sans Mono")
    expected = {"one": SHIPPED, "two": "DejaVu Serif", "above": "DejaVu Sans Mono"}
    assert {label.text: label.font[0] for label in titled.labels} == expected
    sketch = Sketch().add_label((0, 0), "a").add_label((0, 1), "b", font=("DejaVu Serif",))
    drawing = styled(sketch.page((-2, 2, -2, 2)), font=SHIPPED)
    assert [label.font for label in drawing.labels] == [(SHIPPED,), ("DejaVu Serif",)]


def test_figures_need_no_font_of_the_machine():
    """Baselines are the same wherever they are drawn."""
    folder = Path(__file__).resolve().parents[2] / "figures"
    signs = "".join(sorted(set("".join(path.read_text(encoding="utf-8") for path in folder.glob("*.py")))))
    assert len(signs) > 90
    assert families_of(Label(signs, (0.0, 0.0), formulas=False)) == [STIX]
