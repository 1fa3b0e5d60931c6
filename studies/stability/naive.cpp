#include "studies/stability/naive.hpp"

#include <algorithm>
#include <numbers>

#include "base/pictures/half.hpp"
#include "base/system/error.hpp"
#include "reference_scenes/engines/analytic/formulas/definition.hpp"
#include "reference_scenes/engines/analytic/formulas/highlight.hpp"
#include "reference_scenes/engines/analytic/formulas/vector.hpp"

namespace lobelia::stability::naive {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

using Float3 = truth::Vector<float>;
Float3 to_float(Vec3 v) { return {float(v.x), float(v.y), float(v.z)}; }

/// The paper's table, first column.
struct ClosedForm {
  std::string_view model;
  float (*coefficient)(float n);
};
constexpr ClosedForm kClosedForms[] = {
    {"phong_rdf", [](float n) { return (n + 1) / (2 * kPi); }},
    {"modified_phong", [](float n) { return (n + 2) / (2 * kPi); }},
    {"blinn_phong_rdf", [](float n) { return (n + 2) / (4 * kPi * (2 - std::pow(2.0f, -n / 2))); }},
    {"modified_blinn_phong",
     [](float n) { return (n + 2) * (n + 4) / (8 * kPi * (std::pow(2.0f, -n / 2) + n)); }},
    {"blinn_phong_ndf", [](float n) { return (n + 1) / (8 * kPi); }},
    {"blinn_phong_heightfield", [](float n) { return (n + 2) / (8 * kPi); }},
    {"microfacet_smith", [](float n) { return (n + 2) / (8 * kPi); }},
};

float by_quadrature(const Highlight& h, const truth::ModelRow& model) {
  constexpr int kSteps = 1024;
  const float step = kPi / 2 / kSteps;
  float sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const float x = (float(i) + 0.5f) * step;
    const float value =
        lobe(h.lobe, std::cos(model.lobe_of_half_angle ? x / 2 : x), h.exponent) * std::sin(x);
    sum += model.integral_has_cosine ? value * std::cos(x) : value;
  }
  return 1 / (2 * kPi * sum * step * float(model.parts));
}

/// For unit vectors.
template <class Number>
Number unit_shape(const Highlight& highlight, const truth::Vector<Number>& n,
                  const truth::Vector<Number>& v, const truth::Vector<Number>& l) {
  const Number n_dot_l = dot(n, l);
  if (n_dot_l <= Number(0)) return Number(0);
  const ModelInfo& model = info(highlight.model);
  const Number cosine = model.angle == LobeAngle::kReflection
                            ? dot(Number(2) * dot(n, v) * n - v, l)
                            : dot(n, normalize(l + v));
  const Number value =
      cosine > Number(0) ? lobe_definition(highlight.lobe, cosine, highlight.exponent) : Number(0);
  return value * truth::geometry<Number>(truth::model_row(highlight.model), highlight.exponent,
                                         n_dot_l, dot(n, v));
}

constexpr float kEpsilon = 1e-4f;

/// The distance to the first hit of a sphere, or a negative number.
float meet(const Sphere& sphere, Float3 origin, Float3 direction) {
  const Float3 offset = origin - to_float(sphere.center);
  const float radius = float(sphere.radius);
  const float b = dot(offset, direction), c = dot(offset, offset) - radius * radius;
  const float discriminant = b * b - c;
  return discriminant > 0 ? -b - std::sqrt(discriminant) : -1;
}

struct Tracer {
  explicit Tracer(const Scene& s) : scene(s) {
    if (const std::string found = beyond_delta_lights(scene); !found.empty())
      throw Error(ExitCode::kInternal, "the naive renderer does not know: " + found);
    for (const Material& material : scene.materials)
      coefficients.push_back(coefficient(material.highlight));
  }

  const Scene& scene;
  std::vector<float> coefficients;  ///< by material

  Pixel pixel(Float3 origin, Float3 direction) const {
    Pixel found;
    float nearest = 0;
    for (int k = 0; k < int(scene.spheres.size()); ++k) {
      const float t = meet(scene.spheres[k], origin, direction);
      if (!(t > 0) || (found.sphere >= 0 && t >= nearest)) continue;
      found.sphere = k;
      nearest = t;
    }
    if (found.sphere < 0) return found;
    const Sphere& sphere = scene.spheres[found.sphere];
    const Float3 point = origin + nearest * direction;
    const Float3 normal = 1 / float(sphere.radius) * (point - to_float(sphere.center));
    for (const Light& light : scene.lights)
      found.radiance = found.radiance + lit(light, sphere, point, normal, -1.0f * direction);
    return found;
  }

  Rgb lit(const Light& light, const Sphere& sphere, Float3 point, Float3 normal,
          Float3 to_eye) const {
    Float3 to_light;
    float distance = 0, falloff = 1;
    const Lamp lamp = lamp_of(light);
    if (lamp.is_distant) {
      to_light = -1.0f * to_float(lamp.direction);
    } else {
      const Float3 offset = to_float(lamp.position) - point;
      distance = std::sqrt(dot(offset, offset));
      falloff = 1 / (distance * distance);
      to_light = 1 / distance * offset;
    }
    for (const Sphere& other : scene.spheres) {
      const float t = meet(other, point, to_light);
      if (t > kEpsilon && (distance == 0 || t < distance)) return {};
    }
    const Material& material = scene.materials[sphere.material];
    const float value = coefficients[sphere.material] *
                        unit_shape(material.highlight, normal, to_eye, to_light) * falloff;
    return double(value) * (lamp.strength * material.specular_reflectance);
  }
};

}  // namespace

float lobe(LobeId lobe, float cosine, double exponent) {
  return cosine > 0 ? lobe_definition(lobe, cosine, exponent) : 0;
}

float shape(const Highlight& highlight, Vec3 normal, Vec3 to_eye, Vec3 to_light) {
  return unit_shape(highlight, normalize(to_float(normal)), normalize(to_float(to_eye)),
                    normalize(to_float(to_light)));
}

double shape_in_half_floats(const Highlight& highlight, Vec3 normal, Vec3 to_eye, Vec3 to_light) {
  using Vector = truth::Vector<Half>;
  return double(unit_shape(highlight, Vector(normal), Vector(to_eye), Vector(to_light)));
}

float coefficient(const Highlight& highlight) {
  const truth::ModelRow& model = truth::model_row(highlight.model);
  if (info(highlight.lobe).name != "cosine") return by_quadrature(highlight, model);
  const auto* const form = std::ranges::find(kClosedForms, model.name, &ClosedForm::model);
  return form == std::end(kClosedForms) ? by_quadrature(highlight, model)
                                        : form->coefficient(float(highlight.exponent));
}

std::vector<Pixel> picture(const Scene& scene) {
  const Camera& camera = scene.camera;
  const Float3 forward = normalize(to_float(camera.target) - to_float(camera.origin));
  const Float3 right = normalize(cross(forward, to_float(camera.up))), up = cross(right, forward);
  const float half_width = std::tan(float(camera.fov_degrees) * std::numbers::pi_v<float> / 360);
  const float half_height = half_width * float(scene.film.height) / float(scene.film.width);
  const Tracer tracer(scene);
  std::vector<Pixel> pixels;
  for (int y = 0; y < scene.film.height; ++y)
    for (int x = 0; x < scene.film.width; ++x) {
      const float u = (2 * (float(x) + 0.5f) / float(scene.film.width) - 1) * half_width;
      const float v = (1 - 2 * (float(y) + 0.5f) / float(scene.film.height)) * half_height;
      pixels.push_back(
          tracer.pixel(to_float(camera.origin), normalize(forward + u * right + v * up)));
    }
  return pixels;
}

}  // namespace lobelia::stability::naive
