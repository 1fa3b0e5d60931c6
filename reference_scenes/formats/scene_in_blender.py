

def vectors(*numbers):
    return [Vector(v) for v in numbers]


def empty_scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene, film = bpy.context.scene, SCENE["film"]
    scene.render.engine = "CYCLES"
    scene.render.resolution_x, scene.render.resolution_y = film["width"], film["height"]
    scene.render.resolution_percentage = 100
    image = scene.render.image_settings
    image.file_format, image.color_mode, image.color_depth = "OPEN_EXR", "RGB", "32"
    scene.cycles.samples = max(film["samples"], 64)
    scene.cycles.seed = film["seed"] % 2**31
    scene.cycles.use_denoising = False
    scene.cycles.max_bounces = SCENE["depth"]["mirror"] + SCENE["depth"]["glossy"]
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0
    return scene


def placed(scene, name, data, origin, x=(1, 0, 0), y=(0, 1, 0), z=(0, 0, 1)):
    """An object with its axes in the world. Cameras look and lamps shine along -z."""
    thing = bpy.data.objects.new(name, data)
    scene.collection.objects.link(thing)
    thing.matrix_world = Matrix([[x[i], y[i], z[i], origin[i]] for i in range(3)] + [[0, 0, 0, 1]])
    return thing


def add_camera(scene):
    camera, film = SCENE["camera"], SCENE["film"]
    data = bpy.data.cameras.new("camera")
    data.sensor_fit = "HORIZONTAL"
    data.lens = max(1, 16/camera["halfWidth"])  # mm; Blender takes none below 1
    data.sensor_width = 2*data.lens*camera["halfWidth"]
    # Both shifts are in widths of the picture.
    data.shift_x = camera["shiftU"]/(2*camera["halfWidth"])
    data.shift_y = camera["shiftV"]/(2*camera["halfWidth"])
    data.clip_end = 1e6
    if camera["apertureRadius"] > 0:
        data.dof.use_dof = True
        data.dof.focus_distance = camera["focusDistance"]
        data.dof.aperture_fstop = data.lens/1000/(2*camera["apertureRadius"])
    right, up, forward = vectors(camera["right"], camera["up"], camera["forward"])
    scene.camera = placed(scene, "camera", data, camera["origin"], right, up, -forward)


def add_light(scene, light):
    """Blender's watts: a sun in W/m^2, a point of intensity I has 4 pi I, a radiance L on an area A has 4 A L for a rectangle and
    pi A L for a ball."""
    kind, strength = light["type"], light["strength"]
    if kind in ("constant", "envmap"):
        return add_sky(scene, light)
    peak = max(strength)
    data = bpy.data.lights.new(kind, {"directional": "SUN", "rectangle": "AREA"}.get(kind, "POINT"))
    data.color = [c/peak for c in strength] if peak > 0 else (0, 0, 0)
    origin, x, y, z = vectors((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1))
    if kind == "directional":
        data.energy, data.angle = peak, 0
        z = -Vector(light["direction"])
        x = z.orthogonal().normalized()
        y = z.cross(x)
    elif kind == "point":
        data.energy, data.shadow_soft_size = 4*math.pi*peak, 0
        origin = light["position"]
    elif kind == "sphere":
        origin, radius = light["center"], light["radius"]
        data.energy, data.shadow_soft_size = 4*math.pi**2*radius**2*peak, radius
    else:
        u, v = vectors(light["halfU"], light["halfV"])
        data.shape, data.size, data.size_y = "RECTANGLE", 2*u.length, 2*v.length
        data.energy = 4*data.size*data.size_y*peak
        origin, x, z = light["center"], u.normalized(), -u.cross(v).normalized()
        y = z.cross(x)
    placed(scene, kind, data, origin, x, y, z)


def add_sky(scene, light):
    """Only the last environment of a scene stays: Blender has one."""
    tree = scene.world.node_tree
    background = tree.nodes["Background"]
    background.inputs["Strength"].default_value = 1
    background.inputs["Color"].default_value = (*light["strength"], 1)
    if light["type"] == "constant":
        return
    # Blender's pole is +z and the middle of its picture is +x; here they are +y and -z.
    turned = tree.nodes.new("ShaderNodeMapping")
    turned.vector_type = "VECTOR"
    turned.inputs["Rotation"].default_value = Matrix(
        ((0, 0, -1), (-1, 0, 0), (0, 1, 0))).to_euler()
    tree.links.new(tree.nodes.new("ShaderNodeTexCoord").outputs["Generated"], turned.inputs[0])
    picture = tree.nodes.new("ShaderNodeTexEnvironment")
    file = os.path.join(os.path.dirname(os.path.abspath(__file__)), light["filename"])
    picture.image = bpy.data.images.load(file)
    tree.links.new(turned.outputs[0], picture.inputs["Vector"])
    scaled = tree.nodes.new("ShaderNodeVectorMath")
    scaled.operation = "MULTIPLY"
    tree.links.new(picture.outputs["Color"], scaled.inputs[0])
    scaled.inputs[1].default_value = light["strength"]
    tree.links.new(scaled.outputs[0], background.inputs["Color"])


def make_material(number):
    """A diffuse and a glossy shader, added. Ashikhmin-Shirley has a distribution of normals cos^n, which is Blinn-Phong; it has its
    own shadowing factor, so away from normal incidence it differs. Other models and lobes become the nearest such one: with
    the exponent of the same width, and as bright where light, eye and normal are one."""
    exact = SCENE["materials"][number]
    material = bpy.data.materials.new(f"{exact['model']} {exact['lobe']} {exact['exponent']:g}")
    material["lobelia"] = json.dumps(exact)  # the exact one, under custom properties
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    surface = tree.nodes.new("ShaderNodeBsdfDiffuse")
    surface.inputs["Color"].default_value = (*exact["diffuse"], 1)
    result = surface.outputs[0]

    def add(roughness, color, distribution):
        nonlocal result
        glossy = tree.nodes.new("ShaderNodeBsdfGlossy")
        if distribution in glossy.bl_rna.properties["distribution"].enum_items:
            glossy.distribution = distribution
        glossy.inputs["Roughness"].default_value = roughness
        glossy.inputs["Color"].default_value = (*color, 1)
        both = tree.nodes.new("ShaderNodeAddShader")
        tree.links.new(result, both.inputs[0])
        tree.links.new(glossy.outputs[0], both.inputs[1])
        result = both.outputs[0]

    n = exact["exponent"]*(1 if exact["angle"] == "halfVector" else 4)
    if any(exact["specular"]):
        bright = exact["coefficient"]*8*math.pi/(n + 1)
        add((2/(n + 2))**0.25, [bright*c for c in exact["specular"]], "ASHIKHMIN_SHIRLEY")
    if any(exact["mirror"]):
        add(0, exact["mirror"], "SHARP")
    tree.links.new(result, tree.nodes.new("ShaderNodeOutputMaterial").inputs[0])
    return material


def sphere_mesh(material):
    mesh, shape = bpy.data.meshes.new("sphere"), bmesh.new()
    bmesh.ops.create_uvsphere(shape, u_segments=128, v_segments=64, radius=1)
    for face in shape.faces:
        face.smooth = True
    shape.to_mesh(mesh)
    shape.free()
    mesh.materials.append(material)
    return mesh


def add_plane(scene, plane, materials):
    """A square around the point below the camera. A checker shows its first material only."""
    normal, point, eye = vectors(plane["normal"], plane["point"], SCENE["camera"]["origin"])
    x = normal.orthogonal().normalized()
    size = 1000*max(1, eye.length)
    mesh = bpy.data.meshes.new("plane")
    mesh.from_pydata([(a*size, b*size, 0) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))], [],
                     [(0, 1, 2, 3)])
    mesh.materials.append(materials[plane["material"]])
    below = eye - (eye - point).dot(normal)*normal
    placed(scene, "plane", mesh, below, x, normal.cross(x), normal)


def build():
    scene = empty_scene()
    add_camera(scene)
    for light in SCENE["lights"]:
        add_light(scene, light)
    materials = [make_material(number) for number in range(len(SCENE["materials"]))]
    meshes = [sphere_mesh(material) for material in materials]
    for sphere in SCENE["spheres"]:
        thing = placed(scene, "sphere", meshes[sphere["material"]], sphere["center"])
        thing.scale = [sphere["radius"]]*3
    for plane in SCENE["planes"]:
        add_plane(scene, plane, materials)


build()
