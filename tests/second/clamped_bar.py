#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A second implementation of the clamped cantilever of the figures clamped, cantilever and bar, for small strains.

The clamp keeps the section from changing, which Timoshenko's beam leaves out. Three kinds of cells share no code with the library:

    quadratic   27 nodes, with four pressures each (Q2/P1, stable for nu -> 0.5), small next to the clamp and the sides: the solution
    bending     the energy of src/risorius/tissue/bending_cells.h, written from its comment
    enhanced    8 nodes with up to 30 enhanced strains each (Simo and Rifai 1990), to see what other cells of 8 nodes reach

A layer of cells along the bar is a block of the matrix; blocks are eliminated from the clamp to the end. Deflections are printed over
Timoshenko's. With --check the solutions have to be those of samples/figures/clamped/experiment.json to 3e-4, and bending cells of two
across and half as long as wide have to be in the bands of its checks.

    tests/second/clamped_bar.py [--check SOURCE | --all]    ends with 77 where numpy is not installed
"""
import json
import pathlib
import sys

try:
    import numpy as np
except ImportError:
    print("numpy is not installed")
    sys.exit(77)

LENGTH = 10.0  # of the bar; its section is a unit square, and Young's modulus is 1


def timoshenko(nu):
    return 4 * LENGTH**3 + LENGTH * 2 * (1 + nu) * (12 + 11 * nu) / (10 * (1 + nu))


def lame(nu):
    return 0.5 / (1 + nu), nu / ((1 + nu) * (1 - 2 * nu))


def strain_rows(slopes):
    """Six strains from the slopes of n shape functions, 3 x n, as rows over 3 n displacements; shear strains are doubled."""
    n = slopes.shape[1]
    out = np.zeros((6, n, 3))
    for axis in range(3):
        out[axis, :, axis] = slopes[axis]
    for row, (p, q) in enumerate([(1, 2), (0, 2), (0, 1)], 3):
        out[row, :, p], out[row, :, q] = slopes[q], slopes[p]
    return out.reshape(6, 3 * n)


THREE = [(-np.sqrt(0.6), 5 / 9), (0.0, 8 / 9), (np.sqrt(0.6), 5 / 9)]


def gauss27():
    return [(np.array([a, b, c]), wa * wb * wc / 8) for a, wa in THREE for b, wb in THREE for c, wc in THREE]


def quadratic_slopes(at):
    value = [np.array([t * (t - 1) / 2, 1 - t * t, t * (t + 1) / 2]) for t in at]
    slope = [np.array([t - 0.5, -2 * t, t + 0.5]) for t in at]
    out = []
    for axis in range(3):
        parts = [slope[k] if k == axis else value[k] for k in range(3)]
        out.append(np.einsum("i,j,k->ijk", *parts).ravel())
    return np.array(out)


QUADRATIC = [(at, weight, quadratic_slopes(at)) for at, weight in gauss27()]


def quadratic(edges, nu):
    mu, lam = lame(nu)
    volume, stiff = np.prod(edges), np.zeros((81, 81))
    dilatation, mass = np.zeros((4, 81)), np.zeros((4, 4))
    for at, weight, slopes in QUADRATIC:
        rows = strain_rows(slopes * 2 / np.array(edges)[:, None])
        stiff += weight * volume * mu * (rows.T * np.array([2, 2, 2, 1, 1, 1])) @ rows
        pressure = np.array([1, *at])
        dilatation += weight * volume * np.outer(pressure, rows[:3].sum(0))
        mass += weight * volume * np.outer(pressure, pressure)
    return stiff + lam * dilatation.T @ np.linalg.solve(mass, dilatation)


def trilinear_slopes(at, edges):
    out = np.zeros((3, 8))
    for corner in range(8):
        sign = [1 if corner & (4 >> k) else -1 for k in range(3)]
        part = [0.5 * (1 + sign[k] * at[k]) for k in range(3)]
        for axis in range(3):
            out[axis, corner] = sign[axis] / edges[axis] * np.prod([part[k] for k in range(3) if k != axis])
    return out


def bending(edges, nu):
    mu, lam = lame(nu)
    part = {}
    for corner in range(8):
        s = np.array([1.0 if corner & (4 >> k) else -1.0 for k in range(3)])
        rows = strain_rows(trilinear_slopes(s / np.sqrt(3), edges))
        rows[3:] *= 0.5
        for name, factor in (("", 1), ("0", s[0]), ("1", s[1]), ("2", s[2]), ("12", s[1] * s[2]), ("02", s[0] * s[2]), ("01", s[0] * s[1])):
            part[name] = part.get(name, 0) + factor * rows / 8
    row_of = {(0, 0): 0, (1, 1): 1, (2, 2): 2, (1, 2): 3, (0, 2): 4, (0, 1): 5}

    def square(row, factor):
        return 2 * np.prod(edges) * factor * np.outer(row, row)

    mean = part[""]
    stiff = square(mean[:3].sum(0), lam / 2)
    for row in range(6):
        stiff = stiff + square(mean[row], mu * (1 if row < 3 else 2))
    for k in range(3):
        i, j = [axis for axis in range(3) if axis != k]
        layer = part[str(k)]
        # mu / (1 - nu) (p^2 + q^2 + 2 nu p q), as squares of p + q and p - q
        plus, minus = layer[i] + layer[j], layer[i] - layer[j]
        stiff += square(plus, mu / (1 - nu) * (1 + nu) / 2) + square(minus, mu / (1 - nu) * (1 - nu) / 2)
        stiff += square(layer[row_of[i, j]], 2 * mu)
        stiff += square(part[f"{i}{j}"][k], mu * (1 + nu))
    return stiff


def enhanced(count):
    """Cells with 9, 12, 21 or 30 enhanced strains."""

    def modes(at):
        x, y, z = at
        out = [(axis, at[axis]) for axis in range(3)]
        for row, (p, q) in enumerate([(1, 2), (0, 2), (0, 1)], 3):
            out += [(row, at[p]), (row, at[q])]
        pairs = (x * y, y * z, x * z)
        columns = []
        if count == 12:
            columns = [np.array([f, f, f, 0, 0, 0]) for f in pairs]
        if count >= 21:
            out += [(row, f) for row in range(3) for f in pairs]
        if count >= 30:
            out += [(row, f) for row in range(3, 6) for f in pairs]
        for row, f in out:
            columns.append(f * np.eye(6)[row])
        return np.array(columns).T

    def cell(edges, nu):
        mu, lam = lame(nu)
        law = np.diag([2 * mu] * 3 + [mu] * 3)
        law[:3, :3] += lam
        sums = 0
        for at, weight in gauss27():
            both = np.hstack([strain_rows(trilinear_slopes(at, edges)), modes(at)])
            sums = sums + weight * np.prod(edges) * both.T @ law @ both
        return sums[:24, :24] - sums[:24, 24:] @ np.linalg.lstsq(sums[24:, 24:], sums[24:, :24], rcond=None)[0]

    return cell


def layer(cell, order, length, y, z, nu):
    """The matrix of one layer over its two outer planes of nodes."""
    rows, columns = order * (len(y) - 1) + 1, order * (len(z) - 1) + 1
    plane = 3 * rows * columns
    stiff = np.zeros(((order + 1) * plane, (order + 1) * plane))
    span = range(order + 1)
    for b in range(len(y) - 1):
        for c in range(len(z) - 1):
            nodes = np.array([(p * rows + order * b + q) * columns + order * c + r for p in span for q in span for r in span])
            places = (3 * nodes[:, None] + np.arange(3)).ravel()
            stiff[np.ix_(places, places)] += cell((length, y[b + 1] - y[b], z[c + 1] - z[c]), nu)
    return stiff, plane


def condensed(stiff, plane, free, order):
    all_free = np.concatenate([free] * (order + 1))
    stiff = stiff[np.ix_(all_free, all_free)]
    n = int(free.sum())
    if order == 1:
        return stiff
    outer, inner = np.r_[0:n, 2 * n:3 * n], np.r_[n:2 * n]
    return stiff[np.ix_(outer, outer)] - stiff[np.ix_(outer, inner)] @ np.linalg.solve(stiff[np.ix_(inner, inner)], stiff[np.ix_(inner, outer)])


def deflection(cell, order, nu, section, along, pairs=None):
    """Mean deflection of the end over Timoshenko's. `section`: the planes between cells of a quarter, from 0 to 1/2; z = 0 is neutral."""
    nodes = order * (len(section) - 1) + 1
    fixed = np.zeros((nodes, nodes, 3), bool)
    fixed[0, :, 1] = True  # symmetric in y
    fixed[:, 0, :2] = True  # antisymmetric in z
    free = ~fixed.ravel()
    known, left = {}, None
    n = int(free.sum())
    for length in np.diff(along):
        key = round(float(length), 12)
        if key not in known:
            known[key] = condensed(*pairs, free, 2) if pairs else condensed(*layer(cell, order, key, section, section, nu), free, order)
        stiff = known[key]
        if left is None:
            left = stiff[n:, n:]
        else:
            left = stiff[n:, n:] - stiff[n:, :n] @ np.linalg.solve(stiff[:n, :n] + left, stiff[:n, n:])
    weight = np.zeros((nodes, nodes))
    one = np.array([1, 4, 1]) / 6 if order == 2 else np.array([1, 1]) / 2
    for b in range(len(section) - 1):
        for c in range(len(section) - 1):
            area = (section[b + 1] - section[b]) * (section[c + 1] - section[c])
            weight[order * b:order * (b + 1) + 1, order * c:order * (c + 1) + 1] += area * np.outer(one, one)
    force = np.zeros((nodes, nodes, 3))
    force[:, :, 2] = weight  # a quarter of the whole force of 1
    force = force.ravel()[free]
    return 4 * force @ np.linalg.solve(left, force) / timoshenko(nu)


def dilatation(edges):
    """Mean change of volume of a cell of 8 nodes, as a row over its displacements."""
    return sum(strain_rows(trilinear_slopes(at, edges))[:3].sum(0) * weight for at, weight in gauss27())


def in_pairs(nu, across, lengthwise):
    """As of_cells() with bending cells, but two successive cells along the bar have one pressure together."""
    section = np.linspace(0, 0.5, across // 2 + 1)
    count, size, lam = int(LENGTH) * across * lengthwise, section[1], lame(nu)[1]
    edges = (LENGTH / count, size, size)
    one = dilatation(edges)

    def alone(of, ratio):
        return bending(of, ratio) - lam * np.prod(of) * np.outer(one, one)

    stiff, plane = layer(alone, 1, edges[0], section, section, nu)
    pair = np.zeros((3 * plane, 3 * plane))
    for first in (0, plane):
        pair[first:first + 2 * plane, first:first + 2 * plane] += stiff
    for b in range(len(section) - 1):
        for c in range(len(section) - 1):
            both = np.zeros(3 * plane)
            for first in (0, 1):
                nodes = [((first + p) * len(section) + b + q) * len(section) + c + r for p in (0, 1) for q in (0, 1) for r in (0, 1)]
                both[(3 * np.array(nodes)[:, None] + np.arange(3)).ravel()] += one / 2
            pair += 2 * lam * np.prod(edges) * np.outer(both, both)
    # A pair is a cell of three planes of nodes to the elimination of blocks
    return deflection(None, 1, nu, section, np.linspace(0, LENGTH, count // 2 + 1), pairs=(pair, plane))


def solution(nu, cells=3, first=0.06):
    section = 0.5 * (1 - (1 - np.linspace(0, 1, cells + 1)) ** 1.5)
    along, step = [0.0], first
    while along[-1] + step < LENGTH - 0.3:
        along.append(along[-1] + step)
        step = min(1.4 * step, 1.0)
    return deflection(quadratic, 2, nu, section, np.array(along + [LENGTH]))


def of_cells(cell, nu, across, lengthwise):
    section = np.linspace(0, 0.5, across // 2 + 1)
    return deflection(cell, 1, nu, section, np.linspace(0, LENGTH, int(LENGTH) * across * lengthwise + 1))


def main():
    ratios = (0, 0.3, 0.49, 0.499)
    if sys.argv[1:2] == ["--all"]:
        for nu in ratios:
            print(f"nu = {nu}: solution {solution(nu):.5f}, finer {solution(nu, 4, 0.03):.5f}")
            for name, cell in [("bending", bending)] + [(f"enhanced {n}", enhanced(n)) for n in (9, 12, 21, 30)]:
                print(f"    {name}: {of_cells(cell, nu, 2, 1):.4f} cubes, {of_cells(cell, nu, 2, 2):.4f} half as long", flush=True)
            print(f"    bending, a pressure for two: {in_pairs(nu, 2, 1):.4f} cubes, {in_pairs(nu, 2, 2):.4f} half as long", flush=True)
        return 0
    wrong = 0
    experiment = None
    if sys.argv[1:2] == ["--check"]:
        experiment = json.loads((pathlib.Path(sys.argv[2]) / "samples/figures/clamped/experiment.json").read_text())
        if tuple(experiment["poisson_ratios"]) != ratios:
            print("other Poisson's ratios in the experiment")
            return 1
    for i, nu in enumerate(ratios):
        exact, found = solution(nu), of_cells(bending, nu, 2, 2)
        print(f"nu = {nu}: clamped {exact:.5f}, bending cells {found:.5f}", flush=True)
        if experiment is None:
            continue
        if abs(experiment["solutions"][i] - exact) > 3e-4:
            print(f"the experiment has {experiment['solutions'][i]}")
            wrong += 1
        for check in experiment["checks"]:
            if check["measured"] == f"deflection_ratio/{nu}/2" and not check["low"] < found / exact < check["high"]:
                print(f"{check['measured']}: this program has {found / exact:.4f}, the band is {check['low']} to {check['high']}")
                wrong += 1
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
