"""`stereodel triangulate`: the library's triangles, by rows of the table."""

import geopandas
import numpy as np
import pytest
import trimesh

from stereodel import PlanarDelaunay, SphericalDelaunay, check_delaunay, lonlat_to_xyz
from stereodel.cli.destinations import MESHES


def corners(rows, text):
    return np.array([[int(row[name]) for name in row] for row in rows(text)])


def test_triangles_of_the_sphere(folder, run, rows):
    places = rows((folder / "cities.csv").read_text())
    points = lonlat_to_xyz([(float(row["lon"]), float(row["lat"])) for row in places])
    found = corners(rows, run("triangulate", "cities.csv", "-o", "-")) - 1
    assert found.tolist() == SphericalDelaunay(points).simplices.tolist()
    check_delaunay(points, found.astype(np.int32))


def test_edges_in_the_plane(folder, run, rows):
    points = np.random.default_rng(1).integers(0, 9, (20, 2)).astype(float)
    np.savetxt(folder / "grid.csv", points, delimiter=",", header="east,north", comments="")
    found = corners(rows, run("triangulate", "grid.csv", "--plane", "east", "north", "--edges", "-o", "-"))
    assert (found - 1).tolist() == PlanarDelaunay(points).edges.tolist()


def test_the_far_side_is_left_out(folder, run, rows):
    (folder / "four.csv").write_text("lon,lat\n0,0\n9,0\n0,9\n3,3\n", encoding="utf-8")
    found = corners(rows, run("triangulate", "four.csv", "-o", "-"))
    assert {frozenset(row) for row in found.tolist()} == {frozenset(row) for row in ((1, 2, 4), (2, 3, 4), (1, 3, 4))}


@pytest.mark.parametrize(
    ("kind", "options", "what"),
    [("geojson", [], "Polygon"), ("parquet", ["--edges"], "LineString"), ("gpkg", ["--edges"], "LineString")],
)
def test_shapes(folder, run, rows, kind, options, what):
    run("triangulate", "cities.csv", "-o", f"out.{kind}", *options)
    read = geopandas.read_parquet if kind == "parquet" else geopandas.read_file
    frame = read(folder / f"out.{kind}")
    found = frame.drop(columns="geometry").to_numpy()
    expected = corners(rows, run("triangulate", "cities.csv", "-o", "-", *options))
    assert sorted(found.tolist()) == sorted(expected.tolist())
    assert frame.is_valid.all()
    assert set(frame.geom_type) <= {what, f"Multi{what}"}
    assert frame.crs.to_epsg() == 4326


@pytest.mark.parametrize("kind", MESHES)
def test_meshes_and_pictures(folder, run, kind):
    run("triangulate", "cities.csv", "-o", f"out.{kind}", "--latitude", "geodetic")
    assert (folder / f"out.{kind}").stat().st_size > 0


def test_glb_holds_the_triangles(folder, run, rows):
    run("triangulate", "cities.csv", "-o", "out.glb")
    mesh = trimesh.load(folder / "out.glb", force="mesh", process=False)
    assert len(mesh.faces) >= len(rows(run("triangulate", "cities.csv", "-o", "-")))
    assert np.allclose(np.linalg.norm(mesh.vertices, axis=1), 1, atol=1e-6)
