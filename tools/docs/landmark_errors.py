#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Measures `risorius landmarks` on heads whose landmarks are known: the table of docs/decisions/0091.

    landmark_errors.py RISORIUS FOLDER [--only NAME ...] [--seeds SEED ...] [--modes NUMBER] [--each ID ...]

Heads are the two of ../shared and MakeHuman's woman, compared with the adult; the adult, the named people, and people that
`risorius head --seed` draws, compared with ICT and MakeHuman, as they share the topology of the adult; and heads drawn with the
identity modes of ICT. FOLDER keeps the meshes. Errors are in mm: median, 90 %, largest; `--each` lists those of single landmarks,
as the way from the true place: x to the left, y up, z forward."""
import argparse
import json
import random
import resource
import statistics
import struct
import subprocess
import time
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
SHARED = SOURCE.parent / "shared/data/heads"
TRUTH = SOURCE / "tests/data/heads"
ICT, MAKEHUMAN = SHARED / "ict/ict_neutral.obj", SHARED / "makehuman/mh_head.obj"
ADULT = SOURCE / "models/adult"
FIRST = ["imani", "oskar", "ada", "bruno", "kenji", "mei", "sekou", "greta", "abena", "haruto", "priya", "elin", "jabari"]
REQUIRED = "n prn sn ls sto li pg me t_l t_r en_l en_r ex_l ex_r ps_l ps_r pi_l pi_r ch_l ch_r".split()


def vertices(mesh):
    with open(mesh, encoding="utf-8") as lines:
        return [tuple(map(float, line.split()[1:4])) for line in lines if line.startswith("v ")]


def truth_of(mesh, *files):
    """Landmarks in the units of the mesh; later files overrule earlier ones."""
    at, points = {}, vertices(mesh)
    for file in files:
        for name, one in json.loads(Path(file).read_text())["landmarks"].items():
            at[name] = points[one["vertex"]] if "vertex" in one else tuple(one["xyz"])
    return at


def family(mesh):
    return truth_of(mesh, ADULT / "landmarks.json", ADULT / "landmarks_by_definition.json")


def person(program, folder, name, *options):
    mesh = folder / name / "head.obj"
    if not mesh.exists():
        subprocess.run([program, "head", *options, "--mesh-only", "--quiet", "-o", folder / name], check=True)
    return mesh


def of_modes(folder, seed):
    """A head with random coefficients of ICT's identity modes, of one standard deviation each."""
    mesh = folder / f"ict{seed}.obj"
    if mesh.exists():
        return mesh
    points = vertices(ICT)
    count = 3 * len(points)
    data = (SHARED / "ict/ict_identity20.f32").read_bytes()
    draw = random.Random(seed)
    moved = [x for p in points for x in p]
    for mode in range(len(data) // (4 * count)):
        share = draw.gauss(0, 1)
        for i, x in enumerate(struct.unpack_from(f"<{count}f", data, 4 * count * mode)):
            moved[i] += share * x
    v = 0
    with open(ICT, encoding="utf-8") as lines, open(mesh, "w", encoding="utf-8") as out:
        for line in lines:
            if line.startswith("v "):
                line = "v {:.6f} {:.6f} {:.6f}\n".format(*moved[3 * v : 3 * v + 3])
                v += 1
            out.write(line)
    return mesh


def measured(program, folder, name, mesh, truth, unit_mm, templates):
    out = folder / f"{name}_found.json"
    begin, used = time.monotonic(), resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    command = [program, "landmarks", mesh, "-o", out, "--quiet", "--no-cache"]
    for template in templates:
        command += ["--template", f"{template[0]},{template[1]}"]
    subprocess.run(command, check=True)
    wall, user = time.monotonic() - begin, resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - used
    found = json.loads(out.read_text())["landmarks"]
    ways = {id: [unit_mm * (a - b) for a, b in zip(found[id]["xyz"], truth[id])] for id in truth if id in found}
    return ways, wall, user


def length(way):
    return sum(x * x for x in way) ** 0.5


def summary(errors):
    """Median, the error that 90 % do not exceed, and the largest."""
    errors = sorted(errors)
    return statistics.median(errors), errors[-(-9 * len(errors) // 10) - 1], errors[-1]


def heads(options):
    program, folder = options.program, options.folder
    ict, makehuman = TRUTH / "ict_landmarks.json", TRUTH / "makehuman_landmarks.json"
    others = [(ICT, ict), (MAKEHUMAN, makehuman)]
    woman = SHARED / "makehuman/mh_id1.obj"
    yield "ICT-FaceKit", lambda: (ICT, truth_of(ICT, ict), 10, [])
    yield "MakeHuman", lambda: (MAKEHUMAN, truth_of(MAKEHUMAN, makehuman), 10, [])
    yield "MakeHuman-woman", lambda: (woman, truth_of(woman, makehuman), 10, [])
    yield "adult", lambda: (ADULT / "head.obj", family(ADULT / "head.obj"), 1, others)
    names = sorted(file.stem for file in (SOURCE / "models/identities").glob("*.json"))
    for name in FIRST + [name for name in names if name not in FIRST]:

        def named(name=name):
            mesh = person(program, folder, name, "--identity", name)
            return mesh, family(mesh), 1, others

        yield name, named
    for seed in options.seeds:

        def drawn(seed=seed):
            mesh = person(program, folder, f"seed{seed}", "--seed", str(seed))
            return mesh, family(mesh), 1, others

        yield f"seed{seed}", drawn
    for seed in range(1, options.modes + 1):

        def of_ict(seed=seed):
            mesh = of_modes(folder, seed)
            return mesh, truth_of(mesh, ict), 10, []

        yield f"modes{seed}", of_ict


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--only", nargs="*")
    parser.add_argument("--seeds", nargs="*", type=int, default=[])
    parser.add_argument("--modes", type=int, default=0)
    parser.add_argument("--each", nargs="*", default=[])
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    rows, words = [], lambda numbers: ", ".join(f"{x:.1f}" for x in numbers)
    print("| head | required 20 | all 109 | wall s | processor s |\n|---|---|---|---|---|")
    for name, make in heads(options):
        if options.only and name not in options.only:
            continue
        mesh, truth, unit_mm, templates = make()
        ways, wall, user = measured(options.program, options.folder, name, mesh, truth, unit_mm, templates)
        rows.append([summary(length(ways[id]) for id in REQUIRED), summary(map(length, ways.values()))])
        print(f"| {name} | {words(rows[-1][0])} | {words(rows[-1][1])} | {wall:.1f} | {user:.1f} |", flush=True)
        for id in options.each:
            print(f"    {id}: {length(ways[id]):.1f} ({words(ways[id])})", flush=True)
    if rows:
        mean = [[statistics.mean(row[k][i] for row in rows) for i in range(3)] for k in range(2)]
        print(f"| mean of {len(rows)} | {words(mean[0])} | {words(mean[1])} | | |")


if __name__ == "__main__":
    main()
