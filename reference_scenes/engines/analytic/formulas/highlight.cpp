#include "reference_scenes/engines/analytic/formulas/highlight.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/tanh_sinh.hpp>

#include "base/system/error.hpp"
#include "reference_scenes/engines/analytic/formulas/big.hpp"
#include "reference_scenes/engines/analytic/formulas/definition.hpp"
#include "reference_scenes/engines/analytic/formulas/truth.hpp"

namespace lobelia::truth {

template <class Real>
Real lobe_of_cosine(LobeId lobe, const Real& cosine, double exponent) {
  if (cosine <= 0) return 0;
  // The cosine between two equal directions may be rounded to just above 1.
  return lobe_definition(lobe, cosine < 1 ? cosine : Real(1), exponent);
}
template double lobe_of_cosine(LobeId, const double&, double);
template Big lobe_of_cosine(LobeId, const Big&, double);

double lobe(LobeId lobe, double s, double exponent) {
  return double(lobe_of_cosine(lobe, Big(1 - Big(s)), exponent));
}

double one_minus_cos(double angle) {
  const Big sine = sin(Big(angle) / 2);
  return double(2 * sine * sine);
}

double shape(const Highlight& highlight, Vec3 normal, Vec3 to_eye, Vec3 to_light) {
  const Big3 n = normalize(Big3(normal)), v = normalize(Big3(to_eye)),
             l = normalize(Big3(to_light));
  const Big n_dot_l = dot(n, l);
  if (n_dot_l <= 0) return 0;
  const ModelRow& model = model_row(highlight.model);
  const Big lobe =
      lobe_of_cosine(highlight.lobe, lobe_cosine(model.angle, n, v, l), highlight.exponent);
  return double(Big(lobe * geometry<Big>(model, highlight.exponent, n_dot_l, dot(n, v))));
}

namespace {

constexpr auto kR = LobeAngle::kReflection, kH = LobeAngle::kHalfVector;
constexpr ModelRow kRows[] = {
    {"phong_rdf", kR, false, false, false, 1},
    {"modified_phong", kR, true, false, true, 1},
    {"blinn_phong_rdf", kH, false, true, false, 1},
    {"modified_blinn_phong", kH, true, true, true, 1},
    {"blinn_phong_ndf", kH, true, false, false, 4},
    {"blinn_phong_heightfield", kH, true, false, true, 4},
    {"microfacet_smith", kH, true, false, true, 4, true},
};

}  // namespace

const ModelRow& model_row(std::string_view model) {
  const auto* const row = std::ranges::find(kRows, model, &ModelRow::name);
  if (row == std::end(kRows))
    throw Error(ExitCode::kInternal, "formulas/highlight.cpp has no row for the model '{}'", model);
  return *row;
}

namespace {

/// The density, not normalised.
Big unnormalised(LobeId lobe, const Big& cosine, double exponent) {
  if (cosine <= 0) return 0;
  return lobe_of_cosine(lobe, cosine, exponent) * draw_factor(lobe, cosine, exponent);
}

/// The integral over the cosine from where the lobe ends to 1.
Big whole(LobeId lobe, double exponent) {
  const Big end = lobe.order > 0 ? Big(1 - cos(angle_at(lobe, 0, exponent))) : Big(1);
  Big sum = 0, from = 0, to = 1 / (2 * Big(exponent));
  for (; to < end; from = to, to *= 2)
    sum += boost::math::quadrature::gauss<Big, 30>::integrate(
        [&](const Big& s) { return unnormalised(lobe, 1 - s, exponent); }, from, to);
  // cos^n with a small n rises steeply from the right angle, so the points are crowded there.
  thread_local boost::math::quadrature::tanh_sinh<Big> corner;
  const Big piece = end - from, lowest = 1 - end;
  const auto from_end = [&](const Big& part) {
    return unnormalised(lobe, lowest + piece * part, exponent);
  };
  return sum + piece * corner.integrate(from_end, Big(0), Big(1), Big(1e-22));
}

}  // namespace

std::function<double(double s)> density(LobeId lobe, double exponent) {
  return [=, integral = whole(lobe, exponent)](double s) {
    return double(unnormalised(lobe, 1 - Big(s), exponent) / integral);
  };
}

}  // namespace lobelia::truth
