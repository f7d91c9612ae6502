# SPDX-License-Identifier: MIT
"""Writes files that are made to break readers: deep, huge, endless, cut, contradictory, or of another kind than their name says.

Each function takes the folder and returns {name: path}; made_inputs.py gives them to the commands."""
import base64
import json
import os
import pathlib
import socket
import struct
import zlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
RIG = str(ROOT / "rigs/adult/rig.json")


def script(**more):
    return {"format": "risorius-script", "version": 1, "rig": RIG, "fps": 10, "duration_s": 0.1,
            "view": {"width_px": 16, "height_px": 16}, **more}


def put(folder, files):
    """Writes bytes, text or JSON."""
    out = {}
    for name, value in files.items():
        path = folder / name
        if isinstance(value, (dict, list)):
            value = json.dumps(value)
        path.write_bytes(value if isinstance(value, bytes) else value.encode("utf-8", "surrogatepass"))
        out[name] = path
    return out


def no_files(folder):
    """What is not a regular file."""
    out = {"zero": pathlib.Path("/dev/zero"), "null": pathlib.Path("/dev/null"), "full": pathlib.Path("/dev/full"),
           "tty": pathlib.Path("/dev/tty"), "memory": pathlib.Path("/proc/self/mem"),
           "missing": folder / "missing.json", "long": folder / ("n" * 300), "deep": folder / "/".join(["d"] * 3000)}
    out["folder"] = folder / "folder.json"
    out["folder"].mkdir()
    out["fifo"] = folder / "fifo.json"
    os.mkfifo(out["fifo"])
    out["socket"] = folder / "socket.json"
    with socket.socket(socket.AF_UNIX) as one:
        here = os.getcwd()
        os.chdir(folder)  # a path of at most 108 bytes
        one.bind("socket.json")
        os.chdir(here)
    out["loop"] = folder / "loop.json"
    out["loop"].symlink_to("loop.json")
    out["dangling"] = folder / "dangling.json"
    out["dangling"].symlink_to("nowhere")
    out["unreadable"] = folder / "unreadable.json"
    out["unreadable"].write_text("{}")
    out["unreadable"].chmod(0)
    out["no_utf8"] = pathlib.Path(os.fsdecode(os.fsencode(folder) + b"/\xff\xfe\x1b[31m.json"))
    out["no_utf8"].write_text("{")
    return out


def any_json(folder):
    """JSON that no format is."""
    good = json.dumps(script())
    return put(folder, {
        "empty.json": "", "blank.json": " \n\t ", "null.json": "null", "number.json": "1e400", "list.json": "[1, 2]",
        "nan.json": '{"duration_s": NaN}', "infinity.json": '{"duration_s": 1e999}',
        "twice.json": '{"format": "risorius-script", "format": "risorius-rig", "version": 1}',
        "surrogate.json": '{"format": "\\ud800"}', "nul.json": '{"form\\u0000at": "a\\u0000b"}',
        "raw_nul.json": b'{"a": "\0"}',
        "utf16.json": good.encode("utf-16"), "utf16_odd.json": good.encode("utf-16")[:-1],
        "utf32.json": good.encode("utf-32"),
        "bom.json": b"\xef\xbb\xbf" + good.encode(), "latin.json": b'{"format": "caf\xe9"}',
        "cut.json": good[:len(good) // 2],
        "trailing.json": good + good, "deep.json": "[" * 201 + "]" * 201, "deepest.json": "[" * 500000 + "]" * 500000,
        "deep_objects.json": '{"a":' * 100000 + "1" + "}" * 100000, "wide.json": "[" + "0," * 3000000 + "0]",
        "long_key.json": json.dumps({"k" * 10000000: 1}),
        "many_keys.json": json.dumps({f"k{i}": i for i in range(200000)}),
        "large.json": "[" + " " * 33000000 + "]", "digits.json": '{"version": ' + "9" * 1000000 + "}",
        "minus.json": '{"version": -0, "format": "risorius-script"}', "comment.json": "// a\n" + good,
        "html.json": "<html></html>",
        "program.json": pathlib.Path("/bin/true").read_bytes(), "gzip.json": zlib.compress(b"0" * 100000000)})


def scripts(folder):
    keys = [[i * 1e-7, i % 2] for i in range(300000)]
    made = {
        "endless": script(fps=240, duration_s=1e9), "hour": script(fps=240, duration_s=1e308),
        "negative": script(duration_s=-1),
        "huge_picture": script(view={"width_px": 1000000000, "height_px": 1000000000}),
        "wide_picture": script(view={"width_px": 16384, "height_px": 16384}),
        "no_picture": script(view={"width_px": 0, "height_px": -1}),
        "many_keys": script(channels={"AU12": {"keys": keys}}),
        "back_in_time": script(channels={"AU12": {"keys": [[1, 0], [0, 1]]}}),
        "many_channels": script(channels={f"AU{i}": {"keys": [[0, 1]]} for i in range(50000)}),
        "names": script(channels={"A\u001b[2J\n\u202e": {"keys": [[0, 1]]}, "": {"keys": []}}),
        "many_events": script(events=[{"blink": {}, "start_s": i * 1e-6} for i in range(100000)]),
        "long_event": script(events=[{"expression": "happiness", "start_s": 1e300, "onset_s": 1e300}]),
        "itself": script(rig="itself.json"), "rig_zero": script(rig="/dev/zero"), "rig_folder": script(rig="."),
        "rig_long": script(rig="a/" * 5000), "rig_nul": script(rig="a\0b"), "rig_number": script(rig=5),
        "rig_url": script(rig="http://localhost/rig"),
        "utterance": script(speech={"utterance": "itself.json"}),
        "light": script(view={"width_px": 16, "height_px": 16, "light": "/dev/zero"}),
        "emg": script(emg={"file": "/dev/zero"}), "shutter": script(shutter=-1), "seed": script(seed=1e100)}
    return put(folder, {name + ".json": value for name, value in made.items()})


def designs(folder):
    def design(clip="c", body=None, **more):
        one = {"name": "a", "clip": clip, "script": script()}
        one.update(body or {})
        return {"format": "risorius-design", "version": 1, "name": "d", "sets": [one], **more}

    levels = list(range(1000))
    chain = {f"p{i}": f"${{p{i + 1}}}${{p{i + 1}}}" for i in range(64)}
    experiment = {"programs": ["psychopy", "jspsych", "rating"], "question": "</script>\n'\"${x}",
        "answers": {"j": "a", "f": "b"}}
    steps = {"from": 0, "to": 1, "steps": 100000}
    made = {
        "product": design("c${a}${b}${c}${d}", {"factors": {k: levels for k in "abcd"}}),
        "steps": design("c${a}${b}", {"factors": {"a": steps, "b": steps}}),
        "doubling": design("c${p0}", parameters={**chain, "p64": "x"}),
        "self": design("c${a}", parameters={"a": "${a}"}),
        "pair": design("c${a}", parameters={"a": "${b}", "b": "${a}"}),
        "formula": design("c${a}", parameters={"a": "= " + "(" * 100000 + "1" + ")" * 100000}),
        "minus": design("c${a}", parameters={"a": "= " + "-" * 100000 + "1"}),
        "zero": design("c${a}", parameters={"a": "= 1 / 0"}),
        "infinite": design("c${a}", parameters={"a": "= " + "9" * 400}),
        "names": design("../../${a}", {"factors": {"a": ["/", "..", "\u0000", "\u202e", "CON", "x" * 300]}}),
        "experiment": design("c${a}", {"factors": {"a": [1, 2]}}, experiment=experiment),
        "programs": design("c", experiment={**experiment, "programs": ["../psychopy", "psychopy", "psychopy"]}),
        "answers": design("c", experiment={**experiment, "answers": {f"k{i}": f"a{i}" for i in range(5000)}}),
        "trials": design("c", experiment={**experiment, "trials": 1e18, "repeat": 1000000000}),
        "sample": design("c", {"sample": {"units": ["AU12"], "trials": 1000000000, "count": 1000000000}}),
        "draw": design("c", {"factors": {"a": {"draw": [0, 1], "count": 1000000000}}}),
        "fraction": design("c${a}${b}", {"factors": {"a": levels, "b": levels}, "fraction": [{"sum": ["a", "b"],
        "modulo": 1000}]}),
        "controls": design("c", {"controls": ["reversed"] * 50000}),
        "unknown_control": design("c", {"controls": [{"control": "\x1b"}]}),
        "table": design("c", {"conditions": "/dev/zero"}), "table_folder": design("c", {"conditions": "."}),
        "audio": design("c", {"audio": "/dev/zero"}), "twins": design("c", {"factors": {"a": [1, 1.0, "1"]}}),
        "many_sets": {**design(), "sets": [{"name": f"s{i}", "clip": f"c{i}", "script": {}} for i in range(20000)]},
        "no_sets": {**design(), "sets": []}, "triggers": design("c", triggers={"port": "\n", "code": 1e9}),
        "match": design("c", match={"luminance": {"mean": 1e9}})}
    return put(folder, {name + ".json": value for name, value in made.items()})


def studies(folder):
    def study(**more):
        return {"format": "risorius-study", "version": 1, "name": "s", "rig": RIG, "poses": ["happiness"],
                "vary": {"a": {"of": "tissue/force_scale", "factor": {"log_uniform": [0.5, 2]}}},
                "sample": {"method": "sobol", "count": 64, "seed": 1}, **more}

    experiment = json.loads((ROOT / "samples/figures/mesh/experiment.json").read_text())

    def body(file):
        one = json.loads(json.dumps(experiment))
        one["body"]["mesh"]["file"] = file
        return one

    made = {"count": study(sample={"method": "sobol", "count": 1e15, "seed": 1}),
        "odd": study(sample={"method": "sobol", "count": 63, "seed": 1}),
            "all": study(vary={"a": {"of": "*/" * 100, "each": True}}), "nothing": study(vary={}),
            "poses": study(poses=["happiness"] * 100000),
            "range": study(vary={"a": {"of": "tissue/force_scale", "factor": {"log_uniform": [-1, 0]}}}),
            "rig": study(rig="/dev/zero"),
            "experiment": experiment | {"body": {"kind": "block", "cells": [100000, 100000, 100000]}},
            "kind": experiment | {"kind": "\x1b"},
            "steps": experiment | {"integrator": {"method": "euler", "step_s": 1e-300}},
            "mesh_zero": body("/dev/zero"), "mesh_itself": body("mesh_itself.json")}
    for tets in tet_meshes(folder).values():
        made["experiment_" + tets.name] = body(tets.name)
    return put(folder, {name + ".json": value for name, value in made.items()})


def packed_vtu(blocks, size, last, data):
    """A file of VTK with one packed array, whose header says what it likes."""
    head = base64.b64encode(struct.pack("<III", blocks, size, last) + struct.pack("<I", len(data))).decode()
    return ('<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian" compressor="vtkZLibDataCompressor"><UnstructuredGrid>'
            '<Piece NumberOfPoints="4" NumberOfCells="1"><Points><DataArray type="Float32" NumberOfComponents="3" format="binary">'
            f"{head}{base64.b64encode(data).decode()}</DataArray></Points></Piece></UnstructuredGrid></VTKFile>")


def tet_meshes(folder):
    bomb = zlib.compress(b"\0" * 400000000, 9)
    entities = "".join(f'<!ENTITY l{i} "{f"&l{i - 1};" * 10}">' for i in range(1, 12))
    return put(folder, {
        "bomb.vtu": packed_vtu(1, 400000000, 0, bomb), "blocks.vtu": packed_vtu(0xffffffff, 0xffffffff, 1, b"x"),
        "lies.vtu": packed_vtu(1, 48, 0, zlib.compress(b"\0" * 4800000)),
        "no_zlib.vtu": packed_vtu(1, 48, 0, b"\xff" * 100),
        "entities.vtu": f'<!DOCTYPE a [<!ENTITY l0 "x">{entities}]><VTKFile>&l11;</VTKFile>',
        "nested.vtu": "<VTKFile type=\"UnstructuredGrid\">" + "<a>" * 300000,
        "attributes.vtu": "<VTKFile " + "a=\"b\" " * 500000 + ">",
        "counts.vtu": '<VTKFile type="UnstructuredGrid"><UnstructuredGrid><Piece NumberOfPoints="9e18" NumberOfCells="-1"></Piece></UnstructuredGrid></VTKFile>',
        "counts.mesh": "MeshVersionFormatted 1\nDimension 3\nVertices\n99999999999\n0 0 0 0\n",
        "nan.mesh": "MeshVersionFormatted 1 Dimension 3 Vertices 1 nan inf 1e999 0",
        "loop.meshb": struct.pack("<iiiiii", 1, 2, 4, 8, 4, 8),
        "back.meshb": struct.pack("<iiiii", 1, 1, 3, 20, 3) + struct.pack("<ii", 54, 0),
        "counts.meshb": struct.pack("<iiiiiii", 1, 2, 3, 20, 3, 4, 0x7fffffff) + struct.pack("<i", 0x7fffffff),
        "counts.msh": "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 9223372036854775807 1 9223372036854775807\n3 1 0 9223372036854775807\n",
        "binary.msh": b"$MeshFormat\n4.1 1 8\n" + struct.pack("<i", 1) + b"\n$EndMeshFormat\n$Nodes\n" + b"\xff" * 64,
        "counts.vtk": "# vtk DataFile Version 3.0\nx\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 4000000000 float\n",
        "counts.node": "1000000000 3 1000000000 0\n",
        "empty.vtu": "", "folder.ele": "0 4 0\n"})


def tables(folder):
    row = "\t".join(["0.1"] * 8)
    return put(folder, {
        "columns.tsv": "\t".join(f"c{i}" for i in range(200000)) + "\n" + "\t".join(["0"] * 200000) + "\n",
        "one_line.tsv": "time_s\t" + "x" * 30000000, "quotes.csv": 'time_s,"a\n' + '"' * 1000001,
        "twice.tsv": "time_s\ttime_s\n0\t0\n",
        "ragged.tsv": "time_s\ta\n0\t1\n0.1\n0.2\t1\t2\n",
        "nan.tsv": "time_s\tn.x_mm\tn.y_mm\tn.z_mm\n0\tnan\tinf\t1e999\n", "nul.tsv": b"time_s\ta\n0\t\0\n",
        "back.tsv": "time_s\tprn.x_mm\tprn.y_mm\tprn.z_mm\n1\t0\t0\t0\n0\t0\t0\t0\n",
        "far.tsv": "time_s\tprn.x_mm\tprn.y_mm\tprn.z_mm\n-1e308\t0\t0\t0\n1e308\t0\t0\t0\n",
        "same.tsv": "time_s\tprn.x_mm\tprn.y_mm\tprn.z_mm\n" + "0\t0\t0\t0\n" * 200000,
        "points.tsv": "time_s\tmediapipe_99999.x\tmediapipe_-1.y\n0\t0\t0\n",
        "hex.tsv": "time_s\ta\n0x1p3\t0b1\n", "comma.csv": "time_s;a\n0,1;0,2\n",
        "utf16.tsv": ("time_s\ta\n0\t1\n").encode("utf-16"), "cr.tsv": "time_s\ta\r0\t1\r",
        "face68.csv": "frame,timestamp,confidence,success," + ",".join(f"X_{i}" for i in range(68)) + "\n" +
        "1,0,1,1," + ",".join(["1e308"] * 68) + "\n",
        "key.tsv": "stim_id\tunit\n" + "a\t" + "AU1+" * 100000 + "\n", "sheet.tsv": "clip\tAU1\n" + row + "\n",
        "header.tsv": "\n\n\n", "only.tsv": "time_s\n"})


def recordings(folder):
    storage = "activation\nversion=1\nnRows={}\nnColumns={}\ninDegrees=no\nendheader\ntime\ta\n0\t1\n"
    osc = struct.pack(">8sQ", b"#bundle\0", 1)
    nested = b""
    for _ in range(20000):
        nested = osc + struct.pack(">i", len(nested)) + nested
        if len(nested) > 400000:
            break
    sampler = {"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}], "meshes": [{"primitives": [], "weights": [0]}],
        "buffers": [{"byteLength": 8, "uri": "data:,12345678"}],
               "bufferViews": [{"buffer": 0, "byteLength": 8}],
               "accessors": [{"bufferView": 0, "componentType": 5126, "count": 1000000000, "type": "SCALAR"}],
               "animations": [{"samplers": [{"input": 0, "output": 0}],
               "channels": [{"sampler": 0, "target": {"node": 0, "path": "weights"}}]}]}
    joints = "HIERARCHY\nROOT a\n" + "{\nOFFSET 0 0 0\nCHANNELS 3 Xrotation Yrotation Zrotation\nJOINT a\n" * 100000
    return put(folder, {
        "rows.sto": storage.format(10 ** 18, 2), "minus.sto": storage.format(-1, -1),
        "no_end.sto": "activation\nnRows=1\n" * 100000,
        "nan.sto": storage.format(1, 2).replace("0\t1", "nan\tinf"), "deep.bvh": joints,
        "frames.bvh": "HIERARCHY\nROOT head\n{\nOFFSET 0 0 0\nCHANNELS 3 Xrotation Yrotation Zrotation\nEnd Site\n{\nOFFSET 0 0 0\n}\n}\nMOTION\nFrames: 999999999999\nFrame Time: 1e-300\n0 0 0\n",
        "channels.bvh": "HIERARCHY\nROOT head\n{\nOFFSET 0 0 0\nCHANNELS 2000000000 Xrotation\n",
        "far.csv": "Timecode,BlendShapeCount,JawOpen\n99:99:99:99.999,61,0.1\n00:00:00:00.0,61,1e999\n",
        "rates.csv": "Timecode,BlendShapeCount,JawOpen\n" + "".join(f"00:00:00:{i}.0,61,0.1\n" for i in range(100000)),
        "deep.oscdump": "0.000 " + nested[:400000].hex() + "\n", "short.oscdump": "0.000 2f564d43\n1e999 2f\n",
        "times.jsonl": '{"timestampMs":1e308,"faceBlendshapes":[{"categories":[{"score":1e308,"categoryName":"jawOpen"}]}]}\n' * 2,
        "deep.jsonl": '{"timestampMs":0,"faceBlendshapes":' + "[" * 100000 + "\n",
        "lines.jsonl": '{"timestampMs":0,"faceBlendshapes":[]}\n' * 200000,
        "frames.json": {"fps": 1e-300, "frames": [{"t": 0, "blendShapes": {"jawOpen": 1e300}}, {"t": 1e300,
        "blendShapes": {}}]}, "sampler.gltf": sampler,
        "uri.gltf": {**sampler, "buffers": [{"byteLength": 8, "uri": "/dev/zero"}]}, "empty.csv": "",
        "unknown.csv": "a,b\n1,2\n"})


def sounds(folder):
    def wav(channels=1, rate=48000, bits=16, block=2, kind=1, size=8, data=b"\0" * 8):
        return (b"RIFF" + struct.pack("<I", 36 + len(data)) + b"WAVEfmt " + struct.pack("<IHHIIHH", 16, kind, channels,
            rate & 0xffffffff, 0, block, bits) +
                b"data" + struct.pack("<I", size) + data)

    return put(folder, {
        "channels.wav": wav(channels=65535, block=65535), "no_channels.wav": wav(channels=0, block=0),
        "rate.wav": wav(rate=-1), "no_rate.wav": wav(rate=0),
        "bits.wav": wav(bits=65535), "no_bits.wav": wav(bits=0, block=0), "size.wav": wav(size=0xfffffffe),
        "kind.wav": wav(kind=0x55), "nan.wav": wav(kind=3, bits=32, block=4, data=b"\xff" * 800, size=800),
        "chunks.wav": b"RIFF\xff\xff\xff\xffWAVE" + (b"LIST" + struct.pack("<I", 0)) * 300000, "empty.wav": b"",
        "riff.wav": b"RIFF", "noise.flac": b"fLaC" + b"\xff" * 1000,
        "flac.flac": b"fLaC\x80\x00\x00\x22" + struct.pack(">HH", 16, 65535) + b"\xff" * 30, "text.wav": "hello",
        "mp3.wav": b"ID3\x04\0\0\x7f\x7f\x7f\x7f" + b"\0" * 100})


def labels(folder):
    grid = 'File type = "ooTextFile"\nObject class = "TextGrid"\n\n0\n{}\n<exists>\n{}\n"IntervalTier"\n"phones"\n0\n1\n{}\n0\n1\n"a"\n'
    return put(folder, {
        "tiers.TextGrid": grid.format(1, 10 ** 15, 1), "intervals.TextGrid": grid.format(1, 1, 10 ** 15),
        "far.TextGrid": grid.format("1e300", 1, 1), "open.TextGrid": 'File type = "ooTextFile"\n"' + "x" * 1000000,
        "far.ctm": "a 1 1e300 1e300 AA\n",
        "many.ctm": "".join(f"a 1 {i * 1e-6:.6f} 0.000001 AA1\n" for i in range(100000)), "nan.lab": "nan inf AA\n",
        "far.vtt": "WEBVTT\n\n99999999999:00.000 --> 99999999999:01.000\na\n",
        "long.srt": "1\n00:00:00,000 --> 00:00:01,000\n" + "x" * 5000000,
        "deep.eaf": "<ANNOTATION_DOCUMENT>" + "<TIER>" * 200000,
        "entity.eaf": '<!DOCTYPE a [<!ENTITY a "&a;&a;">]><ANNOTATION_DOCUMENT>&a;</ANNOTATION_DOCUMENT>',
        "phones.pho": "a 1e9 0 100\n" * 1000, "deep.json": "[" * 100000, "cues.tsv": "0\tA\n-1\tB\n"})


def meshes(folder):
    head = "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n"
    return put(folder, {
        "counts.ply": head.format(10 ** 18, 10 ** 18), "minus.ply": head.format(-1, -1),
        "counts.stl": b"x" * 80 + struct.pack("<I", 0xffffffff), "counts.off": "OFF\n999999999 999999999 0\n",
        "index.obj": "v 0 0 0\nf 99999999999999999999 -99999999999999999999 1\n",
        "faces.obj": "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + "f 1 2 3\n" * 1000000,
        "corners.obj": "v 0 0 0\nf" + " 1" * 3000000 + "\n",
        "library.obj": "mtllib /dev/zero\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n",
        "continued.obj": "v 0 0 \\\n" * 1000000, "nan.obj": "v nan inf 1e999\n", "zip.fbx": b"PK\x03\x04" + b"\0" * 100,
        "binary.fbx": b"Kaydara FBX Binary  \x00\x1a\x00" + struct.pack("<III", 7500, 0xffffffff,
        0xffffffff) + b"\xff" * 100, "entities.dae": '<!DOCTYPE a [<!ENTITY a "' + "x" * 100000 + '">]><COLLADA>' +
            "&a;" * 100000 + "</COLLADA>",
        "itself.gltf": {"asset": {"version": "2.0"}, "buffers": [{"byteLength": 99999999999, "uri": "itself.gltf"}]},
        "data.gltf": {"asset": {"version": "2.0"}, "buffers": [{"byteLength": 4,
        "uri": "data:application/octet-stream;base64," + "=" * 1000000}]},
        "cycle.gltf": {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"children": [1]}, {"children": [0]}]}, "wrong.glb": b"glTF" + struct.pack("<II", 2, 0xffffffff) +
        struct.pack("<II", 0xfffffff0, 0x4E4F534A),
        "png.obj": b"\x89PNG\r\n\x1a\n", "obj.png": "v 0 0 0\n",
        "huge.png": b"\x89PNG\r\n\x1a\n" + struct.pack(">I4sIIBBBBB", 13, b"IHDR", 0x7fffffff, 0x7fffffff, 8, 6, 0, 0,
        0) + b"\0\0\0\0", "empty.obj": "",
            "huge.hdr": "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 999999999 +X 999999999\n"})
