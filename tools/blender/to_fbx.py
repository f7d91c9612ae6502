# SPDX-License-Identifier: MIT
"""Converts shapes.glb of `risorius shapes` into FBX, for Unity, Unreal, Maya and others. Blender does the work, without a window:

    blender --background --factory-startup --python tools/blender/to_fbx.py -- shapes.glb shapes.fbx

The FBX has the parts, joints, blend shapes, pictures and the animation of the file. Correctives are blend shapes with keys, since FBX
knows no drivers. Sizes are right for a scene in metres or centimetres: the file says its unit. Exit code 2: the input is not such a file.
"""

import os
import sys

import bpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import risorius_faces  # noqa: E402, this gives numpy.bool back, too


def show_pictures_alone(material):
    """Links the picture to the colour. FBX has no product of picture and shade, and its exporter would leave the picture out."""
    if not material.use_nodes:
        return
    nodes = material.node_tree.nodes
    pictures = [n for n in nodes if n.type == "TEX_IMAGE"]
    shaders = [n for n in nodes if n.type == "BSDF_PRINCIPLED"]
    if len(pictures) == 1 and len(shaders) == 1:
        material.node_tree.links.new(pictures[0].outputs["Color"], shaders[0].inputs["Base Color"])


def convert(source, target):
    """Reads the glTF and writes the FBX. Returns how many shapes the face has."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    face, _ = risorius_faces.import_face(source, drivers=False)
    for material in bpy.data.materials:
        show_pictures_alone(material)
    # Pictures inside a glTF have no names of files, and FBX tells pictures apart by these.
    for image in bpy.data.images:
        image.filepath_raw = "//%s.%s" % (image.name, "png" if image.file_format == "PNG" else "jpg")
    bpy.ops.export_scene.fbx(
        filepath=target,
        object_types={"ARMATURE", "EMPTY", "MESH"},
        use_mesh_modifiers=False,  # shapes are left out of meshes with applied modifiers
        add_leaf_bones=False,
        apply_scale_options="FBX_SCALE_ALL",
        bake_anim=bool(bpy.data.actions),
        bake_anim_use_nla_strips=False,
        bake_anim_use_all_actions=False,
        bake_anim_simplify_factor=0.0,
        path_mode="COPY",
        embed_textures=True,
    )
    return len(face.data.shape_keys.key_blocks) - 1


def main(arguments):
    if len(arguments) != 2 or not arguments[1].lower().endswith(".fbx"):
        print("to_fbx: expected SHAPES.glb OUT.fbx after --, found " + (" ".join(arguments) or "nothing"), file=sys.stderr)
        return 2
    try:
        count = convert(*arguments)
    except (OSError, ValueError, RuntimeError) as error:
        print("to_fbx: " + str(error), file=sys.stderr)
        return 2
    print("%s: %d shapes, %.1f MB" % (arguments[1], count, os.path.getsize(arguments[1]) / 1e6))
    return 0


if __name__ == "__main__":
    code = main(sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else [])
    sys.stdout.flush()
    os._exit(code)  # Blender would end with 0
