#!/usr/bin/env python3
"""Writes a closed surface of even triangles, an ellipsoid of 8 x 5 x 5 mm, as STL: ellipsoid.py OUT.stl"""
import math
import sys

golden = (1 + math.sqrt(5)) / 2
points = [(x, y, 0) for x in (-1, 1) for y in (-golden, golden)]
points = [p[k:] + p[:k] for k in range(3) for p in points]


def distance(a, b):
    return math.dist(a, b)


def outward(triangle):
    a, b, c = triangle
    u, v = [b[i] - a[i] for i in range(3)], [c[i] - a[i] for i in range(3)]
    normal = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    return triangle if sum(normal[i] * a[i] for i in range(3)) > 0 else (a, c, b)


def middle(a, b):
    m = [(p + q) / 2 for p, q in zip(a, b)]
    length = math.hypot(*m)
    return tuple(round(x / length, 9) for x in m)


edge = 2.0
icosahedron = [(a, b, c) for i, a in enumerate(points) for j, b in enumerate(points[:i]) for c in points[:j]
               if all(abs(distance(p, q) - edge) < 1e-9 for p, q in ((a, b), (b, c), (a, c)))]
unit = [tuple(tuple(round(x / math.hypot(*p), 9) for x in p) for p in t) for t in icosahedron]
triangles = [outward(t) for t in unit]
for _ in range(3):
    finer = []
    for a, b, c in triangles:
        ab, bc, ca = middle(a, b), middle(b, c), middle(a, c)
        finer += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    triangles = finer

with open(sys.argv[1], "w", encoding="ascii") as file:
    file.write("solid ellipsoid\n")
    for triangle in triangles:
        corners = "".join(f" vertex {4 * x:.7g} {2.5 * y:.7g} {2.5 * z:.7g}\n" for x, y, z in triangle)
        file.write(f"facet normal 0 0 0\n outer loop\n{corners} endloop\nendfacet\n")
    file.write("endsolid ellipsoid\n")
