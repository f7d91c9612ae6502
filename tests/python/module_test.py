#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The Python module: numbers of the library, arrays without copies, errors, studies, samples and the wheel.

    module_test.py FOLDER_OF_THE_MODULE FOLDER_OF_THE_SOURCES PROGRAM [TEST...]
"""
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import xml.etree.ElementTree as ElementTree
import zipfile

MODULE, SOURCES, PROGRAM = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3]
sys.path.insert(0, str(MODULE))
os.environ["RISORIUS_DATA"] = str(SOURCES)

import numpy as np  # noqa: E402

import risorius  # noqa: E402

# A shell that runs this in the background ignores the signal, and so would Python.
signal.signal(signal.SIGINT, signal.default_int_handler)


class FaceTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.face = risorius.Face()

    def setUp(self):
        self.face.reset()

    def test_a_smile_raises_the_corners_alike(self):
        rest = {side: self.face.landmark("ch_" + side) for side in "lr"}
        self.assertTrue(self.face.settle({"AU12": 1}))  # the former name
        moved = {side: 1e3 * (self.face.landmark("ch_" + side) - rest[side]) for side in "lr"}
        self.assertGreater(moved["l"][1], 8)
        self.assertLess(np.abs(moved["l"] - moved["r"] * [-1, 1, 1]).max(), 0.7)

    def test_names_add_up_and_intensities_are_seen_shares(self):
        rest = self.face.landmark("ch_l")
        way = []
        for intensity in (0.5, 1):
            self.face.solve_equilibrium({"AU12": intensity})
            way.append(np.linalg.norm(self.face.landmark("ch_l") - rest))
        self.assertAlmostEqual(way[0] / way[1], 0.5, delta=0.06)
        self.face.solve_equilibrium({"jaw_open": 0.5, "AU12.r": 1})
        self.assertLess(np.linalg.norm((self.face.landmark("ch_l") - rest)[:2]), 12e-3)
        self.assertEqual(self.face.activation[self.face.columns.index("zygomaticus_major.l")], 0)
        self.assertGreater(self.face.activation[self.face.columns.index("zygomaticus_major.r")], 0.2)

    def test_arrays_look_at_the_memory_of_the_face(self):
        for name, columns in (("vertices", 3), ("rest_vertices", 3), ("nodes", 3), ("tets", 4), ("triangles", 3)):
            array = getattr(self.face, name)
            self.assertEqual(array.shape[1], columns, name)
            self.assertFalse(array.flags.owndata, name)
            self.assertFalse(array.flags.writeable, name)
        vertices, nodes, activation = self.face.vertices, self.face.nodes, self.face.activation
        before = vertices.copy(), nodes.copy()
        self.face.step({"jaw_open": 0.3, "AU12": 1}, 10)
        self.assertGreater(np.abs(vertices - before[0]).max(), 3e-3)
        self.assertGreater(np.abs(nodes - before[1]).max(), 3e-3)
        self.assertGreater(activation.max(), 0.1)
        self.assertTrue(np.array_equal(vertices, self.face.vertices))

    def test_vertices_that_are_looked_at_late_are_those_of_now(self):
        self.assertIsNotNone(self.face.vertices)
        other = risorius.Face()
        for face in (self.face, other):
            face.step({"AU12": 1}, 4)
            face.step(steps=2)
        self.assertTrue(np.array_equal(self.face.vertices, other.vertices))

    def test_an_array_keeps_its_face_alive(self):
        vertices = risorius.Face(quality="draft").vertices
        self.assertTrue(np.isfinite(vertices).all())

    def test_steps_are_those_of_the_time_and_repeat_to_the_bit(self):
        paths = []
        for _ in range(2):
            self.face.reset()
            self.face.step({"AU1": 1}, 30)
            paths.append(self.face.vertices.copy())
        self.assertAlmostEqual(self.face.time_s, 0.5, places=9)
        self.assertTrue(np.array_equal(*paths))

    def test_sensitivities_are_derivatives(self):
        name, step = "zygomaticus_major.l", 0.01
        self.face.solve_equilibrium({name: 0.3})
        slope = self.face.sensitivities([name, "jaw_open"])
        self.assertEqual(slope.shape, (2,) + self.face.vertices.shape)
        ends = []
        for value in (0.3 - step, 0.3 + step):
            self.face.solve_equilibrium({name: value})
            ends.append(self.face.vertices.copy())
        difference = (ends[1] - ends[0]) / (2 * step)
        self.assertLess(np.abs(slope[0] - difference).max(), 0.1 * np.abs(difference).max())

    def test_arrays_of_vertices_follow_the_steps_while_somebody_holds_them(self):
        drive = {"zygomaticus_major": 0.6}
        self.face.step(drive, 5)
        held = self.face.vertices
        corner = int(np.argmin(np.linalg.norm(self.face.rest_vertices - self.face.landmark("ch_l"), axis=1)))
        part = held[corner : corner + 1, 1]
        before = held.copy()
        self.face.step(drive)
        self.assertFalse(np.array_equal(held, before))
        self.assertTrue(np.array_equal(part, self.face.vertices[corner : corner + 1, 1]))
        del held
        before = part.copy()
        self.face.step(drive, 20)
        self.assertFalse(np.array_equal(part, before), "a part of the array holds it as well")
        del part
        self.face.step(drive)
        self.assertTrue(np.isfinite(self.face.vertices).all())

    def test_rig_gradient_is_the_slope_by_numbers_of_the_rig(self):
        # L: the height of the left brow; slopes by faces of rigs with other numbers
        drive = {"frontalis_medial": 0.3}
        corner = int(np.argmin(np.linalg.norm(self.face.rest_vertices - self.face.landmark("bm_l"), axis=1)))
        self.face.solve_equilibrium(drive)
        of_height = np.zeros(self.face.vertices.shape)
        of_height[corner, 1] = 1
        paths = ["tissue/deep_shear_pa", "anatomy/strength/frontalis_medial", "anatomy/solids/zygomaticus_major/strength",
                 "tissue/superficial_shear_pa", "skin/membrane_n_per_m"]
        slopes = self.face.rig_gradient(of_height, paths)
        self.assertLess(slopes[0], 0)  # stiffer tissue moves less
        text = (SOURCES / "rigs/adult/rig.json").read_text().replace("../../", str(SOURCES) + "/").replace(
            "../standard", str(SOURCES / "rigs/standard"))
        with tempfile.TemporaryDirectory() as folder:
            def slope_of(section, key, value):
                heights = []
                for number in (value * 0.9, value / 0.9):
                    rig = json.loads(text)
                    rig.setdefault(section, {})[key] = number
                    file = pathlib.Path(folder, "rig.json")
                    file.write_text(json.dumps(rig))
                    face = risorius.Face(file)
                    face.solve_equilibrium(drive)
                    heights.append(face.vertices[corner, 1])
                return (heights[1] - heights[0]) / -np.log(0.9 * 0.9)

            # The fine layer of skin depends on the last two, beside the nodes.
            for path, value, within in ((0, 910, 0.05), (3, 1950, 0.05), (4, 11.4, 0.05)):
                slope = slope_of(*paths[path].split("/"), value)
                self.assertLess(abs(slopes[path] - slope), within * abs(slope), paths[path])
        # A muscle with k times the strength at activation a pulls as one with k a, but for what it resists when stretched.
        by_activation = 0.3 * self.face.sensitivities(["frontalis_medial.l", "frontalis_medial.r"])[:, corner, 1].sum()
        self.assertLess(abs(slopes[1] - by_activation), 0.15 * abs(by_activation))
        self.assertLess(abs(slopes[2]), 0.01 * abs(slopes[1]))  # a muscle at rest, far away
        for wrong, part in ((["anatomy/thickness/points/*/thickness_mm"], "numbers of"), (["tissue/none"], "a number of the rig")):
            with self.assertRaises(risorius.Error) as caught:
                self.face.rig_gradient(of_height, wrong)
            self.assertIn(part, str(caught.exception))

    def test_fields_are_those_of_the_muscles_and_the_tissue(self):
        self.face.solve_equilibrium({"zygomaticus_major": 0.5})
        fields = self.face.fields()
        self.assertEqual(set(fields), {"tissue", "fibres", "solids"})
        tissue, solids = fields["tissue"], fields["solids"]
        self.assertEqual(tissue["stress_pa"].shape, (len(self.face.tets), 6))
        self.assertTrue(np.array_equal(tissue["cells"], self.face.tets))
        self.assertGreater(tissue["von_mises_pa"].max(), 500)
        active = solids["column"] == self.face.columns.index("zygomaticus_major.l")
        self.assertAlmostEqual(solids["activation"][active].mean(), 0.5, places=6)
        self.assertLess(solids["stretch"][active].mean(), 0.99)
        self.assertLess(np.abs(solids["J"] - 1).max(), 0.1)

    def test_pictures_are_arrays(self):
        rest = self.face.render(96, 128, draft=True)
        self.assertEqual((rest.shape, rest.dtype), ((128, 96, 4), np.uint8))
        self.face.solve_equilibrium({"jaw_open": 1})
        self.assertGreater(np.abs(self.face.render(96, 128, draft=True).astype(int) - rest).mean(), 1)

    def test_play_follows_the_script(self):
        script = {"format": "risorius-script", "version": 1, "rig": "rig.json", "duration_s": 0.5, "fps": 20,
                  "channels": {"jaw_open": {"keys": [[0, 0], [0.5, 1]]}}}
        times, chin = [], []
        self.face.play(script, lambda t: (times.append(t), chin.append(self.face.landmark("pg")[1])))
        self.assertEqual(len(times), 10)
        self.assertTrue(all(a >= b - 1e-4 for a, b in zip(chin, chin[1:])))
        self.assertLess(chin[-1], chin[0] - 0.015)

    def test_errors_say_what_was_expected(self):
        for wrong, part in (({"AU99": 1}, "the name of a muscle, an action unit"), ({"procerus": float("nan")}, "NaN")):
            with self.assertRaises(risorius.Error) as caught:
                self.face.solve_equilibrium(wrong)
            self.assertIn(part, str(caught.exception))
            self.assertIsInstance(caught.exception, ValueError)
        with self.assertRaises(risorius.Error):
            risorius.Face("no/such/rig.json")
        with self.assertRaises(TypeError):
            self.face.solve_equilibrium({"AU12": "much"})
        with self.assertRaises(ZeroDivisionError):
            self.face.play({"format": "risorius-script", "version": 1, "rig": "r", "duration_s": 1}, lambda t: 1 / 0)


class SoftBodyTest(unittest.TestCase):
    BODY = {"kind": "solid", "discretisation": "cells", "grid": [4, 4, 4], "rest": {"block_m": [0.3, 0.3, 0.3]},
            "material": {"young_pa": 20000, "poisson_ratio": 0.45, "density_kg_per_m3": 1000, "viscosity_pa_s": 20},
            "fixed": [{"a3": "last"}]}

    def test_a_hanging_cube_sags_and_keeps_its_volume(self):
        body = risorius.SoftBody(self.BODY)
        volume, lowest = body.volume_m3, body.nodes[:, 2].min()
        body.advance(0.2)
        self.assertAlmostEqual(body.time_s, 0.2, places=9)
        self.assertLess(body.nodes[:, 2].min(), lowest - 1e-3)
        self.assertLess(abs(body.volume_m3 / volume - 1), 0.03)
        self.assertEqual(body.grid, [4, 4, 4])
        with self.assertRaises(risorius.Error) as caught:
            risorius.SoftBody(dict(self.BODY, grid=[1, 4, 4]))
        self.assertIn("body:/grid", str(caught.exception))


class RenderTest(unittest.TestCase):
    SCRIPT = {"format": "risorius-script", "version": 1, "rig": str(SOURCES / "rigs/adult/rig.json"), "duration_s": 0.2,
              "fps": 20, "events": [{"expression": "surprise", "start_s": 0, "onset_s": 0.1}]}

    def test_a_script_becomes_a_video_with_its_record(self):
        with tempfile.TemporaryDirectory() as folder:
            seen = []
            record = risorius.render(self.SCRIPT, pathlib.Path(folder) / "x.mkv", size=(64, 64), draft=True,
                                     progress=lambda fraction, what: seen.append(fraction))
            self.assertTrue((pathlib.Path(folder) / "x.mkv").exists())
            self.assertEqual(record["format"], "risorius-run")
            self.assertTrue(seen and seen == sorted(seen))

    def test_ctrl_c_stops_and_leaves_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
            with self.assertRaises(KeyboardInterrupt):
                risorius.render(dict(self.SCRIPT, duration_s=60), pathlib.Path(folder) / "x.mkv", size=(64, 64), draft=True)
            self.assertEqual(os.listdir(folder), [])


class StudyTest(unittest.TestCase):
    VARY = {"force": {"of": "tissue/force_scale", "factor": {"log_uniform": [0.5, 2]}},
            "each": {"of": "anatomy/strength/*", "factor": {"uniform": [0.9, 1.1]}, "each": True}}

    def test_values_are_those_of_the_program(self):
        wanted = {"poses": ["AU1", "AU12"], "landmarks": ["ch_l", "bm_l"], "vary": self.VARY}
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "study.json")
            file.write_text(json.dumps({
                "format": "risorius-study", "version": 1, "name": "two", "rig": str(SOURCES / "rigs/adult/rig.json"),
                "sample": {"method": "latin_hypercube", "count": 2, "seed": 5, "replicates": 20}, **wanted}))
            subprocess.run([PROGRAM, "study", str(file), "-o", folder + "/out", "--quiet"], check=True)
            table = {name: [line.split("\t") for line in pathlib.Path(folder, "out", name + ".tsv").read_text().splitlines()[1:]]
                     for name in ("samples", "displacements", "spread", "indices")}
        seen = []
        found = risorius.study(**wanted, samples=2, method="latin_hypercube", seed=5, replicates=20,
                               progress=lambda fraction, what: seen.append(fraction))
        self.assertEqual(seen, sorted(seen))
        self.assertEqual((found.parameters, found.poses, found.landmarks), (["force", "each"], ["AU1", "AU12"], ["ch_l", "bm_l"]))
        self.assertEqual(found.displacements_mm.shape, (9, 2, 2, 3))
        self.assertFalse(found.displacements_mm.flags.owndata)
        self.assertFalse(found.displacements_mm.flags.writeable)
        self.assertEqual(found.matrix, [row[1] for row in table["samples"]])
        self.assertEqual(found.row.tolist(), [-1] + [int(row[2]) for row in table["samples"][1:]])
        np.testing.assert_allclose(found.samples, np.array([row[3:5] for row in table["samples"]], float), rtol=1e-8)
        self.assertEqual(found.in_equilibrium.all(axis=1).tolist(), [row[5] == "1" for row in table["samples"]])

        def same(values, rows, first, digits):
            texts = [["%.*f" % (digits, value + 0.0) for value in row] for row in values]
            self.assertEqual([[t.replace("-0." + "0" * digits, "0." + "0" * digits) for t in row] for row in texts],
                             [row[first:] for row in rows])

        same(found.displacements_mm.reshape(-1, 3), table["displacements"], 3, 4)
        keys = ("rig_mm", "mean_mm", "sd_mm", "p5_mm", "p95_mm", "away_p95_mm")
        same(np.stack([found.spread[key].ravel() for key in keys], axis=1), table["spread"], 2, 3)
        of_all = np.concatenate([found.first_of_pose, found.total_of_pose], axis=-1).reshape(-1, 6)
        of_each = np.concatenate([found.first, found.total], axis=-1).reshape(-1, 6)
        same(np.concatenate([of_all, of_each]), table["indices"], 3, 4)

    def test_without_indices_there_are_none(self):
        found = risorius.study(SOURCES / "rigs/adult/rig.json", poses=["AU1"], landmarks=["bm_l"], vary=self.VARY, samples=2,
                               method="random", indices=False, quality="draft")
        self.assertEqual((found.first.shape, len(found.samples)), ((1, 1, 0, 3), 3))

    def test_errors_name_the_place(self):
        for wrong, part in (({"poses": ["AU121"]}, "study:/poses/0"), ({"method": "sobel"}, "study:/sample/method"),
                            ({"samples": 1}, "study:/sample/count"), ({"vary": {"p": {"of": "tissue/none"}}}, "study:/vary/p")):
            with self.assertRaises(risorius.Error) as caught:
                risorius.study(**{"poses": ["AU1"], "vary": self.VARY, **wrong})
            self.assertIn(part, str(caught.exception))

    def test_ctrl_c_stops(self):
        threading.Timer(2, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        begin = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            risorius.study(poses=["AU1"], vary=self.VARY, samples=1024)
        self.assertLess(time.monotonic() - begin, 60)  # all faces would take an hour
        with self.assertRaises(ZeroDivisionError):
            risorius.study(poses=["AU1"], vary=self.VARY, progress=lambda fraction, what: 1 / 0)


class SampleTest(unittest.TestCase):
    def run_sample(self, name, *arguments):
        environment = {**os.environ, "PYTHONPATH": str(MODULE)}
        done = subprocess.run([sys.executable, str(SOURCES / "samples/python" / name), *map(str, arguments)],
                              capture_output=True, text=True, env=environment, timeout=600)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_smile(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertIn("the left corner of the mouth moves by", self.run_sample("smile.py", folder + "/smile.ppm"))
            self.assertEqual((pathlib.Path(folder) / "smile.ppm").stat().st_size, 15 + 512 * 512 * 3)

    def test_cantilever_converges(self):
        errors = [abs(float(line.split("mm, ")[1].split(" %")[0])) for line in self.run_sample("cantilever.py").splitlines()]
        self.assertEqual(errors, sorted(errors, reverse=True))
        self.assertLess(errors[-1], 10)

    def test_inverse_finds_the_activations(self):
        self.assertLess(float(self.run_sample("inverse.py").rsplit(" ", 1)[1]), 0.02)

    def test_mesh_body(self):
        with tempfile.TemporaryDirectory() as folder:
            mesh = pathlib.Path(folder, "one.mesh")
            mesh.write_text("MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
                            "Tetrahedra\n1\n1 2 3 4 7\n")
            described = {
                "kind": "mesh", "mesh": {"file": str(mesh)}, "gravity_m_per_s2": [0, 0, -1],
                "materials": [{"tags": [7], "law": "neo-hookean", "c10_pa": 400, "bulk_pa": 4000, "density_kg_per_m3": 100}],
                "fixed": [{"low_m": [-1, -1, -1], "high_m": [2, 2, 0.5]}]}
            body = risorius.SoftBody(described, method="quasi_static")
            risorius.write_feb(described, pathlib.Path(folder, "one.feb"))
            feb = ElementTree.parse(pathlib.Path(folder, "one.feb")).getroot()
            with self.assertRaises(risorius.Error):
                risorius.write_feb(SoftBodyTest.BODY, pathlib.Path(folder, "none.feb"))
        self.assertEqual(feb.attrib["version"], "4.0")
        self.assertEqual([float(feb.find(f"Material/material/{key}").text) for key in ("c1", "c2", "k", "density")], [400, 0, 4000, 100])
        self.assertEqual(feb.find("Mesh/NodeSet").text, "1,2,3")
        self.assertEqual(feb.find("Loads/body_load/force").text, "0,0,1")
        body.advance(1)
        # One free node: what pulls it down, a quarter of the weight, stretches a column of a third of the volume
        self.assertEqual(body.tets.tolist(), [[0, 1, 2, 3]])
        self.assertLess(body.nodes[3, 2], 1)
        self.assertGreater(body.nodes[3, 2], 0.99)
        self.assertLess(body.volume_m3, 1 / 6)

    def test_belly_pulls_as_its_closed_form(self):
        belly = json.loads((SOURCES / "samples/figures/belly/experiment.json").read_text())["body"]
        belly["mesh"]["file"] = str(SOURCES / "samples/figures/belly/prism.vtk")
        body = risorius.SoftBody(belly, method="quasi_static")
        self.assertEqual(body.fibre_stretch, [1])
        with self.assertRaises(risorius.Error):
            body.set_activation([0.5, 0.5])
        for activation in (0.5, 1):
            body.set_activation([activation])
            body.advance(body.time_s + 1)
            self.assertAlmostEqual(body.holding_n[0, 0], -30 * activation, places=5)

    def test_study(self):
        rows = [line.split("\t") for line in self.run_sample("study.py").splitlines()]
        self.assertEqual(len(rows), 10)
        self.assertGreater(float(rows[3][2]), float(rows[1][2]))

    def test_dependence(self):
        lines = self.run_sample("dependence.py", 2).splitlines()
        self.assertTrue(lines[0].startswith("9 faces; the corner of the mouth moves by"), lines)
        self.assertEqual([line.split("\t")[0] for line in lines[2:]], ["fat", "force"])

    def test_play(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(self.run_sample("play.py", SOURCES / "samples/smile/script.json", folder + "/p.tsv").split()[1], "frames")


class WheelTest(unittest.TestCase):
    def test_a_wheel_brings_everything_along(self):
        with tempfile.TemporaryDirectory() as folder:
            made = subprocess.run([sys.executable, str(SOURCES / "tools/package/make_wheel.py"), str(MODULE.parent), str(SOURCES),
                                   "0.1.0", folder], capture_output=True, text=True)
            self.assertEqual(made.returncode, 0, made.stderr)
            wheel = made.stdout.strip()
            place = folder + "/installed"
            if subprocess.run([sys.executable, "-m", "pip", "--version"], capture_output=True).returncode == 0:
                pip = subprocess.run([sys.executable, "-m", "pip", "install", "--no-index", "--no-deps", "--target", place, wheel],
                                     capture_output=True, text=True)
                self.assertEqual(pip.returncode, 0, pip.stderr)
            else:  # a wheel is an archive
                zipfile.ZipFile(wheel).extractall(place)
            environment = {key: value for key, value in os.environ.items() if key not in ("RISORIUS_DATA", "PYTHONPATH")}
            done = subprocess.run([sys.executable, "-c", "import risorius; print(risorius.data_folder()); "
                                   "print(risorius.Face(quality='draft').vertices.shape)"],
                                  capture_output=True, text=True, cwd=place, env=environment)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn(place + "/risorius/data", done.stdout)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[4:], verbosity=2)
