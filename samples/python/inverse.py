# SPDX-License-Identifier: MIT
"""Which activations bring the landmarks where they were measured? Gauss-Newton with the gradients of the face.

The "measurement" is made with known activations, so that the answer can be checked.
"""
import numpy as np

import risorius

face = risorius.Face()
names = ["zygomaticus_major.l", "zygomaticus_major.r", "frontalis_medial.l", "frontalis_medial.r"]
truth = np.array([0.3, 0.15, 0.25, 0.4])
marks = [np.argmin(np.linalg.norm(face.rest_vertices - face.landmark(m), axis=1)) for m in ("ch_l", "ch_r", "bm_l", "bm_r", "bc_l", "bc_r")]


def settled(activation):
    face.solve_equilibrium(dict(zip(names, activation)))
    return face.vertices[marks].ravel().copy()


measured = settled(truth)
found = np.full(len(names), 0.1)
for iteration in range(6):
    error = settled(found) - measured
    print("%d: %.4f mm, %s" % (iteration, 1e3 * np.sqrt(np.mean(error**2)), np.round(found, 3)))
    jacobian = face.sensitivities(names)[:, marks].reshape(len(names), -1).T
    found = np.clip(found - np.linalg.lstsq(jacobian, error, rcond=None)[0], 0, 1)
print("largest error of an activation: %.4f" % np.abs(found - truth).max())
