#include "studies/accuracy/lobe_candidates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/words/constants.hpp"
#include "renderer/formula.hpp"
#include "renderer/lobe_properties.hpp"
#include "renderer/operation_count.hpp"

namespace lobelia::accuracy {
namespace {

/// The rounding before a lobe: of float64 to float32 in nine components, in one s, or none; half floats are emulated.
constexpr double kRoundingPrice[] = {4, 3, 0, 10000};
static_assert(std::size(kRoundingPrice) == kPrecisionCount);

}  // namespace

Highlight with_lobe(Highlight highlight, LobeId lobe) {
  if (highlight.lobe == lobe) return highlight;
  highlight.lobe = lobe;
  highlight.normalisation = Normalisation::kExact;
  return highlight;
}

Scene with_lobe(const Scene& scene, LobeId lobe) {
  Scene changed = scene;
  for (Material& material : changed.materials)
    material.highlight = with_lobe(material.highlight, lobe);
  return changed;
}

std::optional<LobeId> own_lobe(const Scene& scene) {
  std::optional<LobeId> own;
  for (const Material& material : scene.materials) {
    if (!has_highlight(material)) continue;
    if (own && *own != material.highlight.lobe) return std::nullopt;
    own = material.highlight.lobe;
  }
  return own;
}

std::vector<LobeId> lobe_candidates(const Scene& scene) {
  std::vector<LobeId> lobes(all_lobes().begin(), all_lobes().end());
  const auto add = [&](std::optional<LobeId> lobe) {
    if (lobe && std::find(lobes.begin(), lobes.end(), *lobe) == lobes.end()) lobes.push_back(*lobe);
  };
  add(own_lobe(scene));
  for (const Material& material : scene.materials)
    if (has_highlight(material))  // find_lobe knows which orders there are
      add(find_lobe(fmt::format("cs{}", material.highlight.exponent)));
  return lobes;
}

double highlight_difference(const Highlight& stand_in, const Highlight& target) {
  if (stand_in.lobe == target.lobe && stand_in.normalisation == target.normalisation) return 0;
  const PreparedLobe a = prepare(stand_in.lobe, stand_in.exponent),
                     b = prepare(target.lobe, target.exponent);
  const double ratio = radiance_coefficient(stand_in) / radiance_coefficient(target);
  const auto at = [&](double angle) {
    const double s = versine(angle);
    return std::abs(ratio * a.value(s) - b.value(s));
  };
  // Lobes end at the right angle, most of them at a value that is not 0 if n is small.
  const double end = std::nextafter(kRightAngle, 0);
  double most = std::max(at(0), at(end));
  const auto scan = [&](double to) {
    constexpr int kPoints = 1000;
    const double step = to / kPoints;
    int best = 0;
    double there = -1;
    for (int i = 0; i <= kPoints; ++i)
      if (const double value = at(i * step); value > there) there = value, best = i;
    // Between the neighbours of the best point the difference has one maximum: thirds close in on it.
    double low = std::max(0, best - 1) * step, high = std::min(kPoints, best + 1) * step;
    for (int i = 0; i < 60; ++i) {
      const double third = (high - low) / 3;
      if (at(low + third) < at(high - third))
        low += third;
      else
        high -= third;
    }
    most = std::max({most, there, at(low), at(high)});
  };
  // Across the peak, on the scale on which a lobe of that exponent bends, and across the rest.
  scan(std::min(end, 2 / std::sqrt(target.exponent)));
  scan(std::min(end, 20 / std::sqrt(target.exponent)));
  scan(end);
  return most;
}

double shading_cost(LobeId lobe, Precision precision) {
  return price(lobe, precision) + (lobe.formula ? 0 : kRoundingPrice[std::size_t(precision)]);
}

}  // namespace lobelia::accuracy
