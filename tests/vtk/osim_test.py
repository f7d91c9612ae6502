#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Exports the muscles of the adult for OpenSim and reads them with a strict reader: elements and their values are those of models of
OpenSim 4, every frame and every member of a group is there, forces are those that `risorius info` prints, and the activations come back
through `risorius import`.

    osim_test.py RISORIUS SOURCE
"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

RISORIUS, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
MUSCLE = ["min_control", "max_control", "GeometryPath", "max_isometric_force", "optimal_fiber_length", "tendon_slack_length",
          "pennation_angle_at_optimal", "max_contraction_velocity", "ignore_tendon_compliance", "activation_time_constant",
          "deactivation_time_constant"]


def run(*arguments):
    done = subprocess.run([RISORIUS, *map(str, arguments)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


def only(element, *tags):
    """The children of an element, which have these tags in this order."""
    found = [child.tag for child in element]
    assert found == list(tags), f"{element.tag}: {found} in place of {list(tags)}"
    return list(element)


def numbers(element, count):
    out = [float(word) for word in element.text.split()]
    assert len(out) == count and all(map(math.isfinite, out)), element.text
    return out


def objects(element):
    listed, groups = only(element, "objects", "groups")
    return list(listed), list(groups)


def read_path(muscle, frames):
    point_set, = only(muscle.find("GeometryPath"), "PathPointSet")
    points, groups = objects(point_set)
    assert not groups and len(points) >= 2
    out = []
    for point in points:
        assert point.tag == "PathPoint"
        frame, location = only(point, "socket_parent_frame", "location")
        assert frame.text in frames, frame.text
        out.append((frame.text, numbers(location, 3)))
    return out


def read_model(file):
    root = ElementTree.parse(file).getroot()
    assert root.tag == "OpenSimDocument" and root.attrib == {"Version": "40000"}
    model, = only(root, "Model")
    ground, gravity, length, force, bodies, joints, forces = only(
        model, "ground", "gravity", "length_units", "force_units", "BodySet", "JointSet", "ForceSet")
    assert ground.attrib["name"] == "ground" and numbers(gravity, 3) == [0, -9.81, 0]
    assert (length.text, force.text) == ("meters", "N")
    frames = {"/ground"}
    for body in objects(bodies)[0]:
        mass, centre, inertia = only(body, "mass", "mass_center", "inertia")
        assert numbers(mass, 1)[0] > 0 and numbers(centre, 3) and min(numbers(inertia, 6)[:3]) > 0
        frames.add("/bodyset/" + body.attrib["name"])
    held = set()
    for joint in objects(joints)[0]:
        assert joint.tag in ("PinJoint", "WeldJoint")
        own = {frame.attrib["name"]: frame.find("socket_parent").text for frame in joint.find("frames")}
        assert own[joint.find("socket_parent_frame").text] == "/ground"
        held.add(own[joint.find("socket_child_frame").text])
    assert held == frames - {"/ground"}, held
    muscles, groups = objects(forces)
    read = {}
    for muscle in muscles:
        assert muscle.tag == "Millard2012EquilibriumMuscle"
        only(muscle, *MUSCLE)
        name = muscle.attrib["name"]
        assert name not in read and " " not in name, name
        read[name] = {key: float(muscle.find(key).text) for key in MUSCLE if key not in ("GeometryPath", "ignore_tendon_compliance")}
        read[name]["path"] = read_path(muscle, frames)
    members = [member for group in groups for member in group.find("members").text.split()]
    assert sorted(members) == sorted(read)
    return read


def check_muscles(muscles, results, info):
    known = {muscle["id"]: muscle for muscle in info["muscles"]}
    force = {}
    for name, muscle in muscles.items():
        row = results["muscles"][name]
        assert math.isclose(muscle["max_isometric_force"], row["f0_n"], rel_tol=1e-6) and muscle["max_isometric_force"] > 0
        assert len(muscle["path"]) == row["points"]
        force[row["column"]] = force.get(row["column"], 0) + muscle["max_isometric_force"]
        length = sum(math.dist(a[1], b[1]) for a, b in zip(muscle["path"], muscle["path"][1:]))
        fibre = math.hypot(length - muscle["tendon_slack_length"], muscle["optimal_fiber_length"] * math.sin(muscle["pennation_angle_at_optimal"]))
        stretch = fibre / muscle["optimal_fiber_length"]
        assert 0.5 < stretch < 1.6, f"{name}: fibres at {stretch} of their optimal length"
        # The face lies before, the neck below the tragia; +z is the subject's right.
        if name.endswith(("_l", "_r")):
            sign = -1 if name.endswith("_l") else 1
            assert sign * sum(point[1][2] for point in muscle["path"]) > 0, name
    for column, total in force.items():
        of = known[column.rsplit(".", 1)[0] if column.endswith((".l", ".r")) else column]
        assert math.isclose(total, of["greatest_force_n"], rel_tol=1e-4), f"{column}: {total} N, info says {of['greatest_force_n']}"
    simulated = {muscle["id"] for muscle in info["muscles"] if muscle["simulated_as"] != "none"}
    assert {column.split(".")[0] for column in force} == simulated
    jaw = muscles["masseter_superficial_l"]["path"]
    assert jaw[0][0] == "/ground" and jaw[-1][0] == "/bodyset/mandible", jaw


def read_storage(file):
    lines = file.read_text().splitlines()
    end = lines.index("endheader")
    header = dict(line.split("=", 1) for line in lines[1:end])
    columns = lines[end + 1].split("\t")
    rows = [[float(word) for word in line.split("\t")] for line in lines[end + 2:]]
    assert columns[0] == "time" and header["inDegrees"] == "no"
    assert int(header["nRows"]) == len(rows) and int(header["nColumns"]) == len(columns)
    assert all(len(row) == len(columns) for row in rows)
    return columns, rows


def value_at(keys, time):
    for (t0, v0), (t1, v1) in zip(keys, keys[1:]):
        if t0 <= time <= t1:
            return v0 + (v1 - v0) * (time - t0) / (t1 - t0)
    return keys[-1][1]


def main():
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "osim"
        run("export", SOURCE / "samples/smile/script.json", "--format", "osim", "--times", "0,0.25,0.5,0.75", "--quality", "draft", "-o", out)
        results = json.loads((out / "results.json").read_text())
        assert results["files"] == ["activation.sto", "face.osim", "results.json"], results["files"]
        muscles = read_model(out / "face.osim")
        rig = SOURCE / "rigs/adult/rig.json"
        check_muscles(muscles, results, json.loads(run("info", rig, "--json")))
        columns, rows = read_storage(out / "activation.sto")
        assert columns[1:] == list(muscles)
        assert max(max(row[1:]) for row in rows) > 0.3 and min(min(row[1:]) for row in rows) >= 0
        script = pathlib.Path(folder) / "back.json"
        run("import", out / "activation.sto", "--rig", rig, "--tolerance", "0", "-o", script)
        channels = json.loads(script.read_text())["channels"]
        moved = 0
        for c, name in enumerate(columns[1:], 1):
            column = results["muscles"][name]["column"]
            whole = column.rsplit(".", 1)[0]
            channel = channels.get(column) or channels.get(whole)
            for row in rows:
                back = value_at(channel["keys"], row[0]) if channel else 0
                assert abs(back - row[c]) < 2e-5, f"{name} at {row[0]} s: {row[c]} came back as {back}"
            moved += channel is not None
        assert moved >= 4, moved
        print(f"{len(muscles)} muscles, {moved} of them active")


if __name__ == "__main__":
    main()
