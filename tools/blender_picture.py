"""Renders a scene with Blender's Cycles from a camera that `lucerna render` was given, for a look side
by side. Direct light only, as the passes do; Blender is not a dependency of Lucerna.

  blender -b --factory-startup -P tools/blender_picture.py -- SCENE CAMERA.json OUT.png [WxH] [SAMPLES] [EXPOSURE] [ANIMATION TIME]

CAMERA.json: {"position": [x, y, z], "target": [x, y, z], "fovY": degrees}, y up, metres.
ANIMATION: the name of the one that plays, or none; TIME: where it stands, in seconds.
A scene without lights gets the headlight and ambient light that lucerna gives it. Where Cycles knows
something only as a hint for its viewport, the materials are rewired to mean it: alpha cutoffs and the
backs of single-sided materials. Ambient light becomes emission, for Cycles would darken it by what is
near; and Disney's diffuse reflection, which is up to six times Lambert's where a headlight meets a
surface at a grazing angle, becomes Lambert's, which glTF and OBJ mean.
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
BACKGROUND = (0.035, 0.045, 0.06, 1)  # as scene::Background
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
        for image in bpy.data.images:
            image.alpha_mode = "CHANNEL_PACKED"  # colours are not premultiplied in glTF
    elif extension == ".obj":
        bpy.ops.wm.obj_import(filepath=path, forward_axis="NEGATIVE_Z", up_axis="Y")
    elif extension == ".ply":
        bpy.ops.import_mesh.ply(filepath=path)
    else:
        sys.exit(f"{path}: this script imports glTF, OBJ and PLY")


def play(animation, time):
    """The importer keeps each animation as an NLA track, shifted to the scene's first frame: what plays is
    its action itself, at the scene's frames a second."""
    found = False
    for item in bpy.data.objects:
        if not item.animation_data:
            continue
        item.animation_data.action = None
        for track in item.animation_data.nla_tracks:
            track.mute = True
            if track.name == animation:
                item.animation_data.action = track.strips[0].action
                found = True
    if animation != "none" and not found:
        sys.exit(f"no animation {animation}")
    rendering = bpy.context.scene.render
    frame = time * rendering.fps / rendering.fps_base
    bpy.context.scene.frame_set(int(frame // 1), subframe=frame % 1)


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


def principled(tree, like, color, metallic):
    """The highlights of a Principled BSDF; its diffuse part only where `color` is one."""
    shader = tree.nodes.new("ShaderNodeBsdfPrincipled")
    connect(tree, color, shader.inputs["Base Color"])
    shader.inputs["Metallic"].default_value = metallic
    for name in ("Roughness", "Specular", "Normal"):
        if like.inputs[name].is_linked:
            tree.links.new(source_of(like.inputs[name]), shader.inputs[name])
        elif name != "Normal":
            shader.inputs[name].default_value = like.inputs[name].default_value
    shader.distribution = "GGX"
    return shader.outputs[0]


def combined(tree, kind, *inputs):
    node = tree.nodes.new(kind)
    for socket, source in zip(node.inputs, inputs):
        if isinstance(source, bpy.types.NodeSocket):
            tree.links.new(source, socket)
        else:
            socket.default_value = source
    return node.outputs[0]


def opacity(material, tree, shader):
    """What the file says: with a cutoff where it has one, and of OBJ from the mask's grey."""
    socket = shader.inputs["Alpha"]
    alpha = source_of(socket)
    if not socket.is_linked:
        return alpha
    image = alpha.node
    is_mask = image.type == "TEX_IMAGE" and not image.outputs["Color"].is_linked
    if is_mask:
        image.image.colorspace_settings.name = "Non-Color"
        alpha = image.outputs["Color"]
    if is_mask or material.blend_method == "CLIP":
        cut = tree.nodes.new("ShaderNodeMath")
        cut.operation = "GREATER_THAN"
        cut.inputs[1].default_value = material.alpha_threshold
        tree.links.new(alpha, cut.inputs[0])
        alpha = cut.outputs[0]
    return alpha


def as_lambert(material, ambient):
    """Every Principled BSDF becomes Lambert's diffuse reflection plus its own highlights, ambient light
    and emission, all behind its opacity."""
    tree = material.node_tree
    for shader in [n for n in tree.nodes if n.type == "BSDF_PRINCIPLED"]:
        targets = [link.to_socket for link in shader.outputs[0].links]
        color, metallic = source_of(shader.inputs["Base Color"]), source_of(shader.inputs["Metallic"])
        diffuse = tree.nodes.new("ShaderNodeBsdfDiffuse")
        connect(tree, color, diffuse.inputs["Color"])
        if shader.inputs["Normal"].is_linked:
            tree.links.new(source_of(shader.inputs["Normal"]), diffuse.inputs["Normal"])
        dielectric = combined(tree, "ShaderNodeAddShader", diffuse.outputs[0],
                              principled(tree, shader, (0, 0, 0, 1), 0))
        surface = combined(tree, "ShaderNodeMixShader", metallic, dielectric,
                           principled(tree, shader, color, 1))
        own = tree.nodes.new("ShaderNodeEmission")
        connect(tree, source_of(shader.inputs["Emission"]), own.inputs["Color"])
        own.inputs["Strength"].default_value = shader.inputs["Emission Strength"].default_value
        around = tree.nodes.new("ShaderNodeEmission")
        connect(tree, color, around.inputs["Color"])
        around.inputs["Strength"].default_value = ambient
        for emission in (own, around):
            surface = combined(tree, "ShaderNodeAddShader", surface, emission.outputs[0])
        clear = tree.nodes.new("ShaderNodeBsdfTransparent").outputs[0]
        surface = combined(tree, "ShaderNodeMixShader", opacity(material, tree, shader), clear, surface)
        for target in targets:
            tree.links.new(surface, target)


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
    world.node_tree.nodes["Background"].inputs["Color"].default_value = BACKGROUND
    for rays in ("diffuse", "glossy", "transmission", "scatter"):
        setattr(world.cycles_visibility, rays, False)
    bpy.context.scene.world = world
    if any(item.type == "LIGHT" for item in bpy.data.objects):
        return 0
    sun = bpy.data.lights.new("headlight", "SUN")
    sun.energy, sun.angle = HEADLIGHT, 0
    item = bpy.data.objects.new("headlight", sun)
    item.rotation_euler = camera_item.rotation_euler
    bpy.context.scene.collection.objects.link(item)
    return AMBIENT


def main():
    scene_path, camera_path, out, *rest = sys.argv[sys.argv.index("--") + 1:]
    width, height = map(int, (rest[0] if rest else "640x360").split("x"))
    samples = int(rest[1]) if len(rest) > 1 else 16
    exposure = float(rest[2]) if len(rest) > 2 else 0
    load(os.path.abspath(scene_path))
    if len(rest) > 4:
        play(rest[3], float(rest[4]))
    with open(camera_path, encoding="utf-8") as file:
        item = place_camera(json.load(file))
    ambient = light(item)
    for material in materials():
        as_lambert(material, ambient)
        if material.use_backface_culling:
            hide_back(material)
        material.cycles.sample_as_light = False  # what emits lights nothing else, as in the passes
    for item in bpy.data.objects:
        if item.type == "MESH":
            item.visible_diffuse = item.visible_glossy = item.visible_transmission = False
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
    scene.view_settings.exposure = exposure
    scene.render.image_settings.file_format = "PNG"
    scene.render.image_settings.color_mode = "RGB"
    scene.render.filepath = os.path.abspath(out)
    bpy.ops.render.render(write_still=True)


main()
