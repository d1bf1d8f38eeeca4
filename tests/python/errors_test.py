"""Errors are a small tree, and Python's own classes catch them."""
import pickle

import numpy as np
import pytest

import ostia


@pytest.mark.parametrize("kind, own, code", [
    ("UsageError", TypeError, 2), ("InvalidInput", ValueError, 3), ("IoError", OSError, 3), ("GeometryError", ValueError, 3),
    ("NumericalError", ArithmeticError, 6), ("ResourceError", MemoryError, 5), ("Cancelled", ostia.Error, 130),
])
def test_the_tree(kind, own, code):
    error = getattr(ostia, kind)
    assert issubclass(error, ostia.Error) and issubclass(error, own) and error.exit_code == code
    assert str(pickle.loads(pickle.dumps(error("why")))) == "why"


def test_files(tmp_path):
    with pytest.raises(ostia.IoError, match="none.stl"):
        ostia.read_surface(tmp_path / "none.stl")
    (tmp_path / "bad.nrrd").write_bytes(b"NRRD0004\ntype: short\n")
    with pytest.raises(ostia.InvalidInput, match="bad.nrrd"):
        ostia.read_image(tmp_path / "bad.nrrd")
    with pytest.raises(ostia.InvalidInput):
        ostia.export_mesh(tmp_path / "a.vtu", _one_tetrahedron(), "no-format")


def _one_tetrahedron():
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
    sides = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]], np.int32)
    mesh = ostia.TriMesh(points, sides)
    faced = ostia.FacedSurface(mesh, np.ones(4, np.int32), [ostia.Face(1, "wall")])
    return ostia.tetrahedralize(faced).mixed()


def test_geometry(surface):
    with pytest.raises(ostia.GeometryError, match="outside|inside"):
        ostia.extract_centerlines(surface, (500, 0, 0), [(0, 0, 0)])


def test_another_type_of_value(surface, ball):
    with pytest.raises(TypeError):
        ostia.extract_centerlines(surface.points)
    with pytest.raises(ostia.InvalidInput, match="image: a Volume of uint8; it must be of int16"):
        ostia.segment_vessels(ball, [[(0, 0, 0), (1, 0, 0)]])
    with pytest.raises(ostia.UsageError, match="LumenModel or a VesselTree"):
        ostia.pressure(3)
