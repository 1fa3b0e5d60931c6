"""A renderer of another kind: one sphere under directional lights, in plain Python, one ray a pixel.

Usage: sphere.py SCENE.json PICTURE.exr, with a scene as `lobelia scene SCENE --to json` writes it.
"""
import json
import math
import struct
import sys


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def normalised(a):
    length = math.sqrt(dot(a, a))
    return [x / length for x in a]


def shadowing(n, n_dot_l, n_dot_v):
    """Smith's G / ((N.L)(N.V)) for GGX."""
    def twice_lambda(c):
        return math.sqrt(1 + 2 / (n + 2) * (1 / c**2 - 1)) - 1
    return 1 / ((1 + twice_lambda(n_dot_l) / 2 + twice_lambda(n_dot_v) / 2) * n_dot_l * n_dot_v)


def radiance(material, lights, normal, to_eye):
    """Of the highlight alone: coefficient x cos^n (angle), grey."""
    total = 0
    for light in lights:
        to_light = normalised([-x for x in light["direction"]])
        cosine = dot(normal, to_light)
        if cosine <= 0:
            continue
        if material["angle"] == "halfVector":
            half = normalised([l + v for l, v in zip(to_light, to_eye)])
            angle = dot(normal, half)
        else:
            angle = 2 * cosine * dot(normal, to_eye) - dot(to_light, to_eye)
        value = material["coefficient"] * max(angle, 0) ** material["exponent"]
        if material["appliesCosine"]:
            value *= cosine
        if material["hasShadowing"]:
            value *= shadowing(material["exponent"], cosine, dot(normal, to_eye))
        total += value * light["strength"][0]
    return total * material["specular"][0]


def render(scene):
    camera, film, sphere = scene["camera"], scene["film"], scene["spheres"][0]
    material = scene["materials"][sphere["material"]]
    from_center = [o - c for o, c in zip(camera["origin"], sphere["center"])]
    for y in range(film["height"]):
        v = camera["halfHeight"] * (1 - 2 * (y + 0.5) / film["height"])
        row = []
        for x in range(film["width"]):
            u = camera["halfWidth"] * (2 * (x + 0.5) / film["width"] - 1)
            ray = normalised([f + u * r + v * up for f, r, up in
                              zip(camera["forward"], camera["right"], camera["up"])])
            b = dot(ray, from_center)
            root = b * b - dot(from_center, from_center) + sphere["radius"] ** 2
            if root < 0:
                row.append(0)
                continue
            at = [o + (-b - math.sqrt(root)) * d for o, d in zip(from_center, ray)]
            row.append(radiance(material, scene["lights"], normalised(at), [-d for d in ray]))
        yield row


def write_exr(path, rows, width, height):
    """Three channels of float32, not compressed (OpenEXR file layout)."""
    def attribute(name, kind, data):
        return name + b"\0" + kind + b"\0" + struct.pack("<i", len(data)) + data
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    channels = b"".join(c + b"\0" + struct.pack("<iiii", 2, 0, 1, 1) for c in (b"B", b"G", b"R"))
    head = struct.pack("<ii", 20000630, 2) + b"".join([
        attribute(b"channels", b"chlist", channels + b"\0"),
        attribute(b"compression", b"compression", b"\0"),
        attribute(b"dataWindow", b"box2i", window), attribute(b"displayWindow", b"box2i", window),
        attribute(b"lineOrder", b"lineOrder", b"\0"),
        attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1)),
        attribute(b"screenWindowCenter", b"v2f", struct.pack("<ff", 0, 0)),
        attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1))]) + b"\0"
    line = 8 + 12 * width
    with open(path, "wb") as file:
        file.write(head + b"".join(struct.pack("<Q", len(head) + 8 * height + line * y)
                                   for y in range(height)))
        for y, row in enumerate(rows):
            file.write(struct.pack("<ii", y, 12 * width) + struct.pack(f"<{width}f", *row) * 3)


if sys.argv[1:] == ["--version"]:
    print("sphere.py 1.0")
else:
    with open(sys.argv[1]) as scene_file:
        scene = json.load(scene_file)
    write_exr(sys.argv[2], render(scene), scene["film"]["width"], scene["film"]["height"])
