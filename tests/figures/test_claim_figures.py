"""What the pictures of claims without a figure of the paper show: computed once more, in another way."""

import re
from itertools import combinations, pairwise

import numpy as np
import pytest

from stereodel import SphereCircle, bubble_to_bubble, in_bubble, lonlat_to_xyz
from stereodel.interpolation import LinearInterpolator
from stereodel.sphere import angular_distance
from stereodel.triangulation import PlanarDelaunay, SphericalDelaunay
from tests.figures.scripts import geometry, page, script

# P7: claim_theorem.


def test_the_facets_left_out_are_those_whose_bubble_holds_the_pole():
    module, g = script("claim_theorem"), geometry("claim_theorem")
    own = {frozenset(corners) for corners in g["triangles"].tolist()}
    left_out = {frozenset(corners) for corners in g["left_out"].tolist()}
    facets = {frozenset(corners) for corners in g["facets"].tolist()}
    assert own | left_out == facets
    assert not own & left_out
    assert len(left_out) == len(g["corners"]) - 2
    for corners in g["left_out"]:
        assert in_bubble(*g["lifts"][corners], module["POLE"]) > 0


def test_the_circle_drawn_holds_no_site_on_the_sphere_and_all_in_the_plane():
    module, g = script("claim_theorem"), geometry("claim_theorem")
    *normal, offset = g["circle"]
    others = np.delete(np.arange(len(g["sites"])), g["shown"])
    assert (g["lifts"][others] @ normal < offset).all()
    assert module["POLE"] @ normal > offset
    away = np.linalg.norm(g["sites"] - g["image"][:2], axis=1)
    assert away[g["shown"]] == pytest.approx(g["image"][2], rel=1e-12)
    assert (away[others] < g["image"][2]).all()


def test_words_stand_on_facets_that_are_what_they_say_and_no_site_is_near_a_line():
    module, g, drawn = script("claim_theorem"), geometry("claim_theorem"), page("claim_theorem")
    for text, inside in (("left out", True), ("kept", False)):
        place = lonlat_to_xyz(module["WORDS"][text])
        corners = g["facets"][SphericalDelaunay(g["lifts"]).find_simplex(place)]
        assert (set(corners) in map(set, g["left_out"])) == inside
        assert text in {label.text for label in drawn.labels}
    for start, end in combinations(g["sites"], 2):  # nothing looks degenerate that is not
        way, left = (end - start) / np.linalg.norm(end - start), g["sites"] - start
        away = np.abs(left @ [-way[1], way[0]])
        assert np.sort(away)[2] * module["SCALE"] * drawn.points_per_unit > 6
    away = np.abs(np.linalg.norm(g["sites"] - g["image"][:2], axis=1) - g["image"][2])
    assert np.sort(away)[3] * module["SCALE"] * drawn.points_per_unit > 6


# P12 and P13: claim_separation.


def test_the_curves_of_separation_have_closed_forms():
    separation = geometry("claim_separation")
    for name, bound in (("largest", lambda t: 4 * np.arctan(t)), ("smallest", lambda t: 2 * np.arcsin(t))):
        share, constant = separation[name][1:].T
        assert constant == pytest.approx(bound(share) / (np.pi * share), rel=1e-10), name
    assert separation["bounds"] == pytest.approx([2 / np.pi, 4 / np.pi], rel=1e-15)
    assert [separation[name][0, 1] for name in ("smallest", "largest")] == separation["bounds"].tolist()


def test_no_pair_lies_beyond_the_curves_and_sides_end_on_them():
    separation = geometry("claim_separation")
    for name in ("pairs", "short_side", "long_side"):
        share, constant = separation[name].T
        assert (constant <= 4 * np.arctan(share) / (np.pi * share) * (1 + 1e-12)).all()
        assert (constant >= 2 * np.arcsin(np.minimum(share, 1)) / (np.pi * share) * (1 - 1e-12)).all()
    for name in ("short_side", "long_side"):
        share, constant = separation[name][-1]
        assert constant == pytest.approx(2 * np.arcsin(share) / (np.pi * share), rel=1e-12)


# P12 and P17: claim_scales.


def test_ratios_of_lengths_are_those_of_the_images():
    module = script("claim_scales")
    rectangle = module["lift"]()
    paths = np.random.default_rng(1).uniform(-1, 1, size=(40, 5, 2)) * [rectangle.width / 2, rectangle.height / 2]
    t = np.linspace(0, 1, 401)[:, None]
    for path, ratio in zip(paths, module["ratios"](rectangle, paths), strict=True):
        points = np.concatenate([a + t * (b - a) for a, b in pairwise(path)])
        lifted = rectangle.forward(points)
        image = np.radians(angular_distance(lifted[:-1], lifted[1:])).sum() * rectangle.sphere.radius
        assert ratio == pytest.approx(image / np.linalg.norm(np.diff(points, axis=0), axis=1).sum(), rel=1e-4)
        assert 0.5 < ratio < 1


def test_curves_of_equal_ratio():
    """Their points are maps between bubbles whose scales differ by that much, and levels run from 1/2 to 2."""
    g = geometry("claim_scales")
    assert len(g["levels"]) == 9
    for line, level in zip(np.split(g["curves"], np.cumsum(g["sizes"])[:-1]), g["levels"], strict=True):
        chi, xi = np.radians(line).T
        assert (np.cos(chi / 2) / np.cos(xi / 2)) ** 2 == pytest.approx(level, rel=2e-3)
        assert 0.5 < level < 2
    chi, xi = line[len(line) // 3]
    source = SphereCircle.around((0, 20), chi)
    scale = bubble_to_bubble(source, SphereCircle.around((90, 0), xi)).scale_factor(
        [source.center, source.sample(1)[0]]
    )
    assert scale[0] / scale[1] == pytest.approx(level, rel=2e-3)


# P23: claim_projections.


def test_triangles_said_to_be_broken_have_sites_in_both_bubbles():
    module, g = script("claim_projections"), geometry("claim_projections")
    # The sites, from where the stereographic panel has them: back by its formula, up to the panel's size.
    projection, rim = module["Stereographic"](module["PLACE"]), module["CIRCLE"].sample(720)
    drawn, true = g["stereographic_circle"], projection.forward(rim)
    size = np.linalg.norm(drawn[0] - drawn[360]) / np.linalg.norm(true[0] - true[360])
    sites = projection.inverse((g["stereographic_sites"] - drawn[0]) / size + true[0])
    assert angular_distance(sites, lonlat_to_xyz(module["PLACE"])).max() <= module["REACH"]
    texts = [label.text for label in page("claim_projections").labels if "triangles" in label.text]
    for name, text in zip(module["DRAWN"], texts, strict=True):
        triangles, broken = g[f"{name}_triangles"], g[f"{name}_broken"]
        a, b, c = np.moveaxis(sites[triangles], 1, 0)
        signs = in_bubble(a[:, None], b[:, None], c[:, None], sites[None])
        others = ~(np.arange(len(sites)) == triangles[..., None]).any(axis=1)
        both = ((signs > 0) & others).any(axis=1) & ((signs < 0) & others).any(axis=1)
        assert broken.tolist() == both.tolist(), name
        assert broken.any() == (name != "stereographic"), name
        assert len(triangles) == len(PlanarDelaunay(g[f"{name}_sites"]).simplices)
        assert [int(number) for number in re.findall(r"\d+", text)] == [n for n in (both.sum(), len(triangles)) if n]


# P22: claim_terrain and claim_planet.


@pytest.mark.parametrize("name", ["claim_terrain", "claim_planet"])
def test_facets_are_painted_from_back_to_front(name):
    """Of two facets that cover one place of the page, the one nearer to the viewer comes later: the depths decide."""
    module, g = script(name), geometry(name)
    if name == "claim_terrain":
        places = module["block_place"](g["points"], g["heights"])
        depth = np.column_stack([g["points"], module["STEEP"] * g["heights"]]) @ module["toward"]()
    else:
        space = module["raised"](g)
        places = module["SIDEWAYS"].project(space)
        depth = space @ module["SIDEWAYS"].matrix[2]
    triangles = g["triangles"][g["order"]]
    low, high = places.min(axis=0), places.max(axis=0)
    several = 0
    for place in np.random.default_rng(3).uniform(low, high, size=(4000, 2)):
        weights = barycentric(places[triangles], place)
        covering = np.flatnonzero((weights > 1e-9).all(axis=1))
        nearness = (weights[covering] * depth[triangles[covering]]).sum(axis=1)
        assert (np.diff(nearness) > -1e-9).all(), (name, covering)
        several += len(covering) > 1
    assert several > (40 if name == "claim_terrain" else 2000), several


def barycentric(corners, place):
    """Weights (m, 3) of a place in triangles of the page (m, 3, 2)."""
    a, b, c = np.moveaxis(corners, 1, 0)

    def cross(p, q):
        return p[..., 0] * q[..., 1] - p[..., 1] * q[..., 0]

    whole = cross(b - a, c - a)
    return np.column_stack([cross(c - b, place - b), cross(a - c, place - c), cross(b - a, place - a)]) / whole[:, None]


@pytest.mark.parametrize("name", ["claim_terrain", "claim_planet"])
def test_contours_have_their_heights_and_the_points_those_of_the_relief(name):
    module, g = script(name), geometry(name)
    network = (PlanarDelaunay if name == "claim_terrain" else SphericalDelaunay)(g["points"])
    levels = np.repeat(g["levels"], g["sizes"])
    # Rounding may put a point on the hull outside: a third of the way along each piece lies inside.
    inside = np.flatnonzero(np.diff(levels) == 0)
    middle = (2 * g["contours"][inside] + g["contours"][inside + 1]) / 3
    found = LinearInterpolator(network, g["heights"])(middle)
    step = np.linalg.norm(g["contours"][inside + 1] - g["contours"][inside], axis=1)
    same = step < 0.05  # else from one line to the next of its level
    assert same.mean() > 0.5
    same &= ~np.isin(inside + 1, np.cumsum(g["sizes"]))
    assert np.nanmax(np.abs(found - levels[inside])[same]) < 1e-9
    space = g["points"] if g["points"].shape[1] == 3 else np.column_stack([g["points"], np.zeros(len(g["points"]))])
    assert g["heights"].tolist() == module["relief"](space, module["WAVELENGTH"], module["SEED"]).tolist()


# The partitions: what their two rounds find is what all airports have together.


def turned(triangles):
    """Triangles with their lowest corner first, in order."""
    first = np.argmin(triangles, axis=1)[:, None]
    rows = np.take_along_axis(triangles, (np.arange(3) + first) % 3, axis=1)
    return np.unique(rows, axis=0).tolist()


def test_triangles_are_those_of_all_airports_about_its_own():
    g = geometry("earth_partitions")
    whole = SphericalDelaunay(g["points"]).simplices
    assert turned(g["triangles"]) == turned(whole[np.isin(whole, g["own"]).any(axis=1)])


def test_every_bubble_meets_a_box_and_every_box_a_bubble():
    """By points of the boxes' parts of the sphere, close together: a bubble that the boxes' balls let by has none."""
    module, g = script("earth_partitions"), geometry("earth_partitions")
    meet = module["meet"](g["planes"], g["boxes"])
    assert meet.any(axis=1).all()
    assert meet.any(axis=0).all()
    inside = g["points"][g["new"]] @ g["planes"][:, :3].T >= g["planes"][:, 3]
    assert 0 < inside.any(axis=0).sum() < len(g["planes"])  # that a box is met does not say that a point is
    # Those drawn are different, in sight, and each passes own points of the partition.
    assert len(set(g["shown"])) == module["SHOWN"]
    assert (module["VIEW"].depth(g["planes"][g["shown"], :3]) > 0).all()
    through = np.abs(g["points"][g["own"]] @ g["planes"][g["shown"], :3].T - g["planes"][g["shown"], 3])
    assert through.min(axis=0).max() < 1e-12
