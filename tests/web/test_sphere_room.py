"""What the Sphere room says of sites, against the library: bubbles, facets that see the pole, insertion, the plane."""

import numpy as np
import pytest

from figures._theorem import merged_polygons
from stereodel import PlanarDelaunay, SphericalDelaunay, Stereographic, in_bubble, lonlat_to_xyz
from stereodel.sphere import SphereCircle
from stereodel.triangulation import planar_part
from stereodel.web.contents import scattered

from .conftest import LOADED, SCRIPT, asking

ask = asking(f"""{LOADED}
import {{ lonlatToXyz }} from "{SCRIPT}/kernel/api.ts";
import {{ directionOf }} from "{SCRIPT}/space.ts";
import {{ SphereSites }} from "{SCRIPT}/rooms/sphere_sites.ts";
import {{ Twin }} from "{SCRIPT}/rooms/twin.ts";
import {{ sphereSets }} from "{SCRIPT}/sets.ts";
const facetsAfter = ({{ before, seeing, fan }}) =>
  [...before.simplices.filter((_, k) => !seeing.includes(Math.floor(k / 3))), ...fan];
const sitesOf = (lonlat) => new SphereSites(Float64Array.from(lonlat.flat()));
""")


def triangles(rows):
    """Facets as a set, each from its lowest site on."""
    turned = [tuple(np.roll(row, -int(np.argmin(row))).tolist()) for row in np.reshape(rows, (-1, 3))]
    assert len(set(turned)) == len(turned)
    return set(turned)


@pytest.fixture
def lonlat(rng):
    return np.round(rng.uniform((-180, -90), (180, 90), size=(80, 2)), 3)


POLE = [-150.0, 53.1]


def test_facets_that_see_the_pole_are_those_the_plane_lacks(node, lonlat):
    poles = [POLE, [12.0, -89.0], lonlat[3].tolist()]
    expression = "given.poles.map((pole) => [...sitesOf(given.lonlat).seeing(lonlatToXyz(pole))])"
    seeing = ask(node, expression, {"lonlat": lonlat.tolist(), "poles": poles})
    delaunay = SphericalDelaunay.from_lonlat(lonlat)
    corners = np.moveaxis(delaunay.points[delaunay.simplices], 1, 0)
    for pole, found in zip(poles, seeing, strict=True):
        np.testing.assert_array_equal(found, np.asarray(in_bubble(*corners, lonlat_to_xyz(pole))) >= 0)
        assert len(planar_part(delaunay, lonlat_to_xyz(pole))) == len(found) - sum(found) > 0
        assert sum(found) > 0


def test_the_images_of_the_other_facets_are_the_triangulation_of_the_plane(node, lonlat):
    expression = """(() => {
      const sites = sitesOf(given.lonlat), pole = directionOf(...given.pole), twin = new Twin(pole);
      const seeing = sites.seeing(pole);
      const flat = Array.from({ length: sites.count }, (_, k) => twin.forward(sites.site(k)));
      const kept = [...sites.delaunay.simplices].filter((_, k) => !seeing[Math.floor(k / 3)]);
      return { flat, kept, back: flat.map(([u, v]) => twin.inverse(u, v)) };
    })()"""
    answer = ask(node, expression, {"lonlat": lonlat.tolist(), "pole": POLE})
    plane = Stereographic((30.0, -53.1))
    np.testing.assert_allclose(answer["flat"], plane.forward(lonlat_to_xyz(lonlat)), rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(answer["back"], lonlat_to_xyz(lonlat), atol=1e-14)
    assert triangles(answer["kept"]) == triangles(PlanarDelaunay(answer["flat"]).simplices)


def test_bubbles_and_their_images_are_circles_of_the_library(node, lonlat):
    expression = """((sites, twin) => Array.from({ length: sites.facetCount }, (_, k) => sites.bubble(k))
      .map((bubble) => ({ ...bubble, image: twin.circle(bubble.center, bubble.cosine) })))
      (sitesOf(given.lonlat), new Twin(directionOf(...given.pole)))"""
    bubbles = ask(node, expression, {"lonlat": lonlat.tolist(), "pole": POLE})
    delaunay, plane = SphericalDelaunay.from_lonlat(lonlat), Stereographic((30.0, -53.1))
    for bubble, corners in zip(bubbles, delaunay.points[delaunay.simplices], strict=True):
        circle = SphereCircle.through(*corners)
        np.testing.assert_allclose(bubble["center"], circle.center, atol=1e-12)
        image = plane.image_of(circle)
        np.testing.assert_allclose(bubble["image"]["middle"], image.center, rtol=1e-8, atol=1e-9)
        np.testing.assert_allclose(bubble["image"]["radius"], image.radius, rtol=1e-8)
        assert bubble["image"]["holdsPole"] == (bubble["cosine"] < np.dot(bubble["center"], lonlat_to_xyz(POLE)))
    assert {bubble["image"]["holdsPole"] for bubble in bubbles} == {True, False}


def test_a_circle_through_the_pole_becomes_a_line(node):
    """The image of a point of the circle opposite the pole lies on it."""
    line = ask(node, "new Twin([0, 0, 1]).circle([0.6, 0, 0.8], 0.8)")
    assert line["isLine"]
    image = Stereographic((0.0, -90.0)).forward([0.96, 0, 0.28])
    assert np.dot(line["normal"], image) == pytest.approx(line["offset"]) != 0


def test_inserting_one_site_after_another_ends_with_the_kernels_facets(node, lonlat):
    told = "({ before, ...step }) => ({ ...step, after: facetsAfter({ before, ...step }) })"
    taken = f"(_, k) => ({told})(sites.insertion(k + 4))"
    expression = f"((sites) => Array.from({{ length: sites.count - 4 }}, {taken}))(sitesOf(given))"
    steps = ask(node, expression, lonlat.tolist())
    assert len(steps) == len(lonlat) - 4
    for step in steps:
        after = SphericalDelaunay.from_lonlat(lonlat[: step["site"] + 1])
        assert triangles(step["after"]) == triangles(after.simplices)
        assert len(step["outline"]) == len(step["fan"]) // 3 == len(step["seeing"]) + 2


def test_inserting_into_squares_keeps_a_triangulation(node):
    """Sites that lie on a bubble displace nothing: what comes out differs from the kernel's by diagonals alone."""
    around = [[lon, lat] for lat in (-40, 0, 40) for lon in range(-180, 180, 45)]
    sites = [[0, 90], *around, [0, -90]]
    each = "(_, k) => [...facetsAfter(sitesOf(given).insertion(k + 8))]"
    after = ask(node, f"Array.from({{ length: given.length - 8 }}, {each})", sites)
    for count, facets in zip(range(9, len(sites) + 1), after, strict=True):
        delaunay = SphericalDelaunay.from_lonlat(sites[:count])
        assert len(triangles(facets)) == 2 * count - 4
        assert merged_polygons(delaunay, np.reshape(facets, (-1, 3))) == merged_polygons(delaunay)


def test_without_facets_nothing_sees_a_site_and_one_that_is_there_already_lies_in_no_bubble(node, lonlat):
    circle = [[lon, 0] for lon in (0, 20, 50, 90, 200)]
    expression = "[sitesOf(given).insertion(4).seeing, sitesOf([]).facetAt([1, 0, 0]), sitesOf(given).facetCount]"
    assert ask(node, expression, circle) == [[], None, 0]
    sites = [*lonlat.tolist(), lonlat[7].tolist()]
    step = ask(node, f"(({{ seeing, outline }}) => [seeing, outline])(sitesOf(given).insertion({len(lonlat)}))", sites)
    assert step == [[], []]


def test_sets_are_places_of_the_sphere_with_facets(node):
    stored = {name: scattered()[name].ravel().tolist() for name in ("gap", "everywhere", "hemisphere")}
    sets = ask(node, "sphereSets(given, null).map((set) => [set.name, [...set.make()]])", stored)
    assert [name for name, _ in sets] == ["gap", "everywhere", "hemisphere", "dodecahedron"]
    for name, places in sets:
        lonlat = np.reshape(places, (-1, 2))
        delaunay = SphericalDelaunay.from_lonlat(lonlat)
        assert len(delaunay.simplices) == 2 * len(lonlat) - 4
        assert delaunay.closing.any() == (name == "hemisphere")
