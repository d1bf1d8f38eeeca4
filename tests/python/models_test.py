"""From a surface to its axes, walls, profile, mesh and pressure, against what is known."""
import gc
import pickle
import sys
import types
import weakref

import numpy as np
import pytest

import ostia


def test_a_surface_with_fields(tmp_path, surface):
    shear = np.linspace(0, 1, len(surface.points))
    ostia.write_surface_fields(tmp_path / "f.vtp", surface, {"shear": shear, "normal": surface.points})
    read, points, triangles = ostia.read_surface_fields(tmp_path / "f.vtp")
    np.testing.assert_array_equal(points["shear"], shear)
    np.testing.assert_array_equal(points["normal"], surface.points)
    np.testing.assert_array_equal(read.triangles, surface.triangles)


def test_the_mask_of_a_ball(ball):
    assert ostia.segment_mask(ball).volume == pytest.approx(4 / 3 * np.pi * 64, rel=0.06)


def test_walls_are_round_where_the_axis_says_so(model):
    profile = ostia.lumen_profile(model, 1)
    assert profile.found.all() and len(profile) == len(profile.s_mm)
    middle = (profile.s_mm > 3) & (profile.s_mm < 14)
    np.testing.assert_allclose(profile.diameter_mm[middle], 3.0, atol=0.05)
    assert profile.volume_mm3(5, 10) == pytest.approx(np.pi * 1.5**2 * 5, rel=0.02)


def test_the_narrowing_is_found(model):
    walls = model.solve()
    (found,) = ostia.find_stenoses(model, 1, walls)
    assert found.throat_mm == pytest.approx(20, abs=0.5)
    assert found.diameter_percent == pytest.approx(50, abs=3) and found.cad_rads == "3"
    assert walls.vessels == [1]
    inside = walls.values(1, [(0, 0, 8), (1.5, 0, 8), (2.0, 0, 8)])
    assert inside[0] < 0 and abs(inside[1]) < 0.02 and inside[2] > 0


def test_other_walls_are_refused(model):
    with pytest.raises(ostia.InvalidInput, match="vessel"):
        model.solve().values(7, [(0, 0, 0)])


def test_the_surface_is_closed_and_as_large(model):
    surface = model.surface(0.2)
    assert surface.closed and surface.volume == pytest.approx(np.pi * 1.5**2 * 40, rel=0.15)


def test_edits_make_other_models(model):
    edited = ostia.apply_edit(model, "wall.push", vessel=1, path=[(0.0, 0, 8), (0.9, 0, 8)], radius_mm=1.0)
    assert edited.vessels == [1] and edited.model != model and edited.model.digest != model.digest
    assert ostia.lumen_profile(edited.model, 1).area_mm2.max() > ostia.lumen_profile(model, 1).area_mm2.max() + 0.3
    same = ostia.apply_edit(model, '{"v": 1, "op": "vessel.rename", "vessel": 1, "name": "RCA"}')
    assert same.model.tree.vessels[0].name == "RCA" and model.tree.vessels[0].name == "LAD"
    with pytest.raises(ostia.InvalidInput, match="op"):
        ostia.apply_edit(model, "wall.paint", vessel=1)


def test_samples(model):
    samples = model.samples(1)
    assert set(samples) == {"id", "position", "normal", "s_mm", "origin"}
    np.testing.assert_allclose(np.linalg.norm(samples["normal"], axis=1), 1)


def test_a_mesh_with_named_faces(tmp_path):
    surface = ostia.example_surface(0.4)
    tree = ostia.extract_centerlines(surface).tree
    meshed = ostia.mesh_lumen(surface, tree, sizing={"edge_ratio": 0.6}, volume={"layers": {"layers": 2}})
    mesh = meshed.mesh
    assert meshed.ok, meshed.reasons
    assert len(mesh.prisms) > 0 and {"wall", "inlet", "outlet"} == {face.kind for face in mesh.faces}
    assert meshed.quality["volume"]["inverted"] == 0
    ostia.export_mesh(tmp_path / "m.msh", mesh, "gmsh4")
    again = ostia.read_volume_mesh(tmp_path / "m.msh")
    assert len(again.tetrahedra) == len(mesh.tetrahedra) and len(again.prisms) == len(mesh.prisms)
    np.testing.assert_allclose(sorted(again.points[:, 2]), sorted(mesh.points[:, 2]), atol=1e-12)


def test_edges_are_as_long_as_asked(surface):
    mesh = ostia.remesh(surface, 0.6)
    a, b, c = (mesh.points[mesh.triangles[:, i]] for i in range(3))
    assert np.linalg.norm(b - a, axis=1).mean() == pytest.approx(0.6, rel=0.1)


def test_pressure_falls_at_the_narrowing(tree, model):
    rest = ostia.pressure(tree, conditions={"rest_flow_ml_min": 60.0})
    assert rest["lesions"] and 0.3 < rest["lesions"][0]["ffr"] < 1.0
    higher = ostia.pressure(tree, conditions={"rest_flow_ml_min": 30.0})
    assert higher["lesions"][0]["ffr"] > rest["lesions"][0]["ffr"]
    with pytest.raises(ostia.InvalidInput, match="systolic_mmhg|systolic"):
        ostia.pressure(model, conditions={"systolic_mmhg": 900.0})
    with pytest.raises(ostia.UsageError, match=r"no option conditions\.systolic"):
        ostia.pressure(model, conditions={"systolic": 120})


def test_a_network_as_arrays(tmp_path):
    points = np.array([[0, 0, 0], [0, 0, 5], [3, 0, 9], [-3, 0, 9]], float)
    graph = ostia.VesselGraph(points, [[0, 1], [1, 2], [1, 3]], [2.0, 1.5, 1.2], [1.8, 1.0, 1.0])
    assert graph.edges["radius_end"].tolist() == [1.8, 1.0, 1.0] and graph.edges["end"].tolist() == [1, 2, 3]
    assert ostia.write_graph(tmp_path / "tree.vtp", graph) == []
    again = ostia.read_graph(tmp_path / "tree.vtp")
    assert np.array_equal(again.points, points) and np.array_equal(again.edges, graph.edges)
    assert np.array_equal(pickle.loads(pickle.dumps(graph)).edges, graph.edges) and len(graph) == 3
    assert not graph.edges.flags.writeable and "3 edges" in repr(graph)
    with pytest.raises(ostia.InvalidInput, match="radius_start: 2 numbers for 3 edges"):
        ostia.VesselGraph(points, [[0, 1], [1, 2], [1, 3]], [2.0, 1.5])
    with pytest.raises(ostia.InvalidInput, match="edges: 9 in row 0 is the index of no point"):
        ostia.VesselGraph(points, [[0, 9]], 1.0)


def test_other_packages(surface, ball, tree, model):
    pandas = pytest.importorskip("pandas")
    table = ostia.convert.to_pandas(tree)
    assert list(table.columns) == ["vessel", "x", "y", "z", "radius_mm", "s_mm"] and len(table) == 161
    assert isinstance(ostia.convert.to_pandas(ostia.lumen_profile(model, 1)), pandas.DataFrame)
    assert ostia.convert.to_pandas(ostia.find_stenoses(model, 1)).cad_rads.tolist() == ["3"]
    with pytest.raises(ostia.UsageError):
        ostia.convert.to_pandas(surface)


def test_vtk(surface, ball):
    pytest.importorskip("vtkmodules.vtkCommonDataModel")
    polydata = ostia.convert.to_vtk(surface)
    assert polydata.GetNumberOfCells() == len(surface.triangles)
    again = ostia.convert.from_vtk(polydata)
    assert again.points.__array_interface__["data"] [0] == surface.points.__array_interface__["data"][0]
    np.testing.assert_array_equal(again.triangles, surface.triangles)
    image = ostia.convert.from_vtk(ostia.convert.to_vtk(ball))
    np.testing.assert_array_equal(image.array, ball.array)
    assert image.spacing == ball.spacing and image.origin == ball.origin


def test_copies_from_vtk_can_be_forbidden(surface):
    pytest.importorskip("vtkmodules.vtkCommonDataModel")
    with pytest.raises(ostia.InvalidInput, match="triangles: .* would have to be copied"):
        ostia.convert.from_vtk(ostia.convert.to_vtk(surface), copy=False)


def test_a_view_of_simpleitks_keeps_its_image_alive(monkeypatch):
    """In the manner of SimpleITK, whose views do not: the memory ends with the image."""

    class Image:
        def __init__(self):
            self.memory = np.arange(24, dtype=np.int16).reshape(2, 3, 4)

        GetDimension = staticmethod(lambda: 3)
        GetDirection = staticmethod(lambda: np.eye(3).ravel())
        GetSpacing = staticmethod(lambda: (0.5, 0.5, 1.0))
        GetOrigin = staticmethod(lambda: (1.0, 2.0, 3.0))

    class Borrowed:
        def __init__(self, image):
            self.__array_interface__ = image.memory.__array_interface__

    module = types.ModuleType("SimpleITK")
    module.GetArrayViewFromImage = lambda image: np.asarray(Borrowed(image))
    monkeypatch.setitem(sys.modules, "SimpleITK", module)
    image = Image()
    watch, address = weakref.ref(image), image.memory.__array_interface__["data"][0]
    array = ostia.convert.from_sitk(image, copy=False).array
    del image
    gc.collect()
    assert watch() is not None and array.__array_interface__["data"][0] == address and array[1, 2, 3] == 23
    del array
    gc.collect()
    assert watch() is None


def test_meshio(surface):
    pytest.importorskip("meshio")
    mesh = ostia.convert.to_meshio(surface)
    again = ostia.convert.from_meshio(mesh)
    np.testing.assert_array_equal(again.points, surface.points)
    np.testing.assert_array_equal(again.triangles, surface.triangles)
