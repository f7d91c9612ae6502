# SPDX-License-Identifier: MIT
"""A smile in ten lines: prints how far the corner of the mouth moves, and writes a picture.

    python3 smile.py smile.ppm
"""
import sys

import risorius

face = risorius.Face()
rest = face.landmark("ch_l")
face.solve_equilibrium({"AU6": 0.7, "AU12": 1})
moved = 1e3 * (face.landmark("ch_l") - rest)
print("the left corner of the mouth moves by %.1f, %.1f, %.1f mm" % tuple(moved))
picture = face.render(512, 512)[:, :, :3]
with open(sys.argv[1] if len(sys.argv) > 1 else "smile.ppm", "wb") as file:
    file.write(b"P6 %d %d 255\n" % (picture.shape[1], picture.shape[0]) + picture.tobytes())
