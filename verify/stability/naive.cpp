#include "verify/stability/naive.hpp"

#include <algorithm>
#include <numbers>

#include "reference_scenes/engines/analytic/formulas/definition.hpp"
#include "reference_scenes/engines/analytic/formulas/highlight.hpp"
#include "verify/stability/float3.hpp"

namespace lobelia::stability::naive {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

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
  const truth::ModelRow& model = truth::model_row(highlight.model);
  if (info(highlight.lobe).name != "cosine") return by_quadrature(highlight, model);
  const auto* const form = std::ranges::find(kClosedForms, model.name, &ClosedForm::model);
  return form == std::end(kClosedForms) ? by_quadrature(highlight, model)
                                        : form->coefficient(float(highlight.exponent));
}

}  // namespace lobelia::stability::naive
