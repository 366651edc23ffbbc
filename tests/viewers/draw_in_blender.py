# Imports a lit scene into Blender and draws it.
#
#   blender -b --python-exit-code 1 --python draw_in_blender.py -- FOLDER/scene.glb PICTURE.png
#
# The camera and the unlit materials come from the glTF file. An OBJ file has neither: then the script makes a camera
# from scene.view.json beside the file, and connects each texture to an emission instead of a lit surface.
import json
import math
import os
import sys

import bpy
from mathutils import Matrix, Vector

file, picture = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene


def add_camera():
    with open(os.path.join(os.path.dirname(file), "scene.view.json")) as text:
        view = json.load(text)
    to_blender = Matrix.Rotation(math.radians(90), 4, "X")  # the importer turns y upwards into z upwards
    eye = to_blender @ Vector(view["eye"])
    forward = (to_blender @ Vector(view["look_at"]) - eye).normalized()
    right = forward.cross(to_blender @ Vector(view["up"])).normalized()
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.matrix_world = Matrix((right, right.cross(forward), -forward)).transposed().to_4x4()
    camera.matrix_world.translation = eye
    camera.data.sensor_fit = "VERTICAL"
    camera.data.angle = math.radians(view["fov"])
    camera.data.clip_end = 1e6
    bpy.context.collection.objects.link(camera)


def make_unlit(material):
    nodes, links = material.node_tree.nodes, material.node_tree.links
    emission = nodes.new("ShaderNodeEmission")
    for node in list(nodes):
        if node.type == "TEX_IMAGE":
            links.new(node.outputs["Color"], emission.inputs["Color"])
        if node.type == "OUTPUT_MATERIAL":
            links.new(emission.outputs["Emission"], node.inputs["Surface"])


if file.endswith(".glb"):
    # Not by normals: Debian's Blender 3.4 and numpy 1.24 do not fit together there.
    bpy.ops.import_scene.gltf(filepath=file, import_shading="FLAT")
else:
    bpy.ops.wm.obj_import(filepath=file)
    add_camera()
    for each in bpy.data.materials:
        make_unlit(each)

print("objects:", " ".join(sorted(o.name for o in bpy.data.objects if o.type == "MESH")))
scene.camera = next(o for o in bpy.data.objects if o.type == "CAMERA")
scene.render.engine = "CYCLES"
scene.cycles.device = "CPU"
scene.cycles.samples = 4
scene.cycles.max_bounces = 8  # the importer mixes unlit materials with transparent ones
scene.cycles.use_denoising = False
scene.view_settings.view_transform = "Standard"
scene.render.resolution_x, scene.render.resolution_y = 800, 600
scene.render.image_settings.color_mode = "RGB"
scene.render.filepath = os.path.abspath(picture)
bpy.ops.render.render(write_still=True)
