#include "verify/stability/naive.hpp"

#include <algorithm>
#include <numbers>

#include "reference_scenes/engines/analytic/formulas/definition.hpp"
#include "verify/stability/float3.hpp"

namespace lobelia::stability::naive {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

/// The paper's table, first column.
float closed_form(std::string_view model, float n) {
  if (model == "phong_rdf") return (n + 1) / (2 * kPi);
  if (model == "modified_phong") return (n + 2) / (2 * kPi);
  if (model == "blinn_phong_rdf") return (n + 2) / (4 * kPi * (2 - std::pow(2.0f, -n / 2)));
  if (model == "modified_blinn_phong")
    return (n + 2) * (n + 4) / (8 * kPi * (std::pow(2.0f, -n / 2) + n));
  return model == "blinn_phong_ndf" ? (n + 1) / (8 * kPi) : (n + 2) / (8 * kPi);
}

float by_quadrature(const Highlight& h) {
  constexpr int kSteps = 1024;
  const std::string_view model = info(h.model).name;
  const bool halved = model == "blinn_phong_rdf" || model == "modified_blinn_phong";
  const bool cosine = halved ? model == "modified_blinn_phong"
                             : model == "modified_phong" || model == "blinn_phong_heightfield";
  const float step = kPi / 2 / kSteps;
  float sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const float x = (float(i) + 0.5f) * step;
    const float value = lobe(h.lobe, std::cos(halved ? x / 2 : x), h.exponent) * std::sin(x);
    sum += cosine ? value * std::cos(x) : value;
  }
  const float parts =
      model == "blinn_phong_ndf" || model == "blinn_phong_heightfield" ? 4.0f : 1.0f;
  return 1 / (2 * kPi * sum * step * parts);
}

}  // namespace

float lobe(LobeId lobe, float cosine, double exponent) {
  return cosine > 0 ? lobe_definition(lobe, cosine, exponent) : 0;
}

float unit_shape(const Highlight& highlight, Float3 n, Float3 v, Float3 l) {
  const float n_dot_l = dot(n, l);
  if (n_dot_l <= 0) return 0;
  const ModelInfo& model = info(highlight.model);
  const float cosine = model.angle == LobeAngle::kReflection ? dot(2 * dot(n, v) * n - v, l)
                                                             : dot(n, normalize(l + v));
  const float value = lobe(highlight.lobe, cosine, highlight.exponent);
  return model.applies_cosine ? value * n_dot_l : value;
}

float shape(const Highlight& highlight, Vec3 normal, Vec3 to_eye, Vec3 to_light) {
  return unit_shape(highlight, normalize(Float3(normal)), normalize(Float3(to_eye)),
                    normalize(Float3(to_light)));
}

float coefficient(const Highlight& highlight) {
  return info(highlight.lobe).name == "cosine"
             ? closed_form(info(highlight.model).name, float(highlight.exponent))
             : by_quadrature(highlight);
}

}  // namespace lobelia::stability::naive
