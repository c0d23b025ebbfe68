"""Files: every format read back with the library that it is for; wrong requests; nothing half-written."""

import io
import json
from contextlib import nullcontext

import geopandas
import numpy as np
import pytest
import pyvista
import shapely
import trimesh
import xarray as xr

import stereodel as sd
from stereodel.io import PointTable, from_ugrid, to_geodataframe, to_geojson, to_polydata, to_trimesh, to_ugrid, write
from stereodel.io.formats.names import DataWarning
from tests import sets

SPHERE = sets.sphere("random").drawn(60)
UNIT = sets.unit(SPHERE)
PLANE = sets.plane("random").drawn(50)
NAMES = np.array([f"Ort „{k}“, ä" for k in range(60)])
GREAT_CIRCLE = sets.sphere("short circle").points


@pytest.fixture
def diagram():
    return sd.SphericalVoronoi(SPHERE)


@pytest.mark.parametrize(
    ("ending", "what"),
    [("geojson", "cells"), ("parquet", "triangles"), ("gpkg", "edges"), ("gpkg", "cells"), ("parquet", "ridges")],
)
def test_geometries_come_back(tmp_path, ending, what, diagram):
    frame = to_geodataframe(diagram, what=what)
    write(tmp_path / f"a.{ending}", diagram, what=what)
    write(tmp_path / f"b.{ending}", frame)
    for path in sorted(tmp_path.iterdir()):
        back = geopandas.read_parquet(path) if ending == "parquet" else geopandas.read_file(path)
        assert back.crs == "EPSG:4326"
        # A GeoPackage has one type in a layer: a Polygon comes back as a MultiPolygon of one part.
        theirs, ours = (shapely.get_parts(table.geometry.values, return_index=True) for table in (back, frame))
        assert shapely.equals_exact(theirs[0], ours[0], tolerance=0).all()
        assert (theirs[1] == ours[1]).all()
        assert back.drop(columns="geometry").to_numpy().tolist() == frame.drop(columns="geometry").to_numpy().tolist()


def test_geojson_rounds_transforms_and_turns_rings():
    """And has no numbers but finite ones: not those of missing values and of unbounded cells."""
    clockwise = shapely.Polygon([(0, 0), (0, 1e5), (1e5, 1e5), (1e5, 0)])
    frame = geopandas.GeoDataFrame({"value": [np.nan]}, geometry=[clockwise], crs=3857)
    feature = json.loads(to_geojson(frame, decimals=3))["features"][0]
    assert feature["properties"] == {"value": None}
    assert feature["geometry"]["coordinates"] == [[[0, 0], [0.898, 0], [0.898, 0.898], [0, 0.898], [0, 0]]]
    collection = json.loads(to_geojson(to_geodataframe(sd.PlanarVoronoi(PLANE[:3]))))
    assert [feature["properties"]["area"] for feature in collection["features"]] == [None] * 3


def test_triangles_as_csv(tmp_path):
    triangulation = sd.PlanarDelaunay(PLANE)
    write(tmp_path / "triangles.csv", triangulation)
    rows = np.loadtxt(tmp_path / "triangles.csv", delimiter=",", skiprows=1, dtype=int)
    sd.check_delaunay(PLANE, rows)
    north = sd.SphericalDelaunay(SPHERE[SPHERE[:, 2] > 0])  # what closes the far side has no row
    write(tmp_path / "north.csv", north)
    rows = np.loadtxt(tmp_path / "north.csv", delimiter=",", skiprows=1, dtype=int)
    assert rows.tolist() == to_geodataframe(north)[["a", "b", "c"]].to_numpy().tolist()
    write(tmp_path / "cells.csv", sd.PlanarVoronoi(triangulation))
    assert (tmp_path / "cells.csv").read_text().startswith("x,y,area\n")


def canonical(faces):
    return sorted(tuple(np.roll(face, -int(np.argmin(face)))) for face in (row[row >= 0] for row in np.asarray(faces)))


@pytest.mark.parametrize("what", ["triangles", "cells"])
def test_ugrid_comes_back(tmp_path, what):
    triangulation = sd.SphericalDelaunay(SPHERE)
    dataset = to_ugrid(triangulation, what=what)
    write(tmp_path / "mesh.nc", triangulation, what=what)
    with (
        xr.open_dataset(tmp_path / "mesh.nc") as decoded,
        xr.open_dataset(tmp_path / "mesh.nc", mask_and_scale=False) as raw,
    ):
        for read in (dataset, decoded, raw):
            nodes, faces = from_ugrid(read)
            if what == "triangles":
                assert (nodes == np.column_stack([dataset[f"node_{k}"] for k in "xyz"])).all()
                assert sd.angular_distance(nodes, SPHERE).max() < 1e-13
                sd.check_delaunay(SPHERE, faces)
                assert canonical(faces) == canonical(triangulation.simplices)
            else:
                regions = sd.SphericalVoronoi(triangulation).regions
                assert [[int(k) for k in row[row >= 0]] for row in faces] == regions
            assert float(read["face_area"].sum()) == pytest.approx(4 * np.pi)


def test_ugrid_of_the_plane_and_without_cartesian_nodes_counted_from_one():
    dataset = to_ugrid(sd.SphericalDelaunay(SPHERE)).drop_vars(["node_x", "node_y", "node_z"])
    links = dataset["face_node_connectivity"]
    dataset["face_node_connectivity"] = (links.dims, links.values + 1, links.attrs | {"start_index": 1})
    nodes, faces = from_ugrid(dataset)
    assert sd.angular_distance(nodes, SPHERE).max() < 1e-13
    sd.check_delaunay(SPHERE, faces)
    nodes, faces = from_ugrid(to_ugrid(sd.PlanarDelaunay(PLANE)))
    assert (nodes == PLANE).all()
    sd.check_delaunay(nodes, faces)


@pytest.mark.parametrize(
    ("points", "what"), [(SPHERE, "triangles"), (SPHERE, "cells"), (SPHERE[:2], "cells"), (GREAT_CIRCLE, "cells")]
)
def test_uxarray_opens_the_grid(tmp_path, points, what):
    import uxarray  # which brings 300 MB along: only into the process of this test

    diagram = sd.SphericalVoronoi(points)
    write(tmp_path / "mesh.nc", diagram, what=what)
    grid = uxarray.open_grid(tmp_path / "mesh.nc")
    ours = to_ugrid(diagram, what=what)
    assert (grid.n_face, grid.n_node, grid.n_edge) == tuple(ours.sizes[each] for each in ("face", "node", "edge"))
    for name in ("face_lon", "face_lat", "edge_lon", "edge_lat"):
        assert (getattr(grid, name).values == ours[name].values).all()
    if points is SPHERE:
        assert (grid.face_node_connectivity.values[:, :3] == ours["face_node_connectivity"].values[:, :3]).all()
        assert grid.n_node - grid.n_edge + grid.n_face == 2


VALUED = {
    "people": np.array([2**62 + k for k in range(len(SPHERE))]),
    "name": np.array([f"site {k}, „ü“" for k in range(len(SPHERE))]),
    "part": np.array([None, "x"] * (len(SPHERE) // 2), dtype=object),
    "half": np.linspace(0, 1, len(SPHERE)).astype(np.float16),
    "flag": np.arange(len(SPHERE)) % 2 == 0,
    "since": np.datetime64("2020-01-01T00:00:00.25", "ns") + np.arange(len(SPHERE)).astype("m8[h]"),
    "list": np.arange(2 * len(SPHERE)).reshape(-1, 2),
    "node_x": np.zeros(len(SPHERE)),
    "km/h, (mean) ": np.ones(len(SPHERE)),
}
"""A column of each kind, and names that are taken or that NetCDF has not."""


@pytest.mark.filterwarnings("ignore::stereodel.io.RenamedColumnWarning")
@pytest.mark.parametrize(
    ("what", "kind"), [("cells", "nc"), ("triangles", "nc"), ("cells", "vtp"), ("triangles", "vtp")]
)
def test_columns_of_meshes_come_back(tmp_path, what, kind):
    """Data on the faces of cells, and on the nodes of triangles, as uxarray and PyVista read them."""
    path = tmp_path / f"mesh.{kind}"
    with (
        nullcontext() if kind == "nc" else pytest.warns(DataWarning, match="column 'name' is left out, as it has text")
    ):
        write(path, sd.SphericalDelaunay(SPHERE), what=what, columns=VALUED)
    names = [*list(VALUED)[:-2], *(["node_x_1"] if kind == "nc" else ["node_x"]), "km_h, (mean) _"]
    if kind == "nc":
        import uxarray

        found = uxarray.open_dataset(path, path)
        for name, given in zip(names, VALUED, strict=True):
            assert found[name].dims == ("n_face" if what == "cells" else "n_node",)
            assert found[name].attrs == {"mesh": "mesh", "location": found[name].dims[0][2:], "long_name": given}
    else:
        import pyvista

        mesh = pyvista.read(path)
        found = mesh.cell_data if what == "cells" else mesh.point_data
    assert ("name" in found) == (kind == "nc")
    read = {given: np.asarray(found[name]) for name, given in zip(names, VALUED, strict=True) if name in found}
    for name in {"people", "name", "half", "flag"} & set(read):
        assert read[name].tolist() == VALUED[name].tolist()
    assert read["part"].tolist() == ["", "x"] * (len(SPHERE) // 2)
    assert read["list"].tolist() == [f"[{a}, {b}]" for a, b in VALUED["list"]]
    assert (read["since"].astype("M8[ns]") == VALUED["since"]).all()


def test_points_without_a_face_lose_their_values(tmp_path):
    points = np.vstack([SPHERE, SPHERE[:3]])
    with pytest.warns(DataWarning, match=f"3 of {len(points)} points have no bounded cell of their own: their values"):
        dataset = to_ugrid(sd.SphericalVoronoi(points), columns={"k": range(len(points))})
    assert dataset["k"].values.tolist() == list(range(len(SPHERE)))
    with pytest.raises(ValueError, match=r"column 'k' has .* \.nc cannot hold"):
        write(tmp_path / "a.nc", sd.SphericalVoronoi(SPHERE), columns={"k": ["a\0b"] * len(SPHERE)})


@pytest.mark.parametrize("mesh", [sd.SphericalVoronoi(SPHERE), sd.SphericalDelaunay(SPHERE), sd.PlanarVoronoi(PLANE)])
def test_ugrid_keeps_to_its_conventions(mesh):
    """UGRID 1.0: attributes of the topology name variables of the right shape; places have standard names and units."""
    dataset = to_ugrid(mesh)
    topology, spherical = dataset["mesh"].attrs, mesh.points.shape[1] == 3
    assert topology["topology_dimension"] == 2
    standards = [{"standard_name": "longitude", "units": "degrees_east"}]
    standards += [{"standard_name": "latitude", "units": "degrees_north"}]
    for location in ("node", "face", "edge"):
        names = topology[f"{location}_coordinates"].split()
        assert names == [f"{location}_{axis}" for axis in (("lon", "lat") if spherical else ("x", "y"))]
        places = [dataset[name] for name in names]
        assert all(each.dims == (location,) and np.isfinite(each).all() for each in places)
        assert not spherical or [each.attrs for each in places] == standards
        if location != "node":
            links = dataset[topology[f"{location}_node_connectivity"]]
            assert links.dims[0] == topology[f"{location}_dimension"] == location
            assert links.attrs["start_index"] == 0


def test_centres_of_ugrid():
    """Sites of cells; triangles hold theirs; middles of edges are as far from one end as from the other."""
    cells, triangles = to_ugrid(sd.SphericalVoronoi(SPHERE)), to_ugrid(sd.SphericalDelaunay(SPHERE))

    def places(dataset, location):
        return sd.lonlat_to_xyz(np.column_stack([dataset[f"{location}_lon"], dataset[f"{location}_lat"]]))

    assert sd.angular_distance(places(cells, "face"), SPHERE[cells["face_point"].values]).max() < 1e-13
    found = sd.SphericalDelaunay(SPHERE).find_simplex(places(triangles, "face"))
    assert (found == triangles["face_triangle"].values).all()
    for dataset in (cells, triangles):
        ends = places(dataset, "node")[dataset["edge_node_connectivity"].values]
        middle = places(dataset, "edge")
        to_both = sd.angular_distance(ends[:, 0], middle), sd.angular_distance(ends[:, 1], middle)
        assert np.abs(to_both[0] - to_both[1]).max() < 1e-12
        assert np.abs(to_both[0] + to_both[1] - sd.angular_distance(*ends.transpose(1, 0, 2))).max() < 1e-12


@pytest.mark.parametrize("ending", ["glb", "ply"])
def test_globes_and_coloured_cells_come_back(tmp_path, ending, diagram):
    triangulation, colors = sd.SphericalDelaunay(SPHERE), np.random.default_rng(13).integers(0, 256, size=(60, 3))
    write(tmp_path / f"globe.{ending}", triangulation)
    write(tmp_path / f"cells.{ending}", diagram, colors=colors)
    globe, cells = (
        trimesh.load(tmp_path / f"{name}.{ending}", force="mesh", process=False) for name in ("globe", "cells")
    )
    assert np.allclose(globe.vertices, UNIT, atol=1e-6)
    assert globe.is_watertight
    assert globe.volume == pytest.approx(trimesh.Trimesh(UNIT, triangulation.simplices, process=False).volume)
    sd.check_delaunay(SPHERE, globe.faces)
    made = to_trimesh(diagram, colors=colors)
    assert np.allclose(cells.vertices, made.vertices, atol=1e-6)
    assert (cells.faces == made.faces).all()
    assert (cells.visual.vertex_colors[:, :3] == colors[made.vertex_attributes["point"].astype(int)]).all()


@pytest.mark.parametrize("points", [SPHERE, SPHERE[:2], GREAT_CIRCLE], ids=["random", "two", "great circle"])
def test_facets_of_cells_cover_the_sphere(points):
    diagram = sd.SphericalVoronoi(points)
    mesh = to_trimesh(diagram, max_segment=2)
    owner = mesh.vertex_attributes["point"].astype(int)
    assert np.allclose(np.linalg.norm(mesh.vertices, axis=1), 1, rtol=1e-14)
    assert (owner[mesh.faces] == owner[mesh.faces[:, :1]]).all()
    assert (np.einsum("ij,ij->i", mesh.face_normals, mesh.triangles_center) > 0)[mesh.area_faces > 1e-12].all()
    areas = np.bincount(owner[mesh.faces[:, 0]], mesh.area_faces, minlength=len(points))
    assert np.allclose(areas, diagram.areas(), rtol=2e-3)


def test_meshes_of_the_plane():
    triangles, cells = to_trimesh(sd.PlanarDelaunay(PLANE)), to_trimesh(sd.PlanarVoronoi(PLANE))
    assert (triangles.vertices == np.column_stack([PLANE, np.zeros(50)])).all()
    bounded = np.isfinite(sd.PlanarVoronoi(PLANE).areas())
    assert cells.area == pytest.approx(sd.PlanarVoronoi(PLANE).areas()[bounded].sum())
    assert to_polydata(sd.PlanarDelaunay(PLANE)).area == pytest.approx(triangles.area)
    assert to_polydata(sd.PlanarVoronoi(PLANE)).n_cells == bounded.sum()


def test_coloured_triangles():
    triangulation = sd.SphericalDelaunay(SPHERE)
    colors = np.random.default_rng(14).uniform(size=(len(triangulation.simplices), 4))
    mesh = to_trimesh(triangulation, colors=colors)
    assert np.allclose(mesh.triangles, UNIT[triangulation.simplices], atol=1e-15)
    assert (mesh.visual.vertex_colors[mesh.faces] == np.round(255 * colors)[:, None]).all()


def test_polydata_comes_back(tmp_path, diagram):
    write(tmp_path / "cells.vtp", diagram)
    mesh = pyvista.read(tmp_path / "cells.vtp")
    assert mesh.n_cells == 60
    assert mesh["area"].sum() == pytest.approx(4 * np.pi)
    assert [mesh.get_cell(k).point_ids for k in range(60)] == diagram.regions
    triangles = to_polydata(sd.SphericalDelaunay(SPHERE))
    assert (triangles.regular_faces == sd.SphericalDelaunay(SPHERE).simplices).all()
    assert triangles.is_manifold


def test_streams():
    stream = io.BytesIO()
    write(stream, PointTable([[1.5, 2.0]], {"name": ["a"]}), format="csv")
    assert stream.getvalue() == b"lon,lat,name\n1.5,2,a\n"
