"""Cells cut with polygons: what overlays of whole maps give, and areas on the sphere."""

import geopandas
import numpy as np
import pytest
import shapely

from stereodel import SphericalDelaunay, SphericalVoronoi, data
from stereodel.io import to_geodataframe, write
from stereodel.io.maps.clipping import areas_on_sphere

RNG = np.random.default_rng(21)
LONLAT = np.column_stack([RNG.uniform(-180, 180, 300), np.degrees(np.arcsin(RNG.uniform(-1, 1, 300)))])
DIAGRAM = SphericalVoronoi.from_lonlat(LONLAT)
WHOLE = to_geodataframe(DIAGRAM)
LAND = shapely.union_all([shapely.Polygon(rings[0], rings[1:]) for rings in data.land("110m").polygons()])


def planar(frame):
    return shapely.area(np.asarray(frame.geometry))


def test_land_is_that_of_one_overlay():
    """The squares into which land is divided leave no trace; Antarctica and both sides of ±180° are there."""
    found = to_geodataframe(DIAGRAM, clip=LAND)
    expected = shapely.intersection(np.asarray(WHOLE.geometry), LAND)
    there = np.flatnonzero(shapely.area(expected) > 0)
    assert found["point"].tolist() == there.tolist()
    assert shapely.is_valid(found.geometry.values).all()
    assert set(found.geom_type) == {"Polygon", "MultiPolygon"}
    assert shapely.symmetric_difference(np.asarray(found.geometry), expected[there]).dtype == object
    assert np.abs(planar(found) - shapely.area(expected[there])).max() < 1e-10
    assert shapely.area(shapely.symmetric_difference(np.asarray(found.geometry), expected[there])).max() < 1e-10
    assert planar(found).sum() == pytest.approx(LAND.area, rel=1e-12)
    assert found.total_bounds[[0, 1, 2]].tolist() == [-180, -90, 180]


@pytest.mark.parametrize("latitude", ["spherical", "geodetic", "authalic"])
def test_areas_of_an_octant(latitude):
    """A box from the equator to a pole holds an eighth of the sphere, whatever latitudes are."""
    diagram = SphericalVoronoi.from_lonlat(LONLAT, latitude=latitude)
    octant = shapely.box(0, 0, 90, 90)
    found = to_geodataframe(diagram, clip=octant, max_segment=0.1)
    assert found["area"].sum() == pytest.approx(np.pi / 2, rel=1e-6)
    inside = shapely.contains_properly(octant, np.asarray(found.geometry))
    assert inside.any()
    assert (found["area"][inside] == diagram.areas()[found["point"][inside]]).all()


def test_the_whole_map_changes_nothing():
    found = to_geodataframe(DIAGRAM, clip=shapely.box(-180, -90, 180, 90))
    assert shapely.area(shapely.symmetric_difference(*(np.asarray(f.geometry) for f in (found, WHOLE)))).max() == 0
    assert np.allclose(found["area"], WHOLE["area"], rtol=1e-12)


def test_areas_on_the_sphere():
    triangle = shapely.Polygon([(0, 0), (90, 0), (90, 90), (0, 90)])
    hole = shapely.Polygon(
        shapely.box(0, 0, 90, 90).exterior, [list(shapely.box(10, 10, 20, 20).exterior.coords)[::-1]]
    )
    belt = np.radians(10) * (np.sin(np.radians(20)) - np.sin(np.radians(10)))
    found = areas_on_sphere(
        shapely.orient_polygons([triangle, hole, shapely.box(-180, -90, 180, 90), shapely.Polygon()]), "spherical"
    )
    assert found == pytest.approx([np.pi / 2, np.pi / 2 - belt, 4 * np.pi, 0])
    # Below the line from (0, 0) to (1, 1): the integral of sin x, as steep lines are no parallels.
    line = areas_on_sphere(np.array([shapely.Polygon([(0, 0), (50, 0), (50, 50)])]), "spherical")
    assert line == pytest.approx([1 - np.cos(np.radians(50))])


@pytest.mark.parametrize("shift", [0, 360, -360])
def test_polygons_beyond_the_180th_meridian(shift):
    beyond = shapely.box(170 + shift, -10, 190 + shift, 10)
    apart = shapely.union_all([shapely.box(170, -10, 180, 10), shapely.box(-180, -10, -170, 10)])
    one, other = (to_geodataframe(DIAGRAM, clip=clip) for clip in (beyond, apart))
    assert one["point"].tolist() == other["point"].tolist()
    assert np.abs(planar(one) - planar(other)).max() < 1e-10
    assert planar(one).sum() == pytest.approx(400)


def test_what_cuts(tmp_path):
    """Files, frames with coordinate systems, several geometries that overlap or cross themselves."""
    box = shapely.box(0, 0, 20, 10)
    expected = to_geodataframe(DIAGRAM, clip=box)
    metres = geopandas.GeoSeries([box.segmentize(0.01)], crs=4326).to_crs(3857)
    metres.to_file(tmp_path / "box.gpkg")
    (tmp_path / "box.geojson").write_text(shapely.to_geojson(box))
    bowtie = shapely.Polygon([(0, 0), (20, 0), (0, 10), (20, 10)])
    sources = [metres, tmp_path / "box.gpkg", tmp_path / "box.geojson", [box, shapely.box(5, 5, 9, 9)], [bowtie, box]]
    for clip in sources:
        found = to_geodataframe(DIAGRAM, clip=clip)
        assert found["point"].tolist() == expected["point"].tolist()
        assert np.abs(planar(found) - planar(expected)).max() < 1e-7


def test_triangles_and_files(tmp_path):
    triangulation = SphericalDelaunay.from_lonlat(LONLAT)
    found = to_geodataframe(triangulation, clip=LAND)
    assert planar(found).sum() == pytest.approx(LAND.area, rel=1e-10)
    write(tmp_path / "cells.gpkg", DIAGRAM, clip="land", columns={"lat_of_site": LONLAT[:, 1]})
    cells = geopandas.read_file(tmp_path / "cells.gpkg")
    assert (cells["lat_of_site"].to_numpy() == LONLAT[cells["point"], 1]).all()
    assert 0.27 < cells["area"].sum() / (4 * np.pi) < 0.31  # 29 % of the Earth is land
