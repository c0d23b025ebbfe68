"""The validator of glTF is asked, and heard."""

import numpy as np
import trimesh

from stereodel import PlanarVoronoi, SphericalDelaunay, SphericalVoronoi
from stereodel.drawing import Scene, View
from stereodel.io import write
from tools import gltf


def test_issues_are_told_file_by_file(tmp_path):
    good, bad = Scene().solid(View(0, 0)).save(tmp_path / "good.glb"), tmp_path / "bad.glb"
    normals = np.tile([0.0, 0.0, 2.0], (3, 1))
    mesh = trimesh.Trimesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], vertex_normals=normals, process=False)
    bad.write_bytes(trimesh.exchange.gltf.export_glb(mesh, include_normals=True, unitize_normals=False))
    first, second = gltf.issues([good, bad])
    assert first == []
    assert second[0].startswith("error ACCESSOR_VECTOR3_NON_UNIT")


def test_meshes_of_data_have_neither_errors_nor_warnings(tmp_path):
    points = np.random.default_rng(0).normal(size=(30, 3))
    meshes = [SphericalDelaunay(points), SphericalVoronoi(points), PlanarVoronoi(points[:, :2])]
    files = [tmp_path / f"{type(mesh).__name__}.glb" for mesh in meshes]
    for file, mesh in zip(files, meshes, strict=True):
        write(file, mesh)
    for found in gltf.issues(files):
        assert [issue for issue in found if not issue.startswith("hint ")] == []
