# SPDX-License-Identifier: MIT
"""Facial animation by muscles.

    import risorius

    face = risorius.Face()                      # the adult that comes with Risorius
    face.solve_equilibrium({"AU6": 0.7, "AU12": 1})   # a smile
    print(face.landmark("ch_l"))                # the left corner of the mouth, m
    picture = face.render(512, 512)             # height x width x 4

Positions are in metres: x to the subject's left, y up, z forward. Errors in input are risorius.Error, a ValueError.
"""
import os as _os
import pathlib as _pathlib

from ._core import Error, Face, RunError, SoftBody, Study, __version__, data_folder, render, set_data_folder, study, write_feb

__all__ = ["Error", "Face", "RunError", "SoftBody", "Study", "data_folder", "render", "set_data_folder", "study", "write_feb", "__version__"]

# A wheel brings the data along.
_data = _pathlib.Path(__file__).parent / "data"
if "RISORIUS_DATA" not in _os.environ and _data.is_dir():
    set_data_folder(_data)
