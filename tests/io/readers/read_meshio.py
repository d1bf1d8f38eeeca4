"""Reads meshes with meshio and writes their measures. Usage: read_meshio.py FORMAT PATH OUT [PATH OUT]..."""
import re

import meshio
import numpy as np
from measure import Found, main

VTK_TETRA = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]
VTK_WEDGE = [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)]
# meshio turns Gmsh's 10-node tetrahedron into VTK's order, but leaves the 18-node prism as Gmsh has it.
GMSH_WEDGE = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 4), (2, 5), (3, 4), (3, 5), (4, 5), (0, 1, 4, 3), (0, 2, 5, 3), (1, 2, 5, 4)]
KINDS = {"tetra": "tetra", "tetra10": "tetra", "wedge": "wedge", "wedge18": "wedge",
         "triangle": "triangle", "triangle6": "triangle", "quad": "quad", "quad9": "quad"}
# Abaqus Analysis User's Guide, "Element Library": corners of the sides S1, S2, ...
ABAQUS_SIDES = {"tetra": [(0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)],
                "wedge": [(0, 1, 2), (3, 5, 4), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)]}
ABAQUS_EDGES = dict(zip(VTK_TETRA, range(4, 10)))


def tagged(mesh, tags, found):
    """Cells and facets by their tags; names from the field data."""
    names = {int(number): name for name, (number, dimension) in mesh.field_data.items() if dimension == 2}
    for block, ids in zip(mesh.cells, tags):
        kind = KINDS[block.type]
        if kind in ("tetra", "wedge"):
            found.add_cells(kind, block.data)
            continue
        for number in np.unique(ids):
            found.add_face(names[int(number)], int(number), kind, block.data[ids == number])


def gmsh(path):
    mesh = meshio.read(path, file_format="gmsh")
    found = Found(mesh.points, {"tetra": VTK_TETRA, "wedge": GMSH_WEDGE})
    tagged(mesh, mesh.cell_data["gmsh:physical"], found)
    return found


def xdmf(path):
    volume, facets = (meshio.read(f"{path}/{name}.xdmf") for name in ("mesh", "facets"))
    assert np.array_equal(volume.points, facets.points)
    found = Found(volume.points, {"tetra": VTK_TETRA, "wedge": VTK_WEDGE}, sense=-1)
    assert all((ids == 0).all() for ids in volume.cell_data["CellEntityIds"])
    tagged(volume, volume.cell_data["CellEntityIds"], found)
    tagged(facets, facets.cell_data["CellEntityIds"], found)
    return found


def edge_node(cell, a, b):
    return cell[ABAQUS_EDGES[(a, b) if (a, b) in ABAQUS_EDGES else (b, a)]]


def outward(kind, cell, side):
    """The side's facet, as its corners run outward, with the nodes on its edges."""
    corners = list(ABAQUS_SIDES[kind][side])
    if kind == "tetra" and side == 0 or kind == "wedge" and side < 2:
        corners.reverse()  # the manual lists these as seen from inside
    if kind == "tetra" and side > 0:
        corners = {1: [0, 1, 3], 2: [1, 2, 3], 3: [2, 0, 3]}[side]
    nodes = [cell[c] for c in corners]
    if len(cell) == 10:
        nodes += [edge_node(cell, corners[i], corners[(i + 1) % 3]) for i in range(3)]
    return nodes


def abaqus(path):
    mesh = meshio.read(path)
    found = Found(mesh.points, {"tetra": VTK_TETRA})
    for block in mesh.cells:
        found.add_cells(KINDS[block.type], block.data)
    text = open(path, encoding="utf-8").read()
    for name, body in re.findall(r"\*SURFACE, TYPE=ELEMENT, NAME=(\S+)\n((?:[^*\n].*\n)+)", text):
        nodes = set()
        for elements, side in re.findall(r"(\S+), S(\d)", body):
            for block, members in zip(mesh.cells, mesh.cell_sets[elements]):
                kind = KINDS[block.type]
                facets = [outward(kind, block.data[m], int(side) - 1) for m in members]
                for facet in facets:
                    nodes.update(facet)
                    found.add_face(name, 0, "quad" if len(facet) == 4 else "triangle", [facet])
        assert nodes == set(mesh.point_sets[name]), f"the node set of {name} is not its surface's"
    return found


if __name__ == "__main__":
    main({"gmsh2": gmsh, "gmsh4": gmsh, "xdmf": xdmf, "abaqus": abaqus})
