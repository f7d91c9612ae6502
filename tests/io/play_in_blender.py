# SPDX-License-Identifier: MIT
"""Imports a face by the add-on in Blender, plays it, and writes what came of it as JSON.

blender -b --factory-startup [--enable-autoexec] --python play_in_blender.py -- ADDON.py FACE.glb OUT.json [FRAME ...]
"""
import importlib.util
import json
import struct
import sys

import bpy

addon_file, glb, out, *wanted = sys.argv[sys.argv.index("--") + 1 :]
spec = importlib.util.spec_from_file_location("risorius_faces", addon_file)
addon = importlib.util.module_from_spec(spec)
spec.loader.exec_module(addon)
addon.register()
for thing in list(bpy.data.objects):
    bpy.data.objects.remove(thing)

face, note = addon.import_face(glb, drivers=True)
keys = face.data.shape_keys
scene = bpy.context.scene
for modifier in face.modifiers:
    modifier.show_viewport = False  # The joints turn the head; the cache has the shapes alone


def vertex_numbers():
    """The number of each vertex of the skin in the mesh of the rig. Blender keeps the order of the file."""
    gltf = addon.read_json_of_glb(glb)
    with open(glb, "rb") as file:
        content = file.read()
    start = 20 + struct.unpack_from("<I", content, 12)[0] + 8
    numbers = []
    for primitive in next(m for m in gltf["meshes"] if m["name"] == "Face")["primitives"]:
        accessor = gltf["accessors"][primitive["attributes"]["_VERTEX"]]
        at = start + gltf["bufferViews"][accessor["bufferView"]].get("byteOffset", 0)
        numbers += [int(n) for n in struct.unpack_from("<%df" % accessor["count"], content, at)]
    return numbers


def evaluated(frame):
    scene.frame_set(frame)
    graph = bpy.context.evaluated_depsgraph_get()
    mesh = face.evaluated_get(graph).to_mesh()
    # Back from Blender's z up to the y up of the file
    return [[v.co.x, v.co.z, -v.co.y] for v in mesh.vertices]


frames = [int(f) for f in wanted] or range(scene.frame_start, scene.frame_end + 1)
weights, points = [], []
for frame in frames:
    points.append(evaluated(frame))
    weights.append({b.name: b.value for b in keys.key_blocks if b.name != "Basis"})
curves = keys.animation_data.action.fcurves
whole = all(abs(p.co.x - round(p.co.x)) < 1e-4 for c in curves for p in c.keyframe_points)
values = [
    p.co.y
    for a in bpy.data.actions
    for c in a.fcurves
    if c.data_path.startswith("key_blocks")
    for p in c.keyframe_points
]
pictures = [i for i in bpy.data.images if i.packed_file]


def has_picture(material):
    """Whether a picture colours a material."""
    return any(n.type == "TEX_IMAGE" and n.image for n in material.node_tree.nodes)


meshes = {
    o.name: {
        "size_m": [
            max(v.co[k] for v in o.data.vertices) - min(v.co[k] for v in o.data.vertices)
            for k in range(3)
        ],
        "scale": list(o.scale),
        "keys": len(o.data.shape_keys.key_blocks) - 1 if o.data.shape_keys else 0,
    }
    for o in bpy.data.objects
    if o.type == "MESH"
}
script = addon.script_of(face, "rig.json")
used = addon.import_script(script, face)
scene.frame_set(frames[-1])
again = {b.name: b.value for b in keys.key_blocks if b.name != "Basis"}
with open(out, "w") as file:
    json.dump(
        {
            "note": note,
            "fps": scene.render.fps / scene.render.fps_base,
            "last_frame": scene.frame_end,
            "meshes": meshes,
            "pictures": len(pictures),
            "pictures_in_srgb": len([i for i in pictures if i.colorspace_settings.name == "sRGB"]),
            "materials": {
                m.name: has_picture(m) for o in bpy.data.objects if o.type == "MESH" for m in o.data.materials
            },
            "least_value": min(values, default=0),
            "greatest_value": max(values, default=0),
            "whole_frames": whole,
            "weights": weights,
            "vertices": vertex_numbers(),
            "points": points,
            "drivers": len(keys.animation_data.drivers),
            "script": script,
            "script_channels_read": used,
            "weights_of_script": again,
        },
        file,
    )
addon.unregister()
