# SPDX-License-Identifier: MIT
"""How far does a smile depend on the stiffness of the fat and the strength of the muscles? Spread and Sobol indices.

    python3 dependence.py [ROWS]
"""
import sys

import risorius

rows = int(sys.argv[1]) if len(sys.argv) > 1 else 16
found = risorius.study(
    poses=["AU12"],
    landmarks=["ch_l", "bm_l"],
    vary={
        "fat": {"of": "tissue/deep_shear_pa", "factor": {"log_uniform": [0.5, 2]}},
        "force": {"of": "tissue/force_scale", "factor": {"log_uniform": [0.5, 2]}},
    },
    samples=rows,
    method="sobol",
    seed=1,
)
corner = found.landmarks.index("ch_l")
moved = {name: values[0, corner] for name, values in found.spread.items()}
print("%d faces; the corner of the mouth moves by %.2f mm, 5 to 95 %%: %.2f to %.2f mm" % (
    len(found.samples), moved["rig_mm"], moved["p5_mm"], moved["p95_mm"]))
print("parameter\tfirst_order\ttotal")
for p, name in enumerate(found.parameters):
    print("%s\t%.2f\t%.2f" % (name, found.first[0, corner, p, 0], found.total[0, corner, p, 0]))
