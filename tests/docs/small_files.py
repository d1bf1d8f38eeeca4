"""Small files as a person would bring them, written with the standard library alone: an image of a forked vessel as
NRRD and DICOM, its mask, a network in SWC, surfaces as SimVascular writes them, points as 3D Slicer writes them.

The vessel runs where the examples put their seeds: from (8, -187, 675) to (6, -178, 720), LPS, mm.
"""
import gzip
import json
import math
import struct

SPACING_MM = 0.6
ORIGIN = (-8.0, -200.0, 666.0)
SIZE = (60, 50, 100)
# Ends and radii of the pieces, mm: the trunk in two halves, a branch from its middle.
TRUNK_END, TRUNK_START, FORK = (5.8, -177.2, 724.0), (8.2, -188.0, 670.0), (7.0, -182.6, 697.0)
BRANCH_END = (20.0, -180.0, 722.0)
PIECES = ((TRUNK_START, FORK, 3.0, 2.8), (FORK, TRUNK_END, 2.6, 2.2), (FORK, BRANCH_END, 2.2, 1.8))


def _vessel():
    """Depth below the wall, mm, of the voxels in and near the vessel, by their index; and the piece, from 1."""
    depth = {}
    for piece, (a, b, first, last) in enumerate(PIECES, 1):
        along = [q - p for p, q in zip(a, b)]
        length2 = sum(d * d for d in along)
        reach = first + 2.0
        low = [max(0, int((min(p, q) - reach - o) / SPACING_MM)) for p, q, o in zip(a, b, ORIGIN)]
        high = [min(n, int((max(p, q) + reach - o) / SPACING_MM) + 2) for p, q, o, n in zip(a, b, ORIGIN, SIZE)]
        for k in range(low[2], high[2]):
            for j in range(low[1], high[1]):
                for i in range(low[0], high[0]):
                    p = [o + SPACING_MM * n - s for o, n, s in zip(ORIGIN, (i, j, k), a)]
                    t = min(1.0, max(0.0, sum(x * d for x, d in zip(p, along)) / length2))
                    d2 = sum((x - t * d) ** 2 for x, d in zip(p, along))
                    if d2 < reach * reach:
                        index = (k * SIZE[1] + j) * SIZE[0] + i
                        inside = first + t * (last - first) - math.sqrt(d2)
                        depth[index] = max((inside, piece), depth.get(index, (-9.0, 0)))
    return depth


def _nrrd(path, kind, voxels):
    s = SPACING_MM
    header = (f"NRRD0004\ntype: {kind}\ndimension: 3\nspace: left-posterior-superior\nsizes: {SIZE[0]} {SIZE[1]} {SIZE[2]}\n"
              f"space directions: ({s},0,0) (0,{s},0) (0,0,{s})\nkinds: domain domain domain\nendian: little\n"
              f"encoding: raw\nspace origin: ({ORIGIN[0]},{ORIGIN[1]},{ORIGIN[2]})\n\n")
    path.write_bytes(header.encode() + voxels)


def hounsfield():
    """The image's voxels, HU: a vessel of 360 in tissue of -60, blurred by 0.5 mm, with the same noise each time."""
    voxels = [-60 + (index * 7919 % 104729) % 31 - 15 for index in range(SIZE[0] * SIZE[1] * SIZE[2])]
    for index, (inside, _) in _vessel().items():
        voxels[index] += round(210.0 * math.erfc(-inside / (math.sqrt(2.0) * 0.5)))
    return voxels


def write_image(path):
    voxels = hounsfield()
    _nrrd(path, "short", struct.pack(f"<{len(voxels)}h", *voxels))


def write_mask(path, by_piece=False):
    """1 within the vessel, or the number of its piece."""
    voxels = bytearray(SIZE[0] * SIZE[1] * SIZE[2])
    for index, (inside, piece) in _vessel().items():
        voxels[index] = (piece if by_piece else 1) if inside > 0 else 0
    _nrrd(path, "unsigned char", bytes(voxels))


def write_calcium_scan(path):
    """A chest without contrast agent, voxels of 2 x 2 x 3 mm: a ball of a heart in fat in lung, with two spots of calcium on it."""
    size, spacing, middle, radius = (80, 80, 44), (2.0, 2.0, 3.0), (80.0, 80.0, 66.0), 45.0
    spots = [tuple(m + radius * p for m, p in zip(middle, place)) for place in ((0.8, -0.47, 0.46), (-1.1, -0.1, -0.2))]

    def value(x, y, z):
        if any(abs(x - a) < 3 and abs(y - b) < 3 and abs(z - c) < 3 for a, b, c in spots):
            return 450
        away = math.dist((x, y, z), middle)
        return 45 if away < radius else -90 if away < radius + 9 else -850 if math.hypot(x - 80, y - 80) < 72 else 50
    voxels = [value(2.0 * i, 2.0 * j, 3.0 * k) for k in range(size[2]) for j in range(size[1]) for i in range(size[0])]
    directions = " ".join("(" + ",".join(str(s if a == b else 0) for b in range(3)) + ")" for a, s in enumerate(spacing))
    head = (f"NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: {size[0]} {size[1]} {size[2]}\n"
            f"space directions: {directions}\nspace origin: (0,0,0)\nendian: little\nencoding: gzip\n\n")
    path.write_bytes(head.encode() + gzip.compress(struct.pack(f"<{len(voxels)}h", *voxels)))


def write_segmentation(path):
    """The mask as 3D Slicer saves a segmentation: three segments, with names, in one layer."""
    write_mask(path, by_piece=True)
    header, _, voxels = path.read_bytes().partition(b"\n\n")
    names = "".join(f"\nSegment{n}_ID:=Segment_{n + 1}\nSegment{n}_LabelValue:={n + 1}\nSegment{n}_Layer:=0\nSegment{n}_Name:={name}"
                    for n, name in enumerate(("proximal", "distal", "branch")))
    path.write_bytes(header + names.encode() + b"\nSegmentation_MasterRepresentation:=Binary labelmap\n\n" + voxels)


def _element(group, element, kind, value):
    if isinstance(value, str):
        value = value.encode()
    if len(value) % 2:
        value += b"\0" if kind == "UI" else b" "
    head = struct.pack("<HH2s", group, element, kind.encode())
    return head + (struct.pack("<xxI", len(value)) if kind in ("OB", "OW") else struct.pack("<H", len(value))) + value


def write_dicom(folder, voxels=None, size=SIZE, spacing=(SPACING_MM,) * 3, origin=ORIGIN):
    """A CT series, a file a slice (explicit VR, little endian), of voxels in HU."""
    folder.mkdir()
    voxels = hounsfield() if voxels is None else voxels
    series, kind, plain = "2.25.4711.1", "1.2.840.10008.5.1.4.1.1.2", "1.2.840.10008.1.2.1"
    short = lambda group, element, value: _element(group, element, "US", struct.pack("<H", value))
    area = size[0] * size[1]
    for k in range(size[2]):
        image = f"{series}.{k + 1}"
        meta = (_element(2, 1, "OB", b"\0\1") + _element(2, 2, "UI", kind) + _element(2, 3, "UI", image)
                + _element(2, 0x10, "UI", plain) + _element(2, 0x12, "UI", "2.25.4711"))
        place = "\\".join(f"{x:.3f}" for x in (origin[0], origin[1], origin[2] + k * spacing[2]))
        body = (_element(8, 0x16, "UI", kind) + _element(8, 0x18, "UI", image) + _element(8, 0x60, "CS", "CT")
                + _element(0x10, 0x10, "PN", "Nobody^Synthetic") + _element(0x10, 0x20, "LO", "0")
                + _element(0x18, 0x50, "DS", f"{spacing[2]:.3f}") + _element(0x20, 0x0D, "UI", "2.25.4711.2")
                + _element(0x20, 0x0E, "UI", series) + _element(0x20, 0x13, "IS", str(k + 1)) + _element(0x20, 0x32, "DS", place)
                + _element(0x20, 0x37, "DS", "1\\0\\0\\0\\1\\0") + _element(0x20, 0x52, "UI", "2.25.4711.3")
                + short(0x28, 2, 1) + _element(0x28, 4, "CS", "MONOCHROME2") + short(0x28, 0x10, size[1]) + short(0x28, 0x11, size[0])
                + _element(0x28, 0x30, "DS", f"{spacing[1]:.4f}\\{spacing[0]:.4f}") + short(0x28, 0x100, 16)
                + short(0x28, 0x101, 16) + short(0x28, 0x102, 15) + short(0x28, 0x103, 1)
                + _element(0x28, 0x1052, "DS", "0") + _element(0x28, 0x1053, "DS", "1")
                + _element(0x7FE0, 0x10, "OW", struct.pack(f"<{area}h", *voxels[k * area:(k + 1) * area])))
        (folder / f"CT{k + 1:04}.dcm").write_bytes(b"\0" * 128 + b"DICM" + _element(2, 0, "UL", struct.pack("<I", len(meta))) + meta + body)


def write_swc(path):
    """The same vessel as a network."""
    rows = [(1, TRUNK_START, 3.0, -1), (2, FORK, 2.6, 1), (3, TRUNK_END, 2.2, 2), (4, BRANCH_END, 1.8, 2)]
    path.write_text("".join(f"{n} 2 {x} {y} {z} {r} {parent}\n" for n, (x, y, z), r, parent in rows))


def write_curve(path, points, name, kind="Curve"):
    """A curve or list of points, as 3D Slicer saves its markups."""
    markup = {"type": kind, "coordinateSystem": "LPS", "coordinateUnits": "mm",
              "controlPoints": [{"id": str(n), "label": f"{name}-{n}", "position": list(p), "positionStatus": "defined"}
                                for n, p in enumerate(points, 1)]}
    schema = "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/Resources/Schema/markups-schema-v1.0.3.json#"
    path.write_text(json.dumps({"@schema": schema, "markups": [markup]}))


def write_fcsv(path, points):
    """Points as Slicer 4 saved them: right, anterior, superior."""
    head = "# Markups fiducial file version = 4.11\n# CoordinateSystem = RAS\n# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n"
    path.write_text(head + "".join(f"{n},{-x},{-y},{z},0,0,0,1,1,1,0,F-{n},,\n" for n, (x, y, z) in enumerate(points, 1)))
