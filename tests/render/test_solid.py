"""Scenes in space: what a GLB holds, read back by trimesh and by the specification; what a picture with light shows."""

import json
import os
import struct
import subprocess
import sys
from dataclasses import replace

import imageio.v3 as iio
import numpy as np
import pytest
import trimesh

from stereodel.drawing import CircleArc, Scene, Solid, View
from stereodel.drawing.page.style import LINES, LineStyle
from stereodel.render import Figure, gl
from stereodel.render.space.bodies import bodies_of, linear
from stereodel.render.space.save_solid import CAMERA, glb_bytes
from stereodel.render.space.surfaces import CURVE_ERROR
from stereodel.sphere import SphereCircle, lonlat_to_xyz
from tests.figures.scripts import FIGURES, FOLDER, script
from tests.tiers import by_day
from tools.gltf import issues

VIEW = View(20, 30, 10)
SITES = lonlat_to_xyz([(0, 80), (10, 10), (70, 20), (40, 50), (-30, 40), (120, -40), (-140, -20)])
IN_SPACE = ("fig01_sphere", "fig03_bubbles", "fig04_triangles", "fig05_projections", "fig08_hemisphere")
IN_SPACE += ("fig10_earth", "fig11_fisheye4", "fig12_fisheye20")
LARGEST = 1_500_000
"""Bytes that the GLB of a figure may have."""


def scene(style="solid", *, sheet=True, **options):
    made = Scene(style=style, **options)
    made.add_edges(SITES, [[0, 1], [1, 2], [2, 3]], name="delaunay")
    made.add_circles([SphereCircle.around((30, 40), 25)], name="circle")
    made.add_points(SITES, name="sites")
    made.add_cap(SphereCircle.around((0, 0), 20), name="cell")
    if sheet:
        square = np.array([[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1]])
        made.add_flat_polygon(made.center + made.radius * square)
    made.add_label(SITES[3], "$p$", offset=(2.0, 5.0))
    return made


@pytest.fixture
def solid():
    return scene().solid(VIEW, width=200.0)


def parts(data):
    """The text and the numbers of a GLB file."""
    magic, version, length = struct.unpack("<4sII", data[:12])
    assert (magic, version, length) == (b"glTF", 2, len(data))
    size, kind = struct.unpack("<I4s", data[12:20])
    assert kind == b"JSON"
    return json.loads(data[20 : 20 + size]), data[28 + size :]


@pytest.mark.parametrize("name", by_day(IN_SPACE, "fig03_bubbles"))
def test_figures_are_valid_and_small(name, tmp_path):
    file = script(name)["FIGURE"].solid().save(tmp_path / f"{name}.glb")
    assert file.stat().st_size < LARGEST
    assert issues([file]) == [[]]


def test_what_shows_space_is_in_space():
    """Every figure of balls, and no section of the plane."""
    assert [name for name in FIGURES if script(name)["FIGURE"].in_space] == list(IN_SPACE)


@pytest.mark.parametrize("style", ["solid", "glass", "none"])
def test_any_scene_is_valid(style, tmp_path):
    dashed = Scene(style=style)
    dashed.add_circles([SphereCircle.around((0, 0), 50)], style=LINES["construction"])
    solids = [scene(style, radius=0.7, center=(1, 2, 3)).solid(VIEW), dashed.solid(VIEW)]
    files = [solid.save(tmp_path / f"{number}.GLB") for number, solid in enumerate(solids)]
    assert issues(files) == [[], []]


def test_what_is_hidden_or_has_no_size_is_not_seen():
    """Behind an opaque ball and in it; without points, area or length it is no body either."""
    hidden, nothing = Scene(), Scene()
    hidden.add_circles([SphereCircle.around((200, -30), 30)], style=LineStyle("red", 4.0))
    hidden.add_curves([CircleArc(np.zeros(3), np.array([0, 0.5, 0.0]), np.array([0.0, 0.0, 0.5]))], name="circle")
    nothing.add_points(np.zeros((0, 3)))
    nothing.add_flat_polygon(3 * VIEW.matrix[2] + np.outer([0.0, 1.0, 2.0], VIEW.matrix[0]))
    nothing.add_segments([[2, 0, 0]], [[2, 0, 0]], name="chord")
    assert list(nothing.solid(VIEW).to_trimesh().geometry) == ["ball"]
    ball = Scene().solid(VIEW).pixels(size=80)
    for made in (hidden, nothing):
        assert np.array_equal(made.solid(VIEW).pixels(size=80), ball)
    light = ball.astype(int).sum(axis=2)
    assert light[24, 28] > light[40, 40] > light[60, 60]  # it comes from the upper left
    assert light[16:64, 16:64].max() <= 3 * 0xF8  # not burnt out


def test_a_file_of_nothing_and_one_of_another_kind_are_refused(solid, tmp_path):
    with pytest.raises(ValueError, match=r"path must end in \.glb or \.png, got 'a\.svg'"):
        solid.save(tmp_path / "a.svg")
    with pytest.raises(ValueError, match="scenes hold no body"):
        Scene(style="none").solid(VIEW).save(tmp_path / "empty.glb")
    assert list(tmp_path.iterdir()) == []
    assert (Scene(style="none").solid(VIEW).pixels(size=9) == 255).all()


@pytest.mark.thorough
def test_a_file_has_the_same_bytes_whatever_the_seed_of_hashes(tmp_path):
    code = "import sys; sys.path.insert(0, sys.argv[1]); from fig05_projections import FIGURE\n"
    code += "FIGURE.solid().save(sys.argv[2])"
    for seed in ("1", "2"):
        environment = {**os.environ, "PYTHONHASHSEED": seed}
        subprocess.run([sys.executable, "-c", code, FOLDER, tmp_path / f"{seed}.glb"], check=True, env=environment)
    assert (tmp_path / "1.glb").read_bytes() == (tmp_path / "2.glb").read_bytes()


def test_names_are_those_of_the_scene(solid):
    tree, _ = parts(glb_bytes(solid))
    nodes = {node["name"]: node for node in tree["nodes"]}
    assert [node["name"] for node in tree["nodes"] if "[" not in node["name"]] == [
        "scene", "ball", "delaunay", "circle", "sites", "cell", "plane", "label $p$", "page",
    ]  # fmt: skip
    assert [nodes[f"sites[{k}]"]["mesh"] for k in range(len(SITES))] == [nodes["sites[0]"]["mesh"]] * len(SITES)
    assert nodes["label $p$"]["extras"] == {"text": "$p$", "size": 9.0, "offset": [2.0, 5.0]}
    assert "mesh" not in nodes["label $p$"]
    assert tree["asset"]["generator"] == "stereodel"


def test_names_that_come_again_are_numbered():
    twice = Scene()
    for _ in range(3):
        twice.add_circles([SphereCircle.around((0, 0), 20)])
    page = twice.page(VIEW)
    both = Solid(page, [twice.placed(VIEW), twice.placed(VIEW, at=(3.0, 0.0))]).to_trimesh()
    assert {"scene 1", "scene 2", "circle", "circle 2", "circle 6", "ball 2"} <= set(both.graph.nodes)
    assert set(both.geometry) == {"ball", "circle"}  # equal meshes stand there once


def test_things_are_where_the_page_has_them(solid, tmp_path):
    """Read back by trimesh: x right, y up, z toward the viewer, in page units."""
    read = trimesh.load(solid.save(tmp_path / "scene.glb"))
    radius = 0.5 * (LINES["circle"].width / solid.page.points_per_unit)
    box = trimesh.bounds.contains(np.array([[-1, -1], [1, 1]]) * (1 + 2 * radius), read.geometry["ball"].bounds[:, :2])
    assert box.all()
    for k, site in enumerate(SITES):
        pose, name = read.graph.get(f"sites[{k}]")
        assert name == "sites"
        assert pose[:3, 3] == pytest.approx(VIEW.axes(site), abs=1e-6)
    pose, _ = read.graph.get("label $p$")
    assert pose[:2, 3] == pytest.approx(solid.page.labels[0].anchor, abs=1e-6)
    circle = read.geometry["circle"].copy()
    circle.apply_transform(read.graph.get("circle")[0])
    pole = VIEW.axes(lonlat_to_xyz((30.0, 40.0)))
    away = np.degrees(np.arccos(circle.vertices @ pole / np.linalg.norm(circle.vertices, axis=1)))
    assert np.abs(away - 25).max() < 1


def test_a_scene_off_the_middle_keeps_its_place():
    """And lines of a name lie above those before, by the error of a chord, so that they cover them as on the page."""
    off = Scene(radius=0.5, center=(1.0, 2.0, 3.0))
    off.add_circles([SphereCircle.around((0, 90), 90)], name="arc", style=LineStyle("black", 1.0))
    off.add_circles([SphereCircle.around((0, 90), 90)], name="circle", style=LineStyle("black", 1.0))
    placed = off.placed(VIEW, at=(7.0, -2.0), scale=2.0)
    bodies = list(bodies_of(placed, 100.0))
    for body, height in zip(bodies[1:], (1.0, 1 + CURVE_ERROR), strict=True):
        points, sides = body.surface.points, body.surface.faces[0, 2]
        rings = points[: len(points) // sides * sides].reshape(-1, sides, 3)
        middles = rings.mean(axis=1) - off.center
        assert np.sqrt(np.sum(middles**2, axis=1)) == pytest.approx(0.5 * height, abs=1e-12)
        assert middles[:, 2] == pytest.approx(0.0, abs=1e-12)
        across = rings[0] - off.center - middles[0]
        assert np.sqrt(np.sum(across**2, axis=1)) == pytest.approx(0.5 / 100 / 2)  # half a point on the page
    x, y, z = (placed.pose @ [*off.center, 1.0])[:3]
    assert (x, y) == pytest.approx(2 * VIEW.project(off.center) + [7.0, -2.0])
    assert z == pytest.approx(2 * VIEW.depth(off.center))


def test_colours_are_linear_and_not_rounded(solid):
    tree, _ = parts(glb_bytes(solid))
    materials = {material["name"]: material for material in tree["materials"]}
    assert linear((0.04045, 0.04046, 1.0, 0.5)) == pytest.approx([0.04045 / 12.92, 0.0031316, 1.0, 0.5], abs=1e-6)
    for name, color in (("delaunay", LINES["delaunay"].color), ("ball", (0xF4 / 255, 0xF6 / 255, 0xF8 / 255, 1.0))):
        assert materials[name]["pbrMetallicRoughness"]["baseColorFactor"] == linear(color)
    assert materials["cell"]["alphaMode"] == "BLEND"
    assert materials["cell"]["doubleSided"]
    assert materials["ball"]["alphaMode"] == "OPAQUE"
    # Those of trimesh's scene are the same, in whole levels.
    (red, *_) = solid.to_trimesh().geometry["delaunay"].visual.material.baseColorFactor
    assert red == pytest.approx(255 * linear(LINES["delaunay"].color)[0], abs=1)


def test_the_camera_sees_the_page(solid):
    tree, _ = parts(glb_bytes(solid))
    (camera,) = tree["cameras"]
    left, right, bottom, top = solid.page.extent
    assert camera["name"] == CAMERA
    assert (camera["orthographic"]["xmag"], camera["orthographic"]["ymag"]) == ((right - left) / 2, (top - bottom) / 2)
    x, y, z = next(node["translation"] for node in tree["nodes"] if node["name"] == CAMERA)
    assert (x, y) == pytest.approx((0.0, 0.0), abs=1e-12)
    low, high = solid.to_trimesh().bounds[:, 2]
    assert z - camera["orthographic"]["znear"] > high
    assert z - camera["orthographic"]["zfar"] < low


def test_indices_are_short_where_they_may_be(monkeypatch, solid):
    kinds = []
    for largest in (2**16 - 1, 100):
        monkeypatch.setattr("stereodel.render.space.save_solid.SHORT", largest)
        tree, _ = parts(glb_bytes(solid))
        indices = [tree["accessors"][mesh["primitives"][0]["indices"]] for mesh in tree["meshes"]]
        kinds.append({accessor["componentType"] for accessor in indices})
    assert kinds == [{5123}, {5123, 5125}]


def test_a_picture_is_that_of_the_page_with_light(tmp_path):
    solid = scene(sheet=False).solid(VIEW, width=200.0)
    bare, page = solid.pixels(size=300, text=False), solid.page.pixels(size=300, text=False)
    assert bare.shape == page.shape
    rows, columns = np.mgrid[0.5:300, 0.5:300]
    distance = np.hypot(columns - 150, rows - 150) * 2.04 / 300
    # Outside the ball and its lines is paper; inside, where the page has the ball alone, something like its colour.
    assert (bare[distance > 1.03] == 255).all()
    plain = (page.min(axis=2) > 200) & (distance < 0.98)
    assert plain.mean() > 0.3
    assert 150 < bare[plain].min(axis=1).mean() < 245
    dark = (page.max(axis=2) < 60) & (distance < 0.9)
    assert dark.sum() > 200
    assert np.median(bare[dark].max(axis=1)) < 110
    file = solid.save(tmp_path / "a.png", size=300)
    assert np.array_equal(iio.imread(file), solid.pixels(size=300))


def test_labels_are_those_of_the_page(solid):
    text, bare = solid.pixels(size=300), solid.pixels(size=300, text=False)
    rows, columns = np.nonzero((text != bare).any(axis=2))
    x, y = solid.page.labels[0].anchor
    at = (np.array([x, y]) - solid.page.extent[::2]) / 2.04 * 300 + np.array([2.0, 5.0]) * 300 / 200
    assert columns.mean() == pytest.approx(at[0], abs=2)
    assert 300 - rows.mean() == pytest.approx(at[1], abs=2)


def test_what_is_behind_glass_is_seen_through_it():
    behind = Scene(style="glass")
    behind.add_circles([SphereCircle.around((180, 0), 30)], style=LineStyle("red", 4.0))
    behind.add_cap(SphereCircle.around((180, 0), 20), name="cell", color=("blue", 0.5))
    picture = behind.solid(View(0, 0), width=200.0).pixels(size=200).astype(int)
    nothing = Scene(style="glass").solid(View(0, 0), width=200.0).pixels(size=200).astype(int)
    line, region, limb, middle = picture[100, 149], picture[100, 100], nothing[100, 4], nothing[100, 100]
    assert line[0] > line[1] + 60
    assert region[2] > region[0] + 30
    assert limb.sum() < middle.sum()  # denser toward the limb


@pytest.mark.parametrize("angle", [8, 50, 88])
def test_regions_lie_above_the_ball_and_those_before_them(angle):
    covered = Scene()
    covered.add_cap(SphereCircle.around((10, 20), angle), name="cell", color="red")
    covered.add_cap(SphereCircle.around((10, 20), angle), name="cell", color="blue")
    picture = covered.solid(View(10, 20), width=100.0).pixels(size=200).astype(int)
    rows, columns = np.mgrid[0.5:200, 0.5:200]
    inside = np.hypot(columns - 100, rows - 100) * 2.04 / 200 < np.sin(np.radians(angle)) - 0.02
    blue = picture[..., 2] - np.maximum(picture[..., 0], picture[..., 1])
    assert blue[inside].min() > 100


def test_a_sheet_covers_what_is_beyond_it():
    def picture(*corners):
        made = Scene()
        made.add_flat_polygon(corners, color="red")
        return made.solid(View(0, 0)).pixels(size=60).astype(int)

    square = np.array([[0.0, -0.5, -0.5], [0.0, 0.5, -0.5], [0.0, 0.5, 0.5], [0.0, -0.5, 0.5]])
    before, after, turned = (picture(*(square[::step] + [x, 0, 0])) for x, step in ((1.1, 1), (-1.1, 1), (1.1, -1)))
    assert before[30, 30, 0] > before[30, 30, 1] + 100
    assert after[30, 30, 0] == pytest.approx(after[30, 30, 1], abs=10)
    assert np.array_equal(before, turned)


def test_windows_fit_together(solid, monkeypatch):
    """And pages look the same after a picture in space."""
    page = solid.page.pixels(size=100)
    whole = solid.pixels(size=150, text=False).astype(int)
    assert np.array_equal(solid.page.pixels(size=100), page)
    monkeypatch.setattr(gl, "BAND", 64)
    monkeypatch.setattr(gl, "COLUMNS", 70)
    assert np.abs(solid.pixels(size=150, text=False) - whole).max() <= 2


FLAT = Figure("small", lambda: {"style": "solid"}, lambda g: scene(**g).page(VIEW, width=100.0), renderer="agg")
SPATIAL = replace(FLAT, in_space=lambda g: scene(**g).solid(VIEW, width=100.0))


def test_a_figure_in_space_writes_a_glb_and_a_flat_one_says_that_it_has_none(tmp_path):
    SPATIAL.main(["--out", str(tmp_path), "--size", "50"])
    assert sorted(path.suffix for path in tmp_path.iterdir()) == [".glb", ".pdf", ".png", ".svg"]
    assert (tmp_path / "small.glb").read_bytes() == glb_bytes(scene().solid(VIEW, width=100.0))
    picture = SPATIAL.solid().save(tmp_path / "small_solid.png", size=50, text=False)
    assert np.array_equal(iio.imread(picture), SPATIAL.solid().pixels(size=50, text=False))
    with pytest.raises(ValueError, match="figure 'small' shows nothing in space; give it in_space="):
        FLAT.solid()
