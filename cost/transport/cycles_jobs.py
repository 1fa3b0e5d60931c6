"""Renders one matt sphere on a matt plane in Cycles, as often as asked, and says how long each took.

    blender -b --factory-startup -noaudio --python cycles_jobs.py -- job.json

All vectors are in Blender's axes, +z up. Light goes from surface to surface as often as the job's
"bounces" say; 0 is direct light only. What happens is told in lines

    lobelia: begin NAME
    lobelia: done NAME SECONDS      of the call, with the hand-over of the scene and the file
"""

import json
import os
import sys
import time

import bpy
from mathutils import Matrix, Vector


def empty_scene(threads, bounces):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.pixel_filter_type = "BOX"
    cycles.filter_width = 1
    cycles.max_bounces = cycles.diffuse_bounces = bounces
    cycles.min_light_bounces = bounces  # no path ends by chance
    # On by default, and not the estimate that was asked for: see render_scenes.py.
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False
    cycles.sample_clamp_direct = 0
    cycles.sample_clamp_indirect = 0
    cycles.blur_glossy = 0
    cycles.light_sampling_threshold = 0
    cycles.film_exposure = 1
    cycles.use_auto_tile = False

    render = scene.render
    render.resolution_percentage = 100
    render.pixel_aspect_x = render.pixel_aspect_y = 1
    render.film_transparent = False
    render.dither_intensity = 0
    render.use_compositing = False
    render.use_sequencer = False
    render.threads_mode, render.threads = "FIXED", threads
    image = render.image_settings
    image.file_format, image.color_mode, image.color_depth = "OPEN_EXR", "RGB", "32"
    return scene


def matrix(x, y, z, origin):
    return Matrix([[x[i], y[i], z[i], origin[i]] for i in range(3)] + [[0, 0, 0, 1]])


def add(scene, name, data):
    thing = bpy.data.objects.new(name, data)
    scene.collection.objects.link(thing)
    return thing


def add_camera(scene, camera):
    data = bpy.data.cameras.new("camera")
    data.sensor_fit = "HORIZONTAL"
    data.lens = max(1.0, 16 / camera["halfWidth"])
    data.sensor_width = 2 * data.lens * camera["halfWidth"]
    data.clip_start, data.clip_end = 0.01, 1e6
    scene.camera = add(scene, "camera", data)
    scene.camera.matrix_world = matrix(camera["right"], camera["up"],
                                       [-c for c in camera["forward"]], camera["origin"])


def diffuse(colour):
    material = bpy.data.materials.new("diffuse")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    surface = tree.nodes.new("ShaderNodeBsdfDiffuse")
    surface.inputs["Color"].default_value = (*colour, 1)
    surface.inputs["Roughness"].default_value = 0
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(surface.outputs[0], output.inputs["Surface"])
    return material


def add_sphere(scene, sphere):
    """A point primitive, which Cycles intersects as a true sphere (render_scenes.py)."""
    material = diffuse(sphere["colour"])
    mesh = bpy.data.meshes.new("point")
    mesh.from_pydata([(0, 0, 0)], [], [])
    mesh.materials.append(material)
    thing = add(scene, "sphere", mesh)
    thing.location = sphere["center"]
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


def add_floor(scene, floor):
    r, z = floor["halfSize"], floor["height"]
    mesh = bpy.data.meshes.new("floor")
    mesh.from_pydata([(-r, -r, z), (r, -r, z), (r, r, z), (-r, r, z)], [], [(0, 1, 2, 3)])
    mesh.materials.append(diffuse(floor["colour"]))
    add(scene, "floor", mesh)


def add_rectangle(scene, light):
    u, v = Vector(light["halfU"]), Vector(light["halfV"])
    data = bpy.data.lights.new("lamp", "AREA")
    data.shape = "RECTANGLE"
    data.size, data.size_y = 2 * u.length, 2 * v.length
    data.energy = 4 * data.size * data.size_y * light["radiance"]  # W; radiance is P/(4 area)
    z = -u.cross(v).normalized()  # a lamp shines along its -z
    x = u.normalized()
    add(scene, "lamp", data).matrix_world = matrix(x, z.cross(x), z, light["center"])


def set_world(scene, light):
    world = bpy.data.worlds.new("world")
    world.use_nodes = True
    background = world.node_tree.nodes["Background"]
    background.inputs["Strength"].default_value = 0
    if light["kind"] == "environment":
        background.inputs["Strength"].default_value = 1
        image = world.node_tree.nodes.new("ShaderNodeTexEnvironment")
        image.image = bpy.data.images.load(light["file"])
        image.interpolation = "Linear"
        world.node_tree.links.new(image.outputs["Color"], background.inputs["Color"])
    scene.world = world


def main():
    job_file = os.path.abspath(sys.argv[sys.argv.index("--") + 1])
    with open(job_file, encoding="utf-8") as file:
        job = json.load(file)
    scene = empty_scene(job["threads"], job["bounces"])
    add_camera(scene, job["camera"])
    add_sphere(scene, job["sphere"])
    add_floor(scene, job["floor"])
    set_world(scene, job["light"])
    if job["light"]["kind"] == "rectangle":
        add_rectangle(scene, job["light"])
    for picture in job["renders"]:
        name = picture["name"]
        print("lobelia: begin", name, flush=True)
        scene.render.resolution_x, scene.render.resolution_y = picture["width"], picture["height"]
        scene.cycles.samples, scene.cycles.seed = picture["samples"], picture["seed"]
        scene.render.filepath = os.path.join(os.path.dirname(job_file), name + ".exr")
        begun = time.monotonic()
        bpy.ops.render.render(write_still=True)
        print("lobelia: done", name, "%.6f" % (time.monotonic() - begun), flush=True)


main()
