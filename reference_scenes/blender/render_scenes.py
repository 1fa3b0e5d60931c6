"""Renders spheres with highlights in Blender's Cycles, one ray through the middle of each pixel.

    blender -b --factory-startup -noaudio --python render_scenes.py -- job.json

job.json (numbers and enumerations only):
    {"threads": 2, "secondsPerScene": 600, "goOn": true, "scenes": [
      {"name": "scene0", "width": 256, "height": 256,
       "camera": {"origin": [..], "target": [..], "up": [..], "fovDegrees": 28, "offset": [0, 0]},
       "lights": [{"kind": "directional", "direction": [..], "irradiance": [r, g, b]},
                  {"kind": "point", "position": [..], "intensity": [r, g, b], "normal": [..]}],
       "materials": [{"model": "phong_rdf", "lobe": "cosine", "normalisation": "exact",
                      "exponent": 64, "fresnel": "none",
                      "specular": [r, g, b], "diffuse": [r, g, b], "mirror": [r, g, b]}],
       "spheres": [{"center": [..], "radius": 1, "material": 0}],
       "planes": [{"point": [..], "u": [..], "v": [..],
                   "material": 0, "checkerMaterial": 0, "checkerSize": 1}],
       "native": false, "passes": [{"light": 0, "mirrors": 0}]}]}

Native highlights are Cycles' own closure, others are nodes. Each pass is a picture of its own, NAME-PASS.exr (float32, beside job.json): what comes from one light
by so many mirrors. Whoever asked for them adds them up, in more digits than a renderer would. What
happens is told in lines

    lobelia: begin NAME
    lobelia: done NAME SECONDS CPU_SECONDS PEAK_BYTES
    lobelia: failed NAME WHY
    lobelia: more

"more" comes with "goOn" alone, when all scenes are done: then a line of standard input names a file,
beside job.json, with one scene more. At its end, or an empty line, so does this program.
CPU_SECONDS and PEAK_BYTES are of the process since it started.

The coefficients and lobes below are written from their formulas and not from Lobelia's source, so
that a mistake there shows as a difference of pictures.
"""

import json
import math
import os
import re
import signal
import sys
import time

import bpy
from mathutils import Matrix, Vector


# ---- Coefficients: what multiplies the lobe to give radiance for unit irradiance -----------------

REFLECTION_MODELS = ("phong_rdf", "modified_phong")
HALF_VECTOR_MODELS = ("blinn_phong_rdf", "modified_blinn_phong",
                      "blinn_phong_ndf", "blinn_phong_heightfield")
RDF_MODELS = ("phong_rdf", "blinn_phong_rdf")  # their radiance has no factor N.L


def cosine_exact(model, n):
    """1 over the integral, times 2 pi, of cos^n with the weight that the model has; a microfacet
    distribution D (the last two) reflects D/4."""
    tail = 2.0 ** (-n / 2)
    return {
        "phong_rdf": (n + 1) / (2 * math.pi),
        "modified_phong": (n + 2) / (2 * math.pi),
        "blinn_phong_rdf": (n + 2) / (4 * math.pi * (2 - tail)),
        "modified_blinn_phong": (n + 2) * (n + 4) / (8 * math.pi * (tail + n)),
        "blinn_phong_ndf": (n + 1) / (8 * math.pi),
        "blinn_phong_heightfield": (n + 2) / (8 * math.pi),
    }[model]


def cosine_paper(model, n):
    """The paper prints 4 pi instead of 8 pi in one row, and so twice the energy."""
    misprint = 2 if model == "modified_blinn_phong" else 1
    return misprint * cosine_exact(model, n)


def cs16_paper(model, n):
    return {
        "phong_rdf": 1.063 * n / (2 * math.pi),
        "modified_phong": (1.063 * n + 1) / (2 * math.pi),
        "blinn_phong_rdf": (1.068 * n + 0.96) / (8 * math.pi),
        "modified_blinn_phong": (1.027 * n + 4.8) / (8 * math.pi),
        "blinn_phong_ndf": 1.063 * n / (8 * math.pi),
        "blinn_phong_heightfield": (1.063 * n + 1) / (8 * math.pi),
    }[model]


def order_of(lobe):
    """The k of a lobe cs_k, or None."""
    return int(lobe[2:]) if re.fullmatch("cs[0-9]+", lobe) else None


def lobe_value(lobe, s, n):
    """Of s = 1 - cos(angle) below 1."""
    k = order_of(lobe)
    if k:
        return max(0.0, 1 - n * s / k) ** k
    if lobe == "spherical_gaussian":
        return math.exp(-n * s)
    if lobe == "gauss":
        return math.exp(-2 * n * math.asin(math.sqrt(s / 2)) ** 2)
    if lobe == "schlick":
        return (1 - s) / (1 - s + n * s)
    raise KeyError(lobe)


def integral(f, end):
    """From 0 to end by the rule of Takahasi and Mori, whose points crowd at both ends: a lobe of any
    sharpness is resolved at 0, and one that drops only at the horizon is there."""
    step, total = 1 / 64, 0.0
    for i in range(-205, 206):
        u = math.pi / 2 * math.sinh(i * step)
        slope = math.pi / 4 * math.cosh(i * step) / math.cosh(u) ** 2
        total += f(end / (1 + math.exp(-2 * u))) * slope
    return total * end * step


def exact(model, lobe, n):
    """1 over 2 pi times the integral of the lobe over the angle x = 0..pi/2, with the model's weight; a
    microfacet distribution D (the last two) reflects D/4."""
    if lobe == "cosine":
        return cosine_exact(model, n)
    part, cosine, factor = {   # the lobe's angle in terms of x; whether cos x is a weight
        "phong_rdf": (1.0, False, 1),
        "modified_phong": (1.0, True, 1),
        "blinn_phong_rdf": (0.5, False, 1),
        "modified_blinn_phong": (0.5, True, 1),
        "blinn_phong_ndf": (1.0, False, 4),
        "blinn_phong_heightfield": (1.0, True, 4),
    }[model]
    # Where the lobe ends or has fallen to 4e-18, in s; Schlick's reaches to the horizon.
    reach = {"schlick": 1.0}.get(lobe, (order_of(lobe) or 40) / n)
    end = min(math.pi / 2, 2 * math.asin(math.sqrt(min(1.0, reach) / 2)) / part)

    def integrand(x):
        s = 2 * math.sin(part * x / 2) ** 2
        return lobe_value(lobe, s, n) * math.sin(x) * (math.cos(x) if cosine else 1)

    return 1 / (2 * math.pi * factor * integral(integrand, end))


def coefficient_of(material):
    model, lobe, n = material["model"], material["lobe"], material["exponent"]
    if material["normalisation"] == "paper":
        return {"cosine": cosine_paper, "cs16": cs16_paper}[lobe](model, n)
    return exact(model, lobe, n)


# ---- Formulas as shader nodes --------------------------------------------------------------------

class Nodes:
    """Arithmetic on sockets of a shader's node tree. Numbers and triples stand for constants."""

    def __init__(self, tree):
        self.tree = tree

    def new(self, kind, **properties):
        node = self.tree.nodes.new(kind)
        for name, value in properties.items():
            setattr(node, name, value)
        return node

    def feed(self, socket, value):
        if isinstance(value, bpy.types.NodeSocket):
            self.tree.links.new(value, socket)
        else:
            socket.default_value = value

    def math(self, operation, *operands):
        node = self.new("ShaderNodeMath", operation=operation, use_clamp=False)
        for socket, value in zip(node.inputs, operands):
            self.feed(socket, value)
        return node.outputs[0]

    def vector(self, operation, *operands, scale=None):
        node = self.new("ShaderNodeVectorMath", operation=operation)
        for socket, value in zip(node.inputs, operands):
            self.feed(socket, value)
        if scale is not None:
            self.feed(node.inputs["Scale"], scale)
        scalar = operation in ("DOT_PRODUCT", "LENGTH")
        return node.outputs["Value" if scalar else "Vector"]

    def constant(self, triple):
        node = self.new("ShaderNodeCombineXYZ")
        for socket, value in zip(node.inputs, triple):
            socket.default_value = value
        return node.outputs[0]

    def one_minus_cos(self, a, b):
        """Of unit vectors, from their difference: 1 - a.b has no digits left near the peak."""
        difference = self.vector("SUBTRACT", a, b)
        return self.math("MULTIPLY", 0.5, self.vector("DOT_PRODUCT", difference, difference))

    def cosine_lobe(self, s, n):
        """(1 - s)^n as exp(n log1p(-s)). A float32 power of 1 - s is off by 2e-5 at n = 1024; with
        w = 1 - s as rounded, log(w) s/(1 - w) takes the rounding out again."""
        w = self.math("MAXIMUM", self.math("SUBTRACT", 1.0, s), 0.0)
        rounded_s = self.math("SUBTRACT", 1.0, w)
        is_zero = self.math("LESS_THAN", rounded_s, 1e-12)
        ratio = self.math("DIVIDE", s, self.math("ADD", rounded_s, is_zero))
        # A logarithm node returns 0 for 0, which would be a lobe of 1: see the last factor.
        logarithm = self.math("MULTIPLY", self.math("LOGARITHM", w, math.e), ratio)
        log1p = self.math("SUBTRACT", logarithm, self.math("MULTIPLY", s, is_zero))
        lobe = self.math("EXPONENT", self.math("MULTIPLY", n, log1p))
        return self.math("MULTIPLY", lobe, self.math("GREATER_THAN", w, 0.0))

    def half_square_of_angle(self, s):
        """Of the angle whose 1 - cos is s. An arc cosine would lose the digits of a small one."""
        half = self.math("ARCSINE", self.math("SQRT", self.math("MULTIPLY", 0.5, s)))
        return self.math("MULTIPLY", 2.0, self.math("MULTIPLY", half, half))

    def lobe(self, name, s, n):
        k = order_of(name)
        if name == "cosine":
            value = self.cosine_lobe(s, n)
        elif k:  # (1 - n s / k)^k is cos^k for another s
            value = self.cosine_lobe(self.math("MULTIPLY", n / k, s), k)
        elif name == "spherical_gaussian":
            value = self.math("EXPONENT", self.math("MULTIPLY", -n, s))
        elif name == "gauss":
            value = self.math("EXPONENT", self.math("MULTIPLY", -n, self.half_square_of_angle(s)))
        elif name == "schlick":
            c = self.math("MAXIMUM", self.math("SUBTRACT", 1.0, s), 0.0)
            value = self.math("DIVIDE", c, self.math("ADD", c, self.math("MULTIPLY", n, s)))
        else:
            raise KeyError(name)
        # Every lobe ends at 90 degrees.
        return self.math("MULTIPLY", value, self.math("LESS_THAN", s, 1.0))

    def fresnel(self, kind, reflectance, cosine, at_grazing=1.0):
        """The colour of the highlight or mirror: F0, or Schlick's F0 + (F90 - F0)(1 - cosine)^5."""
        if kind == "none":
            return self.constant(reflectance)
        if kind != "schlick":
            raise KeyError(kind)
        base = self.math("MAXIMUM", self.math("SUBTRACT", 1.0, cosine), 0.0)
        square = self.math("MULTIPLY", base, base)
        weight = self.math("MULTIPLY", self.math("MULTIPLY", square, square), base)
        rest = self.constant([at_grazing - c for c in reflectance])
        return self.vector("ADD", self.vector("SCALE", rest, scale=weight), tuple(reflectance))

    def choose(self, condition, a, b):
        """Of vectors: a where condition is 1, b where it is 0."""
        other = self.math("SUBTRACT", 1.0, condition)
        return self.vector("ADD", self.vector("SCALE", a, scale=condition),
                           self.vector("SCALE", b, scale=other))


class Surface(Nodes):
    """A material in which one lamp and any number of mirrors can be seen. It is a diffuse surface
    (radiance: colour/pi times N.L times the lamp's light) whose colour at each point is what the
    highlight asks for. The lamp is real: horizon, shadow, N.L and the light that arrives are Cycles'
    own. (A surface that shines with the finished radiance is not closer to the truth, and sees no
    shadow.)"""

    def __init__(self, light, lamp):
        self.material = bpy.data.materials.new("surface")
        self.material.use_nodes = True
        super().__init__(self.material.node_tree)
        self.tree.nodes.clear()
        geometry = self.new("ShaderNodeNewGeometry")
        self.position = geometry.outputs["Position"]
        self.normal = geometry.outputs["Normal"]  # of a plane, the one towards the eye
        self.to_eye = geometry.outputs["Incoming"]
        self.falloff = None
        if light["kind"] == "point":
            offset = self.vector("SUBTRACT", tuple(light["position"]), self.position)
            self.to_light = self.vector("NORMALIZE", offset)
            if any(light["normal"]):  # a lamp has no cosine of its own
                towards = self.vector("DOT_PRODUCT", self.to_light,
                                      tuple(-c for c in light["normal"]))
                self.falloff = self.math("MAXIMUM", towards, 0.0)
        else:
            # The lamp's own direction as Blender rounded it: a different rounding would not cancel
            # in lobe/N.L * N.L, which is 2e-4 of the peak where N.L is 1e-3.
            self.to_light = self.constant(lamp.matrix_world.col[2][:3])

    def highlight(self, material):
        """The colour of a diffuse surface that looks like the material's highlight and base."""
        model, n = material["model"], material["exponent"]
        if model in REFLECTION_MODELS:
            twice = self.math("MULTIPLY", 2.0, self.vector("DOT_PRODUCT", self.normal, self.to_eye))
            mirrored = self.vector("SUBTRACT", self.vector("SCALE", self.normal, scale=twice),
                                   self.to_eye)
            s = self.one_minus_cos(mirrored, self.to_light)
        elif model in HALF_VECTOR_MODELS:
            half = self.vector("NORMALIZE", self.vector("ADD", self.to_light, self.to_eye))
            s = self.one_minus_cos(self.normal, half)
        else:
            raise KeyError(model)

        # Radiance = (specular lobe + diffuse/pi) N.L E, where an RDF's lobe is without the N.L.
        weight = self.lobe(material["lobe"], s, n)
        if model in RDF_MODELS:
            # What Cycles multiplies is divided out; where N.L <= 0 it shows black in any case.
            n_dot_l = self.vector("DOT_PRODUCT", self.normal, self.to_light)
            weight = self.math("DIVIDE", weight, self.math("MAXIMUM", n_dot_l, 1e-7))
        weight = self.math("MULTIPLY", math.pi * coefficient_of(material), weight)
        # V.H is half the length of L + V.
        both = self.vector("LENGTH", self.vector("ADD", self.to_light, self.to_eye))
        specular = self.fresnel(material["fresnel"], material["specular"],
                                self.math("MULTIPLY", 0.5, both))
        return self.vector("ADD", self.vector("SCALE", specular, scale=weight),
                           tuple(material["diffuse"]))

    def closure(self, material):
        """The highlight by Cycles' own closure of Ashikhmin and Shirley, whose distribution is cos^n
        of the half-vector angle. Under a unit sun it shows
            (n + 1)/(8 pi) (N.H)^n N.L / ((H.V) max(N.L, N.V)):
        its colour takes out that geometry term, and puts in what the model has."""
        model, n = material["model"], material["exponent"]
        if model not in HALF_VECTOR_MODELS or material["lobe"] != "cosine":
            raise KeyError(model + " " + material["lobe"])
        glossy = self.new("ShaderNodeBsdfGlossy")
        glossy.distribution = "ASHIKHMIN_SHIRLEY"
        glossy.inputs["Roughness"].default_value = (2/(n + 2))**0.25
        n_dot_l = self.vector("DOT_PRODUCT", self.normal, self.to_light)
        n_dot_v = self.vector("DOT_PRODUCT", self.normal, self.to_eye)
        both = self.vector("LENGTH", self.vector("ADD", self.to_light, self.to_eye))
        h_dot_v = self.math("MULTIPLY", 0.5, both)
        weight = self.math("MULTIPLY", h_dot_v, self.math("MAXIMUM", n_dot_l, n_dot_v))
        if model in RDF_MODELS:
            weight = self.math("DIVIDE", weight, self.math("MAXIMUM", n_dot_l, 1e-7))
        weight = self.math("MULTIPLY", coefficient_of(material)*8*math.pi/(n + 1), weight)
        color = self.fresnel(material["fresnel"], material["specular"], h_dot_v)
        if self.falloff is not None:
            weight = self.math("MULTIPLY", weight, self.falloff)
        self.feed(glossy.inputs["Color"], self.vector("SCALE", color, scale=weight))
        return glossy.outputs[0]

    def mirror(self, material):
        if not any(material["mirror"]):
            return self.constant((0, 0, 0))
        cosine = self.vector("DOT_PRODUCT", self.normal, self.to_eye)
        at_grazing = min(1.0, 50*max(material["mirror"]))  # a mirror of reflectance 0 is none
        return self.fresnel(material["fresnel"], material["mirror"], cosine, at_grazing)

    def finish(self, color, mirror, mirrors, closure=None):
        """The base as seen by so many mirrors: before, a surface is a mirror and nothing else."""
        if self.falloff is not None:
            color = self.vector("SCALE", color, scale=self.falloff)
        base = self.new("ShaderNodeBsdfDiffuse")
        self.feed(base.inputs["Color"], color)
        shader = base.outputs[0]
        if closure is not None:
            both = self.new("ShaderNodeAddShader")
            self.feed(both.inputs[0], shader)
            self.feed(both.inputs[1], closure)
            shader = both.outputs[0]
        if mirrors > 0:
            glossy = self.new("ShaderNodeBsdfGlossy")
            if "SHARP" in glossy.bl_rna.properties["distribution"].enum_items:
                glossy.distribution = "SHARP"  # until Blender 3.6
            glossy.inputs["Roughness"].default_value = 0
            self.feed(glossy.inputs["Color"], mirror)
            depth = self.new("ShaderNodeLightPath").outputs["Ray Depth"]
            mix = self.new("ShaderNodeMixShader")
            self.feed(mix.inputs[0], self.math("LESS_THAN", depth, mirrors - 0.5))
            self.feed(mix.inputs[1], shader)
            self.feed(mix.inputs[2], glossy.outputs[0])
            shader = mix.outputs[0]
        output = self.new("ShaderNodeOutputMaterial")
        self.tree.links.new(shader, output.inputs["Surface"])
        return self.material


def sphere_material(job, sphere, light, lamp, mirrors):
    surface = Surface(light, lamp)
    material = job["materials"][sphere["material"]]
    if job["native"]:
        return surface.finish(surface.constant(material["diffuse"]), surface.mirror(material), mirrors,
                              surface.closure(material))
    return surface.finish(surface.highlight(material), surface.mirror(material), mirrors)


def plane_material(job, plane, light, lamp, mirrors, is_lit):
    """A lamp that lies in the plane shines along it; Cycles' rounding would light points at random."""
    surface = Surface(light, lamp)
    first = job["materials"][plane["material"]]
    color, mirror = surface.highlight(first), surface.mirror(first)
    if plane["checkerMaterial"] != plane["material"]:
        from_point = surface.vector("SUBTRACT", surface.position, tuple(plane["point"]))
        squares = [surface.math("FLOOR", surface.math(
            "DIVIDE", surface.vector("DOT_PRODUCT", from_point, tuple(plane[axis])),
            plane["checkerSize"])) for axis in ("u", "v")]
        half = surface.math("MULTIPLY", 0.5, surface.math("ADD", *squares))
        is_odd = surface.math("GREATER_THAN", surface.math("FRACT", half), 0.25)
        second = job["materials"][plane["checkerMaterial"]]
        color = surface.choose(is_odd, surface.highlight(second), color)
        mirror = surface.choose(is_odd, surface.mirror(second), mirror)
    return surface.finish(color if is_lit else surface.constant((0, 0, 0)), mirror, mirrors)


# ---- The scene -----------------------------------------------------------------------------------

def unit(v):
    length = math.sqrt(sum(c * c for c in v))
    return [c / length for c in v]


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def towards_light(light):
    return [-c for c in unit(light["direction"])]


def empty_scene(width, height, threads, mirrors):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"

    cycles = scene.cycles
    cycles.device = "CPU"
    # The first sample of a pixel is in the middle of the pixel filter. Only the filter's table
    # shifts it, in proportion to its width, and .01 is the narrowest that Blender takes.
    cycles.samples = 1
    cycles.pixel_filter_type = "GAUSSIAN"
    cycles.filter_width = 0.01
    cycles.seed = 0
    # No more reflections than a pass asks for, and none left out at random.
    cycles.max_bounces = cycles.glossy_bounces = cycles.min_light_bounces = mirrors
    cycles.diffuse_bounces = 0
    # All of these are on by default and change single pixels: noise removal, clamping of bright
    # light, blurring, and a random choice whether a dim light is worth its shadow ray.
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False
    cycles.sample_clamp_direct = 0
    cycles.sample_clamp_indirect = 0
    cycles.blur_glossy = 0
    cycles.light_sampling_threshold = 0
    cycles.film_exposure = 1
    cycles.use_auto_tile = False

    render = scene.render
    render.resolution_x, render.resolution_y = width, height
    render.resolution_percentage = 100
    render.pixel_aspect_x = render.pixel_aspect_y = 1
    render.film_transparent = False
    render.dither_intensity = 0
    render.use_compositing = False
    render.use_sequencer = False
    render.threads_mode, render.threads = "FIXED", threads
    image = render.image_settings
    image.file_format, image.color_mode, image.color_depth = "OPEN_EXR", "RGB", "32"

    world = bpy.data.worlds.new("black")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0
    scene.world = world
    return scene


def add_camera(scene, camera, width, height):
    """From the vectors themselves: columns right, up, -forward, eye."""
    forward = unit(minus(camera["target"], camera["origin"]))
    right = unit(cross(forward, camera["up"]))
    up = cross(right, forward)
    data = bpy.data.cameras.new("camera")
    data.type = "PERSP"
    data.sensor_fit = "HORIZONTAL"
    half_width = math.tan(math.radians(camera["fovDegrees"]) / 2)
    data.lens = max(1.0, 16 / half_width)  # mm; Blender takes no shorter one
    data.sensor_width = 2 * data.lens * half_width
    # Blender moves the picture the other way, and counts both in widths.
    data.shift_x = -camera["offset"][0]
    data.shift_y = -camera["offset"][1]*height/width
    data.clip_start, data.clip_end = 0.01, 1e6
    thing = bpy.data.objects.new("camera", data)
    scene.collection.objects.link(thing)
    thing.matrix_world = Matrix([[right[i], up[i], -forward[i], camera["origin"][i]]
                                 for i in range(3)] + [[0, 0, 0, 1]])
    scene.camera = thing


def add_lamp(scene, light):
    """A lamp without extent: sun angle or radius 0. Its strength is its brightest channel, because
    a colour above 1 need not survive."""
    directional = light["kind"] == "directional"
    power = light["irradiance"] if directional else light["intensity"]
    peak = max(power)
    data = bpy.data.lights.new("lamp", "SUN" if directional else "POINT")
    data.color = [c / peak for c in power] if peak > 0 else (0, 0, 0)
    thing = bpy.data.objects.new("lamp", data)
    scene.collection.objects.link(thing)
    if directional:
        data.energy = peak  # W/m^2 on a plane facing the sun
        data.angle = 0
        thing.rotation_mode = "QUATERNION"  # a lamp shines along its -Z
        thing.rotation_quaternion = Vector(towards_light(light)).to_track_quat("Z", "Y")
    else:
        data.energy = 4 * math.pi * peak  # W, from W/sr
        data.shadow_soft_size = 0
        thing.location = light["position"]
    return thing


def add_sphere(scene, sphere, material):
    """A point primitive, which Cycles intersects as a true sphere with its true normal. A mesh of
    64 x 32 faces is 2 % of the peak off at n = 64, even when shaded smooth."""
    mesh = bpy.data.meshes.new("point")
    mesh.from_pydata([(0, 0, 0)], [], [])
    mesh.materials.append(material)
    thing = bpy.data.objects.new("sphere", mesh)
    thing.location = sphere["center"]
    scene.collection.objects.link(thing)

    group = bpy.data.node_groups.new("sphere", "GeometryNodeTree")
    if hasattr(group, "interface"):  # Blender 4
        for direction in ("INPUT", "OUTPUT"):
            group.interface.new_socket("Geometry", in_out=direction,
                                       socket_type="NodeSocketGeometry")
    else:
        group.inputs.new("NodeSocketGeometry", "Geometry")
        group.outputs.new("NodeSocketGeometry", "Geometry")
    vertex = group.nodes.new("NodeGroupInput")
    point = group.nodes.new("GeometryNodeMeshToPoints")
    point.inputs["Radius"].default_value = sphere["radius"]
    painted = group.nodes.new("GeometryNodeSetMaterial")
    painted.inputs["Material"].default_value = material
    result = group.nodes.new("NodeGroupOutput")
    group.links.new(vertex.outputs[0], point.inputs[0])
    group.links.new(point.outputs[0], painted.inputs[0])
    group.links.new(painted.outputs[0], result.inputs[0])
    thing.modifiers.new("sphere", "NODES").node_group = group
    return thing


def add_plane(scene, plane, eye, material):
    """Squares within squares around the point below the eye, each ten times the last, to beyond what
    a pixel of the horizon shows: a single large one would be uneven where it is seen from near."""
    u, v = plane["u"], plane["v"]
    offset = minus(eye, plane["point"])
    middle = [p + dot(offset, u)*a + dot(offset, v)*b for p, a, b in zip(plane["point"], u, v)]
    corners, faces = [], [(0, 1, 2, 3)]
    for ring in range(7):
        half = 10.0**ring
        corners += [[m + half*(x*a + y*b) for m, a, b in zip(middle, u, v)]
                    for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        inner, outer = 4*(ring - 1), 4*ring
        if ring > 0:
            faces += [(inner + i, outer + i, outer + (i + 1) % 4, inner + (i + 1) % 4)
                      for i in range(4)]
    mesh = bpy.data.meshes.new("plane")
    mesh.from_pydata(corners, [], faces)
    mesh.materials.append(material)
    thing = bpy.data.objects.new("plane", mesh)
    scene.collection.objects.link(thing)
    return thing


def render_pass(job, index, threads, file_name):
    light = job["lights"][job["passes"][index]["light"]]
    mirrors = job["passes"][index]["mirrors"]
    scene = empty_scene(job["width"], job["height"], threads, mirrors)
    add_camera(scene, job["camera"], job["width"], job["height"])
    lamp = add_lamp(scene, light)
    bpy.context.view_layer.update()  # computes the lamp's matrix
    surfaces = [add_sphere(scene, sphere, sphere_material(job, sphere, light, lamp, mirrors))
                for sphere in job["spheres"]]
    for plane in job["planes"]:
        is_lit = len(surfaces) not in light.get("liesOn", ())
        surfaces.append(add_plane(scene, plane, job["camera"]["origin"],
                                  plane_material(job, plane, light, lamp, mirrors, is_lit)))
    for index in light.get("liesOn", ()):
        surfaces[index].visible_shadow = False  # the one lamp of this pass lies on it
    scene.render.filepath = file_name
    bpy.ops.render.render(write_still=True)


def tell(*words):
    print("lobelia:", *words, flush=True)


def jobs_scenes(job, directory):
    """Those that the job lists; then, if someone is there to ask, those that he names files of."""
    yield from job["scenes"]
    while job.get("goOn"):
        tell("more")
        file_name = sys.stdin.readline().strip()
        if not file_name:
            break
        with open(os.path.join(directory, file_name), encoding="utf-8") as file:
            yield json.load(file)


def peak_memory():
    """Bytes, resident, since Blender started. getrusage would tell at least those of the process that started it."""
    with open("/proc/self/status", encoding="ascii", errors="replace") as status:
        for line in status:
            if line.startswith("VmHWM:"):
                return int(line.split()[1]) * 1024
    return 0


def main():
    job_file = os.path.abspath(sys.argv[sys.argv.index("--") + 1])
    directory = os.path.dirname(job_file)
    with open(job_file, encoding="utf-8") as file:
        job = json.load(file)
    # A hanging renderer does not listen to Python; the system's alarm ends the process regardless.
    signal.signal(signal.SIGALRM, signal.SIG_DFL)
    for scene in jobs_scenes(job, directory):
        name = scene["name"]
        tell("begin", name)
        begun = time.monotonic()
        signal.setitimer(signal.ITIMER_REAL, job["secondsPerScene"])
        try:
            for index in range(len(scene["passes"])):
                picture = os.path.join(directory, "%s-%d.exr" % (name, index))
                render_pass(scene, index, job["threads"], picture)
        except Exception as error:  # one scene's failure is not the next one's
            tell("failed", name, type(error).__name__, " ".join(str(error).split()))
        else:
            # Of the process since its start: what it took to start is part of its first scene.
            used = time.process_time()
            tell("done", name, "%.3f" % (time.monotonic() - begun), "%.3f" % used, peak_memory())
        signal.setitimer(signal.ITIMER_REAL, 0)


main()
