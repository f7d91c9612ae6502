# SPDX-License-Identifier: MIT
"""Plays a script and writes the path of two landmarks as a table, without a picture.

    python3 play.py SCRIPT.json path.tsv
"""
import sys

import risorius

script = {
    "format": "risorius-script",
    "version": 1,
    "rig": str(risorius.data_folder() / "rigs/adult/rig.json"),
    "duration_s": 1.0,
    "fps": 30,
    "events": [{"expression": "surprise", "start_s": 0.1, "onset_s": 0.2, "hold_s": 0.3, "offset_s": 0.3}],
}
face = risorius.Face()
rows = ["t_s\tbrow_y_mm\tchin_y_mm"]
face.play(
    sys.argv[1] if len(sys.argv) > 1 else script,
    lambda t_s: rows.append("%.4f\t%.3f\t%.3f" % (t_s, 1e3 * face.landmark("bm_l")[1], 1e3 * face.landmark("pg")[1])),
)
with open(sys.argv[2] if len(sys.argv) > 2 else "path.tsv", "w") as table:
    table.write("\n".join(rows) + "\n")
print("%d frames" % (len(rows) - 1))
