#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes masseter.msh: a spindle of tetrahedra from the cheekbone to the angle of the left mandible of rigs/adult, mm, with the directions of
its fibres as $ElementData. Usage: make_belly.py OUT.msh"""
import math
import sys

ORIGIN, INSERTION, OUTWARD = (55.2, -16.8, 47.1), (45.5, -56.8, 21.5), (0.95, 0.0, 0.3)
WIDTH, THICKNESS, ENDS = 28.0, 11.0, (0.5, 0.55)  # mm; width and thickness at the ends over those of the belly
CELLS = (8, 4, 2)  # along, across, through
PATHS = ((0, 1, 2), (1, 2, 0), (2, 0, 1), (0, 2, 1), (2, 1, 0), (1, 0, 2))  # six tetrahedra along the axes of a cube


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    return tuple(x / math.sqrt(dot(a, a)) for x in a)


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def node(at):
    """The node at a place of the grid."""
    along = unit(minus(INSERTION, ORIGIN))
    sideways = unit(cross(OUTWARD, along))
    outward = cross(along, sideways)
    t, x, y = at[0] / CELLS[0], 2 * at[1] / CELLS[1] - 1, 2 * at[2] / CELLS[2] - 1
    rise = 1 - abs(2 * t - 1)
    rise = rise * rise * (3 - 2 * rise)  # 0 at the ends, 1 in the middle
    half = [0.5 * size * (end + (1 - end) * rise) for size, end in zip((WIDTH, THICKNESS), ENDS)]
    u, v = half[0] * x * math.sqrt(1 - y * y / 2), half[1] * y * math.sqrt(1 - x * x / 2)
    return tuple(a + t * (b - a) + u * s + v * o for a, b, s, o in zip(ORIGIN, INSERTION, sideways, outward))


def main():
    grid = [(i, j, k) for i in range(CELLS[0] + 1) for j in range(CELLS[1] + 1) for k in range(CELLS[2] + 1)]
    number = {at: n + 1 for n, at in enumerate(grid)}
    tets, fibres = [], []
    for low in grid:
        if any(c == most for c, most in zip(low, CELLS)):
            continue
        middle = [tuple(c + d / 2 for c, d in zip(low, (end, 1, 1))) for end in (0, 2)]
        fibre = unit(minus(node(middle[1]), node(middle[0])))
        for path in PATHS:
            corner, corners = list(low), [number[low]]
            for axis in path:
                corner[axis] += 1
                corners.append(number[tuple(corner)])
            points = [node(grid[c - 1]) for c in corners]
            edges = [minus(p, points[0]) for p in points[1:]]
            if dot(edges[0], cross(edges[1], edges[2])) < 0:
                corners[2], corners[3] = corners[3], corners[2]
            tets.append(corners)
            fibres.append(fibre)
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", str(len(grid))]
    lines += [f"{number[at]} " + " ".join(f"{x:.4f}" for x in node(at)) for at in grid]
    lines += ["$EndNodes", "$Elements", str(len(tets))]
    lines += [f"{t + 1} 4 2 1 1 " + " ".join(map(str, corners)) for t, corners in enumerate(tets)]
    lines += ["$EndElements", "$ElementData", "1", '"fibre"', "1", "0", "3", "0", "3", str(len(tets))]
    lines += [f"{t + 1} " + " ".join(f"{x:.5f}" for x in fibre) for t, fibre in enumerate(fibres)]
    lines.append("$EndElementData")
    with open(sys.argv[1], "w", encoding="utf-8") as out:
        out.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
