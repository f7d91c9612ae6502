#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""`risorius export` against a strict reader, against VTK's own readers where python3-vtk9 is installed, and against the Python module
where it is built.

    tests/vtk/export_test.py PROGRAM SOURCE MODULE
"""
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True  # the sources stay as they are

import strict_reader  # noqa: E402

PROGRAM, SOURCE, MODULE = sys.argv[1:4]
TIMES = [0, 0.25, 0.5]
SCRIPT = {
    "format": "risorius-script", "version": 1, "fps": 20, "duration_s": 0.5, "rig": SOURCE + "/rigs/adult/rig.json",
    "channels": {
        "zygomaticus_major": {"keys": [[0, 0], [0.25, 0.6]]},
        "risorius.l": {"keys": [[0, 0], [0.25, 0.5]]},
        "jaw_open": {"keys": [[0, 0], [0.25, 0.3]]},
        "orbicularis_oris_upper_marginal": {"keys": [[0, 0], [0.25, 0.3]]},
        "head_yaw_deg": {"keys": [[0, 0], [0.5, 10]]},
    },
}


def tuples(array):
    components, values = array
    return [values[i:i + components] for i in range(0, len(values), components)]


def determinant(a, b, c):
    return (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]))


class Exported(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        root = pathlib.Path(cls.folder.name)
        (root / "script.json").write_text(json.dumps(SCRIPT))
        cls.out = {}
        for encoding in ("appended", "ascii"):
            cls.out[encoding] = root / encoding
            cls.run_export(root, encoding, cls.out[encoding])
        cls.meshes = {path.name: strict_reader.read_mesh(path) for path in sorted(cls.out["appended"].glob("*.vt[up]"))}
        cls.record = json.loads((cls.out["appended"] / "results.json").read_text())

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @staticmethod
    def run_export(root, encoding, out):
        subprocess.run([PROGRAM, "export", root / "script.json", "-o", out, "--encoding", encoding, "--quality", "draft", "--quiet",
                        "--times", ",".join(map(str, TIMES))], check=True, cwd=root)

    def test_the_series_name_every_file_and_time(self):
        found = set()
        for name in ("tissue", "fibres", "solids", "skin"):
            steps = strict_reader.read_series(self.out["appended"] / f"{name}.pvd")
            self.assertEqual([time for time, _, _ in steps], TIMES)
            found |= {path.name for _, _, path in steps}
            for time, _, path in steps:
                self.assertEqual(self.meshes[path.name]["time_s"], time)
        everything = strict_reader.read_series(self.out["appended"] / "face.pvd")
        self.assertEqual({path.name for _, _, path in everything}, found)
        self.assertEqual({part for _, part, _ in everything}, {0, 1, 2, 3})
        self.assertEqual(set(self.meshes), found)
        self.assertEqual(set(self.record["files"]), {path.name for path in self.out["appended"].iterdir()})

    def test_text_and_binary_have_the_same_numbers(self):
        for name, mesh in self.meshes.items():
            self.assertEqual(strict_reader.read_mesh(self.out["ascii"] / name), mesh, name)

    def test_two_runs_have_the_same_bytes(self):
        with tempfile.TemporaryDirectory() as folder:
            again = pathlib.Path(folder) / "again"
            self.run_export(pathlib.Path(self.folder.name), "appended", again)
            for path in self.out["appended"].iterdir():
                self.assertEqual((again / path.name).read_bytes(), path.read_bytes(), path.name)

    def test_volume_and_stress_follow_from_the_positions(self):
        mesh = self.meshes["tissue_0002.vtu"]
        moved = tuples(mesh["point_data"]["displacement_m"])
        now = mesh["points"]
        rest = [[p - u for p, u in zip(*pair)] for pair in zip(now, moved)]

        def volume(cell, points):
            a, b, c, d = (points[i] for i in cell)
            return determinant(*[[q - p for p, q in zip(a, e)] for e in (b, c, d)])

        stress, mises = tuples(mesh["cell_data"]["stress_pa"]), mesh["cell_data"]["von_mises_pa"][1]
        # Only the neck follows a part of the turn of the head, which is no strain: compare where all corners turn alike
        for i, cell in enumerate(mesh["cells"]):
            if min(rest[k][1] for k in cell) < -0.02:
                continue
            ratio = volume(cell, now) / volume(cell, rest)
            self.assertAlmostEqual(mesh["cell_data"]["J"][1][i], ratio, delta=2e-3)
            xx, yy, zz, xy, yz, xz = stress[i]
            mean = (xx + yy + zz) / 3
            deviator = (xx - mean) ** 2 + (yy - mean) ** 2 + (zz - mean) ** 2 + 2 * (xy * xy + yz * yz + xz * xz)
            self.assertAlmostEqual(mises[i], math.sqrt(1.5 * deviator), delta=1e-9 * (1 + mises[i]))
        self.assertGreater(max(mises), 500)
        self.assertLess(max(self.meshes["tissue_0000.vtu"]["cell_data"]["von_mises_pa"][1]), 0.1 * max(mises))

    def test_muscles_that_act_are_short_and_pull(self):
        columns = self.record["columns"]
        for name, of, muscle, activation in (("solids", "solids_0002.vtu", "zygomaticus_major.l", 0.6),
                                             ("fibres", "fibres_0002.vtu", "risorius.l", 0.5)):
            data, rest = self.meshes[of]["cell_data"], self.meshes[of.replace("2.", "0.")]["cell_data"]
            mine = [i for i, column in enumerate(data["column"][1]) if columns[int(column)] == muscle]
            self.assertTrue(mine, name)

            def mean(fields, key):
                return sum(fields[key][1][i] for i in mine) / len(mine)

            self.assertAlmostEqual(mean(data, "activation"), activation, delta=0.05)
            self.assertLess(mean(data, "stretch"), mean(rest, "stretch") - 0.02)
            self.assertGreater(mean(data, "tension_n"), mean(rest, "tension_n") + 0.01)
            for x, y, z in tuples(data["direction"]):
                self.assertAlmostEqual(math.hypot(x, y, z), 1, places=9)

    def test_closed_lips_press(self):
        pressure = self.meshes["tissue_0002.vtu"]["point_data"]["contact_pa"][1]
        self.assertGreaterEqual(min(pressure), 0)
        self.assertGreater(max(pressure), 10)
        self.assertLess(sum(p > 0 for p in pressure), 0.5 * len(pressure))

    def test_the_skin_lies_on_the_tissue(self):
        skin, tissue = self.meshes["skin_0002.vtp"], self.meshes["tissue_0002.vtu"]
        box = [(min(p[k] for p in tissue["points"]), max(p[k] for p in tissue["points"])) for k in range(3)]
        near = sum(all(low - 0.01 < p[k] < high + 0.01 for k, (low, high) in enumerate(box)) for p in skin["points"])
        self.assertGreater(near, 0.3 * len(skin["points"]))
        self.assertGreater(max(math.hypot(*u) for u in tuples(skin["point_data"]["displacement_m"])), 0.005)

    def test_vtk_reads_it_without_a_word(self):
        try:
            import vtk
        except ImportError:
            self.skipTest("python3-vtk9 is not installed")
        said = []
        for encoding in ("appended", "ascii"):
            for name, mesh in self.meshes.items():
                reader = vtk.vtkXMLPolyDataReader() if name.endswith(".vtp") else vtk.vtkXMLUnstructuredGridReader()
                for event in ("ErrorEvent", "WarningEvent"):
                    reader.AddObserver(event, lambda *what: said.append(what))
                reader.SetFileName(str(self.out[encoding] / name))
                reader.Update()
                got = reader.GetOutput()
                self.assertEqual(got.GetNumberOfPoints(), len(mesh["points"]))
                self.assertEqual(got.GetNumberOfCells(), len(mesh["cells"]))
                self.assertEqual([got.GetPoint(i) for i in range(0, len(mesh["points"]), 97)], mesh["points"][::97])
                for data, mine in ((got.GetPointData(), mesh["point_data"]), (got.GetCellData(), mesh["cell_data"])):
                    self.assertEqual({data.GetArrayName(i) for i in range(data.GetNumberOfArrays())}, set(mine))
                    for key, array in mine.items():
                        rows = tuples(array)
                        self.assertEqual([data.GetArray(key).GetTuple(i) for i in range(0, len(rows), 89)],
                                         [tuple(row) for row in rows[::89]])
                if not name.endswith(".vtp") and mesh["cells"]:
                    self.assertEqual(got.GetCellType(0), mesh["types"][0])
                    if mesh["types"][0] in (10, 12) and name.endswith("_0000.vtu"):
                        quality = vtk.vtkCellSizeFilter()
                        quality.SetInputData(got)
                        quality.Update()
                        sizes = quality.GetOutput().GetCellData().GetArray("Volume")
                        self.assertGreater(min(sizes.GetValue(i) for i in range(sizes.GetNumberOfTuples())), 0)
        self.assertEqual(said, [])

    def test_python_has_the_same_positions(self):
        sys.path.insert(0, MODULE)
        try:
            import numpy
            import risorius
        except ImportError as missing:
            self.skipTest(f"the Python module is not there: {missing}")
        # Nodes of the module are in the head frame: here the head keeps still
        still = dict(SCRIPT, duration_s=0.55,
                     channels={name: keys for name, keys in SCRIPT["channels"].items() if not name.startswith("head")})
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            (root / "script.json").write_text(json.dumps(still))
            self.run_export(root, "appended", root / "out")
            face = risorius.Face(SOURCE + "/rigs/adult/rig.json", quality="draft")
            seen = {}
            face.play(still, lambda t_s: seen.update({
                round(t_s, 6): (numpy.array(face.vertices), numpy.array(face.nodes), face.fields())}))
            vertices, nodes, fields = seen[0.5]
            tissue = strict_reader.read_mesh(root / "out" / "tissue_0002.vtu")
            solids = strict_reader.read_mesh(root / "out" / "solids_0002.vtu")
            skin = strict_reader.read_mesh(root / "out" / "skin_0002.vtp")
            count = len(tissue["points"])
            self.assertEqual(count + len(solids["points"]), len(nodes))
            self.assertLess(numpy.abs(numpy.array(tissue["points"]) - nodes[:count]).max(), 1e-6)
            self.assertLess(numpy.abs(numpy.array(solids["points"]) - nodes[count:]).max(), 1e-6)
            self.assertEqual(tissue["cells"], face.tets.tolist())
            fibres = strict_reader.read_mesh(root / "out" / "fibres_0002.vtu")
            for name, mesh in (("tissue", tissue), ("fibres", fibres), ("solids", solids)):
                self.assertEqual([list(cell) for cell in mesh["cells"]], fields[name]["cells"].tolist())
                of = {**mesh["cell_data"], **mesh["point_data"]}
                compared = [key for key in of if key in fields[name]]
                self.assertGreaterEqual(len(compared), {"tissue": 4, "fibres": 5, "solids": 8}[name])
                for key in compared:
                    values = numpy.array(of[key][1]).reshape(fields[name][key].shape)
                    scale = max(numpy.abs(values).max(), 1e-9)
                    self.assertLess(numpy.abs(values - fields[name][key]).max(), 1e-6 * scale, f"{name}, {key}")
            self.assertLess(self.farthest(numpy, skin["points"], vertices), 1e-6)
            moved = numpy.array(face.rest_vertices)
            self.assertGreater(self.farthest(numpy, skin["points"], moved), 1e-3)

    @staticmethod
    def farthest(numpy, points, vertices):
        points = numpy.array(points)[::50]
        return max(numpy.min(numpy.linalg.norm(vertices - p, axis=1)) for p in points)


if __name__ == "__main__":
    os.environ.setdefault("LC_ALL", "C")
    unittest.main(argv=sys.argv[:1])
