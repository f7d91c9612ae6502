#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A second implementation of figure 11b: one fibre and its tendon in series, without mass, in one dimension.

    F0 fT((L - l - lTs) / lTs) = F0 [ a fl(l/l0) fv(l'/(vmax l0)) + fp(l/l0) + b l'/(vmax l0) ]

It shares no code with the library. The curves are written from docs/theory/muscle.md, and the differential equation is solved by
bisection for the speed and Runge-Kutta steps of 0.1 ms. It prints the times of the release, and with --check it compares them, and values of the curves, with the
bands of samples/figures/11b/experiment.json and samples/figures/muscle-curves/experiment.json: each band has to contain the value of this
program, and to be narrow: the mass and the viscosity of the belly may slow it down by 12 %.

    tests/second/one_fibre.py [--check SOURCE]
"""
import json
import math
import pathlib
import sys

ACTIVE = [(0.401, 0.0), (0.527, 0.227), (0.629, 0.637), (0.719, 0.857), (0.861, 0.950), (1.0, 1.0), (1.218, 0.770), (1.439, 0.247),
          (1.619, 0.0)]


def hermite(s, width, f0, f1, t0, t1):
    return ((2 * s**3 - 3 * s**2 + 1) * f0 + (s**3 - 2 * s**2 + s) * width * t0 + (-2 * s**3 + 3 * s**2) * f1
            + (s**3 - s**2) * width * t1)


def slope_at(i):
    if i in (0, 5, len(ACTIVE) - 1):
        return 0.0
    (before, f_before), (after, f_after) = ACTIVE[i - 1], ACTIVE[i + 1]
    return (f_after - f_before) / (after - before)


def active(length):
    for i in range(len(ACTIVE) - 1):
        (l0, f0), (l1, f1) = ACTIVE[i], ACTIVE[i + 1]
        if l0 <= length <= l1:
            return hermite((length - l0) / (l1 - l0), l1 - l0, f0, f1, slope_at(i), slope_at(i + 1))
    return 0.0


def passive(length):
    k, strain = 4.0, 0.47
    s = (length - 1) / strain
    if s <= 0:
        return 0.0
    if s < 1:
        return (math.exp(k * s) - 1 - k * s) / (math.exp(k) - 1 - k)
    return 1 + k * (math.exp(k) - 1) / ((math.exp(k) - 1 - k) * strain) * (length - 1 - strain)


def velocity(v):
    hill, most = 0.25, 1.4
    if v <= -1.1:
        return 0.0
    if v < -0.9:
        return hermite((v + 1.1) / 0.2, 0.2, 0.0, (1 - 0.9) / (1 + 0.9 / hill), 0.0, 0.236295)
    if v < 0:
        return (1 + v) / (1 - v / hill)
    return most - (most - 1) / (1 + (1 + 1 / hill) / (most - 1) * v)


def tendon(strain):
    toe, k, at_f0 = 1 / 3, 3.0, 0.033
    steep = k * (math.exp(k) - 1) / (math.exp(k) - 1 - k)
    end = at_f0 / (1 + (1 - toe) / (toe * steep))
    if strain <= 0:
        return 0.0
    if strain < end:
        s = strain / end
        return toe * (math.exp(k * s) - 1 - k * s) / (math.exp(k) - 1 - k)
    return toe + toe * steep / end * (strain - end)


def speed(length, force, activation, damping):
    """The speed, over vmax, at which the fibre has this force, over F0."""
    low, high = -2.0, 2.0
    for _ in range(45):
        v = (low + high) / 2
        if activation * active(length) * velocity(v) + passive(length) + damping * v < force:
            low = v
        else:
            high = v
    return (low + high) / 2


def release(vmax, damping=0.07, slack=0.5):
    """Times of a release from length 1 to 0.9375 within 1 ms, s. Lengths are over l0; `slack` is lTs / l0."""
    def course(t):
        return 1 + slack - 0.0625 * min(max(t / 1e-3, 0.0), 1.0)

    def force(t, length):
        return tendon((course(t) - length - slack) / slack)

    # Isometric equilibrium before the release
    low, high = 0.8, 1.0
    for _ in range(100):
        length = (low + high) / 2
        if force(0, length) > active(length) + passive(length):
            low = length
        else:
            high = length
    step, t, samples = 1e-4, 0.0, []

    def rate(at, of):
        return vmax * speed(of, force(at, of), 1.0, damping)

    while t < 0.2:
        samples.append((t, force(t, length)))
        a = rate(t, length)
        b = rate(t + step / 2, length + step / 2 * a)
        c = rate(t + step / 2, length + step / 2 * b)
        d = rate(t + step, length + step * c)
        length += step / 6 * (a + 2 * b + 2 * c + d)
        t += step
    least = min(range(len(samples)), key=lambda i: samples[i][1])
    final = samples[-1][1]

    def back(share):
        for i in range(least + 1, len(samples)):
            (t0, f0), (t1, f1) = samples[i - 1], samples[i]
            if f1 >= share * final:
                return t0 + (t1 - t0) * (share * final - f0) / (f1 - f0)
        raise ValueError("the force does not come back")

    return {"t50_s": back(0.5), "t90_s": back(0.9), "final_f0": final, "before_f0": samples[0][1]}


def main():
    results = {f"v-{vmax}": release(vmax) for vmax in (10, 4, 2)}
    print(json.dumps(results, indent=1))
    if sys.argv[1:2] != ["--check"]:
        return 0
    file = pathlib.Path(sys.argv[2]) / "samples/figures/11b/experiment.json"
    wrong = 0
    for check in json.loads(file.read_text())["checks"]:
        quantity, run = check["measured"].split("/")
        if quantity not in ("t50_s", "t90_s") or run not in results:
            continue
        value, low, high = results[run][quantity], check["low"], check["high"]
        if not low < value < high or high - low > 0.15 * value:
            print(f"{check['measured']}: this program has {value:.5f}, the band is {low} to {high}")
            wrong += 1
    curves = {"active": active, "passive": passive, "velocity": velocity, "tendon": tendon}
    file = pathlib.Path(sys.argv[2]) / "samples/figures/muscle-curves/experiment.json"
    for check in json.loads(file.read_text())["checks"]:
        parts = check["measured"].split("/")
        if parts[:2] != ["value", "zajac"] or "one_fibre.py" not in check.get("note", ""):
            continue
        value = curves[parts[2]](float(parts[3]))
        if not check["low"] < value < check["high"] or check["high"] - check["low"] > 2.1e-5:
            print(f"{check['measured']}: this program has {value:.6f}, the band is {check['low']} to {check['high']}")
            wrong += 1
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
