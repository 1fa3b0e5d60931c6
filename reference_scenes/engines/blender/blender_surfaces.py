"""Materials as shader nodes."""

import math

import bpy

from blender_formulas import MODELS, coefficient_of, find_lobe


class Nodes:
    """Arithmetic on sockets of a shader's node tree. Numbers and triples are constants."""

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
        """For unit vectors, from their difference: 1 - a.b loses all digits near the peak."""
        difference = self.vector("SUBTRACT", a, b)
        return self.math("MULTIPLY", 0.5, self.vector("DOT_PRODUCT", difference, difference))

    def cosine_lobe(self, s, n):
        """(1 - s)^n as exp(n log1p(-s)). A float32 power of 1 - s is off by 2e-5 at n = 1024. With the rounded w = 1 - s,
        log(w) s/(1 - w) cancels the rounding."""
        w = self.math("MAXIMUM", self.math("SUBTRACT", 1.0, s), 0.0)
        rounded_s = self.math("SUBTRACT", 1.0, w)
        is_zero = self.math("LESS_THAN", rounded_s, 1e-12)
        ratio = self.math("DIVIDE", s, self.math("ADD", rounded_s, is_zero))
        # The logarithm node returns 0 for 0, which would make the lobe 1; the last factor prevents that.
        logarithm = self.math("MULTIPLY", self.math("LOGARITHM", w, math.e), ratio)
        log1p = self.math("SUBTRACT", logarithm, self.math("MULTIPLY", s, is_zero))
        lobe = self.math("EXPONENT", self.math("MULTIPLY", n, log1p))
        return self.math("MULTIPLY", lobe, self.math("GREATER_THAN", w, 0.0))

    def half_square_of_angle(self, s):
        """Half the square of the angle with 1 - cos = s. An arc cosine would lose the digits of small angles."""
        half = self.math("ARCSINE", self.math("SQRT", self.math("MULTIPLY", 0.5, s)))
        return self.math("MULTIPLY", 2.0, self.math("MULTIPLY", half, half))

    def smith(self, n, n_dot_l, n_dot_v):
        """G/((N.L)(N.V)) of GGX with alpha^2 = 2/(n + 2), light and eye correlated by height."""
        n_dot_l = self.math("MAXIMUM", n_dot_l, 1e-7)
        return self.math("DIVIDE", 2.0, self.math(
            "ADD", self.math("MULTIPLY", n_dot_l, self.smith_root(n, n_dot_v)),
            self.math("MULTIPLY", n_dot_v, self.smith_root(n, n_dot_l))))

    def own_smith(self, n, n_dot_l, n_dot_v):
        """The same by Cycles' GGX closure: until Blender 3.4 the product of the two shares, not correlated."""
        if bpy.app.version >= (3, 5):
            return self.smith(n, n_dot_l, n_dot_v)
        sums = [self.math("ADD", cosine, self.smith_root(n, cosine))
                for cosine in (self.math("MAXIMUM", n_dot_l, 1e-7), n_dot_v)]
        return self.math("DIVIDE", 4.0, self.math("MULTIPLY", *sums))

    def smith_root(self, n, cosine):
        a = 2 / (n + 2)
        square = self.math("MULTIPLY", cosine, cosine)
        return self.math("SQRT", self.math("ADD", a, self.math("MULTIPLY", 1 - a, square)))

    def lobe(self, material, s, n):
        lobe, order = find_lobe(material)
        value = lobe.node(self, s, n, order)
        # Every lobe ends at 90 degrees.
        return self.math("MULTIPLY", value, self.math("LESS_THAN", s, 1.0))

    def fresnel(self, kind, reflectance, cosine, at_grazing=1.0):
        """Colour of the highlight or mirror: F0, or Schlick's F0 + (F90 - F0)(1 - cosine)^5."""
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
        """Vector a where condition is 1, vector b where it is 0."""
        other = self.math("SUBTRACT", 1.0, condition)
        return self.vector("ADD", self.vector("SCALE", a, scale=condition),
                           self.vector("SCALE", b, scale=other))


class Surface(Nodes):
    """A material that shows one lamp and any number of mirrors. It is a diffuse surface (radiance: colour/pi times N.L times
    the lamp's light) with the colour at each point set to show the highlight. The lamp is real: Cycles does horizon, shadow,
    N.L and the arriving light. (A surface that emits the finished radiance is not closer to the truth, and sees no
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
            if "spot" in light:
                least, step = light["spot"]
                part = self.math("DIVIDE", self.math("SUBTRACT", towards, least), step)
                part = self.math("MINIMUM", self.math("MAXIMUM", part, 0.0), 1.0)
                rest = self.math("SUBTRACT", 3.0, self.math("MULTIPLY", 2.0, part))
                self.falloff = self.math("MULTIPLY", self.math("MULTIPLY", part, part), rest)
        else:
            # The lamp's direction as Blender has rounded it. Another rounding would not cancel in lobe/N.L * N.L: an error of
            # 2e-4 of the peak where N.L is 1e-3.
            self.to_light = self.constant(lamp.matrix_world.col[2][:3])

    def highlight(self, material):
        """The colour of a diffuse surface that looks like the material's highlight and base."""
        model, n = MODELS[material["model"]], material["exponent"]
        if not model.half_vector:
            twice = self.math("MULTIPLY", 2.0, self.vector("DOT_PRODUCT", self.normal, self.to_eye))
            mirrored = self.vector("SUBTRACT", self.vector("SCALE", self.normal, scale=twice),
                                   self.to_eye)
            s = self.one_minus_cos(mirrored, self.to_light)
        else:
            half = self.vector("NORMALIZE", self.vector("ADD", self.to_light, self.to_eye))
            s = self.one_minus_cos(self.normal, half)

        # Radiance = (specular lobe + diffuse/pi) N.L E; for an RDF the lobe's term has no N.L.
        weight = self.lobe(material, s, n)
        if model.is_rdf:
            # Cancels Cycles' factor N.L. Where N.L <= 0 Cycles shows black anyway.
            n_dot_l = self.vector("DOT_PRODUCT", self.normal, self.to_light)
            weight = self.math("DIVIDE", weight, self.math("MAXIMUM", n_dot_l, 1e-7))
        if model.smith:
            weight = self.math("MULTIPLY", weight, self.smith(
                n, self.vector("DOT_PRODUCT", self.normal, self.to_light),
                self.vector("DOT_PRODUCT", self.normal, self.to_eye)))
        weight = self.math("MULTIPLY", math.pi * coefficient_of(material), weight)
        # V.H is half the length of L + V.
        both = self.vector("LENGTH", self.vector("ADD", self.to_light, self.to_eye))
        specular = self.fresnel(material["fresnel"], material["specular"],
                                self.math("MULTIPLY", 0.5, both))
        return self.vector("ADD", self.vector("SCALE", specular, scale=weight),
                           tuple(material["diffuse"]))

    def closure(self, material):
        """The highlight by one of Cycles' closures, whose geometry term the colour replaces by the model's. Under a unit sun
        Ashikhmin and Shirley's shows (n + 1)/(8 pi) (N.H)^n N.L / ((H.V) max(N.L, N.V)), and GGX
        (n + 2)/(8 pi) D(N.H)/D(1) N.L times G / ((N.L) (N.V))."""
        model, n = MODELS[material["model"]], material["exponent"]
        distributions = {"cosine": "ASHIKHMIN_SHIRLEY", "ggx": "GGX"}
        if not model.half_vector or material["lobe"] not in distributions:
            raise KeyError(material["model"] + " " + material["lobe"])
        glossy = self.new("ShaderNodeBsdfGlossy")
        glossy.distribution = distributions[material["lobe"]]
        glossy.inputs["Roughness"].default_value = (2/(n + 2))**0.25
        n_dot_l = self.vector("DOT_PRODUCT", self.normal, self.to_light)
        n_dot_v = self.vector("DOT_PRODUCT", self.normal, self.to_eye)
        both = self.vector("LENGTH", self.vector("ADD", self.to_light, self.to_eye))
        h_dot_v = self.math("MULTIPLY", 0.5, both)
        if material["lobe"] == "ggx":
            own = (n + 2)/(8*math.pi)
            weight = self.math("DIVIDE", self.smith(n, n_dot_l, n_dot_v) if model.smith else 1.0,
                               self.own_smith(n, n_dot_l, n_dot_v))
        else:
            own = (n + 1)/(8*math.pi)
            weight = self.math("MULTIPLY", h_dot_v, self.math("MAXIMUM", n_dot_l, n_dot_v))
            if model.smith:
                weight = self.math("MULTIPLY", weight, self.smith(n, n_dot_l, n_dot_v))
        if model.is_rdf:
            weight = self.math("DIVIDE", weight, self.math("MAXIMUM", n_dot_l, 1e-7))
        weight = self.math("MULTIPLY", coefficient_of(material)/own, weight)
        color = self.fresnel(material["fresnel"], material["specular"], h_dot_v)
        if self.falloff is not None:
            weight = self.math("MULTIPLY", weight, self.falloff)
        self.feed(glossy.inputs["Color"], self.vector("SCALE", color, scale=weight))
        return glossy.outputs[0]

    def mirror(self, material):
        if not any(material["mirror"]):
            return self.constant((0, 0, 0))
        cosine = self.vector("DOT_PRODUCT", self.normal, self.to_eye)
        at_grazing = min(1.0, 50*max(material["mirror"]))  # 0 for reflectance 0
        return self.fresnel(material["fresnel"], material["mirror"], cosine, at_grazing)

    def finish(self, color, mirror, mirrors, closure=None):
        """The base after this many mirrors. For fewer, the surface is only a mirror."""
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
    """A lamp in the plane shines along it and does not light it; Cycles' rounding would light points at random."""
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


def matt_material(colour):
    """For Cycles' own light transport."""
    material = bpy.data.materials.new("surface")
    material.use_nodes = True
    nodes = Nodes(material.node_tree)
    nodes.tree.nodes.clear()
    base = nodes.new("ShaderNodeBsdfDiffuse")
    base.inputs["Color"].default_value = (*colour, 1)
    output = nodes.new("ShaderNodeOutputMaterial")
    nodes.tree.links.new(base.outputs[0], output.inputs["Surface"])
    return material
