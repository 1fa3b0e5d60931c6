// Mitsuba 3's scene file. A scene that its parts cannot say exactly is refused, with the reason.
//
// The highlight is the BSDF `phong` of Mitsuba 0.6: (n + 2)/(2 pi) cos^n of the angle from the mirror direction, times
// the specular reflectance (Lafortune and Willems 1994). That is modified Phong with the lobe cosine. Mitsuba 3 has no
// such BSDF any more, so a scene with a highlight brings it along in phong.py.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/words/text.hpp"
#include "reference_scenes/formats/catalogue.hpp"
#include "reference_scenes/formats/mitsuba.hpp"
#include "renderer/frame.hpp"

namespace lobelia {
namespace embedded {
extern const std::string_view phong_py;
}
namespace {

bool is_mitsuba_phong(const Highlight& h) {
  return info(h.model).name == kMitsubaModel && info(h.lobe).name == kMitsubaLobe &&
         std::abs(radiance_coefficient(h) / ((h.exponent + 2) / (2 * kPi)) - 1) < 1e-14;
}

std::string why_not_material(const Material& material, std::size_t index) {
  const Highlight& h = material.highlight;
  if (is_mirror(material))
    return fmt::format("material {} has a mirror, and Mitsuba has none on top of a highlight",
                       index);
  if (material.fresnel != Fresnel::kNone)
    return fmt::format("material {} has a Fresnel factor, and Mitsuba's phong has none", index);
  if (has_highlight(material) && !is_mitsuba_phong(h))
    return fmt::format(
        "material {} is {} with the lobe {} and the normalisation {}; Mitsuba's phong is {} with the lobe {} and "
        "the normalisation exact (--model modified_phong --lobe cosine make it that)",
        index, info(h.model).name, info(h.lobe).name, name(h.normalisation), kMitsubaModel,
        kMitsubaLobe);
  return {};
}

std::string why_not_film(const Scene& scene) {
  const Filter filter = scene.film.filter;
  const std::string_view type = name(filter);
  if (type == "tent" || type == "gaussian") return {};
  if (type != "box" && type != "mitchell") return fmt::format("Mitsuba has no filter {}", type);
  if (filter == *find_filter(type)) return {};
  return fmt::format("the filter {} has the radius {}, and Mitsuba's always has {}", type,
                     filter.radius, find_filter(type)->radius);
}

std::string why_not_mitsuba(const Scene& scene) {
  if (std::string why = why_not_spelled_out(scene); !why.empty()) return why;
  if (!scene.planes.empty()) return "it has a plane, and Mitsuba has no infinite planes";
  for (std::size_t i = 0; i < scene.materials.size(); ++i)
    if (std::string why = why_not_material(scene.materials[i], i); !why.empty()) return why;
  int environments = 0;
  for (const Light& light : scene.lights) {
    const auto lamp = find_lamp(light);
    if (lamp && lamp->has_normal())
      return "a point light falls with the cosine to its normal, and Mitsuba has no such light";
    if (is_environment(light) && ++environments > 1)
      return "it has several environments, and Mitsuba has at most one";
    const Rgb s = strength(light);
    if (!picture_file(light).empty() && (s.r != s.g || s.g != s.b))
      return "the radiance of its envmap is a colour, and Mitsuba scales the picture by one number";
  }
  const Camera& camera = scene.camera;
  if (camera.aperture_radius > 0 &&
      (camera.principal_point_offset_x != 0 || camera.principal_point_offset_y != 0))
    return "it has a lens and a principal point that is off centre, and Mitsuba's thinlens has no such offset";
  return why_not_film(scene);
}

std::string mitsuba_text(double value) { return fmt::format("{}", value); }
std::string mitsuba_text(int value) { return std::to_string(value); }
std::string mitsuba_text(Vec3 v) { return fmt::format("{}, {}, {}", v.x, v.y, v.z); }
std::string mitsuba_text(Rgb c) { return fmt::format("{}, {}, {}", c.r, c.g, c.b); }
std::string mitsuba_text(std::string_view text) { return escape_markup(text); }

/// Elements, indented by their depth.
class MitsubaWriter {
 public:
  template <class Content>
  void element(std::string_view tag, std::string_view attributes, Content content) {
    xml_ += fmt::format("{:{}}<{} {}>\n", "", 2 * depth_, tag, attributes);
    ++depth_;
    content();
    --depth_;
    xml_ += fmt::format("{:{}}</{}>\n", "", 2 * depth_, tag);
  }
  void line(std::string_view text) { xml_ += fmt::format("{:{}}{}\n", "", 2 * depth_, text); }
  template <class T>
  void parameter(std::string_view tag, std::string_view name, const T& value) {
    line(fmt::format("<{} name=\"{}\" value=\"{}\"/>", tag, name, mitsuba_text(value)));
  }
  std::string take() { return std::move(xml_); }

 private:
  std::string xml_;
  int depth_ = 0;
};

std::string typed(std::string_view type) { return fmt::format("type=\"{}\"", type); }

/// Rays are cut off outside of these distances, by default outside of 0.01 and 10000.
void write_clip(MitsubaWriter& out, const Scene& scene) {
  double far = 2 * length(scene.camera.target - scene.camera.origin);
  for (const Sphere& sphere : scene.spheres)
    far = std::max(far, 2 * (length(sphere.center - scene.camera.origin) + sphere.radius));
  for (const Light& light : scene.lights)
    if (const LightBounds at = bounds(light); at.kind == LightBounds::kBall)
      far = std::max(far, 2 * (length(at.at - scene.camera.origin) + at.radius));
  out.parameter("float", "near_clip", 1e-6 * far);
  out.parameter("float", "far_clip", far);
}

void write_filter(MitsubaWriter& out, Filter filter) {
  out.element("rfilter", typed(name(filter)), [&] {
    if (name(filter) == "tent") out.parameter("float", "radius", filter.radius);
    if (name(filter) == "gaussian") {
      out.line("<!-- Mitsuba cuts it off at 4 standard deviations, Lobelia at 3. -->");
      out.parameter("float", "stddev", filter.radius / kGaussianDeviations);
    }
  });
}

void write_sensor(MitsubaWriter& out, const Scene& scene) {
  const Camera& c = scene.camera;
  const bool lens = c.aperture_radius > 0;
  out.element("sensor", typed(lens ? "thinlens" : "perspective"), [&] {
    out.parameter("float", "fov", c.fov_degrees);
    out.parameter("string", "fov_axis", std::string_view("x"));
    write_clip(out, scene);
    if (lens) {
      out.parameter("float", "aperture_radius", c.aperture_radius);
      out.parameter("float", "focus_distance", c.focus_distance);
    }
    // Mitsuba's x is towards the left.
    if (c.principal_point_offset_x != 0)
      out.parameter("float", "principal_point_offset_x", -c.principal_point_offset_x);
    if (c.principal_point_offset_y != 0)
      out.parameter("float", "principal_point_offset_y", c.principal_point_offset_y);
    out.element("transform", "name=\"to_world\"", [&] {
      out.line(fmt::format("<lookat origin=\"{}\" target=\"{}\" up=\"{}\"/>",
                           mitsuba_text(c.origin), mitsuba_text(c.target), mitsuba_text(c.up)));
    });
    out.element("film", typed("hdrfilm"), [&] {
      out.parameter("integer", "width", scene.film.width);
      out.parameter("integer", "height", scene.film.height);
      out.parameter("string", "component_format", std::string_view("float32"));
      write_filter(out, scene.film.filter);
    });
    out.element("sampler", typed("independent"), [&] {
      if (scene.sampler.sample_count == 1)
        out.line(
            "<!-- Lobelia's one ray a pixel goes through its centre, Mitsuba's through any place. -->");
      out.parameter("integer", "sample_count", scene.sampler.sample_count);
      out.parameter("integer", "seed", std::to_string(std::uint32_t(scene.sampler.seed)));
    });
  });
}

void write_material(MitsubaWriter& out, const Material& material, std::size_t index) {
  const bool phong = is_mitsuba_phong(material.highlight);
  out.element("bsdf",
              fmt::format("{} id=\"material_{}\"", typed(phong ? "phong" : "diffuse"), index), [&] {
                if (!phong)
                  return out.parameter("rgb", "reflectance", material.diffuse_reflectance);
                out.parameter("float", "exponent", material.highlight.exponent);
                out.parameter("rgb", "specular_reflectance", material.specular_reflectance);
                out.parameter("rgb", "diffuse_reflectance", material.diffuse_reflectance);
              });
}

/// Its surface reflects nothing. Rays pass through it, but those to other lights do not.
void write_area(MitsubaWriter& out, Rgb radiance) {
  out.line("<bsdf type=\"null\"/>");
  out.element("emitter", typed("area"), [&] { out.parameter("rgb", "radiance", radiance); });
}

void write_lamp(MitsubaWriter& out, const Lamp& lamp) {
  out.element("emitter", typed(lamp.is_distant ? "directional" : "point"), [&] {
    if (lamp.is_distant) {
      out.parameter("vector", "direction", lamp.direction);
    } else {
      out.parameter("point", "position", lamp.position);
    }
    out.parameter("rgb", lamp.is_distant ? "irradiance" : "intensity", lamp.strength);
  });
}

void write_environment(MitsubaWriter& out, const std::string& picture, Rgb radiance) {
  out.element("emitter", typed(picture.empty() ? "constant" : "envmap"), [&] {
    if (picture.empty()) return out.parameter("rgb", "radiance", radiance);
    out.parameter("string", "filename", std::string_view(picture));
    out.parameter("float", "scale", radiance.r);
    // Mitsuba's -z is at the edge of the picture, Lobelia's in the middle.
    out.line("<transform name=\"to_world\"><rotate y=\"1\" angle=\"180\"/></transform>");
  });
}

void write_light(MitsubaWriter& out, const Light& light) {
  if (const auto lamp = find_lamp(light)) return write_lamp(out, *lamp);
  if (is_environment(light)) return write_environment(out, picture_file(light), strength(light));
  const auto vector = [&](std::string_view name) { return std::get<Vec3>(value_of(light, name)); };
  const bool is_ball = bounds(light).is_ball;
  out.element("shape", typed(is_ball ? "sphere" : "rectangle"), [&] {
    const Vec3 c = vector("center");
    if (is_ball) {
      out.parameter("point", "center", c);
      out.parameter("float", "radius", std::get<double>(value_of(light, "radius")));
    } else {
      const Vec3 u = vector("half_u"), v = vector("half_v"), n = normalize(cross(u, v));
      out.element("transform", "name=\"to_world\"", [&] {
        out.line(fmt::format("<matrix value=\"{} {} {} {}  {} {} {} {}  {} {} {} {}  0 0 0 1\"/>",
                             u.x, v.x, n.x, c.x, u.y, v.y, n.y, c.y, u.z, v.z, n.z, c.z));
      });
    }
    write_area(out, strength(light));
  });
}

std::string mitsuba_xml(const Scene& scene) {
  MitsubaWriter out;
  out.element("scene", "version=\"3.0.0\"", [&] {
    if (std::ranges::any_of(scene.materials,
                            [](const Material& m) { return is_mitsuba_phong(m.highlight); })) {
      out.line(
          "<!-- Mitsuba 3 itself has no phong. phong.py beside this file adds it: python3 phong.py scene.xml");
      out.line(
          "     It is modified Phong, (n + 2)/(2 pi) cos^n of the angle from the mirror direction. -->");
    }
    out.element("integrator", typed("path"), [&] {
      out.line("<!-- 2 is light straight from the lights. -->");
      out.parameter("integer", "max_depth", scene.depth.glossy + kMitsubaDirectDepth);
    });
    write_sensor(out, scene);
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
      write_material(out, scene.materials[i], i);
    for (const Light& light : scene.lights) write_light(out, light);
    for (const Sphere& sphere : scene.spheres)
      out.element("shape", typed("sphere"), [&] {
        out.parameter("point", "center", sphere.center);
        out.parameter("float", "radius", sphere.radius);
        out.line(fmt::format("<ref id=\"material_{}\"/>", sphere.material));
      });
  });
  return out.take();
}

std::map<std::string, std::string> write_mitsuba(const Scene& scene) {
  std::map<std::string, std::string> texts{{"scene.xml", mitsuba_xml(scene)}};
  if (std::ranges::any_of(scene.materials,
                          [](const Material& m) { return is_mitsuba_phong(m.highlight); }))
    texts["phong.py"] = embedded::phong_py;
  return texts;
}

}  // namespace

constinit const SceneFormat kMitsubaFormat{
    "mitsuba",
    "Mitsuba 3",
    "scene.xml",
    "spheres and lights; highlights of modified Phong with cos^n, which phong.py adds to Mitsuba 3",
    why_not_mitsuba,
    write_mitsuba,
};

}  // namespace lobelia
