# SPDX-License-Identifier: MIT
"""Renders frames of shapes.glb of `risorius shapes` in Blender, without a window, to see what Blender makes of the file:

    blender --background --factory-startup --python tools/blender/to_picture.py -- shapes.glb picture_#.png 0 87 140

`#` stands for the frame. The scene is the one that the add-on makes with "Camera and lights". Cycles draws it, which needs no graphics
card. Exit code 2: the input is not such a file.
"""

import os
import sys

import bpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import risorius_faces  # noqa: E402, this gives numpy.bool back, too

SAMPLES = 48  # of a pixel


def draw(source, target, frames):
    """Reads the glTF and writes a picture of each frame."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    risorius_faces.register()
    risorius_faces.import_face(source, stage=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples = SAMPLES
    scene.cycles.use_denoising = False
    scene.render.resolution_x = scene.render.resolution_y = 768
    for frame in frames:
        scene.frame_set(frame)
        scene.render.filepath = os.path.abspath(target.replace("#", str(frame)))
        bpy.ops.render.render(write_still=True)


def main(arguments):
    if len(arguments) < 3 or not arguments[1].lower().endswith(".png"):
        print("to_picture: expected SHAPES.glb PICTURE_#.png FRAME ... after --, found " + (" ".join(arguments) or "nothing"), file=sys.stderr)
        return 2
    try:
        draw(arguments[0], arguments[1], [int(frame) for frame in arguments[2:]])
    except (OSError, ValueError, RuntimeError) as error:
        print("to_picture: " + str(error), file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    code = main(sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else [])
    sys.stdout.flush()
    os._exit(code)  # Blender would end with 0
