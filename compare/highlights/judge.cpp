#include "compare/highlights/judge.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "compare/highlights/slack.hpp"
#include "compare/profile/peak.hpp"

namespace lobelia {
namespace {

/// A highlight with less of its light is gone.
constexpr double kGone = 0.1;

/// Sums of a field over pixels: plain, times x, times y, times the squared distance from the centre.
struct Moments {
  double sum = 0, x = 0, y = 0, spread = 0;

  void add(double value, double dx, double dy) {
    sum += value;
    x += value * dx;
    y += value * dy;
    spread += value * (dx * dx + dy * dy);
  }
};

/// The median of a - b over the ring, of each channel; 0 of too few pixels.
std::array<double, 3> change_around(const Image& a, const Image& b,
                                    const LocalHighlight& highlight) {
  constexpr std::size_t kFewest = 16;
  std::array<double, 3> change{};
  if (highlight.ring.size() < kFewest) return change;
  std::vector<double> differences(highlight.ring.size());
  const auto middle = differences.begin() + std::ptrdiff_t(differences.size() / 2);
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < differences.size(); ++i) {
      const std::size_t value = 3 * std::size_t(highlight.ring[i]) + c;
      differences[i] = double(a.values()[value]) - double(b.values()[value]);
    }
    std::nth_element(differences.begin(), middle, differences.end());
    change[c] = *middle;
  }
  return change;
}

double energy_error(const Image& a, const Image& b, const std::array<double, 3>& around,
                    const LocalHighlight& highlight) {
  std::array<double, 3> differences{};
  for_pixels(highlight.core, b.width(), [&](std::size_t pixel, int, int) {
    for (std::size_t i = 0; i < 3; ++i)
      differences[i] +=
          double(a.values()[3 * pixel + i]) - double(b.values()[3 * pixel + i]) - around[i];
  });
  return *std::ranges::max_element(differences, {}, [](double d) { return std::abs(d); }) /
         highlight.energy;
}

double beyond(double size, double slack) { return std::max(0.0, size - slack); }

}  // namespace

double LocalErrors::badness() const {
  return std::max(
      {energy_beyond / kEnergyLimit, width_beyond / kWidthLimit, shift_beyond / kShiftLimit});
}

LocalErrors judge_highlight(const Image& a, const Image& b, const LocalHighlight& highlight) {
  LocalErrors errors;
  const std::array<double, 3> around = change_around(a, b, highlight);
  errors.energy = energy_error(a, b, around, highlight);
  errors.energy_beyond = beyond(std::abs(errors.energy), highlight.energy_slack);
  // Each over its base.
  Moments in_a, in_b;
  const double base_of_a = highlight.base + (around[0] + around[1] + around[2]) / 3;
  for_pixels(highlight.pixels, b.width(), [&](std::size_t pixel, int x, int y) {
    const double dx = x - highlight.centre_x, dy = y - highlight.centre_y;
    in_a.add(radiance_at(a, pixel) - base_of_a, dx, dy);
    in_b.add(radiance_at(b, pixel) - highlight.base, dx, dy);
  });
  errors.gone = !(in_a.sum > kGone * in_b.sum);
  if (errors.gone) return errors;
  const double scale = in_b.sum / in_a.sum;
  const double wider =
      highlight.spread > 0 ? (scale * in_a.spread - in_b.spread) / highlight.spread : 0;
  errors.width = std::sqrt(std::max(0.0, 1 + wider)) - 1;
  errors.width_beyond = beyond(std::abs(errors.width), highlight.width_slack);
  errors.shift_x = (scale * in_a.x - in_b.x) / highlight.light;
  errors.shift_y = (scale * in_a.y - in_b.y) / highlight.light;
  errors.shift_beyond = beyond(std::hypot(errors.shift_x, errors.shift_y), highlight.shift_slack);
  return errors;
}

std::vector<JudgedHighlight> judge_highlights(const Image& a, const Image& b,
                                              std::span<const LocalHighlight> highlights) {
  std::vector<JudgedHighlight> judged(highlights.size());
  oneapi::tbb::parallel_for(std::size_t{0}, highlights.size(), [&](std::size_t i) {
    judged[i] = {&highlights[i], judge_highlight(a, b, highlights[i])};
  });
  std::ranges::stable_sort(judged, std::ranges::greater{},
                           [](const JudgedHighlight& one) { return one.errors.badness(); });
  return judged;
}

}  // namespace lobelia
