"""Reads HDF5-based meshes by their formats' manuals, with h5py alone.

Usage: read_hdf5.py FORMAT PATH OUT [PATH OUT]...
"""
from xml.etree import ElementTree

import h5py
import numpy as np
from measure import Found, main

TETRA = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]
# SIDS: a PENTA_18 has its mid-edge nodes on 12 23 31, 14 25 36, 45 56 64, then 1254, 2365, 3146.
CGNS_WEDGE = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 4), (2, 5), (3, 4), (4, 5), (5, 3), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)]
CGNS_TYPES = {5: ("triangle", 3), 6: ("triangle", 6), 7: ("quad", 4), 9: ("quad", 9), 10: ("tetra", 4), 11: ("tetra", 10),
              14: ("wedge", 6), 16: ("wedge", 18)}
CGNS_CONDITIONS = {b"BCWall", b"BCInflow", b"BCOutflow"}

# XDMF's numbers and VTK's orders.
XDMF_WEDGE = [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)]
XDMF_TYPES = {4: ("triangle", 3), 36: ("triangle", 6), 5: ("quad", 4), 35: ("quad", 9), 6: ("tetra", 4), 38: ("tetra", 10),
              8: ("wedge", 6), 41: ("wedge", 18)}
XDMF_NAMES = {"Triangle": 4, "Triangle_6": 36, "Quadrilateral": 5, "Quadrilateral_9": 35, "Tetrahedron": 6,
              "Tetrahedron_10": 38, "Wedge": 8, "Wedge_18": 41}


def split_mixed(types, numbers):
    """(kind, nodes) of each element of a list that names the type before each element's nodes."""
    out, at = [], 0
    while at < len(numbers):
        kind, n = types[numbers[at]]
        out.append((kind, numbers[at + 1:at + 1 + n]))
        at += 1 + n
    return out


def children(node, label):
    return [child for child in node.values() if child.attrs.get("label", b"") == label]


def data(node):
    return node[" data"][()]


def string(node):
    return bytes(np.asarray(data(node)).astype(np.uint8)).strip(b"\0 ")


def cgns(path):
    file = h5py.File(path, "r")
    (base,) = children(file, b"CGNSBase_t")
    (zone,) = children(base, b"Zone_t")
    (grid,) = children(zone, b"GridCoordinates_t")
    found = Found(np.stack([data(grid["Coordinate" + a]) for a in "XYZ"], axis=1),
                  {"tetra": TETRA, "wedge": CGNS_WEDGE})
    assert data(zone)[:, 0].tolist()[0] == len(found.points)
    elements = {}
    for section in children(zone, b"Elements_t"):
        kind = int(data(section)[0])
        first, last = data(section["ElementRange"])
        numbers = data(section["ElementConnectivity"])
        listed = [(CGNS_TYPES[kind][0], nodes) for nodes in numbers.reshape(-1, CGNS_TYPES[kind][1])]
        assert len(listed) == last - first + 1
        elements.update(zip(range(first, last + 1), listed))
        for kind in ("tetra", "wedge"):
            found.add_cells(kind, [nodes - 1 for k, nodes in listed if k == kind])
    (conditions,) = children(zone, b"ZoneBC_t")
    for condition in children(conditions, b"BC_t"):
        name = condition.attrs["name"].decode()
        assert string(condition) in CGNS_CONDITIONS
        assert string(condition["GridLocation"]) == b"FaceCenter"
        first, last = data(condition["PointRange"]).ravel()
        for kind in ("triangle", "quad"):
            found.add_face(name, int(string(condition["CellEntityIds"])), kind,
                           [elements[e][1] - 1 for e in range(first, last + 1) if elements[e][0] == kind])
    return found


def xdmf(path):
    found, points = None, None
    for name in ("mesh", "facets"):
        grid = ElementTree.parse(f"{path}/{name}.xdmf").getroot().find("Domain/Grid")

        def item(element):
            file, inside = element.find("DataItem").text.split(":")
            values = h5py.File(f"{path}/{file}", "r")[inside][()]
            assert list(values.shape) == [int(d) for d in element.find("DataItem").get("Dimensions").split()]
            return values

        points = item(grid.find("Geometry"))
        found = found or Found(points, {"tetra": TETRA, "wedge": XDMF_WEDGE}, sense=-1)
        topology = grid.find("Topology")
        kind = topology.get("TopologyType")
        numbers = item(topology)
        listed = (split_mixed(XDMF_TYPES, numbers) if kind == "Mixed" else
                  [(XDMF_TYPES[XDMF_NAMES[kind]][0], nodes) for nodes in numbers])
        assert len(listed) == int(topology.get("NumberOfElements"))
        tags = item(grid.find("Attribute"))
        names = {int(m.text): m.get("key") for m in ElementTree.fromstring(grid.find("Information").text)}
        for number in np.unique(tags):
            for kind in ("tetra", "wedge", "triangle", "quad"):
                nodes = [n for (k, n), tag in zip(listed, tags) if k == kind and tag == number]
                if kind in ("tetra", "wedge"):
                    found.add_cells(kind, nodes)
                elif name == "facets":
                    found.add_face(names[int(number)], int(number), kind, nodes)
    return found


if __name__ == "__main__":
    main({"cgns": cgns, "xdmf": xdmf})
