#include "studies/cost/lobe_errors.hpp"

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/system/error.hpp"
#include "base/words/constants.hpp"
#include "reference_scenes/engines/analytic/formulas/definition.hpp"
#include "reference_scenes/engines/analytic/formulas/number_limits.hpp"
#include "reference_scenes/engines/analytic/formulas/truth.hpp"

namespace lobelia::cost {
namespace {

/// The number in which errors of float and double are measured.
using Quad = boost::multiprecision::cpp_bin_float_quad;
static_assert(std::numeric_limits<Quad>::digits == 113);
const bool kQuadLimits = truth::made_limits<Quad>();

constexpr std::size_t kCore = 2048, kTail = 512;

std::size_t place_of(LobeId lobe) {
  const auto lobes = all_lobes();
  return std::size_t(std::find(lobes.begin(), lobes.end(), lobe) - lobes.begin());
}

}  // namespace

std::vector<records::CostError> lobe_error_kinds() {
  return {{"max", "largest error seen, of the peak"},
          {"rms", "RMS error over the highlight, of the peak"},
          {"energy", "error of the energy, of that of cos^n"}};
}

LobeTruth::LobeTruth(double exponent) : cosine_energy_(1 / (exponent + 1)) {
  add_samples(exponent);
  cosine_ = place_of(*find_lobe("cosine"));
  const ModelId whole = *find_model("phong_rdf");  // 1/coefficient: 2 pi times the lobe's integral
  for (const LobeId& lobe : all_lobes()) {
    std::vector<Value>& values = values_.emplace_back();
    for (const float s : s_) {
      const Quad value = s < 1 ? lobe_definition<Quad>(lobe, Quad(1) - Quad(s), exponent) : Quad(0);
      values.push_back({double(value), double(value - Quad(double(value)))});
    }
    const double energy = 1 / (2 * kPi * truth::coefficient(whole, lobe, exponent));
    shape_energy_.push_back(values_.size() - 1 == cosine_ ? 0 : energy / cosine_energy_ - 1);
  }
}

void LobeTruth::add_samples(double exponent) {
  const double end = highlight_end(exponent);
  // Numbers of the narrower type, so that every variant gets exactly the same s.
  const auto add = [&](double s, double weight) {
    s_.push_back(float(s));
    weight_.push_back(weight);
  };
  // Not the middle of a cell: that has few digits, so that 1 - s would not be rounded.
  const auto within = [](std::size_t i) {
    return double(i) + std::fmod(double(i + 1) * std::numbers::phi, 1.0);
  };
  for (std::size_t i = 0; i < kCore; ++i) add(end * within(i) / kCore, end / kCore);
  core_ = s_.size();
  const double step = -std::log(end) / kTail;
  for (std::size_t i = 0; i < kTail && end < 1; ++i) {
    const double s = end * std::exp(within(i) * step);
    add(s, s * step);
  }
  add(0, 0);
  add(1, 0);
  for (int bits = 1; bits <= 24; ++bits) add(1 - std::exp2(-bits), 0);
  for (int bits = 2; bits <= 60; ++bits) add(std::exp2(-bits), 0);
  while (s_.size() % kLobeBlock != 0) add(0, 0);
}

LobeVariantErrors LobeTruth::errors(const LobeVariant& variant) const {
  const std::vector<double> computed = variant.values(s_);
  const std::size_t place = place_of(variant.lobe);
  const std::vector<Value>&own = values_[place], &cosine = values_[cosine_];
  LobeVariantErrors errors;
  double drift = 0;
  const auto add = [&](LobeErrors& e, double difference, std::size_t i) {
    e.max = std::max(e.max, std::abs(difference));
    if (i < core_) e.rms += difference * difference;
  };
  for (std::size_t i = 0; i < s_.size(); ++i) {
    const double rounding = (computed[i] - own[i].high) - own[i].low;
    if (!(std::abs(rounding) <= variant.allowed))
      throw Error(ExitCode::kInternal, "{} is {:.3g} off at s = {}, n = {}; {:.3g} is allowed",
                  variant.name(), std::abs(rounding), s_[i], 1 / cosine_energy_ - 1,
                  variant.allowed);
    add(errors.rounding, rounding, i);
    add(errors.shape, (own[i].high - cosine[i].high) + (own[i].low - cosine[i].low), i);
    add(errors.all, (computed[i] - cosine[i].high) - cosine[i].low, i);
    drift += weight_[i] * rounding;
  }
  for (LobeErrors* e : {&errors.all, &errors.shape, &errors.rounding})
    e->rms = std::sqrt(e->rms / double(core_));
  errors.rounding.energy = std::abs(drift) / cosine_energy_;
  errors.shape.energy = std::abs(shape_energy_[place]);
  errors.all.energy = std::abs(shape_energy_[place] + drift / cosine_energy_);
  return errors;
}

}  // namespace lobelia::cost
