"""The BSDF `phong` for Mitsuba 3, which had it in its versions 0.x: modified Phong over a diffuse base.

    f = specular_reflectance (n + 2)/(2 pi) max(0, cos a)^n + diffuse_reflectance/pi

with n the exponent and a the angle between the outgoing direction and the mirror direction of the other (Lafortune and Willems
1994). Reflectances are not scaled down where their sum is over 1.

Render a scene file with:  python3 phong.py scene.xml [scene.exr]
Or import this module after mitsuba.set_variant(...) and load the scene yourself.
"""

import sys

import drjit as dr
import mitsuba as mi

if mi.variant() is None:
    mi.set_variant("llvm_ad_rgb", "scalar_rgb")


class Phong(mi.BSDF):
    def __init__(self, props):
        mi.BSDF.__init__(self, props)
        self.exponent = props.get("exponent", 30.0)
        self.specular = props.get_texture("specular_reflectance", 0.2)
        self.diffuse = props.get_texture("diffuse_reflectance", 0.5)
        glossy = mi.BSDFFlags.GlossyReflection | mi.BSDFFlags.FrontSide
        diffuse = mi.BSDFFlags.DiffuseReflection | mi.BSDFFlags.FrontSide
        self.m_components = [glossy, diffuse]
        self.m_flags = glossy | diffuse
        specular, base = self.specular.mean(), self.diffuse.mean()
        total = specular + base
        self.specular_share = dr.select(total > 0, specular / dr.maximum(total, 1e-30), 0)

    def traverse(self, callback):
        callback.put("specular_reflectance", self.specular, mi.ParamFlags.Differentiable)
        callback.put("diffuse_reflectance", self.diffuse, mi.ParamFlags.Differentiable)

    def lobe(self, wi, wo):
        """cos^n of the angle between wo and the mirror direction of wi."""
        cosine = dr.maximum(-wi.x * wo.x - wi.y * wo.y + wi.z * wo.z, 0)
        return cosine ** self.exponent

    def eval(self, ctx, si, wo, active=True):
        n = self.exponent
        cos_i, cos_o = mi.Frame3f.cos_theta(si.wi), mi.Frame3f.cos_theta(wo)
        active &= (cos_i > 0) & (cos_o > 0)
        value = self.specular.eval(si, active) * ((n + 2) / (2 * dr.pi) * self.lobe(si.wi, wo))
        value += self.diffuse.eval(si, active) / dr.pi
        return dr.select(active, value * cos_o, 0)

    def pdf(self, ctx, si, wo, active=True):
        n = self.exponent
        cos_i, cos_o = mi.Frame3f.cos_theta(si.wi), mi.Frame3f.cos_theta(wo)
        active &= (cos_i > 0) & (cos_o > 0)
        of_lobe = (n + 1) / (2 * dr.pi) * self.lobe(si.wi, wo)
        of_base = mi.warp.square_to_cosine_hemisphere_pdf(wo)
        return dr.select(active, dr.lerp(of_base, of_lobe, self.specular_share), 0)

    def eval_pdf(self, ctx, si, wo, active=True):
        return self.eval(ctx, si, wo, active), self.pdf(ctx, si, wo, active)

    def sample(self, ctx, si, sample1, sample2, active=True):
        active &= mi.Frame3f.cos_theta(si.wi) > 0
        glossy = sample1 < self.specular_share
        # About the mirror direction, with a density proportional to cos^n.
        cosine = sample2.x ** (1 / (self.exponent + 1))
        sine = dr.safe_sqrt(1 - cosine * cosine)
        turn = 2 * dr.pi * sample2.y
        mirror = mi.Vector3f(-si.wi.x, -si.wi.y, si.wi.z)
        about = mi.Vector3f(sine * dr.cos(turn), sine * dr.sin(turn), cosine)
        wo = dr.select(glossy, mi.Frame3f(mirror).to_world(about),
                       mi.warp.square_to_cosine_hemisphere(sample2))
        active &= mi.Frame3f.cos_theta(wo) > 0
        result = dr.zeros(mi.BSDFSample3f)
        result.wo = wo
        result.pdf = self.pdf(ctx, si, wo, active)
        result.eta = 1.0
        result.sampled_component = dr.select(glossy, mi.UInt32(0), mi.UInt32(1))
        result.sampled_type = dr.select(glossy, mi.UInt32(+mi.BSDFFlags.GlossyReflection),
                                        mi.UInt32(+mi.BSDFFlags.DiffuseReflection))
        active &= result.pdf > 0
        weight = self.eval(ctx, si, wo, active) / dr.maximum(result.pdf, 1e-30)
        return result, dr.select(active, weight, 0)

    def to_string(self):
        return f"Phong[exponent = {self.exponent}]"


mi.register_bsdf("phong", Phong)

if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    picture = sys.argv[2] if len(sys.argv) == 3 else "scene.exr"
    mi.util.write_bitmap(picture, mi.render(mi.load_file(sys.argv[1])), write_async=False)
