"""Renders a scene with Blender's Cycles from a camera that `lucerna render` was given, for a look side
by side. Direct light only, as the passes do; Blender is not a dependency of Lucerna.

  blender -b --factory-startup -P tools/blender_picture.py -- SCENE CAMERA.json OUT.png [WxH] [SAMPLES]

CAMERA.json: {"position": [x, y, z], "target": [x, y, z], "fovY": degrees}, y up, metres.
A scene without lights gets the headlight and ambient light that lucerna gives it. Where Cycles knows
something only as a hint for its viewport, the materials are rewired to mean it: ambient light (as
emission, for Cycles would darken it by what is near) and the backs of single-sided materials.
"""
import json
import math
import os
import sys

import bpy
import numpy
from mathutils import Vector

numpy.bool = bool  # Debian's Blender 3.4 still uses the alias that Debian's NumPy 1.24 dropped
HEADLIGHT = math.pi * 0.8  # irradiance, as scene::complete()
AMBIENT = 0.2
LUMENS_PER_WATT = 683


def from_y_up(p):
    return Vector((p[0], -p[2], p[1]))


def load(path):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    extension = os.path.splitext(path)[1].lower()
    if extension in (".gltf", ".glb"):
        bpy.ops.import_scene.gltf(filepath=path)
        for lamp in bpy.data.lights:
            lamp.energy *= LUMENS_PER_WATT  # the importer turns candela and lux into watts
            lamp.shadow_soft_size = 0
    elif extension == ".obj":
        bpy.ops.wm.obj_import(filepath=path, forward_axis="NEGATIVE_Z", up_axis="Y")
    elif extension == ".ply":
        bpy.ops.import_mesh.ply(filepath=path)
    else:
        sys.exit(f"{path}: this script imports glTF, OBJ and PLY")


def place_camera(camera):
    data = bpy.data.cameras.new("lucerna")
    data.sensor_fit = "VERTICAL"
    data.angle = math.radians(camera["fovY"])
    data.clip_start, data.clip_end = 0.01, 1e5
    item = bpy.data.objects.new("lucerna", data)
    item.location = from_y_up(camera["position"])
    towards = from_y_up(camera["target"]) - item.location
    item.rotation_euler = towards.to_track_quat("-Z", "Y").to_euler()
    bpy.context.scene.collection.objects.link(item)
    bpy.context.scene.camera = item
    return item


def connect(tree, source, socket):
    """`source`: a socket to link, or a value."""
    if isinstance(source, bpy.types.NodeSocket):
        tree.links.new(source, socket)
    else:
        socket.default_value = tuple(source)[:len(socket.default_value)]


def source_of(socket):
    return socket.links[0].from_socket if socket.is_linked else socket.default_value


def add_ambient(material):
    tree = material.node_tree
    for shader in [n for n in tree.nodes if n.type == "BSDF_PRINCIPLED"]:
        own = tree.nodes.new("ShaderNodeVectorMath")
        own.operation = "MULTIPLY"
        connect(tree, source_of(shader.inputs["Emission"]), own.inputs[0])
        own.inputs[1].default_value = (shader.inputs["Emission Strength"].default_value,) * 3
        both = tree.nodes.new("ShaderNodeVectorMath")
        both.operation = "MULTIPLY_ADD"
        connect(tree, source_of(shader.inputs["Base Color"]), both.inputs[0])
        both.inputs[1].default_value = (AMBIENT,) * 3
        tree.links.new(own.outputs[0], both.inputs[2])
        tree.links.new(both.outputs[0], shader.inputs["Emission"])
        shader.inputs["Emission Strength"].default_value = 1


def hide_back(material):
    tree = material.node_tree
    output = next(n for n in tree.nodes if n.type == "OUTPUT_MATERIAL")
    mix = tree.nodes.new("ShaderNodeMixShader")
    tree.links.new(tree.nodes.new("ShaderNodeNewGeometry").outputs["Backfacing"], mix.inputs[0])
    tree.links.new(source_of(output.inputs["Surface"]), mix.inputs[1])
    tree.links.new(tree.nodes.new("ShaderNodeBsdfTransparent").outputs[0], mix.inputs[2])
    tree.links.new(mix.outputs[0], output.inputs["Surface"])


def materials():
    """Those with nodes; objects without a material get a grey one."""
    grey = bpy.data.materials.new("grey")
    grey.use_nodes = True
    grey.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (0.8, 0.8, 0.8, 1)
    grey.node_tree.nodes["Principled BSDF"].inputs["Roughness"].default_value = 1
    for item in bpy.data.objects:
        if item.type == "MESH" and not item.data.materials:
            item.data.materials.append(grey)
    return [m for m in bpy.data.materials if m.use_nodes]


def light(camera_item):
    world = bpy.data.worlds.new("world")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (0, 0, 0, 1)
    bpy.context.scene.world = world
    if any(item.type == "LIGHT" for item in bpy.data.objects):
        return
    for material in materials():
        add_ambient(material)
    sun = bpy.data.lights.new("headlight", "SUN")
    sun.energy, sun.angle = HEADLIGHT, 0
    item = bpy.data.objects.new("headlight", sun)
    item.rotation_euler = camera_item.rotation_euler
    bpy.context.scene.collection.objects.link(item)


def main():
    scene_path, camera_path, out, *rest = sys.argv[sys.argv.index("--") + 1:]
    width, height = map(int, (rest[0] if rest else "640x360").split("x"))
    samples = int(rest[1]) if len(rest) > 1 else 16
    load(os.path.abspath(scene_path))
    with open(camera_path, encoding="utf-8") as file:
        item = place_camera(json.load(file))
    light(item)
    for material in materials():
        if material.use_backface_culling:
            hide_back(material)
    for lamp in bpy.data.lights:
        lamp.use_shadow = False
        lamp.cycles.cast_shadow = False
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples = samples
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.use_denoising = False
    scene.cycles.max_bounces = 0
    scene.cycles.transparent_max_bounces = 32
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.resolution_percentage = 100
    scene.view_settings.view_transform = "Standard"
    scene.render.image_settings.file_format = "PNG"
    scene.render.image_settings.color_mode = "RGB"
    scene.render.filepath = os.path.abspath(out)
    bpy.ops.render.render(write_still=True)


main()
