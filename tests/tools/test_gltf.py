"""The validator of glTF is asked, and heard."""

import numpy as np
import pytest
import trimesh

from stereodel import PlanarVoronoi, SphericalDelaunay, SphericalVoronoi
from stereodel.drawing import Scene, View
from stereodel.io import write
from tools import gltf


def test_issues_are_told_file_by_file(tmp_path, capsys):
    good, bad = Scene().solid(View(0, 0)).save(tmp_path / "good.glb"), tmp_path / "bad.glb"
    normals = np.tile([0.0, 0.0, 2.0], (3, 1))
    mesh = trimesh.Trimesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], vertex_normals=normals, process=False)
    bad.write_bytes(trimesh.exchange.gltf.export_glb(mesh, include_normals=True, unitize_normals=False))
    assert gltf.main([str(good), str(bad)]) == 1
    first, second = capsys.readouterr().out.splitlines()
    assert first.endswith("good.glb: valid")
    assert "error ACCESSOR_VECTOR3_NON_UNIT" in second
    assert gltf.main([str(good)]) == 0


def test_what_is_no_gltf_is_an_error_in_one_line(tmp_path, capsys):
    file = tmp_path / "text.glb"
    file.write_text("no")
    assert gltf.main([str(file)]) == 2
    assert capsys.readouterr().err.startswith("error: the validator of glTF failed: Invalid data")


def test_a_missing_validator_says_how_to_get_it(tmp_path):
    with pytest.raises(gltf.ValidatorError, match=r"holds no validator of glTF; get it with: tools/gltf_validator\.sh"):
        gltf.issues([], prefix=tmp_path)


def test_meshes_of_data_have_neither_errors_nor_warnings(tmp_path):
    points = np.random.default_rng(0).normal(size=(30, 3))
    meshes = [SphericalDelaunay(points), SphericalVoronoi(points), PlanarVoronoi(points[:, :2])]
    files = [tmp_path / f"{type(mesh).__name__}.glb" for mesh in meshes]
    for file, mesh in zip(files, meshes, strict=True):
        write(file, mesh)
    for found in gltf.issues(files):
        assert [issue for issue in found if not issue.startswith("hint ")] == []
