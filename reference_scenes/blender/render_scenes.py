"""Renders spheres with highlights in Blender's Cycles, one ray through the middle of each pixel.

    blender -b --factory-startup -noaudio --python render_scenes.py -- job.json

job.json (numbers and enumerations only):
    {"threads": 2, "secondsPerScene": 600, "secondsPerProcess": 600, "scenes": [
      {"name": "scene0", "width": 256, "height": 256,
       "camera": {"origin": [..], "target": [..], "up": [..], "fovDegrees": 28},
       "lights": [{"kind": "directional", "direction": [..], "irradiance": [r, g, b]},
                  {"kind": "point", "position": [..], "intensity": [r, g, b]}],
       "spheres": [{"center": [..], "radius": 1, "model": "phong_rdf", "lobe": "cosine",
                    "normalisation": "exact", "exponent": 64,
                    "specular": [r, g, b], "diffuse": [r, g, b]}]}]}

Each light is a picture of its own, NAME-LIGHT.exr (float32, beside job.json); whoever asked for
them adds them up, in more digits than a renderer would. What happens is told in lines

    lobelia: begin NAME
    lobelia: done NAME SECONDS
    lobelia: failed NAME WHY

The coefficients and lobes below are written from their formulas and not from Lobelia's source, so
that a mistake there shows as a difference of pictures.
"""

import json
import math
import os
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


def cs16_exact(model, n):
    """From the integrals of s^j (1 - n s/16)^16 ds up to where the lobe or the hemisphere ends."""
    half = model in ("blinn_phong_rdf", "modified_blinn_phong")
    s_max = 1 - math.cos(math.pi / 4) if half else 1.0
    end, x = min(s_max, 16 / n), min(1.0, n * s_max / 16)

    def moment(j):
        # The power multiplied out and integrated term by term. In powers of 1 - n s/16 there are
        # fewer terms, which cancel each other to the last digit where n is small.
        terms = (math.comb(16, i) * (-x) ** i / (j + i + 1) for i in range(17))
        return end ** (j + 1) * math.fsum(terms)

    flat = moment(0)                 # weight 1
    tilted = moment(0) - moment(1)   # weight 1 - s, which is the cosine
    if model == "phong_rdf":
        energy = flat
    elif model == "modified_phong":
        energy = tilted
    elif model == "blinn_phong_rdf":
        energy = 4 * tilted
    elif model == "modified_blinn_phong":
        energy = 4 * (moment(0) - 5 * moment(1) + 6 * moment(2) - 2 * moment(3))
    elif model == "blinn_phong_ndf":
        energy = 4 * flat
    elif model == "blinn_phong_heightfield":
        energy = 4 * tilted
    else:
        raise KeyError(model)
    return 1 / (2 * math.pi * energy)


COEFFICIENTS = {
    ("cosine", "exact"): cosine_exact,
    ("cosine", "paper"): cosine_paper,
    ("cs16", "exact"): cs16_exact,
    ("cs16", "paper"): cs16_paper,
}


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

    def cs16_lobe(self, s, n):
        base = self.math("SUBTRACT", 1.0, self.math("MULTIPLY", n / 16, s))
        power = self.math("MAXIMUM", base, 0.0)
        for _ in range(4):
            power = self.math("MULTIPLY", power, power)
        # Below n = 16 the lobe would reach beyond 90 degrees, where every lobe ends.
        return self.math("MULTIPLY", power, self.math("LESS_THAN", s, 1.0))


def highlight_material(sphere, light, lamp):
    """A diffuse surface (radiance: colour/pi times N.L times the lamp's light) whose colour at each
    point is what the highlight of the one `light` asks for. The lamp is real: horizon, shadow, N.L
    and the light that arrives are Cycles' own. (A surface that shines with the finished radiance
    is not closer to the truth, and sees no shadow.)"""
    model, n = sphere["model"], sphere["exponent"]
    material = bpy.data.materials.new("highlight")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    nodes = Nodes(tree)

    geometry = nodes.new("ShaderNodeNewGeometry")
    normal = geometry.outputs["Normal"]
    to_eye = geometry.outputs["Incoming"]
    if light["kind"] == "point":
        offset = nodes.vector("SUBTRACT", tuple(light["position"]), geometry.outputs["Position"])
        to_light = nodes.vector("NORMALIZE", offset)
    else:
        # The lamp's own direction as Blender rounded it: a different rounding would not cancel in
        # lobe/N.L * N.L, which is 2e-4 of the peak where N.L is 1e-3.
        to_light = nodes.constant(lamp.matrix_world.col[2][:3])
    n_dot_l = nodes.vector("DOT_PRODUCT", normal, to_light)

    if model in REFLECTION_MODELS:
        twice = nodes.math("MULTIPLY", 2.0, nodes.vector("DOT_PRODUCT", normal, to_eye))
        mirrored = nodes.vector("SUBTRACT", nodes.vector("SCALE", normal, scale=twice), to_eye)
        s = nodes.one_minus_cos(mirrored, to_light)
    elif model in HALF_VECTOR_MODELS:
        half = nodes.vector("NORMALIZE", nodes.vector("ADD", to_light, to_eye))
        s = nodes.one_minus_cos(normal, half)
    else:
        raise KeyError(model)
    lobe = {"cosine": nodes.cosine_lobe, "cs16": nodes.cs16_lobe}[sphere["lobe"]](s, n)

    coefficient = COEFFICIENTS[sphere["lobe"], sphere["normalisation"]](model, n)
    # Radiance = (specular lobe + diffuse/pi) N.L E, where an RDF's lobe is without the N.L.
    weight = lobe
    if model in RDF_MODELS:
        # What Cycles multiplies is divided out; where N.L <= 0 it shows black in any case.
        weight = nodes.math("DIVIDE", lobe, nodes.math("MAXIMUM", n_dot_l, 1e-7))
    specular = nodes.constant([math.pi * coefficient * c for c in sphere["specular"]])
    color = nodes.vector("ADD", nodes.vector("SCALE", specular, scale=weight),
                         tuple(sphere["diffuse"]))
    surface = nodes.new("ShaderNodeBsdfDiffuse")
    nodes.feed(surface.inputs["Color"], color)
    output = nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(surface.outputs[0], output.inputs["Surface"])
    return material


# ---- The scene -----------------------------------------------------------------------------------

def unit(v):
    length = math.sqrt(sum(c * c for c in v))
    return [c / length for c in v]


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def towards_light(light):
    return [-c for c in unit(light["direction"])]


def empty_scene(width, height, threads):
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
    cycles.max_bounces = 0
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


def add_camera(scene, camera):
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


def render_light(job, light, threads, file_name):
    scene = empty_scene(job["width"], job["height"], threads)
    add_camera(scene, job["camera"])
    lamp = add_lamp(scene, light)
    bpy.context.view_layer.update()  # computes the lamp's matrix
    for sphere in job["spheres"]:
        add_sphere(scene, sphere, highlight_material(sphere, light, lamp))
    scene.render.filepath = file_name
    bpy.ops.render.render(write_still=True)


def tell(*words):
    print("lobelia:", *words, flush=True)


def main():
    job_file = os.path.abspath(sys.argv[sys.argv.index("--") + 1])
    with open(job_file, encoding="utf-8") as file:
        job = json.load(file)
    # A hanging renderer does not listen to Python; the system's alarm ends the process regardless.
    signal.signal(signal.SIGALRM, signal.SIG_DFL)
    started = time.monotonic()
    for scene in job["scenes"]:
        # Leaves the rest to another process, so that whoever waits for this one need not wait
        # longer than for itself and one scene.
        if time.monotonic() - started > job["secondsPerProcess"]:
            break
        name = scene["name"]
        tell("begin", name)
        begun = time.monotonic()
        signal.setitimer(signal.ITIMER_REAL, job["secondsPerScene"])
        try:
            for index, light in enumerate(scene["lights"]):
                picture = os.path.join(os.path.dirname(job_file), "%s-%d.exr" % (name, index))
                render_light(scene, light, job["threads"], picture)
        except Exception as error:  # one scene's failure is not the next one's
            tell("failed", name, type(error).__name__, " ".join(str(error).split()))
        else:
            tell("done", name, "%.3f" % (time.monotonic() - begun))
        signal.setitimer(signal.ITIMER_REAL, 0)


main()
