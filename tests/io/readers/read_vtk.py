"""Reads meshes with VTK's readers and writes their measures. Usage: read_vtk.py FORMAT PATH OUT [PATH OUT]..."""
import pathlib
import re

import numpy as np
import vtk
from measure import Found, main
from vtk.util.numpy_support import vtk_to_numpy

TETRA = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]
WEDGE = [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)]
ORDERS = {"tetra": TETRA, "wedge": WEDGE}
KINDS = {vtk.VTK_TETRA: "tetra", vtk.VTK_QUADRATIC_TETRA: "tetra", vtk.VTK_WEDGE: "wedge",
         vtk.VTK_BIQUADRATIC_QUADRATIC_WEDGE: "wedge", vtk.VTK_TRIANGLE: "triangle",
         vtk.VTK_QUADRATIC_TRIANGLE: "triangle", vtk.VTK_QUAD: "quad", vtk.VTK_BIQUADRATIC_QUAD: "quad"}


def read(reader, path):
    reader.SetFileName(str(path))
    reader.Update()
    assert reader.GetErrorCode() == 0, vtk.vtkErrorCode.GetStringFromErrorCode(reader.GetErrorCode())
    return reader.GetOutput()


def cells_of(data):
    """(kind, nodes, cell numbers), one for each cell type."""
    groups = {}
    ids = vtk.vtkIdList()
    for c in range(data.GetNumberOfCells()):
        data.GetCellPoints(c, ids)
        nodes, numbers = groups.setdefault(data.GetCellType(c), ([], []))
        nodes.append([ids.GetId(i) for i in range(ids.GetNumberOfIds())])
        numbers.append(c)
    return [(KINDS[t], np.array(nodes), np.array(numbers)) for t, (nodes, numbers) in groups.items()]


def points_of(data):
    return vtk_to_numpy(data.GetPoints().GetData())


def array(attributes, name):
    return vtk_to_numpy(attributes.GetArray(name))


class Pieces:
    """Gathers data sets that have points of their own."""

    def __init__(self, scale=1.0, sense=-1):
        self.points, self.count = [], 0
        self.found = Found(np.zeros((0, 3)), ORDERS, sense)
        self.scale = scale

    def add(self, data):
        first = self.count
        self.points.append(points_of(data).astype(float) * self.scale)
        self.count += len(self.points[-1])
        return [(kind, nodes + first, numbers) for kind, nodes, numbers in cells_of(data)]

    def add_volume(self, data):
        for kind, nodes, _ in self.add(data):
            self.found.add_cells(kind, nodes)

    def add_face(self, name, number, data):
        for kind, nodes, _ in self.add(data):
            self.found.add_face(name, number, kind, nodes)

    def done(self):
        self.found.points = np.concatenate(self.points)
        return self.found


def vtu(path):
    grid = read(vtk.vtkXMLUnstructuredGridReader(), path)
    fields = grid.GetFieldData()
    names = fields.GetAbstractArray("FaceNames")
    names = {int(n): names.GetValue(i) for i, n in enumerate(array(fields, "FaceIds"))}
    assert (fields.GetAbstractArray("Axes").GetValue(0), fields.GetAbstractArray("Unit").GetValue(0)) == ("LPS", "mm")
    ids = array(grid.GetCellData(), "CellEntityIds")
    found = Found(points_of(grid), ORDERS, -1)
    for kind, nodes, numbers in cells_of(grid):
        if kind in ("tetra", "wedge"):
            assert (ids[numbers] == 0).all()
            found.add_cells(kind, nodes)
            continue
        for number in np.unique(ids[numbers]):
            found.add_face(names[int(number)], int(number), kind, nodes[ids[numbers] == number])
    return found


def stl(path):
    pieces = Pieces()
    for file in sorted(pathlib.Path(path).iterdir()):
        reader = vtk.vtkSTLReader()
        reader.MergingOff()
        pieces.add_face(file.stem, 0, read(reader, file))
    return pieces.done()


def mesh_complete(path):
    path = pathlib.Path(path)
    grid = read(vtk.vtkXMLUnstructuredGridReader(), path / "mesh-complete.mesh.vtu")
    points, cells = points_of(grid), cells_of(grid)
    assert len(cells) == 1, "one cell type"
    assert np.array_equal(array(grid.GetPointData(), "GlobalNodeID"), np.arange(1, len(points) + 1))
    assert np.array_equal(array(grid.GetCellData(), "GlobalElementID"), np.arange(1, grid.GetNumberOfCells() + 1))
    assert (array(grid.GetCellData(), "ModelRegionID") == 1).all()
    tetrahedra = cells[0][1]
    found = Found(points, ORDERS)
    found.add_cells("tetra", tetrahedra)

    def global_triangles(file):
        data = read(vtk.vtkXMLPolyDataReader(), file)
        for attributes, name in ((data.GetPointData(), "GlobalNodeID"), (data.GetCellData(), "GlobalElementID"),
                                 (data.GetCellData(), "ModelFaceID")):
            assert attributes.GetArray(name).GetDataTypeAsString() == "int", name
        nodes = array(data.GetPointData(), "GlobalNodeID") - 1
        assert np.array_equal(points_of(data), points[nodes]), file
        (kind, corners, _), = cells_of(data)
        triangles = nodes[corners]
        parents = array(data.GetCellData(), "GlobalElementID") - 1
        for triangle, parent in zip(triangles, parents):
            assert set(triangle) <= set(tetrahedra[parent]), f"{file}: element {parent} is not the parent"
        return triangles, array(data.GetCellData(), "ModelFaceID")

    every = []
    for file in sorted((path / "mesh-surfaces").iterdir()):
        triangles, ids = global_triangles(file)
        assert len(set(ids)) == 1
        found.add_face(file.stem, int(ids[0]), "triangle", triangles)
        every += [(*t, i) for t, i in zip(triangles.tolist(), ids.tolist())]
    triangles, ids = global_triangles(path / "mesh-complete.exterior.vtp")
    assert sorted(every) == sorted((*t, i) for t, i in zip(triangles.tolist(), ids.tolist()))
    walls, _ = global_triangles(path / "walls_combined.vtp")
    assert sorted(walls.tolist()) == sorted(found.faces["wall"]["triangle"][0].tolist())
    return found


def openfoam(path, scale=1000.0):
    """In mm. VTK's reader makes wedges of either sense: which is right is checkMesh's to say."""
    marker = pathlib.Path(path) / "case.foam"
    marker.touch()
    reader = vtk.vtkOpenFOAMReader()
    reader.SetFileName(str(marker))
    reader.UpdateInformation()
    reader.EnableAllPatchArrays()
    reader.Update()
    pieces = Pieces(scale)

    def visit(blocks, inside_patches):
        for b in range(blocks.GetNumberOfBlocks()):
            block, name = blocks.GetBlock(b), blocks.GetMetaData(b).Get(vtk.vtkCompositeDataSet.NAME())
            if block is None:
                continue
            if block.IsA("vtkMultiBlockDataSet"):
                visit(block, True)
            elif name == "internalMesh":
                pieces.add_volume(block)
            elif inside_patches:
                pieces.add_face(name, 0, block)

    visit(reader.GetOutput(), False)
    return pieces.done()


def fluent(path):
    """Cells from VTK's reader; of the faces, only the names and numbers of their zones are in its reach."""
    blocks = read(vtk.vtkFLUENTReader(), path)
    pieces = Pieces(sense=1)  # this reader makes wedges that run against VTK's own rule
    for b in range(blocks.GetNumberOfBlocks()):
        if blocks.GetBlock(b) is not None:
            pieces.add_volume(blocks.GetBlock(b))
    text = open(path, encoding="utf-8").read()
    for number, kind, name in re.findall(r"\(45 \((\d+) (\S+) (\S+)\)\(\)\)", text):
        if kind not in ("fluid", "interior"):
            pieces.found.add_face(name, int(number), "triangle", [])
    return pieces.done()


def exodus(path):
    reader = vtk.vtkExodusIIReader()
    reader.SetFileName(str(path))
    reader.UpdateInformation()
    ids = {}
    for i in range(reader.GetNumberOfSideSetArrays()):
        name = reader.GetSideSetArrayName(i)
        reader.SetSideSetArrayStatus(name, 1)
        ids[name] = reader.GetObjectId(vtk.vtkExodusIIReader.SIDE_SET, i)
    reader.Update()
    output = reader.GetOutput()
    pieces = Pieces(sense=1)  # this reader leaves wedges as the file has them
    for part in range(output.GetNumberOfBlocks()):
        group, kind = output.GetBlock(part), output.GetMetaData(part).Get(vtk.vtkCompositeDataSet.NAME())
        for b in range(group.GetNumberOfBlocks() if group else 0):
            block = group.GetBlock(b)
            if block is None:
                continue
            name = group.GetMetaData(b).Get(vtk.vtkCompositeDataSet.NAME())
            if kind == "Element Blocks":
                pieces.add_volume(block)
            elif kind == "Side Sets":
                pieces.add_face(name, ids[name], block)
    return pieces.done()


def cgns(path):
    reader = vtk.vtkCGNSReader()
    reader.SetFileName(str(path))
    reader.UpdateInformation()
    reader.EnableAllBases()
    reader.LoadBndPatchOff()
    reader.Update()
    zone = reader.GetOutput().GetBlock(0).GetBlock(0)
    pieces = Pieces(sense=1)  # this reader leaves wedges as the file has them
    pieces.add_volume(zone)
    return pieces.done()


if __name__ == "__main__":
    main({"vtu": vtu, "stl": stl, "mesh-complete": mesh_complete, "openfoam": openfoam, "openfoam-mm": lambda path: openfoam(path, 1.0), "fluent": fluent,
               "exodus": exodus, "cgns": cgns})
