"""An empty scene, a camera, lamps, spheres and planes for Cycles."""

import math
import os

import bpy
from mathutils import Matrix, Vector


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
    # The first sample of a pixel is in the middle of the filter, shifted by the filter's table in proportion to its width.
    # Blender accepts no width below 0.01.
    cycles.samples = 1
    cycles.pixel_filter_type = "GAUSSIAN"
    cycles.filter_width = 0.01
    cycles.seed = 0
    # Exactly the reflections of the pass, none dropped at random.
    cycles.max_bounces = cycles.glossy_bounces = cycles.min_light_bounces = mirrors
    cycles.diffuse_bounces = 0
    # All of these are on by default and change single pixels: denoising, clamping, blurring, and skipping the shadow rays of
    # dim lights at random.
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
    """Sets the matrix from the vectors: columns right, up, -forward, eye."""
    forward = unit(minus(camera["target"], camera["origin"]))
    right = unit(cross(forward, camera["up"]))
    up = cross(right, forward)
    data = bpy.data.cameras.new("camera")
    data.type = "PERSP"
    data.sensor_fit = "HORIZONTAL"
    half_width = math.tan(math.radians(camera["fovDegrees"]) / 2)
    data.lens = max(1.0, 16 / half_width)  # mm, the shortest that Blender accepts is 1
    data.sensor_width = 2 * data.lens * half_width
    # Blender shifts the picture in the opposite direction, and measures both shifts in widths.
    data.shift_x = -camera["offset"][0]
    data.shift_y = -camera["offset"][1]*height/width
    data.clip_start, data.clip_end = 0.01, 1e6
    thing = bpy.data.objects.new("camera", data)
    scene.collection.objects.link(thing)
    thing.matrix_world = Matrix([[right[i], up[i], -forward[i], camera["origin"][i]]
                                 for i in range(3)] + [[0, 0, 0, 1]])
    scene.camera = thing


def add_lamp(scene, light):
    """A lamp without size: sun angle or radius 0. Its energy is the brightest channel, because colours above 1 may be lost."""
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
    """A point primitive, which Cycles renders as an exact sphere with exact normals. A smooth-shaded mesh of 64 x 32 faces is
    off by 2 % of the peak at n = 64."""
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
    """Nested squares around the point below the eye, each ten times larger, to beyond the last pixel before the horizon. One
    large square would be uneven near the eye."""
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


def add_area_lamp(scene, light):
    """A rectangle that shines to the side of halfU x halfV."""
    u, v = Vector(light["halfU"]), Vector(light["halfV"])
    data = bpy.data.lights.new("lamp", "AREA")
    data.shape = "RECTANGLE"
    data.size, data.size_y = 2*u.length, 2*v.length
    power = [4*data.size*data.size_y*c for c in light["radiance"]]  # W: radiance is power/(4 area)
    data.energy = max(power)
    data.color = [c/max(power) for c in power] if max(power) > 0 else (0, 0, 0)
    thing = bpy.data.objects.new("lamp", data)
    scene.collection.objects.link(thing)
    z = -u.cross(v).normalized()  # a lamp shines along its -Z
    x = u.normalized()
    y = z.cross(x)
    thing.matrix_world = Matrix([[x[i], y[i], z[i], light["center"][i]] for i in range(3)]
                                + [[0, 0, 0, 1]])


def set_sky(scene, light, directory):
    """Blender's pole is +Z and the middle of its picture is +X; ours are +y and -z."""
    tree = scene.world.node_tree
    background = tree.nodes["Background"]
    background.inputs["Strength"].default_value = 1
    if not light.get("file"):
        background.inputs["Color"].default_value = (*light["radiance"], 1)
        return
    parts = tree.nodes.new("ShaderNodeSeparateXYZ")
    tree.links.new(tree.nodes.new("ShaderNodeTexCoord").outputs["Generated"], parts.inputs[0])
    turned = tree.nodes.new("ShaderNodeCombineXYZ")
    for axis, sign, socket in (("Z", -1, "X"), ("X", -1, "Y"), ("Y", 1, "Z")):
        signed = tree.nodes.new("ShaderNodeMath")
        signed.operation = "MULTIPLY"
        tree.links.new(parts.outputs[axis], signed.inputs[0])
        signed.inputs[1].default_value = sign
        tree.links.new(signed.outputs[0], turned.inputs[socket])
    picture = tree.nodes.new("ShaderNodeTexEnvironment")
    picture.image = bpy.data.images.load(os.path.join(directory, light["file"]))
    picture.interpolation = "Linear"
    tree.links.new(turned.outputs[0], picture.inputs["Vector"])
    scaled = tree.nodes.new("ShaderNodeVectorMath")
    scaled.operation = "MULTIPLY"
    tree.links.new(picture.outputs["Color"], scaled.inputs[0])
    scaled.inputs[1].default_value = light["radiance"]
    tree.links.new(scaled.outputs[0], background.inputs["Color"])
