"""Makes the pictures of tests/cycles with Blender's Cycles, a path tracer that shares nothing with
Lucerna. trace_test compares `lucerna reference` with them.

  blender -b --factory-startup --python-exit-code 1 -P tools/cycles_pictures.py [-- NAME ...]

Reads tests/cycles/pictures.json and of each scene the OBJ and the .lucerna.json; writes NAME.exr, linear
radiance as half floats, and says for each how far two pictures of different seeds are apart, which is its
noise. Needs Blender (3.4; Debian's package); nothing else does. What the scenes may hold is what stands
here: Phong materials without highlight, metallic-roughness ones in the light of one point light, mirrors,
lights and cameras of the scene's file.

Lights are set by physics, not by Blender's units. A sphere or disc is a mesh of radiance
I / (projected area) over its front, and everybody agrees what radiance is. A point light of no size is a
lamp of 4 pi I watts, a directional one a sun of the irradiance. A white card is rendered under each kind
first, whose radiance must be I / (pi d^2) or E / pi, or nothing is made (check_lights()). Each light of a
scene makes a picture of its own, and these are added: Cycles would give most samples to the largest.

glTF's reflection is no node of Cycles', whose microfacets (GGX) are masked and shadowed independently
(G1(l) G1(v)) and have no Fresnel term of their own. With one light of no size, l is known when a surface
is shaded, so that nodes weigh Cycles' closures by what is missing: Schlick's Fresnel term, and the
height-correlated masking over the independent one. Distribution, cosines and 1 / (4 (n.l) (n.v)) stay
Cycles'.
"""
import json
import math
import pathlib
import sys

import bpy
import numpy
from mathutils import Matrix, Vector

numpy.bool = bool  # Debian's Blender 3.4 still uses the alias that Debian's NumPy 1.24 dropped
FOLDER = pathlib.Path(__file__).resolve().parent.parent / "tests" / "cycles"
SAMPLES = 4096


def from_y_up(p):
    return Vector((p[0], -p[2], p[1]))


def looking(position, direction, up=(0, 1, 0)):
    """Placed at a point, looking along -z."""
    back = -from_y_up(direction).normalized()
    right = from_y_up(up).cross(back)
    if right.length < 1e-6:
        right = back.orthogonal()
    right.normalize()
    turned = Matrix((right, back.cross(right), back)).transposed().to_4x4()
    return Matrix.Translation(from_y_up(position)) @ turned


def direction_of(item):
    if "direction" in item:
        return item["direction"]
    return [t - p for t, p in zip(item["target"], item["position"])]


class Value:
    """A number or vector that nodes work out; arithmetic on it makes nodes."""

    def __init__(self, tree, source):
        self.tree, self.source = tree, source

    def node(self, kind, operation, *inputs):
        node = self.tree.nodes.new(kind)
        node.operation = operation
        for socket, value in zip(node.inputs, inputs):
            source = value.source if isinstance(value, Value) else value
            if isinstance(source, bpy.types.NodeSocket):
                self.tree.links.new(source, socket)
            else:
                socket.default_value = source
        return node.outputs

    def math(self, operation, *inputs):
        return Value(self.tree, self.node("ShaderNodeMath", operation, *inputs)[0])

    def vector(self, operation, *inputs):
        return Value(self.tree, self.node("ShaderNodeVectorMath", operation, *inputs)[0])

    def dot(self, other):
        return Value(self.tree, self.node("ShaderNodeVectorMath", "DOT_PRODUCT", self, other)[1])

    def unit(self):
        return self.vector("NORMALIZE", self)

    def __add__(self, other):
        return self.math("ADD", self, other)

    def __sub__(self, other):
        return self.math("SUBTRACT", self, other)

    def __rsub__(self, other):
        return self.math("SUBTRACT", other, self)

    def __mul__(self, other):
        return self.math("MULTIPLY", self, other)

    def __truediv__(self, other):
        return self.math("DIVIDE", self, other)

    def __pow__(self, exponent):
        return self.math("POWER", self, exponent)

    def clamped(self):
        return self.math("MINIMUM", self.math("MAXIMUM", self, 0), 1)


def geometry(tree, name):
    node = next((n for n in tree.nodes if n.type == "NEW_GEOMETRY"), None)
    return Value(tree, (node or tree.nodes.new("ShaderNodeNewGeometry")).outputs[name])


def closure(tree, kind, color, roughness=None):
    """color: three numbers, or three Values."""
    node = tree.nodes.new(kind)
    if isinstance(color[0], Value):
        combine = tree.nodes.new("ShaderNodeCombineXYZ")
        for value, socket in zip(color, combine.inputs):
            tree.links.new(value.source, socket)
        tree.links.new(combine.outputs[0], node.inputs["Color"])
    else:
        node.inputs["Color"].default_value = (*color, 1)
    if roughness is not None:
        node.inputs["Roughness"].default_value = roughness
    return node


def joined(tree, kind, first, second):
    """kind: of a node whose last two inputs are shaders."""
    node = tree.nodes.new(kind)
    for shader, socket in zip((first, second), node.inputs[-2:]):
        tree.links.new(shader.outputs[0], socket)
    return node


def phong(tree, material):
    if any(material["specular"]):
        sys.exit("a Phong highlight: no node of Cycles' is one")
    diffuse = closure(tree, "ShaderNodeBsdfDiffuse", material["albedo"], roughness=0)
    if not material.get("reflectivity"):
        return diffuse
    glossy = closure(tree, "ShaderNodeBsdfGlossy", (1, 1, 1), roughness=0)
    glossy.distribution = "SHARP"
    mix = joined(tree, "ShaderNodeMixShader", diffuse, glossy)
    mix.inputs["Fac"].default_value = material["reflectivity"]
    return mix


def metallic_roughness(tree, material, light_position):
    albedo, metallic, roughness = material["albedo"], material["metallic"], material["roughness"]
    normal, eye = geometry(tree, "Normal"), geometry(tree, "Incoming")
    lamp = Value(tree, tuple(from_y_up(light_position)))
    to_light = lamp.vector("SUBTRACT", lamp, geometry(tree, "Position")).unit()
    halfway = to_light.vector("ADD", to_light, eye).unit()
    away = (1 - eye.dot(halfway)).clamped() ** 5
    fresnel = [away * (1 - f0) + f0 for f0 in (0.04 * (1 - metallic) + metallic * a for a in albedo)]

    def hidden(direction):  # Smith's Lambda of GGX
        squared = normal.dot(direction) ** 2
        return ((((1 - squared) / squared) * roughness ** 4 + 1) ** 0.5 - 1) * 0.5
    eye_hidden, light_hidden = hidden(eye), hidden(to_light)
    correlated = (eye_hidden + 1) * (light_hidden + 1) / (eye_hidden + light_hidden + 1)

    diffuse = closure(tree, "ShaderNodeBsdfDiffuse",
                      [(1 - f) * (1 - metallic) * a for f, a in zip(fresnel, albedo)], roughness=0)
    glossy = closure(tree, "ShaderNodeBsdfGlossy", [f * correlated for f in fresnel], roughness)
    glossy.distribution = "GGX"
    return joined(tree, "ShaderNodeAddShader", diffuse, glossy)


def new_tree(item):
    item.use_nodes = True
    item.node_tree.nodes.clear()
    return item.node_tree


def finish(tree, shader):
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(shader.outputs[0], output.inputs["Surface"])


def add_object(name, data, placed):
    item = bpy.data.objects.new(name, data)
    item.matrix_world = placed
    bpy.context.scene.collection.objects.link(item)
    return item


def mesh_light(light, mesh, placed, strength):
    """Sends out color * strength(tree) from its front, and is only seen by what it lights."""
    material = bpy.data.materials.new(light["name"])
    tree = new_tree(material)
    emission = closure(tree, "ShaderNodeEmission", light["color"])
    front = 1 - geometry(tree, "Backfacing")
    tree.links.new((front * strength(tree)).source, emission.inputs["Strength"])
    finish(tree, emission)
    mesh.materials.append(material)
    item = add_object(light["name"], mesh, placed)
    item.visible_camera = item.visible_shadow = item.visible_glossy = False


def scaled_to(mesh, area):
    mesh.transform(Matrix.Scale(math.sqrt(area / sum(p.area for p in mesh.polygons)), 4))
    return mesh


def sphere(radius):
    """Of many faces. It has the sphere's surface and so, being convex, its projected area in the mean."""
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=5)
    made = bpy.context.object
    mesh = made.data
    bpy.data.objects.remove(made)
    return scaled_to(mesh, 4 * math.pi * radius ** 2)


def disc(radius):
    """Its front along -z."""
    corners = [2 * math.pi * i / 256 for i in range(256)]
    mesh = bpy.data.meshes.new("disc")
    mesh.from_pydata([(math.cos(t), -math.sin(t), 0) for t in corners], [], [range(256)])
    return scaled_to(mesh, math.pi * radius ** 2)


def add_point_light(light):
    placed, radius = Matrix.Translation(from_y_up(light["position"])), light.get("radius", 0)
    if radius > 0:
        mesh_light(light, sphere(radius), placed, lambda _: light["intensity"] / (math.pi * radius ** 2))
        return
    lamp = bpy.data.lights.new(light["name"], "POINT")
    lamp.color, lamp.energy = light["color"], 4 * math.pi * light["intensity"]
    lamp.shadow_soft_size = 0
    add_object(light["name"], lamp, placed)


def add_spot_light(light):
    """glTF's, spread over a disc: the same intensity from all of it, within its cone."""
    inner, outer = (math.cos(math.radians(light[k])) for k in ("innerCone", "outerCone"))
    radiance = light["intensity"] / (math.pi * light["radius"] ** 2)

    def strength(tree):
        along = geometry(tree, "Normal").dot(geometry(tree, "Incoming"))
        ramp = ((along - outer) * (1 / (inner - outer))).clamped() ** 2
        return ramp / along * radiance
    mesh_light(light, disc(light["radius"]), looking(light["position"], direction_of(light)), strength)


def add_directional_light(light):
    """Cycles' sun is lit evenly over a flat disc at distance 1, whose mean cosine is in its irradiance."""
    sun = bpy.data.lights.new(light["name"], "SUN")
    sun.color, sun.angle = light["color"], math.radians(light["angle"])
    squared = math.tan(sun.angle / 2) ** 2
    sun.energy = light["intensity"] * squared / (2 * (math.sqrt(1 + squared) - 1))
    add_object(light["name"], sun, looking((0, 0, 0), light["direction"]))


def add_light(light):
    kinds = {"point": add_point_light, "spot": add_spot_light, "directional": add_directional_light}
    kinds[light["kind"]](light)


def add_camera(camera, lens_radius=0, focus_distance=1):
    data = bpy.data.cameras.new("camera")
    data.sensor_fit = "VERTICAL"
    data.clip_start, data.clip_end = 0.001, 1e4
    if "height" in camera:
        data.type, data.ortho_scale = "ORTHO", camera["height"]
    else:
        data.angle = math.radians(camera["fovY"])
    if lens_radius:
        data.dof.use_dof = True
        data.dof.focus_distance = focus_distance
        data.dof.aperture_fstop = data.lens * 1e-3 / (2 * lens_radius)  # focal length in mm
    bpy.context.scene.camera = add_object(
        "camera", data, looking(camera["position"], direction_of(camera), camera.get("up", (0, 1, 0))))


def set_background(color):
    """Seen by the camera and in mirrors; it lights nothing."""
    world = bpy.data.worlds.new("world")
    tree = new_tree(world)
    output = tree.nodes.new("ShaderNodeOutputWorld")
    tree.links.new(closure(tree, "ShaderNodeBackground", color).outputs[0], output.inputs["Surface"])
    world.cycles_visibility.diffuse = False
    world.cycles.sampling_method = "NONE"
    bpy.context.scene.world = world


def new_scene(size, samples):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.render.resolution_x, scene.render.resolution_y = size
    scene.render.resolution_percentage = 100
    cycles = scene.cycles
    cycles.samples = samples
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.pixel_filter_type = "BOX"
    cycles.light_sampling_threshold = 0
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.max_bounces = 0
    image = scene.render.image_settings
    image.file_format, image.color_mode, image.color_depth = "OPEN_EXR", "RGB", "32"
    for name in dir(scene.render):  # nothing of the machine in the file
        if name.startswith("use_stamp_"):
            setattr(scene.render, name, False)
    return scene


def rendered(seed=0):
    """Rows of pixels from below, RGBA."""
    scene = bpy.context.scene
    scene.cycles.seed = seed
    scene.render.filepath = str(pathlib.Path(bpy.app.tempdir) / "picture.exr")
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(scene.render.filepath)
    pixels = numpy.array(image.pixels[:], dtype=numpy.float64)
    bpy.data.images.remove(image)
    return pixels.reshape(-1, 4)


def check_lights():
    """A white card, and what closed forms say of it."""
    distance, intensity = 2.5, 7
    lights = [{"kind": "point"}, {"kind": "point", "radius": 0.8},
              {"kind": "spot", "radius": 0.02, "innerCone": 20, "outerCone": 30},
              {"kind": "directional", "angle": 40}]
    for light in lights:
        new_scene((1, 1), 1 << 16)
        mesh = bpy.data.meshes.new("card")
        mesh.from_pydata([(-1, 0, -1), (1, 0, -1), (1, 0, 1), (-1, 0, 1)], [], [(0, 1, 2, 3)])
        material = bpy.data.materials.new("card")
        tree = new_tree(material)
        finish(tree, phong(tree, {"albedo": [1, 1, 1], "specular": [0, 0, 0]}))
        mesh.materials.append(material)
        add_object("card", mesh, Matrix())
        add_light({"name": light["kind"], "position": [0, 0, distance], "direction": [0, 0, -1],
                   "color": [1, 1, 1], "intensity": intensity, **light})
        add_camera({"position": [0, 0, 2], "direction": [0, 0, -1], "fovY": 0.02})
        irradiance = intensity if light["kind"] == "directional" else intensity / distance ** 2
        ratio = rendered()[0, 0] / (irradiance / math.pi)
        print(f"white card, {light}: {ratio:.4f} of the closed form", flush=True)
        if abs(ratio - 1) > 2e-3:
            sys.exit("Cycles' light is another than was meant")


def picture(entry, text, light, seed):
    """Of one of the scene's lights."""
    scene = new_scene(entry["size"], SAMPLES)
    bpy.ops.wm.obj_import(filepath=str(FOLDER / f"{entry['scene']}.obj"), forward_axis="NEGATIVE_Z",
                          up_axis="Y")
    for material in list(bpy.data.materials):
        given, tree = text["materials"][material.name], new_tree(material)
        finish(tree, phong(tree, given) if given["model"] == "phong" else
               metallic_roughness(tree, given, light["position"]))
        if given.get("reflectivity"):  # highlights alone go on, and they are of mirrors
            scene.cycles.max_bounces = scene.cycles.glossy_bounces = 8
            scene.cycles.diffuse_bounces = 0
    add_light(light)
    camera = next(c for c in text["cameras"] if c["name"] == entry["camera"])
    add_camera(camera, entry.get("lensRadius", 0), entry.get("focusDistance", 1))
    if light is text["lights"][0]:
        set_background(text["background"]["color"])
    return rendered(seed)


def save(path, pixels, size):
    image = bpy.data.images.new("sum", *size, float_buffer=True)
    image.pixels = pixels.ravel()
    settings = bpy.context.scene.render.image_settings
    settings.color_depth, settings.exr_codec = "16", "ZIP"
    image.save_render(str(path))


def make(entry):
    text = json.loads((FOLDER / f"{entry['scene']}.lucerna.json").read_text())
    a, b = (sum(picture(entry, text, light, seed) for light in text["lights"]) for seed in (0, 1))
    save(FOLDER / f"{entry['name']}.exr", (a + b) / 2, entry["size"])
    # The difference of two pictures has twice the noise of their mean.
    noise = numpy.abs(a - b)[:, :3].sum() / 2 / a[:, :3].sum()
    print(f"{entry['name']}: noise {noise:.5f} of the mean radiance", flush=True)


def main():
    names = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    check_lights()
    for entry in json.loads((FOLDER / "pictures.json").read_text()):
        if not names or entry["name"] in names:
            make(entry)


main()
