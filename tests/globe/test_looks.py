"""How globes look: titles, legends, names, colours of layers, sizes, paper."""

import imageio.v3 as iio
import numpy as np
import pytest

from stereodel import SphericalVoronoi, lonlat_to_xyz
from stereodel.drawing import View
from stereodel.drawing.page import Label
from stereodel.drawing.page.colors import to_oklab
from stereodel.drawing.page.scales import MISSING
from stereodel.globe import Globe
from stereodel.globe.layers import Areas
from tests.io.test_shapes import feature
from tests.render.test_vector import SVG, tree_of

SQUARE = [[0, 0], [5, 0], [5, 5], [0, 0]]


def squares(values):
    """A layer whose column `kind` has these values."""
    rings = [[[6 * (k % 10) + x, 6 * (k // 10) + y] for x, y in SQUARE] for k in range(len(values))]
    shapes = [{"type": "Polygon", "coordinates": [ring]} for ring in rings]
    features = [feature(shape, kind=value) for shape, value in zip(shapes, values, strict=True)]
    return {"type": "FeatureCollection", "features": features}


def named(page, name):
    return [item for item in page.items if item.name == name]


def test_a_title_and_a_legend_are_around_the_picture():
    globe = Globe(title="Four cells")
    globe.legend["land"] = "tan"
    plain, told = globe.page(), globe.page(legend=True)
    (title,) = named(plain, "title")
    assert (title.text, plain.title) == ("Four cells", "Four cells")
    assert title.anchor[1] == Globe().page().extent[3] < plain.extent[3]
    assert {item.text for item in named(told, "legend") if isinstance(item, Label)} == {"land"}
    assert told.extent[2] < plain.extent[2] == 0
    assert Globe().page(legend=True).extent == Globe().page().extent


@pytest.mark.parametrize(
    ("values", "entries"),
    [(["b", "a", "b", None], {"a", "b", "no value"}), ([1.0, 5.0, None, 2.0], {"kind"})],
    ids=["words", "numbers"],
)
def test_a_column_colours_polygons_and_enters_the_legend(values, entries):
    globe = Globe()
    globe.add_layer(squares(values), column="kind", color="red")
    assert globe.legend.keys() == entries
    (areas,) = (layer for layer in globe.layers if isinstance(layer, Areas))
    by_value = dict(zip(values, map(tuple, areas.colors.tolist()), strict=True))
    assert by_value[None] == MISSING
    assert len(set(by_value.values())) == len(by_value)
    for value in set(values) - {None}:
        entry = globe.legend[value] if isinstance(value, str) else globe.legend["kind"](value)
        assert by_value[value] == pytest.approx(entry)
    told = globe.page(legend=True)
    samples, words = (named(told, name) for name in ("legend-layer", "legend"))
    assert (len(samples), len(words)) == ((3, 3) if "a" in entries else (0, 0))
    with pytest.raises(ValueError, match="column 'kind' has 9 different words, but 8 colours are told apart at most"):
        globe.add_layer(squares("abcdefghi"), column="kind")


@pytest.mark.parametrize("style", [(), "dark"])
def test_layers_hide_neither_in_the_sea_nor_on_land(style):
    """Sea and land under a layer of the usual colour are neither sea nor land, stay two, and have an outline."""
    globe = Globe()
    globe.add_land(resolution="110m")
    globe.add_layer({"type": "Polygon", "coordinates": [SQUARE]})
    page = globe.page(style=style)
    ball, land, layer = (named(page, name)[0] for name in ("ball", "land", "layer"))
    assert named(page, "layer-outline")
    sea, ground = np.array(ball.color[:3]), land.colors[0, :3]
    color, opacity = layer.colors[0, :3], layer.colors[0, 3]
    assert 0.3 <= opacity <= 0.7
    bare = to_oklab([sea, ground])
    covered = to_oklab([opacity * color + (1 - opacity) * below for below in (sea, ground)])
    assert np.linalg.norm(covered[:, None] - bare, axis=-1).min() > 0.07
    assert np.linalg.norm(covered[0] - covered[1]) > 0.02


def test_names_with_a_rank_and_sides():
    """Two names for one place: the one of the larger number stands to the right, the other finds another side."""
    places, texts = [(10.0, 50.0), (10.0, 50.0)], ["small", "large"]
    globe = Globe()
    globe.add_labels(places, texts, rank=[1, 9], movable=True)
    first, second = globe.page(view=View(10, 50)).labels
    assert (first.text, first.offset) == ("large", (4.0, 0.0))
    assert (second.text, second.offset) == ("small", (-4.0, 0.0))
    fixed = Globe()
    fixed.add_labels(places, texts, rank=[1, np.nan])
    assert [label.text for label in fixed.page(view=View(10, 50)).labels] == ["small"]
    with pytest.raises(ValueError, match=r"rank"):
        fixed.add_labels(places, texts, rank=[1])


def test_transparent_paper(tmp_path):
    """Beside the globe there is nothing, and over white it is the picture that has paper."""
    globe = Globe(title="Nothing")
    globe.add_graticule(30)
    paper, bare = globe.save(tmp_path / "a.png", size=120), globe.save(tmp_path / "b.png", size=120, transparent=True)
    shown, found = iio.imread(paper).astype(float), iio.imread(bare).astype(float)
    opacity = found[..., 3:] / 255
    assert found.shape == (*shown.shape[:2], 4)
    assert found[-1, 0].tolist() == [0, 0, 0, 0]
    assert opacity[80, 60] == 1
    assert 0 < (found[:8, :, 3] > 0).mean() < 1  # type
    assert np.abs(found[..., :3] * opacity + 255 * (1 - opacity) - shown).max() <= 2
    for kind in ("svg", "pdf"):
        whole, without = (globe.save(tmp_path / f"{k}.{kind}", transparent=bool(k)) for k in range(2))
        assert without.stat().st_size < whole.stat().st_size
    assert 'id="ground"' not in (tmp_path / "1.svg").read_text(encoding="utf-8")


def test_shapes_have_ids_and_data_by_a_column(tmp_path):
    """One element each, however many colours there are; missing ids are the layer’s, equal ones are numbered."""
    names, shapes = ["Ulm", "Ulm", None, *map(str, range(67))], squares(np.arange(70) + 0.5)
    for shape, name in zip(shapes["features"], names, strict=True):
        shape["properties"]["Name of it"] = name
    globe = Globe()
    globe.add_layer(shapes, column="kind", id_column="Name of it", name="squares", outline=None)
    page = globe.page(None, View(0, 0))
    assert page.pictured == ()
    (layer,) = (group for group in tree_of(page, tmp_path) if group.get("id") == "squares-layer")
    paths = {path.get("id"): path for path in layer.iter(f"{SVG}path")}
    assert list(paths) == ["Ulm", "Ulm-2", "squares", *(f"_{k}" for k in range(67))]
    names_of_it = [path.get("data-name-of-it") for path in paths.values()]
    assert names_of_it == names
    assert [path.get("data-kind") for path in paths.values()] == [f"{k}.5" for k in range(70)]
    for option in ("id_column", "column"):
        with pytest.raises(ValueError, match=r"column 'nme' is not a property of the features; they have"):
            globe.add_layer(shapes, **{option: "nme"})


def test_lines_points_and_cells_have_ids(tmp_path):
    """All seen of a line is one path; a dot and its rim are a group; what is hidden shifts no names."""
    globe, places = Globe(), [[0, 0], [20, 0], [180, 0], [0, 20], [-20, 10]]
    lines = [[[0, 10]], [[-100, 20], [0, 80], [100, 20], [0, 0]], [[0, 0], [10, 0]]]
    globe.add_lines(lines, ids=["point", "far", "near"])
    globe.add_points(places, ids=["a", "b", "hidden", "c", 5.0])
    voronoi = SphericalVoronoi(lonlat_to_xyz(places))
    globe.add_cells(voronoi, colors=np.eye(3)[[0, 1, 2, 0, 1]], style=None, ids="vwxyz")
    page = globe.page(None, View(0, 0))
    named = {element.get("data-id"): element for element in tree_of(page, tmp_path).iter() if element.get("data-id")}
    found = {name: (element.tag.removeprefix(SVG), len(element)) for name, element in named.items() if name not in "xz"}
    assert found == dict.fromkeys(["far", "near", *"vwy"], ("path", 0)) | dict.fromkeys("abc5", ("g", 2))
    assert (named["far"].get("d").count("M"), named["near"].get("d").count("M")) == (2, 1)
    with pytest.raises(ValueError, match="ids has 1 entries, but there are 2 to name"):
        globe.add_points([[0, 0], [1, 1]], ids=["one"])
