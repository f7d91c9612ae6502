# SPDX-License-Identifier: MIT
"""A parameter study: how far each of several muscles moves the corner of the mouth, at three activations. Prints a table."""
import numpy as np

import risorius

face = risorius.Face()
rest = face.landmark("ch_l")
print("muscle\tactivation\tmoved_mm\tforce_n")
for muscle in ("zygomaticus_major", "risorius", "depressor_anguli_oris"):
    for activation in (0.25, 0.5, 1.0):
        face.solve_equilibrium({muscle: activation})
        moved = 1e3 * np.linalg.norm(face.landmark("ch_l") - rest)
        print("%s\t%.2f\t%.2f\t%.2f" % (muscle, activation, moved, face.muscle(muscle, "l")["force_n"]))
