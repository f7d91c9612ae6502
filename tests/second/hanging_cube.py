#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A second implementation of the finite differences of the thesis: the cube of figure 9 in equilibrium under its weight.

    E = sum over nodes [ 1/4 sum_ij eta_ij (G_ij - G0_ij)^2 + psi (dV - dV0)^2 ] - m g . x

G_ij = r_i . r_j and dV = r_1 . (r_2 x r_3) are made of forward differences, which are zero at an upper border, and eta_ij are those of eq.
(10) with lambda = 1.5. The ceiling holds the nodes at the upper end of a3. It shares no code with the library: numpy, and the
minimiser L-BFGS of scipy. It prints the change of the volume, that of trilinear cells, and with --check it compares it with the
bands of samples/figures/cells/experiment.json: each has to contain the value of this program, and to be narrow.

    tests/second/hanging_cube.py [--check SOURCE]           ends with 77 where numpy or scipy is not installed
"""
import itertools
import json
import pathlib
import sys

try:
    import numpy as np
    import scipy.optimize
except ImportError:
    print("numpy and scipy are not installed")
    sys.exit(77)

SIDE, MASS, LAMBDA, PSI, GRAVITY = 3.0, 4.0, 1.5, 10.0, 9.81


def forward(field, axis, h):
    """(r[n + 1] - r[n]) / h, and zero at the upper border."""
    out = np.zeros_like(field)
    low = [slice(None)] * 4
    low[axis] = slice(0, -1)
    out[tuple(low)] = np.diff(field, axis=axis) / h
    return out


def backward_of(field, axis, h):
    """The transpose of forward()."""
    out = np.zeros_like(field)
    low, high = [slice(None)] * 4, [slice(None)] * 4
    low[axis], high[axis] = slice(0, -1), slice(1, None)
    out[tuple(high)] += field[tuple(low)] / h
    out[tuple(low)] -= field[tuple(low)] / h
    return out


class Cube:
    def __init__(self, n):
        self.n, self.h = n, 1.0 / (n - 1)
        axis = np.linspace(0, SIDE, n)
        self.rest = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), axis=-1)
        self.eta = LAMBDA / ((n - 1) * n * n)
        self.free = np.ones((n, n, n), bool)
        self.free[:, :, -1] = False
        self.inner = np.zeros((n, n, n), bool)
        self.inner[:-1, :-1, :-1] = True
        r = self.tangents(self.rest)
        self.g0, self.dv0 = self.metric(r), self.element(r)

    def tangents(self, x):
        return [forward(x, k, self.h) for k in range(3)]

    @staticmethod
    def metric(r):
        return [[np.sum(r[i] * r[j], axis=-1) for j in range(3)] for i in range(3)]

    @staticmethod
    def element(r):
        return np.sum(r[0] * np.cross(r[1], r[2]), axis=-1)

    def energy(self, x):
        r = self.tangents(x)
        g, strain = self.metric(r), self.element(r) - self.dv0
        strain = np.where(self.inner, strain, 0)
        value = sum(0.25 * self.eta * np.sum((g[i][j] - self.g0[i][j])**2) for i in range(3) for j in range(3))
        value += PSI * np.sum(strain**2)
        pull = [sum(self.eta * (g[i][j] - self.g0[i][j])[..., None] * r[j] for j in range(3)) for i in range(3)]
        for i in range(3):
            pull[i] = pull[i] + (2 * PSI * strain)[..., None] * np.cross(r[(i + 1) % 3], r[(i + 2) % 3])
        gradient = sum(backward_of(pull[i], i, self.h) for i in range(3))
        weight = MASS / self.n**3 * GRAVITY
        value += weight * np.sum(x[..., 2])
        gradient[..., 2] += weight
        return value, gradient

    def settled(self):
        x = self.rest.copy()

        def function(free):
            x[self.free] = free.reshape(-1, 3)
            value, gradient = self.energy(x)
            return value, gradient[self.free].ravel()

        start = self.rest[self.free].ravel()
        found = scipy.optimize.minimize(function, start, jac=True, method="L-BFGS-B",
                                        options={"maxiter": 40000, "maxfun": 80000, "ftol": 1e-16, "gtol": 1e-9, "maxcor": 40})
        x[self.free] = found.x.reshape(-1, 3)
        return x

    def volume(self, x):
        """Of trilinear cells, by 2 x 2 x 2 Gauss points."""
        total, n = 0.0, self.n
        corner = {b: x[b[0]:n - 1 + b[0], b[1]:n - 1 + b[1], b[2]:n - 1 + b[2]] for b in itertools.product((0, 1), repeat=3)}
        place = 0.5 / np.sqrt(3)
        for at in itertools.product((0.5 - place, 0.5 + place), repeat=3):
            slopes = []
            for k in range(3):
                slope = 0
                for b, points in corner.items():
                    weight = 1.0 if b[k] else -1.0
                    for other in range(3):
                        if other != k:
                            weight *= at[other] if b[other] else 1 - at[other]
                    slope = slope + weight * points
                slopes.append(slope)
            total += np.sum(slopes[0] * np.cross(slopes[1], slopes[2])) / 8
        return total


def change_percent(n):
    cube = Cube(n)
    return 100 * (cube.volume(cube.settled()) / cube.volume(cube.rest) - 1)


def main():
    found = {}
    for n in (3, 5, 7):
        found[n] = change_percent(n)
        print(f"{n} x {n} x {n}: {found[n]:.4f} %", flush=True)
    if sys.argv[1:2] != ["--check"]:
        return 0
    wrong = 0
    file = pathlib.Path(sys.argv[2]) / "samples/figures/cells/experiment.json"
    for check in json.loads(file.read_text())["checks"]:
        for n, value in found.items():
            if check["measured"] != f"volume_change_percent/differences/{n}x{n}x{n}":
                continue
            if not check["low"] < value < check["high"] or check["high"] - check["low"] > 0.021 * value:
                print(f"{check['measured']}: this program has {value:.4f}, the band is {check['low']} to {check['high']}")
                wrong += 1
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
