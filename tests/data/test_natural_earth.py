"""Land, countries and borders: valid GeoJSON, that fit together point by point, and are where they are."""

import geopandas
import numpy as np
import pytest
import shapely

from stereodel import data

RESOLUTIONS = ["50m", "110m"]
ALL = [(kind, r) for kind in ("land", "lakes") for r in ("10m", *RESOLUTIONS)]
ALL += [("countries", r) for r in RESOLUTIONS]
WORLD_LAND_KM2 = 149e6
INVALID = {"50m": set(), "110m": {"Sudan"}}
"""A knot of the border in the source."""

both = pytest.mark.parametrize("resolution", RESOLUTIONS)


def rings(table):
    return [ring for polygon in table.polygons() for ring in polygon]


def signed_area(ring):
    (x0, y0), (x1, y1) = ring[:-1].T, ring[1:].T
    return 0.5 * np.sum(x0 * y1 - x1 * y0)


def on_map_edge(ring):
    """Sides along ±180° and along the south pole."""
    start, end = ring[:-1], ring[1:]
    vertical = (np.abs(start[:, 0]) == 180) & (start[:, 0] == end[:, 0])
    return vertical | ((start[:, 1] == -90) & (end[:, 1] == -90))


def sides_of(lines):
    """Each side of each line once, without direction."""
    pairs = np.concatenate([np.stack([line[:-1], line[1:]], axis=1) for line in lines])
    return {tuple(sorted(map(tuple, pair))) for pair in pairs.tolist()}


def country(table, name):
    (k,) = np.flatnonzero(table.name == name)
    start, end = table.country_offsets[k : k + 2]
    return shapely.MultiPolygon([(p[0], p[1:]) for p in table.polygons()[start:end]])


@pytest.mark.parametrize(("kind", "resolution"), ALL)
def test_polygons_are_those_of_geojson(kind, resolution):
    table = getattr(data, kind)(resolution)
    assert (np.abs(table.lonlat).max(axis=0) == [180, 90]).all() == (kind != "lakes")
    assert table.polygon_offsets[-1] == len(table.ring_offsets) - 1
    assert table.ring_offsets[-1] == len(table.lonlat)
    for outline, *holes in table.polygons():
        assert signed_area(outline) > 0
        assert all(signed_area(hole) < 0 for hole in holes)
        assert shapely.Polygon(outline, holes).is_valid or kind == "countries"
    for ring in rings(table):
        assert len(ring) >= 4
        assert ring[0].tolist() == ring[-1].tolist()
        steps = np.abs(np.diff(ring, axis=0))[~on_map_edge(ring)]
        assert steps.any(axis=1).all()
        assert steps[:, 0].max() < 50


@both
def test_polygons_are_valid(resolution):
    table = data.countries(resolution)
    features = table.__geo_interface__["features"]
    names = [feature["properties"]["name"] for feature in features]
    assert names == table.name.tolist()
    shapes = [shapely.geometry.shape(feature["geometry"]) for feature in features]
    assert {name for name, shape in zip(names, shapes, strict=True) if not shape.is_valid} == INVALID[resolution]
    assert shapely.geometry.shape(data.land(resolution)).is_valid


@both
def test_land_is_the_union_of_the_countries(resolution):
    """Its sides are those that one country has alone; two countries have the others, and these are the borders."""
    of_countries = [side for ring in rings(data.countries(resolution)) for side in sides_of([ring])]
    once, twice = set(), set()
    for side in of_countries:
        (twice if side in once else once).add(side)
    assert len(of_countries) == len(once) + len(twice)
    assert sides_of(rings(data.land(resolution))) == once - twice
    assert sides_of(data.borders(resolution).lines()) == twice


@both
def test_a_border_has_its_countries_on_its_sides(resolution):
    borders, countries = data.borders(resolution), data.countries(resolution)
    rows = np.repeat(np.arange(len(countries.name)), np.diff(countries.country_offsets))
    owner = {
        (*start, *end): int(row)
        for row, polygon in zip(rows, countries.polygons(), strict=True)
        for ring in polygon
        for start, end in zip(ring[:-1].tolist(), ring[1:].tolist(), strict=True)
    }
    for (left, right), line in zip(borders.sides.tolist(), borders.lines(), strict=True):
        for start, end in zip(line[:-1].tolist(), line[1:].tolist(), strict=True):
            assert owner[*start, *end] == left
            assert owner[*end, *start] == right


def square_kilometres(shape):
    """On the sphere, by the cylindrical equal-area map."""
    return shapely.transform(shape, lambda p: np.c_[np.radians(p[:, 0]), np.sin(np.radians(p[:, 1]))]).area * 6371.0**2


@pytest.mark.parametrize("resolution", ["10m", "50m", "110m"])
def test_area_of_the_land(resolution):
    assert square_kilometres(shapely.geometry.shape(data.land(resolution))) == pytest.approx(WORLD_LAND_KM2, rel=0.02)


@pytest.mark.parametrize(
    ("name", "alpha3", "number", "continent", "inside", "million_km2"),
    [
        ("Russia", "RUS", 643, "EU", [(37.6, 55.8), (-172.5, 65.5), (158.7, 53.1)], 16.9),
        ("Antarctica", "ATA", 10, "AN", [(0.0, -90.0), (-179.9, -85.0), (179.9, -85.0)], 12.3),
        ("Fiji", "FJI", 242, "OC", [(178.0, -17.8)], 0.0186),
        ("Lesotho", "LSO", 426, "AF", [(28.2, -29.6)], 0.0304),
    ],
)
def test_a_country(name, alpha3, number, continent, inside, million_km2):
    table = data.countries()
    row = int(np.flatnonzero(table.name == name)[0])
    assert (table.alpha3[row], table.number[row], table.continent[row]) == (alpha3, number, continent)
    shape = country(table, name)
    assert all(shape.covers(shapely.Point(place)) for place in inside)
    assert square_kilometres(shape) / 1e6 == pytest.approx(million_km2, rel=0.05)
    assert not country(table, "South Africa").contains(shapely.Point(28.2, -29.6))


@both
def test_coastlines_are_the_outlines_of_the_land(resolution):
    """Apart from some islets and some roundings of the source, and from the edges of the map."""
    coasts, outlines = sides_of(data.coastlines(resolution).lines()), sides_of(rings(data.land(resolution)))
    assert len(coasts - outlines) < {"50m": 0.01, "110m": 0.06}[resolution] * len(coasts)
    assert not any(on_map_edge(line).any() for line in data.coastlines(resolution).lines())


def test_the_finest_coastlines_are_the_outlines_of_the_land_without_the_edges_of_the_map():
    coasts, outlines = data.coastlines("10m"), rings(data.land("10m"))
    assert sum(len(line) - 1 for line in coasts.lines()) == sum(int((~on_map_edge(ring)).sum()) for ring in outlines)
    assert not any(on_map_edge(line).any() for line in coasts.lines())


@pytest.mark.parametrize("resolution", ["10m", "50m", "110m"])
def test_rivers(resolution):
    table = data.rivers(resolution)
    lines = table.lines()
    assert len(lines) == len(table.name) == len(table.rank) == len(table.in_lake)
    assert (np.diff(table.rank) >= 0).all()
    assert min(len(line) for line in lines) >= 2
    assert all(np.diff(line, axis=0).any(axis=1).all() for line in lines)
    danube = shapely.MultiLineString([line for line, name in zip(lines, table.name, strict=True) if name == "Donau"])
    assert table.in_lake.any() == (resolution != "110m")
    lena = shapely.MultiLineString([line for line, name in zip(lines, table.name, strict=True) if name == "Lena"])
    assert lena.distance(shapely.Point(129.7, 62.1)) < 0.6  # Yakutsk
    assert danube.is_empty or danube.distance(shapely.Point(16.4, 48.2)) < 0.1  # Vienna


@pytest.mark.parametrize(
    "function", [data.coastlines, data.land, data.borders, data.rivers, data.lakes, data.countries]
)
def test_other_resolutions_are_refused(function):
    choices = "'50m', '110m'" if function is data.countries else "'10m', '50m', '110m'"
    with pytest.raises(ValueError, match=f"resolution is '10km', but must be one of {choices}"):
        function("10km")


def test_countries_are_a_table_of_geopandas():
    frame = geopandas.GeoDataFrame.from_features(data.countries())
    assert frame.geometry.is_valid.all()
    largest = frame.assign(area=frame.geometry.map(square_kilometres)).nlargest(3, "area")
    assert largest["name"].tolist() == ["Russia", "Antarctica", "Canada"]
    assert largest["alpha2"].tolist() == ["RU", "AQ", "CA"]
