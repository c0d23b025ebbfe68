"""`stereodel contour`: lines of equal values."""

import geopandas


def test_levels_and_multiples(folder, run):
    run("contour", "cities.csv", "--value", "people", "--levels", "2000000,5000000", "-o", "lines.gpkg")
    lines = geopandas.read_file(folder / "lines.gpkg")
    assert set(lines["level"]) == {2e6, 5e6}
    assert lines.is_valid.all()
    run("contour", "cities.csv", "--value", "people", "--interval", 2_000_000, "-o", "lines.geojson")
    levels = geopandas.read_file(folder / "lines.geojson")["level"]
    assert set(levels) == {2e6 * k for k in range(1, 8)}


def test_the_plane(folder, run):
    (folder / "plane.csv").write_text("x,y,z\n0,0,0\n2,0,4\n2,2,4\n0,2,0\n", encoding="utf-8")
    run("contour", "plane.csv", "--plane", "x", "y", "--value", "z", "--levels", "1", "-o", "lines.parquet")
    (line,) = geopandas.read_parquet(folder / "lines.parquet").geometry
    assert {x for x, _ in line.coords} == {0.5}
