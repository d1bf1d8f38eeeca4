"""To and from the objects of other packages. None of them is needed before it is asked for: they are known by their methods."""

from __future__ import annotations

from typing import Any, Mapping

import numpy as np

import ostia


def _module(name: str, how: str) -> Any:
    try:
        return __import__(name, fromlist=["_"])
    except ImportError as error:
        raise ostia.UsageError(f"{name} is not there; install it: {how}") from error


class _Seen:
    """The memory of an array that does not keep its owner alive, for one that does: numpy.asarray(_Seen(array, owner))."""

    def __init__(self, array: Any, owner: Any) -> None:
        self.__array_interface__ = array.__array_interface__
        self.owner = owner


def from_sitk(image: Any, copy: bool | None = None) -> ostia.Volume:
    """A Volume of a SimpleITK image of three dimensions and one component. It keeps the image alive."""
    if image.GetDimension() != 3:
        raise ostia.InvalidInput(f"image: of {image.GetDimension()} dimensions; a Volume has three")
    module = _module("SimpleITK", "pip install SimpleITK")
    direction = np.asarray(image.GetDirection(), dtype=float).reshape(3, 3)
    # SimpleITK's view is good for as long as the image alone.
    array = np.asarray(_Seen(module.GetArrayViewFromImage(image), image))
    return ostia.Volume(array, spacing=image.GetSpacing(), origin=image.GetOrigin(), direction=direction, copy=copy)


def to_sitk(volume: ostia.Volume) -> Any:
    """A SimpleITK image of a Volume. SimpleITK copies the voxels."""
    image = _module("SimpleITK", "pip install SimpleITK").GetImageFromArray(volume.array)
    image.SetSpacing(volume.spacing)
    image.SetOrigin(volume.origin)
    image.SetDirection(volume.direction.ravel().tolist())
    return image


def from_vtk(data: Any, copy: bool | None = None) -> ostia.TriMesh | ostia.Volume:
    """A TriMesh of a vtkPolyData of triangles, or a Volume of a vtkImageData. Places and voxels are shared where they have the
    type; VTK's cells, of 64 bits, are copied, which copy=False refuses."""
    support = _module("vtkmodules.util.numpy_support", "apt install python3-vtk9")
    if data.IsA("vtkImageData"):
        array = support.vtk_to_numpy(data.GetPointData().GetScalars()).reshape(data.GetDimensions()[::-1])
        matrix = data.GetDirectionMatrix()
        direction = [[matrix.GetElement(i, j) for j in range(3)] for i in range(3)]
        return ostia.Volume(array, spacing=data.GetSpacing(), origin=data.GetOrigin(), direction=direction, copy=copy)
    points = support.vtk_to_numpy(data.GetPoints().GetData())
    cells = support.vtk_to_numpy(data.GetPolys().GetConnectivityArray())
    sizes = np.diff(support.vtk_to_numpy(data.GetPolys().GetOffsetsArray()))
    if len(sizes) and not (sizes == 3).all():
        raise ostia.InvalidInput("data: it has polygons of more than three corners; pass it through vtkTriangleFilter first")
    return ostia.TriMesh(points, cells.reshape(-1, 3), copy=copy)


def to_vtk(value: ostia.TriMesh | ostia.Volume) -> Any:
    """A vtkPolyData of a TriMesh, a vtkImageData of a Volume; places and voxels are shared, not copied."""
    support = _module("vtkmodules.util.numpy_support", "apt install python3-vtk9")
    model = _module("vtkmodules.vtkCommonDataModel", "apt install python3-vtk9")
    core = _module("vtkmodules.vtkCommonCore", "apt install python3-vtk9")
    if isinstance(value, ostia.Volume):
        image = model.vtkImageData()
        image.SetDimensions(value.size)
        image.SetSpacing(value.spacing)
        image.SetOrigin(value.origin)
        image.SetDirectionMatrix(*value.direction.ravel())
        image.GetPointData().SetScalars(support.numpy_to_vtk(value.array.ravel()))
        return image
    if not isinstance(value, ostia.TriMesh):
        raise ostia.UsageError(f"value: a TriMesh or a Volume, not {type(value).__name__}")
    points = core.vtkPoints()
    points.SetData(support.numpy_to_vtk(value.points))
    polygons = model.vtkCellArray()
    offsets = np.arange(0, 3 * len(value.triangles) + 1, 3, dtype=np.int64)
    ids = value.triangles.ravel().astype(np.int64)
    polygons.SetData(support.numpy_to_vtkIdTypeArray(offsets, deep=1), support.numpy_to_vtkIdTypeArray(ids, deep=1))
    surface = model.vtkPolyData()
    surface.SetPoints(points)
    surface.SetPolys(polygons)
    return surface


def to_meshio(mesh: Any) -> Any:
    """A meshio.Mesh of a TriMesh, a FacedSurface, a VolumeMesh or a MixedMesh; faces' ids as `face_id`."""
    module = _module("meshio", "apt install python3-meshio")
    if isinstance(mesh, ostia.TriMesh):
        return module.Mesh(mesh.points, [("triangle", mesh.triangles)])
    if isinstance(mesh, ostia.FacedSurface):
        return module.Mesh(mesh.mesh.points, [("triangle", mesh.mesh.triangles)], cell_data={"face_id": [mesh.face_ids]})
    if isinstance(mesh, ostia.VolumeMesh):
        mesh = mesh.mixed()
    if mesh.quadratic:
        raise ostia.InvalidInput("mesh: of quadratic elements; write it with ostia.export_mesh and read that")
    # VTK's wedge, meshio's too, has the opposite sense of a Prism.
    blocks = [("tetra", mesh.tetrahedra), ("wedge", mesh.prisms[:, [3, 4, 5, 0, 1, 2]]), ("triangle", mesh.triangles), ("quad", mesh.quads)]
    ids = [np.zeros(len(mesh.tetrahedra), np.int32), np.zeros(len(mesh.prisms), np.int32), mesh.triangle_face_ids, mesh.quad_face_ids]
    kept = [i for i, (_, cells) in enumerate(blocks) if len(cells)]
    return module.Mesh(mesh.points, [blocks[i] for i in kept], cell_data={"face_id": [ids[i] for i in kept]})


def from_meshio(mesh: Any, copy: bool | None = None) -> ostia.TriMesh:
    """A TriMesh of the triangles of a meshio.Mesh; several blocks of them are put into one array."""
    blocks = [block.data for block in mesh.cells if block.type == "triangle"]
    if not blocks:
        raise ostia.InvalidInput("mesh: it has no triangles; it has " + (", ".join(sorted({b.type for b in mesh.cells})) or "no cells"))
    return ostia.TriMesh(mesh.points, blocks[0] if len(blocks) == 1 else np.concatenate(blocks), copy=copy)


def to_pandas(value: Any) -> Any:
    """A table of a LumenProfile (a row a section), of a list of Stenosis (a row each), of a VesselTree or a Centerline (a row a
    point; x, y, z in mm, LPS). Other columns have their unit in their name."""
    pandas = _module("pandas", "apt install python3-pandas")
    if isinstance(value, ostia.LumenProfile):
        names = ["s_mm", "found", "area_mm2", "perimeter_mm", "diameter_mm", "least_diameter_mm", "largest_diameter_mm"]
        return pandas.DataFrame({name: getattr(value, name) for name in names})
    if isinstance(value, ostia.Centerline):
        return pandas.DataFrame(_columns(value))
    if isinstance(value, ostia.VesselTree):
        tables = [pandas.DataFrame({"vessel": vessel.name, **_columns(value.axis(vessel.id))}) for vessel in value.vessels]
        return pandas.concat(tables, ignore_index=True)
    if isinstance(value, (list, tuple)) and all(isinstance(one, ostia.Stenosis) for one in value):
        names = ["vessel", "from_mm", "to_mm", "throat_mm", "length_mm", "least_diameter_mm", "least_area_mm2",
                 "reference_diameter_mm", "diameter_percent", "area_percent", "cad_rads"]
        return pandas.DataFrame({name: [getattr(one, name) for one in value] for name in names})
    raise ostia.UsageError(f"value: a LumenProfile, a VesselTree, a Centerline or a list of Stenosis, not {type(value).__name__}")


def _columns(line: Any) -> Mapping[str, Any]:
    x, y, z = line.points.T
    return {"x": x, "y": y, "z": z, "radius_mm": line.radius, "s_mm": line.abscissa}


__all__ = ["from_sitk", "to_sitk", "from_vtk", "to_vtk", "from_meshio", "to_meshio", "to_pandas"]
