# SPDX-License-Identifier: MIT
"""A cantilever under its own weight against the beam of Timoshenko, for several numbers of cells across.

    w = q L^4 / (8 E I) + q L^2 / (2 kappa G A),  kappa = 5/6
"""
import risorius

length, height, young, nu, density, g = 0.5, 0.1, 200e3, 0.3, 1000.0, 1.0
q, area, inertia = density * g * height**2, height**2, height**4 / 12
shear = young / (2 * (1 + nu))
timoshenko = q * length**4 / (8 * young * inertia) + q * length**2 / (2 * 5 / 6 * shear * area)

for across in (1, 2, 3):
    body = risorius.SoftBody(
        {
            "kind": "solid",
            "discretisation": "cells",
            "grid": [5 * across + 1, across + 1, across + 1],
            "rest": {"block_m": [length, height, height]},
            "material": {"young_pa": young, "poisson_ratio": nu, "density_kg_per_m3": density},
            "fixed": [{"a1": "first"}],
            "gravity_m_per_s2": [0, 0, -g],
        },
        method="quasi_static",
    )
    rest = body.nodes[:, 2].copy()
    tip = body.nodes[:, 0] > body.nodes[:, 0].max() - 1e-6
    body.advance(1)
    sag = (rest - body.nodes[:, 2])[tip].mean()
    print("%d cells across: %.3f mm, %+.1f %% of Timoshenko's %.3f mm" % (across, 1e3 * sag, 100 * (sag / timoshenko - 1), 1e3 * timoshenko))
