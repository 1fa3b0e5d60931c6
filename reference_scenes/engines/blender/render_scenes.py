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

Native highlights use Cycles' own closure, others nodes. Each pass is a picture NAME-PASS.exr (float32, beside job.json) of
the light of one lamp after a number of mirrors. The caller adds them up in higher precision. Output:

    lobelia: begin NAME
    lobelia: done NAME SECONDS CPU_SECONDS PEAK_BYTES
    lobelia: failed NAME WHY
    lobelia: more

"more" is written with "goOn" only, when all scenes are done. Then a line of standard input names a file beside job.json
with another scene. An empty line or the end of the input ends this program. CPU_SECONDS and PEAK_BYTES count from the start
of the process.

A scene with "transport": {"samples": 16, "seed": 1, "bounces": 4} has one pass by Cycles' own light transport: matt
materials, lights of kind "rectangle" (center, halfU, halfV, radiance) and "environment" (radiance; file: a latitude-longitude
picture, +y up, -z in the middle).
"""

import json
import os
import signal
import sys
import time

import bpy

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from blender_scene import (add_area_lamp, add_camera, add_lamp, add_plane, add_sphere, empty_scene,
                           set_sky)
from blender_surfaces import matt_material, plane_material, sphere_material


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


def render_transport(job, threads, file_name):
    how = job["transport"]
    scene = empty_scene(job["width"], job["height"], threads, how["bounces"])
    cycles = scene.cycles
    cycles.samples, cycles.seed = how["samples"], how["seed"]
    cycles.pixel_filter_type, cycles.filter_width = "BOX", 1
    cycles.diffuse_bounces = how["bounces"]
    add_camera(scene, job["camera"], job["width"], job["height"])
    for light in job["lights"]:
        if light["kind"] == "environment":
            set_sky(scene, light, os.path.dirname(file_name))
        else:
            add_area_lamp(scene, light)
    materials = [matt_material(material["diffuse"]) for material in job["materials"]]
    for sphere in job["spheres"]:
        add_sphere(scene, sphere, materials[sphere["material"]])
    for plane in job["planes"]:
        add_plane(scene, plane, job["camera"]["origin"], materials[plane["material"]])
    scene.render.filepath = file_name
    bpy.ops.render.render(write_still=True)


def tell(*words):
    print("lobelia:", *words, flush=True)


def jobs_scenes(job, directory):
    """The scenes in the job; with "goOn", then those that the caller sends."""
    yield from job["scenes"]
    while job.get("goOn"):
        tell("more")
        file_name = sys.stdin.readline().strip()
        if not file_name:
            break
        with open(os.path.join(directory, file_name), encoding="utf-8") as file:
            yield json.load(file)


def peak_memory():
    """Resident bytes since Blender started. getrusage() would include the memory of the process that started it."""
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
    # A hanging renderer does not run Python, but the system's alarm ends the process.
    signal.signal(signal.SIGALRM, signal.SIG_DFL)
    for scene in jobs_scenes(job, directory):
        name = scene["name"]
        tell("begin", name)
        begun = time.monotonic()
        signal.setitimer(signal.ITIMER_REAL, job["secondsPerScene"])
        try:
            for index in range(len(scene["passes"])):
                picture = os.path.join(directory, "%s-%d.exr" % (name, index))
                if "transport" in scene:
                    render_transport(scene, job["threads"], picture)
                else:
                    render_pass(scene, index, job["threads"], picture)
        except Exception as error:  # go on with the next scene
            tell("failed", name, type(error).__name__, " ".join(str(error).split()))
        else:
            # Since the process started, so the start counts for the first scene.
            used = time.process_time()
            tell("done", name, "%.3f" % (time.monotonic() - begun), "%.3f" % used, peak_memory())
        signal.setitimer(signal.ITIMER_REAL, 0)


main()
