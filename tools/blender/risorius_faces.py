# SPDX-License-Identifier: MIT
"""Faces of Risorius in Blender 3.4 and later.

Menu File, Import, "Risorius face (.glb)": shapes.glb of `risorius shapes`. The frame rate of the scene becomes that of the file,
so that keys lie on whole frames. With "Drive correctives", each corrective follows the shapes by the rule in the file, so that
sliders, and motion of your own, look as they do in Risorius; the keys of the correctives are removed, since they say the same.
Correctives of `shapes --named-correctives` are driven by plain products, others by a function of this file. With "Camera and lights",
the scene gets a camera before the face and three lights around it, so that it can be rendered at once.

Menu File, Import, "Live Link Face (.csv)" or "Risorius script (.json)": motion for the selected face and its parts. The frame rate of
the scene becomes that of the motion. The channels of the script have to be shapes of the face, such as those of ARKit.

Menu File, Import, "Risorius maps (results.json)": the wrinkles that `shapes --maps` has written, for the selected face. Each normal map is
multiplied by the weight of its shape.

Menu File, Export, "Risorius script (.json)": the keys of the selected face as a script that `risorius render` plays.

The importer of glTF in Debian's Blender 3.4 uses numpy.bool, which numpy 1.24 no longer has. This file gives it back.
"""

import csv
import hashlib
import json
import os
import struct

import bpy
import mathutils
import numpy
from bpy.props import BoolProperty, FloatProperty, IntProperty, StringProperty
from bpy_extras.io_utils import ExportHelper, ImportHelper

bl_info = {
    "name": "Risorius faces",
    "author": "Risorius",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "File > Import, File > Export",
    "description": "Blend shapes of Risorius with their correctives, motion and scripts",
    "category": "Import-Export",
}

if "bool" not in numpy.__dict__:
    numpy.bool = bool

PART = "risorius_face"  # custom property of the objects of a face: one word for each face
RULE = "risorius_rule"  # custom property of the shape keys of a face: the rule of its correctives, JSON
# Functions of driver expressions: the weight of a corrective, and one that takes some of the weights of shapes that it needs
WEIGHT, TAKE = "rf_c", "rf_v"
MOST_ARGUMENTS = 24  # more than 30 are packed by operations that Blender forbids in files it does not trust
MOST_LETTERS = 255  # of an expression of a driver


def read_json_of_glb(path):
    """The JSON chunk of a binary glTF file."""
    with open(path, "rb") as file:
        head = file.read(20)
        if len(head) < 20 or head[:4] != b"glTF":
            raise ValueError(path + ": expected a binary glTF file, found another kind of file")
        return json.loads(file.read(struct.unpack_from("<I", head, 12)[0]))


def rule_of_glb(gltf):
    """The rule of the correctives, and the frame rate or None."""
    for mesh in gltf.get("meshes", []):
        extras = mesh.get("extras", {})
        if "risorius" in extras:
            found = extras["risorius"]
            return {
                "terms": found.get("terms") or [],
                "correctives": found.get("correctives") or [],
            }, found.get("fps")
    raise ValueError("expected a file of risorius shapes, found no extras of it")


def term_value(term, weights):
    """The value of a term, in 0 to 1; the weights are those of shapes, by name."""
    value = 1.0
    for name in term.get("fades_with", []):
        value *= 1 - weights[name]
    drivers = term["drivers"]
    if len(drivers) > 1:
        for name in drivers:
            value *= weights[name]
        return value
    w, part = weights[drivers[0]], term["part"]
    largest = 16.0 if part == 2 else 256.0 / 27.0
    return value * largest * w**part * (1 - w) ** (4 - part)


def shapes_of_rule(rule):
    """The shapes that terms use, each once, in the order of the terms."""
    names = []
    for term in rule["terms"]:
        for name in term["drivers"] + term.get("fades_with", []):
            if name not in names:
                names.append(name)
    return names


def shapes_of_corrective(rule, index):
    """The shapes that one corrective follows, each once, in the order of the terms."""
    corrective = rule["correctives"][index]
    used = []
    for i, term in enumerate(rule["terms"]):
        if corrective.get("term") == term["name"] or corrective.get("of_terms", {i: 0})[i] != 0:
            used.append(term)
    return shapes_of_rule({"terms": used})


class Rule:
    """A rule that drivers compute."""

    def __init__(self, rule):
        self.correctives = []
        self.taken = []
        for index, corrective in enumerate(rule["correctives"]):
            names = shapes_of_corrective(rule, index)
            terms = [
                (a, term)
                for a, term in zip(corrective.get("of_terms", []), rule["terms"])
                if a != 0
            ]
            if "term" in corrective:
                terms = [(1.0, t) for t in rule["terms"] if t["name"] == corrective["term"]]
            self.correctives.append((names, terms))

    def weight(self, index):
        names, terms = self.correctives[index]
        weights = {n: min(1.0, max(0.0, w)) for n, w in zip(names, self.taken)}
        self.taken = []
        return min(1.0, max(0.0, sum(a * term_value(term, weights) for a, term in terms)))


_rules = {}  # short name -> Rule


def name_of_rule(text):
    return hashlib.sha1(text.encode()).hexdigest()[:6]


def known_rule(name):
    """A rule by its short name; it stands in the shape keys of a face of this file."""
    if name not in _rules:
        for keys in bpy.data.shape_keys:
            if RULE in keys and name_of_rule(keys[RULE]) == name:
                _rules[name] = Rule(json.loads(keys[RULE]))
    return _rules.get(name)


def take_weights(name, *values):
    """Keeps weights of shapes for the function that computes a corrective. It is called for its arguments, thus before it."""
    known = known_rule(name)
    if known is not None:
        known.taken.extend(values)
    return 0.0


def driven_weight(name, index, *_):
    known = known_rule(name)
    return 0.0 if known is None else known.weight(index)


def variable_name(i):
    """Two letters that are no word of Python."""
    return "ABCDEFGH"[i // 26] + "abcdefghijklmnopqrstuvwxyz"[i % 26]


def product_of_term(term, variable_of):
    """The value of a term as an expression that Blender computes without Python, and the shapes in it."""
    drivers = term["drivers"]
    names = list(dict.fromkeys(drivers + term.get("fades_with", [])))
    factors = ["(1-%s)" % variable_of(names.index(n)) for n in term.get("fades_with", [])]
    if len(drivers) > 1:
        factors += [variable_of(names.index(n)) for n in drivers]
    else:
        w, part = variable_of(0), term["part"]
        largest = "16" if part == 2 else "256/27"
        factors += [largest] + [w] * part + ["(1-%s)" % w] * (4 - part)
    return "*".join(factors), names


def function_of_corrective(rule_name, index, count):
    """The expression of a corrective that follows several terms."""
    takes = []
    for first in range(0, count, MOST_ARGUMENTS):
        some = [variable_name(i) for i in range(first, min(count, first + MOST_ARGUMENTS))]
        takes.append('%s("%s",%s)' % (TAKE, rule_name, ",".join(some)))
    return '%s("%s",%d,%s)' % (WEIGHT, rule_name, index, ",".join(takes))


def drive_one(part, keys, name, expression, names):
    """Lets a shape of a part follow shapes of the face instead of keys."""
    block = part.data.shape_keys.key_blocks[name]
    block.driver_remove("value")
    animation = part.data.shape_keys.animation_data
    if animation and animation.action:
        curve = animation.action.fcurves.find('key_blocks["%s"].value' % name)
        if curve:
            animation.action.fcurves.remove(curve)
    driver = block.driver_add("value").driver
    driver.type = "SCRIPTED"
    for i, other in enumerate(names):
        variable = driver.variables.new()
        variable.name = variable_name(i)
        target = variable.targets[0]
        target.id_type = "KEY"
        target.id = keys
        target.data_path = 'key_blocks["%s"].value' % other
    driver.expression = expression


def drive_correctives(face, others, rule):
    """Gives every corrective of a face, and of the parts that have it too, a driver by the rule. Returns how many keep their keys."""
    text = json.dumps(rule)
    keys = face.data.shape_keys
    keys[RULE] = text
    missing = [n for n in shapes_of_rule(rule) if n not in keys.key_blocks]
    if missing:
        raise ValueError("expected a shape " + missing[0] + ", found none")
    terms = {term["name"]: term for term in rule["terms"]}
    left = 0
    for index, corrective in enumerate(rule["correctives"]):
        expression = ""
        if "term" in corrective:
            expression, names = product_of_term(terms[corrective["term"]], variable_name)
        if not expression or len(expression) > MOST_LETTERS:
            names = shapes_of_corrective(rule, index)
            expression = function_of_corrective(name_of_rule(text), index, len(names))
        if len(expression) > MOST_LETTERS:
            left += 1
            continue
        for part in [face] + others:
            if corrective["name"] in part.data.shape_keys.key_blocks:
                drive_one(part, keys, corrective["name"], expression, names)
    return left


def put_in_place_of_empty(thing):
    """Removes an empty object whose mesh the importer has put below the joints, and gives the mesh its name. Says whether it was one."""
    if thing.type != "EMPTY" or thing.children:
        return False
    mesh = bpy.data.objects.get(thing.name + ".001")
    if mesh is None or mesh.type != "MESH":
        return False
    name = thing.name
    bpy.data.objects.remove(thing)
    mesh.name = name
    return True


def import_face(path, drivers=True, stage=False):
    """Imports shapes.glb. Returns the object of the skin, and what is to be said about the correctives, or ""."""
    rule, fps = rule_of_glb(read_json_of_glb(path))
    scene = bpy.context.scene
    if fps:
        scene.render.fps = max(1, round(fps))
        scene.render.fps_base = scene.render.fps / fps
    before = set(bpy.data.objects)
    bpy.ops.import_scene.gltf(filepath=path)
    made = [o for o in bpy.data.objects if o not in before]
    shaped = [o for o in made if o.type == "MESH" and o.data.shape_keys]
    if not shaped:
        raise ValueError(path + ": expected blend shapes, found none")
    face = max(shaped, key=lambda o: len(o.data.shape_keys.key_blocks))
    made = [o for o in made if not put_in_place_of_empty(o)]
    for thing in made:
        thing[PART] = face.name
    frames = [c.range()[1] for a in bpy.data.actions for c in a.fcurves]
    if fps and frames:
        scene.frame_start, scene.frame_end = 0, round(max(frames))
    note = ""
    if drivers and rule["correctives"]:
        left = drive_correctives(face, [o for o in shaped if o is not face], rule)
        if left:
            note = "%d correctives keep their keys, since they follow too many shapes for a driver" % left
    bpy.context.view_layer.objects.active = face
    if stage:
        add_stage(face)
    return face, note


def add_light(name, place, target, watt, size):
    """An area light that shines from a place onto a target. Returns its data."""
    light = bpy.data.lights.new(name, "AREA")
    light.energy, light.size = watt, size
    lamp = bpy.data.objects.new(name, light)
    lamp.location = place
    lamp.rotation_euler = (mathutils.Vector(target) - lamp.location).to_track_quat("-Z", "Y").to_euler()
    bpy.context.scene.collection.objects.link(lamp)
    return light


def add_stage(face):
    """A camera before a face, as high as it is, and three lights around it. The face looks along -y."""
    scene = bpy.context.scene
    corners = [face.matrix_world @ mathutils.Vector(corner) for corner in face.bound_box]
    low = [min(c[k] for c in corners) for k in range(3)]
    high = [max(c[k] for c in corners) for k in range(3)]
    height = high[2] - low[2]
    middle = mathutils.Vector(((low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2))
    lens = bpy.data.cameras.new("Camera of " + face.name)
    lens.lens, lens.sensor_fit, lens.clip_start = 85, "VERTICAL", 0.01
    camera = bpy.data.objects.new(lens.name, lens)
    camera.location = middle + mathutils.Vector((0, -4.4 * height, 0.02 * height))
    camera.rotation_euler = (middle - camera.location).to_track_quat("-Z", "Y").to_euler()
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.render.resolution_x = scene.render.resolution_y = 1024
    for name, place, watt, size in (
        ("Key", (-1.5, -2.6, 1.6), 14, 1.2),
        ("Fill", (2.2, -2.2, 0.3), 4, 2.0),
        ("Rim", (1.4, 2.2, 1.8), 8, 1.0),
    ):
        offset = mathutils.Vector(place) * height
        light = add_light(name, middle + offset, middle, watt * height**2 * 10, size * height)
        # In Eevee, shadows of lights alone leave the open mouth and the nostrils bright. Blender 4.2 does without.
        if hasattr(light, "use_contact_shadow"):
            light.use_contact_shadow = True
            light.contact_shadow_distance = 0.16 * height
            light.contact_shadow_bias = 0.0016 * height
            light.contact_shadow_thickness = 0.065 * height
    if scene.world is None:
        scene.world = bpy.data.worlds.new("World")
    # Filmic, the default, makes the colours of pictures pale
    scene.view_settings.view_transform = "Standard"


FLAT = (128 / 255, 128 / 255, 1.0)  # the colour of a normal map without wrinkles


def driven_value(tree, keys, name):
    """A node with the weight of a shape."""
    node = tree.nodes.new("ShaderNodeValue")
    node.label = name
    driver = node.outputs[0].driver_add("default_value").driver
    driver.type = "AVERAGE"
    target = driver.variables.new().targets[0]
    target.id_type = "KEY"
    target.id = keys
    target.data_path = 'key_blocks["%s"].value' % name
    return node


def vector_math(tree, operation, *inputs):
    """A node of vector arithmetic with inputs that are outputs of nodes, or vectors."""
    node = tree.nodes.new("ShaderNodeVectorMath")
    node.operation = operation
    for slot, given in zip(node.inputs, inputs):
        if isinstance(given, tuple):
            slot.default_value = given
        else:
            tree.links.new(given, slot)
    return node.outputs[0]


def map_picture(tree, path):
    """A node with a normal map."""
    node = tree.nodes.new("ShaderNodeTexImage")
    node.image = bpy.data.images.load(path, check_existing=True)
    node.image.colorspace_settings.name = "Non-Color"
    return node.outputs["Color"]


def import_maps(path, face, most=24):
    """Adds the deepest normal maps of `shapes --maps` to the material of the skin, each times the weight of its shape. Returns how many."""
    with open(path, encoding="utf-8") as file:
        maps = json.load(file).get("maps")
    if not maps:
        raise ValueError(path + ": expected results.json of shapes --maps, found none of its maps")
    keys = face.data.shape_keys
    found = [m for m in maps["shapes"] if m["normal"] and m["name"] in keys.key_blocks]
    found = sorted(found, key=lambda m: -m["deepest_mm"])[:most]
    skins = [m for m in face.data.materials if m and m.name.split(".")[0] == "Skin" and m.use_nodes]
    if not found or not skins:
        raise ValueError("expected a face with a material Skin and shapes of these maps, found none")
    tree, folder = skins[0].node_tree, os.path.dirname(os.path.abspath(path))
    total = FLAT
    if maps.get("neutral_normal"):
        total = map_picture(tree, os.path.join(folder, maps["neutral_normal"]))
    for one in found:
        turn = vector_math(tree, "SUBTRACT", map_picture(tree, os.path.join(folder, one["normal"])), FLAT)
        weight = driven_value(tree, keys, one["name"]).outputs[0]
        total = vector_math(tree, "MULTIPLY_ADD", turn, weight, total)
    normal = tree.nodes.new("ShaderNodeNormalMap")
    tree.links.new(total, normal.inputs["Color"])
    for shader in tree.nodes:
        if shader.type == "BSDF_PRINCIPLED":
            tree.links.new(normal.outputs["Normal"], shader.inputs["Normal"])
    return len(found)


def parts_of(face):
    """The meshes with shapes that came with a face, and the face."""
    name = face.get(PART)
    return [
        o
        for o in bpy.data.objects
        if o.type == "MESH" and o.data.shape_keys and (o is face or (name and o.get(PART) == name))
    ]


def set_curve(part, name, points):
    """Gives a shape of a part the keys (frame, value), linear between them."""
    keys = part.data.shape_keys
    keys.key_blocks[name].driver_remove("value")
    animation = keys.animation_data or keys.animation_data_create()
    if animation.action is None:
        animation.action = bpy.data.actions.new(part.name + " shapes")
    path = 'key_blocks["%s"].value' % name
    old = animation.action.fcurves.find(path)
    if old:
        animation.action.fcurves.remove(old)
    curve = animation.action.fcurves.new(path)
    curve.keyframe_points.add(len(points))
    curve.keyframe_points.foreach_set("co", [x for point in points for x in point])
    for key in curve.keyframe_points:
        key.interpolation = "LINEAR"
    curve.update()


def set_motion(face, curves, fps, last_frame):
    """Sets curves of shapes, by name, on a face and its parts. Shapes without a curve rest. Returns how many the face has."""
    scene = bpy.context.scene
    scene.render.fps = max(1, round(fps))
    scene.render.fps_base = scene.render.fps / fps
    scene.frame_start, scene.frame_end = 0, last_frame
    driven = set()
    if RULE in face.data.shape_keys:
        driven = {c["name"] for c in json.loads(face.data.shape_keys[RULE])["correctives"]}
    used = [n for n in curves if n in face.data.shape_keys.key_blocks and n not in driven]
    if not used:
        raise ValueError("expected a face with shapes of this motion, found none of them")
    for part in parts_of(face):
        for block in part.data.shape_keys.key_blocks:
            if block.name != "Basis" and block.name not in driven:
                set_curve(part, block.name, curves.get(block.name) or [(0, 0.0)])
    return len(used)


def import_motion(path, face, fps):
    """Reads a table of Live Link Face into keys of the shapes of a face. Returns how many shapes move."""
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    if not rows or len(rows[0]) < 3 or rows[0][0] != "Timecode":
        raise ValueError(path + ": expected a table of Live Link Face, found another kind of file")
    curves = {}
    for column, name in enumerate(rows[0][2:], 2):
        curves[name[:1].lower() + name[1:]] = [
            (frame, min(1.0, max(0.0, float(row[column])))) for frame, row in enumerate(rows[1:])
        ]
    return set_motion(face, curves, fps, max(0, len(rows) - 2))


def import_script(script, face):
    """Reads a script whose channels are shapes of the face, such as those of ARKit. Returns how many there are."""
    if script.get("format") != "risorius-script":
        raise ValueError("expected a script of Risorius, found another kind of file")
    fps = script.get("fps", 30)
    channels = script.get("channels", {})
    unknown = [n for n in channels if n not in face.data.shape_keys.key_blocks]
    if unknown:
        raise ValueError(
            "expected channels that are shapes of the face, found %s: make the face with shapes --script instead"
            % unknown[0]
        )
    curves = {n: [(t * fps, v) for t, v in c["keys"]] for n, c in channels.items()}
    return set_motion(face, curves, fps, max(0, round(script["duration_s"] * fps) - 1))


def script_of(face, rig):
    """A script of Risorius with the curves of a face. Names of ARKit are channels of a script."""
    keys = face.data.shape_keys
    driven = set()
    if RULE in keys:
        driven = {c["name"] for c in json.loads(keys[RULE])["correctives"]}
    scene = bpy.context.scene
    fps = scene.render.fps / scene.render.fps_base
    channels, last = {}, 0.0
    curves = keys.animation_data.action.fcurves if keys.animation_data and keys.animation_data.action else []
    for curve in curves:
        name = curve.data_path.split('"')[1] if '"' in curve.data_path else ""
        if name not in keys.key_blocks or name in driven or name.startswith("corrective"):
            continue
        points = [
            [round(p.co.x / fps, 6), round(min(1.0, max(0.0, p.co.y)), 5)]
            for p in curve.keyframe_points
        ]
        # A key between two keys of the same value says nothing.
        points = [
            p
            for i, p in enumerate(points)
            if i in (0, len(points) - 1) or points[i - 1][1] != p[1] or points[i + 1][1] != p[1]
        ]
        if not any(v for _, v in points):
            continue
        last = max(last, points[-1][0])
        channels[name] = {"keys": points, "interpolation": "linear", "activation": True}
    if not channels:
        raise ValueError("expected a face with keys of its shapes, found none")
    return {
        "format": "risorius-script",
        "version": 1,
        "rig": rig,
        "fps": round(fps),
        "duration_s": round(last + 1 / fps, 6),
        "seed": 1,
        "channels": channels,
    }


class RISORIUS_OT_import_face(bpy.types.Operator, ImportHelper):
    bl_idname = "import_scene.risorius_face"
    bl_label = "Import a Risorius face"
    filename_ext = ".glb"
    filter_glob: StringProperty(default="*.glb", options={"HIDDEN"})
    drivers: BoolProperty(
        name="Drive correctives", default=True, description="Correctives follow the shapes by drivers"
    )

    stage: BoolProperty(
        name="Camera and lights", default=False, description="A camera before the face, and three lights"
    )

    def execute(self, context):
        try:
            note = import_face(self.filepath, self.drivers, self.stage)[1]
            if note:
                self.report({"WARNING"}, note)
        except (OSError, ValueError, RuntimeError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


def with_face(operator, context, use):
    """Calls use() with the selected face; the operator tells what is wrong."""
    face = context.active_object
    if face is None or face.type != "MESH" or face.data.shape_keys is None:
        operator.report({"ERROR"}, "expected a face that is selected, found none")
        return {"CANCELLED"}
    try:
        use(face)
    except (OSError, ValueError, KeyError, TypeError) as error:
        operator.report({"ERROR"}, str(error))
        return {"CANCELLED"}
    return {"FINISHED"}


class RISORIUS_OT_import_motion(bpy.types.Operator, ImportHelper):
    bl_idname = "import_anim.risorius_motion"
    bl_label = "Import motion of Live Link Face"
    filename_ext = ".csv"
    filter_glob: StringProperty(default="*.csv", options={"HIDDEN"})
    fps: FloatProperty(
        name="Frames per second", default=60, min=1, description="The table does not say it; the scene takes it"
    )

    def execute(self, context):
        return with_face(self, context, lambda face: import_motion(self.filepath, face, self.fps))


class RISORIUS_OT_import_script(bpy.types.Operator, ImportHelper):
    bl_idname = "import_anim.risorius_script"
    bl_label = "Import a Risorius script"
    filename_ext = ".json"
    filter_glob: StringProperty(default="*.json", options={"HIDDEN"})

    def execute(self, context):
        def read(face):
            with open(self.filepath, encoding="utf-8") as file:
                import_script(json.load(file), face)

        return with_face(self, context, read)


class RISORIUS_OT_import_maps(bpy.types.Operator, ImportHelper):
    bl_idname = "import_image.risorius_maps"
    bl_label = "Import the wrinkles of a Risorius face"
    filename_ext = ".json"
    filter_glob: StringProperty(default="results.json", options={"HIDDEN"})
    most: IntProperty(
        name="Maps at most", default=24, min=1, description="Those of the deepest wrinkles. Eevee draws about 30 pictures in a material"
    )

    def execute(self, context):
        return with_face(self, context, lambda face: import_maps(self.filepath, face, self.most))


class RISORIUS_OT_export_script(bpy.types.Operator, ExportHelper):
    bl_idname = "export_anim.risorius_script"
    bl_label = "Export a Risorius script"
    filename_ext = ".json"
    rig: StringProperty(name="Rig", default="rig.json", description="The rig that plays it, as the script names it")

    def execute(self, context):
        def write(face):
            text = json.dumps(script_of(face, self.rig), indent=1)
            with open(self.filepath, "w", encoding="utf-8") as file:
                file.write(text + "\n")

        return with_face(self, context, write)


CLASSES = (
    RISORIUS_OT_import_face,
    RISORIUS_OT_import_motion,
    RISORIUS_OT_import_script,
    RISORIUS_OT_import_maps,
    RISORIUS_OT_export_script,
)


def _import_menu(menu, _):
    menu.layout.operator(RISORIUS_OT_import_face.bl_idname, text="Risorius face (.glb)")
    menu.layout.operator(RISORIUS_OT_import_motion.bl_idname, text="Live Link Face (.csv)")
    menu.layout.operator(RISORIUS_OT_import_script.bl_idname, text="Risorius script (.json)")
    menu.layout.operator(RISORIUS_OT_import_maps.bl_idname, text="Risorius maps (results.json)")


def _export_menu(menu, _):
    menu.layout.operator(RISORIUS_OT_export_script.bl_idname, text="Risorius script (.json)")


@bpy.app.handlers.persistent
def _after_load(_):
    bpy.app.driver_namespace[WEIGHT] = driven_weight
    bpy.app.driver_namespace[TAKE] = take_weights


def register():
    for one in CLASSES:
        bpy.utils.register_class(one)
    bpy.types.TOPBAR_MT_file_import.append(_import_menu)
    bpy.types.TOPBAR_MT_file_export.append(_export_menu)
    bpy.app.handlers.load_post.append(_after_load)
    _after_load(None)


def unregister():
    bpy.app.handlers.load_post.remove(_after_load)
    for name in (WEIGHT, TAKE):
        bpy.app.driver_namespace.pop(name, None)
    bpy.types.TOPBAR_MT_file_export.remove(_export_menu)
    bpy.types.TOPBAR_MT_file_import.remove(_import_menu)
    for one in reversed(CLASSES):
        bpy.utils.unregister_class(one)


if __name__ == "__main__":
    register()
