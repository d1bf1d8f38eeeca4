"""Measures of a mesh that a foreign library has read, for comparison with the mesh that was written.

Node orders are given as the format's manual has them: the corners of each second-order node. Nothing here knows how the
writer orders anything.
"""
import itertools
import sys

import numpy as np

TETRA = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
WEDGE = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (0, 1, 1)]
TRIANGLE = [(0, 0), (1, 0), (0, 1)]
QUAD = [(0, 0), (1, 0), (1, 1), (0, 1)]

EDGES_TRIANGLE = [(0, 1), (1, 2), (2, 0)]
EDGES_QUAD = [(0, 1), (1, 2), (2, 3), (3, 0), (0, 1, 2, 3)]


def powers(kind, second):
    """Exponents of the monomials that span the element."""
    n = 2 if second else 1
    every = itertools.product(range(n + 1), repeat=2 if kind in ("triangle", "quad") else 3)
    keep = {
        "tetra": lambda p: sum(p) <= n,
        "wedge": lambda p: p[0] + p[1] <= n,
        "triangle": lambda p: sum(p) <= n,
        "quad": lambda p: True,
    }[kind]
    return [p for p in every if keep(p)]


def monomials(exponents, at):
    return np.array([[np.prod([x ** e for x, e in zip(point, p)]) for p in exponents] for point in at])


def gradients(exponents, at):
    out = []
    for axis in range(len(exponents[0])):
        rows = []
        for point in at:
            row = []
            for p in exponents:
                lower = [e - (i == axis) for i, e in enumerate(p)]
                row.append(0.0 if lower[axis] < 0 else p[axis] * np.prod([x ** e for x, e in zip(point, lower)]))
            rows.append(row)
        out.append(rows)
    return np.moveaxis(np.array(out), 0, 2)  # point, monomial, axis


def gauss(n):
    x, w = np.polynomial.legendre.leggauss(n)
    return (x + 1) / 2, w / 2


def rule(kind):
    """Points and weights; symmetric in the corners for triangles and quads, so that areas do not depend on the start."""
    x, w = gauss(4)
    if kind == "triangle":
        a, b = (6 - 15 ** 0.5) / 21, (6 + 15 ** 0.5) / 21
        points = [(1 / 3, 1 / 3)]
        weights = [9 / 80]
        for c, weight in ((a, (155 - 15 ** 0.5) / 2400), (b, (155 + 15 ** 0.5) / 2400)):
            points += [(c, c), (1 - 2 * c, c), (c, 1 - 2 * c)]
            weights += [weight] * 3
        return points, np.array(weights)
    if kind == "quad":
        x, w = gauss(3)
        return list(itertools.product(x, x)), np.array([a * b for a in w for b in w])
    points, weights = [], []
    for (u, wu), (v, wv), (t, wt) in itertools.product(zip(x, w), repeat=3):
        if kind == "wedge":
            points.append((u, v * (1 - u), t))
            weights.append(wu * wv * wt * (1 - u))
        else:
            points.append((u, v * (1 - u), t * (1 - u) * (1 - v)))
            weights.append(wu * wv * wt * (1 - u) ** 2 * (1 - v))
    return points, np.array(weights)


def derivatives(kind, points, cells, second_nodes):
    """Of the position by the reference coordinates: cell, quadrature point, xyz, axis."""
    corners = np.array({"tetra": TETRA, "wedge": WEDGE, "triangle": TRIANGLE, "quad": QUAD}[kind], float)
    second = cells.shape[1] > len(corners)
    nodes = list(corners) + ([corners[list(group)].mean(axis=0) for group in second_nodes] if second else [])
    exponents = powers(kind, second)
    assert len(nodes) == cells.shape[1] == len(exponents), (kind, cells.shape)
    at, weights = rule(kind)
    shape = np.einsum("qma,mn->qna", gradients(exponents, at), np.linalg.inv(monomials(exponents, nodes)))
    return np.einsum("cnx,qna->cqxa", points[cells], shape), weights


def solid(kind, points, cells, second_nodes=(), sense=1):
    """Volume and smallest Jacobian determinant."""
    if len(cells) == 0:
        return 0.0, np.inf
    jacobian, weights = derivatives(kind, points, cells, second_nodes)
    determinants = sense * np.linalg.det(jacobian)
    return float((determinants * weights).sum()), float(determinants.min())


def surface(kind, points, cells):
    """Area, and area as a vector along the normal."""
    if len(cells) == 0:
        return 0.0, np.zeros(3)
    jacobian, weights = derivatives(kind, points, cells, EDGES_TRIANGLE if kind == "triangle" else EDGES_QUAD)
    normals = np.cross(jacobian[..., 0], jacobian[..., 1])
    return float((np.linalg.norm(normals, axis=2) * weights).sum()), (normals * weights[:, None]).sum(axis=(0, 1))


class Found:
    """What was read; `orders` maps tetra and wedge to their second-order nodes, `sense` is -1 where the format's wedge
    runs the other way round."""

    def __init__(self, points, orders=None, sense=1, scale=1.0):
        self.points = np.asarray(points, float) * scale
        self.orders = orders or {}
        self.sense = sense
        self.cells = {"tetra": [], "wedge": []}
        self.faces = {}

    def add_cells(self, kind, cells):
        if len(cells):
            self.cells[kind].append(np.asarray(cells, int))

    def add_face(self, name, number, kind, cells):
        face = self.faces.setdefault(name, {"id": number, "triangle": [], "quad": []})
        if len(cells):
            face[kind].append(np.asarray(cells, int))

    def write(self, path):
        lines = []
        volume, smallest = 0.0, np.inf
        for kind, blocks in self.cells.items():
            lines.append(f"cells {kind} {sum(len(b) for b in blocks)}")
            for block in blocks:
                v, j = solid(kind, self.points, block, self.orders.get(kind, ()), self.sense if kind == "wedge" else 1)
                volume, smallest = volume + v, min(smallest, j)
        lines.append(f"volume {volume!r} {smallest if np.isfinite(smallest) else 0.0!r}")
        for name, face in self.faces.items():
            area, vector = 0.0, np.zeros(3)
            for kind in ("triangle", "quad"):
                for block in face[kind]:
                    a, n = surface(kind, self.points, block)
                    area, vector = area + a, vector + n
            counts = " ".join(str(sum(len(b) for b in face[kind])) for kind in ("triangle", "quad"))
            lines.append(f"face {name} {face['id']} {counts} {area!r} {' '.join(repr(float(x)) for x in vector)}")
        with open(path, "w", encoding="utf-8") as out:
            out.write("\n".join(lines) + "\n")


def main(readers):
    """The arguments are a format, then pairs of a mesh's path and the file for its measures."""
    for path, out in zip(sys.argv[2::2], sys.argv[3::2]):
        readers[sys.argv[1]](path).write(out)
