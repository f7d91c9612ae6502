#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A second implementation of samples/figures/belly: a bar of neo-Hookean matter with fibres along it, held at its length or free.

    held   F = A s0 [ a fl(1/l0) + fp(1/l0) ]
    free   dW/dl + s0 [ a fl(l) + fp(l) ] = 0,  dW/dw = 0,   W = mu/2 (J^(-2/3) (l^2 + 2 w^2) - 3) + B/2 (J - 1)^2,  J = l w^2

It shares no code with the library; the curves are those of one_fibre.py. The two equations for length l and width w are solved by bisection.
With --check it compares the results with the bands of the experiment: each has to contain the value, and to be narrow.

    tests/second/free_belly.py [--check SOURCE]
"""
import json
import pathlib
import sys

from one_fibre import active, passive

AREA_M2, TENSION_PA, SHEAR_PA, BULK_PA = 1e-4, 3e5, 5770.0, 5e5


def stresses(length, width, activation):
    volume = length * width**2
    squares = length**2 + 2 * width**2
    pressure = BULK_PA * (volume - 1) - SHEAR_PA / 3 * squares * volume ** (-5 / 3)
    scale = SHEAR_PA * volume ** (-2 / 3)
    fibres = TENSION_PA * (activation * active(length) + passive(length))
    return scale * length + pressure * width**2 + fibres, scale * width + pressure * length * width


def root(rising, low, high):
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (low, middle) if rising(middle) > 0 else (middle, high)
    return low


def free(activation):
    def width_at(length):
        return root(lambda width: stresses(length, width, activation)[1], 0.5, 3)

    length = root(lambda one: stresses(one, width_at(one), activation)[0], 0.35, 1.2)
    return length, width_at(length)


def held_n(activation, optimal):
    return AREA_M2 * TENSION_PA * (activation * active(1 / optimal) + passive(1 / optimal))


def main():
    values = {
        "holding_n/isometric/0": held_n(1, 1),
        "holding_n/half/1": held_n(0.5, 1),
        "holding_n/short/0": held_n(1, 1.25),
        "holding_n/long/0": held_n(1, 0.85),
    }
    for activation in (0.02, 0.1, 1):
        length, width = free(activation)
        values[f"fibre_stretch/free-{activation}/0"] = length
        values[f"volume_change_percent/free-{activation}"] = 100 * (length * width**2 - 1)
    for name, value in values.items():
        print(f"{name} {value:.9f}")
    if sys.argv[1:2] != ["--check"]:
        return 0
    wrong = compared = 0
    file = pathlib.Path(sys.argv[2]) / "samples/figures/belly/experiment.json"
    for check in json.loads(file.read_text())["checks"]:
        if check["measured"] not in values:
            continue
        compared += 1
        value, low, high = values[check["measured"]], check["low"], check["high"]
        if not low < value < high or high - low > 1e-4 * abs(value):
            print(f"{check['measured']}: this program has {value:.9f}, the band is {low} to {high}")
            wrong += 1
    return 1 if wrong or compared < 8 else 0


if __name__ == "__main__":
    sys.exit(main())
