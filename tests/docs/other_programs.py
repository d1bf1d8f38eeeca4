"""Files as other programs write them: SimVascular's capped and labelled surface in centimetres, VTK's legacy lines, GXL,
an electrocardiogram of PhysioNet, a ball; and a binary STL moved. With the standard library alone.
"""
import json
import math
import struct

import small_files

TREE = ((small_files.TRUNK_START, 3.0), (small_files.FORK, 2.6), (small_files.TRUNK_END, 2.2), (small_files.BRANCH_END, 1.8))
PIECES = ((0, 1), (1, 2), (1, 3))


def write_vtk_tree_in_metres(path):
    """Legacy VTK as growing programs write it: places in metres, radii in mm."""
    points = "\n".join(" ".join(f"{x / 1000:.7f}" for x in p) for p, _ in TREE)
    lines = "\n".join(f"2 {a} {b}" for a, b in PIECES)
    radii = "\n".join(str(TREE[b][1]) for _, b in PIECES)
    path.write_text(f"# vtk DataFile Version 3.0\ngrown\nASCII\nDATASET POLYDATA\nPOINTS {len(TREE)} float\n{points}\n"
                    f"LINES {len(PIECES)} {3 * len(PIECES)}\n{lines}\nCELL_DATA {len(PIECES)}\nSCALARS radius float 1\n"
                    f"LOOKUP_TABLE default\n{radii}\n")


def write_gxl(path):
    nodes = "".join(f'<node id="n{n}"><attr name=" position"><tup>' + "".join(f"<float>{x}</float>" for x in p)
                    + "</tup></attr></node>" for n, (p, _) in enumerate(TREE))
    edges = "".join(f'<edge id="e{n}" from="n{a}" to="n{b}"><attr name=" radius"><float>{TREE[b][1]}</float></attr></edge>'
                    for n, (a, b) in enumerate(PIECES))
    path.write_text(f'<?xml version="1.0"?><gxl><graph id="G">{nodes}{edges}</graph></gxl>')


def _stl(path, triangles):
    path.write_bytes(b"\0" * 80 + struct.pack("<I", len(triangles))
                     + b"".join(struct.pack("<12fH", 0, 0, 0, *(x for p in t for x in p), 0) for t in triangles))


def write_ball(path, centre, radius, n=16):
    at = lambda i, j: tuple(c + radius * x for c, x in zip(centre, (
        math.sin(math.pi * i / n) * math.cos(2 * math.pi * (j % n) / n),
        math.sin(math.pi * i / n) * math.sin(2 * math.pi * (j % n) / n), math.cos(math.pi * i / n))))
    triangles = []
    for i in range(n):
        for j in range(n):
            a, b, c, d = at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)
            triangles += ([(a, b, c)] if i < n - 1 else []) + ([(a, c, d)] if i > 0 else [])
    _stl(path, triangles)


def move_stl(surface, path, move):
    """A binary STL with each point moved."""
    count = struct.unpack_from("<I", surface, 80)[0]
    moved = []
    for n in range(count):
        values = struct.unpack_from("<12f", surface, 84 + 50 * n)
        moved.append(tuple(move(values[k:k + 3]) for k in (3, 6, 9)))
    _stl(path, moved)


def write_ecg(path):
    """Record 100 with a beat each 0.8 s: header and signal lie side by side."""
    rate, seconds, period = 360, 20, 0.8
    samples = []
    for n in range(rate * seconds):
        beat = (n / rate) % period
        samples.append(round(1000 * math.exp(-((beat - 0.3) / 0.012) ** 2) + 150 * math.exp(-((beat - 0.55) / 0.04) ** 2)))
    path.with_name("100.hea").write_text(f"100 1 {rate} {len(samples)}\n100.dat 16 1000/mV 16 0 {samples[0]} 0 0 MLII\n")
    path.with_name("100.dat").write_bytes(struct.pack(f"<{len(samples)}h", *samples))


def write_moving_points(path):
    """Places of the same points phase by phase, as `ostia evaluate motion` reads them."""
    phases = [{"percent": 25 * n, "points": [[x + 0.5 * n, y, z] for (x, y, z), _ in TREE]} for n in range(4)]
    path.write_text(json.dumps({"v": 1, "unit": "mm", "axes": "LPS", "phases": phases}))


ENDS = (small_files.TRUNK_START, small_files.TRUNK_END, small_files.BRANCH_END)


def _triangles(stl):
    """Points, joined, and triangles of them, each with 0 or the number of the end, from 1, whose cap it is part of."""
    places, points, triangles = {}, [], []
    for n in range(struct.unpack_from("<I", stl, 80)[0]):
        values = struct.unpack_from("<12f", stl, 84 + 50 * n)
        triangles.append([places.setdefault(values[k:k + 3], len(places)) for k in (3, 6, 9)])
    points = list(places)
    directions = [[p - q for p, q in zip(end, small_files.FORK)] for end in ENDS]
    labels = []
    for triangle in triangles:
        on = 0
        for number, (end, way) in enumerate(zip(ENDS, directions), 1):
            along = [sum((x - e) * d for x, e, d in zip(points[i], end, way)) / math.hypot(*way) for i in triangle]
            near = max(math.dist(points[i], end) for i in triangle) < 4
            on = number if near and min(along) > -0.05 else on
        labels.append(on)
    return points, triangles, labels


def write_open_stl(path, stl):
    """The wall without its caps, as VMTK's surfaces are."""
    points, triangles, labels = _triangles(stl)
    _stl(path, [tuple(points[i] for i in triangle) for triangle, label in zip(triangles, labels) if not label])


def _vtp(path, points, kind, cells, array, scale=1.0):
    """VTK's XML in text, with one array of its points or cells: (where, type, name, values)."""
    numbers = lambda values: " ".join(f"{value:.7g}" for value in values)
    ends = [sum(len(cell) for cell in cells[:n]) for n in range(1, len(cells) + 1)] if len(cells) < 9 else range(3, 3 * len(cells) + 1, 3)
    where, number, name, values = array
    path.write_text(
        '<?xml version="1.0"?>\n<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian"><PolyData>\n'
        f'<Piece NumberOfPoints="{len(points)}" NumberOf{kind}="{len(cells)}">\n'
        f'<{where}><DataArray type="{number}" Name="{name}" format="ascii">{numbers(values)}</DataArray></{where}>\n'
        f'<Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">{numbers(scale * x for p in points for x in p)}</DataArray></Points>\n'
        f'<{kind}><DataArray type="Int32" Name="connectivity" format="ascii">{numbers(i for cell in cells for i in cell)}</DataArray>\n'
        f'<DataArray type="Int32" Name="offsets" format="ascii">{numbers(ends)}</DataArray></{kind}>\n'
        '</Piece></PolyData></VTKFile>\n')


def write_simvascular_model(path, stl):
    """A capped solid as SimVascular exports it: centimetres, and the face that each triangle is of in ModelFaceID."""
    points, triangles, labels = _triangles(stl)
    _vtp(path, points, "Polys", triangles, ("CellData", "Int32", "ModelFaceID", [label + 1 for label in labels]), scale=0.1)


def write_vmtk_centerlines(path):
    """Lines from one source to two ends, each whole, as vmtkcenterlines writes them."""
    points, radii, lines = [], [], []
    for way in ((0, 1, 2), (0, 1, 3)):
        line = []
        for a, b in zip(way, way[1:]):
            (p, r), (q, s) = TREE[a], TREE[b]
            steps = int(math.dist(p, q) / 0.5)
            for n in range(steps + (b == way[-1])):
                line.append(len(points))
                points.append(tuple(x + (y - x) * n / steps for x, y in zip(p, q)))
                radii.append(r + (s - r) * n / steps)
        lines.append(line)
    _vtp(path, points, "Lines", lines, ("PointData", "Float64", "MaximumInscribedSphereRadius", radii))
