"""What the Lift room says of a sheet, against the library: images, scales, bounds, facets that see the pole."""

import numpy as np
import pytest

from stereodel import PlanarDelaunay, RectangleLift, SphericalDelaunay, Stereographic, angular_distance
from stereodel.web.contents import scattered

from .conftest import LOADED, SCRIPT, asking

ask = asking(f"""{LOADED}
import {{ LiftSites, separationBounds, sheetSets }} from "{SCRIPT}/rooms/lift_sites.ts";
const sitesOf = (places, sides) => new LiftSites(Float64Array.from(places.flat()), sides);
const imagesOf = (sites, corner) => Array.from({{ length: sites.count }}, (_, k) => {{
  const sheet = sites.sheet(corner), [x, y] = sites.places.subarray(2 * k, 2 * k + 2);
  return [sheet.direction(x, y), sheet.scale(x, y), sheet.image(x, y)];
}});
""")


@pytest.fixture
def places(rng):
    return rng.uniform((3, -2), (7, 1), size=(60, 2))


def on_top(xyz):
    """Directions with the point of contact, the library's south pole, on top; x and y as the sheet has them."""
    return np.asarray(xyz)[..., [1, 0, 2]] * [1, 1, -1]


def test_the_hemisphere_is_that_of_the_rectangle(node, places):
    lift = RectangleLift.fit(places)
    answer = ask(node, "imagesOf(sitesOf(given), 90)", places.tolist())
    np.testing.assert_allclose([direction for direction, _, _ in answer], on_top(lift.forward(places)), atol=1e-14)
    np.testing.assert_allclose([scale for _, scale, _ in answer], lift.scale_factor(places), rtol=1e-13)
    corner = "[rectangle.middle[0] + rectangle.width / 2, rectangle.middle[1] + rectangle.height / 2]"
    expression = f"(({{ rectangle }}, sheet) => [sheet.radius, sheet.leastScale, sheet.direction(...{corner})[2]])"
    answer = ask(node, f"{expression}(sitesOf(given), sitesOf(given).sheet(90))", places.tolist())
    assert answer == pytest.approx([lift.sphere.radius / lift.diagonal, 0.5, 0], abs=1e-14)


@pytest.mark.parametrize("corner", [1, 30, 60, 75])
def test_on_the_way_the_corners_stand_at_the_slider_s_angle(node, places, corner):
    lift = RectangleLift.fit(places)
    sphere = Stereographic((0.0, -90.0), radius=1 / (4 * np.tan(np.radians(corner / 2))))
    flat = (places - lift.center) / lift.diagonal
    answer = ask(node, f"imagesOf(sitesOf(given), {corner})", places.tolist())
    directions = np.array([direction for direction, _, _ in answer])
    np.testing.assert_allclose(directions, on_top(sphere.inverse(flat)), atol=1e-13)
    assert sphere.angular_radius(0.5) == pytest.approx(corner)
    # Each image lies on the ray from its place to the pole, and on the ball.
    images = np.array([image for _, _, image in answer])
    pole = np.array([0, 0, -2 * sphere.radius])
    rays = np.column_stack([flat, np.zeros(len(flat))]) - pole
    np.testing.assert_allclose(np.cross(rays, images - pole), 0, atol=1e-9 * sphere.radius)
    np.testing.assert_allclose(np.linalg.norm(images - pole / 2, axis=1), sphere.radius, rtol=1e-12)


def test_the_plane_is_the_plane(node, places):
    answer = ask(node, "imagesOf(sitesOf(given), 0)", places.tolist())
    lift = RectangleLift.fit(places)
    expected = np.column_stack([(places - lift.center) / lift.diagonal, np.zeros(len(places))])
    np.testing.assert_allclose([image for _, _, image in answer], expected, atol=1e-15)
    assert {scale for _, scale, _ in answer} == {1}


def test_separations_stay_between_the_bounds_which_are_reached(node, places, rng):
    lift = RectangleLift.fit(places)
    corners = np.array([[-1, -1], [1, 1], [1, -1], [-1, 1]]) * [lift.width / 2, lift.height / 2]
    inside = rng.uniform(-0.5, 0.5, size=(300, 2)) * [lift.width, lift.height]
    pairs = np.concatenate([inside.reshape(-1, 2, 2), np.stack([inside, -inside], 1), [corners[:2], corners[[0, 2]]]])
    pairs += lift.center
    distance = np.minimum(np.linalg.norm(pairs[:, 0] - pairs[:, 1], axis=1), lift.diagonal)
    images = lift.forward(pairs)
    angles = angular_distance(images[:, 0], images[:, 1])
    bounds = ask(node, "given.map((t) => separationBounds(t))", (distance / lift.diagonal).tolist())
    low, high = (np.array([bound[key] for bound in bounds]) for key in ("low", "high"))
    paper = np.array([bound["promised"] for bound in bounds]).T
    assert (low - 1e-9 <= angles).all()
    assert (angles <= high + 1e-9).all()
    np.testing.assert_allclose(angles[150:450], high[150:450])  # symmetric pairs reach the upper bound
    np.testing.assert_allclose(angles[450:], low[450:])  # and corners the lower one
    wide = lift.separation_bounds(distance)
    assert (paper[0] <= wide[0]).all()
    assert (wide[0] <= low + 1e-12).all()
    np.testing.assert_allclose(paper[1], wide[1])


@pytest.mark.parametrize("corner", [20, 60, 90])
def test_facets_are_triangles_of_the_sheet_and_those_that_see_the_pole(node, places, corner):
    closing = ask(node, "[...sitesOf(given).closing]", places.tolist())
    images, _, _ = zip(*ask(node, f"imagesOf(sitesOf(given), {corner})", places.tolist()), strict=True)
    rows = lambda flat: {tuple(sorted(row)) for row in np.reshape(flat, (-1, 3)).tolist()}  # noqa: E731
    assert rows(SphericalDelaunay(images).simplices) == rows(PlanarDelaunay(places).simplices) | rows(closing)
    assert len(closing) // 3 + len(PlanarDelaunay(places).simplices) == 2 * len(places) - 4


def test_sets_of_the_sheet(node):
    """With the facets that see the pole the triangles close the hull, also where four sites lie on a circle."""
    made = "map(({ name, make }) => [name, [...make()], sitesOf([...make()]).closing.length / 3])"
    expression = f"sheetSets(Float64Array.from(given.flat())).{made}"
    sets = ask(node, expression, scattered()["sheet"].tolist())
    assert [name for name, _, _ in sets] == ["sheet", "grid", "flat"]
    for _, flat, closing in sets:
        places = np.reshape(flat, (-1, 2))
        assert len(PlanarDelaunay(places).simplices) + closing == 2 * len(places) - 4
