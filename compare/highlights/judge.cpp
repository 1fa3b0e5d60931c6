#include "compare/highlights/judge.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "profile/peak.hpp"

namespace lobelia {
namespace {

/// A highlight with less of its light is gone.
constexpr double kGone = 0.1;
/// Less is left of no widening, or noise would be taken for one.
constexpr double kLeastLeft = 0.5;
/// Half of what a highlight of the reference may have: a pixel filter spreads noise, which then looks less rough, and the
/// judged picture has more of it.
constexpr double kMostSlackOfNew = 0.075;

/// A highlight with so many times the pixels of another is not the same but carries it.
constexpr std::size_t kBroader = 4;

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

/// Medians over the ring.
struct Surroundings {
  double level = 0;                ///< of b's radiance
  std::array<double, 3> change{};  ///< of a - b, of each channel
};

/// If the ring has too few pixels: the highlight's base as the level, and no change.
Surroundings surroundings_of(const Image& a, const Image& b, const LocalHighlight& highlight) {
  constexpr std::size_t kFewest = 16;
  Surroundings around{.level = highlight.base};
  if (highlight.ring.size() < kFewest) return around;
  std::vector<double> values(highlight.ring.size());
  const auto median = [&] {
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  };
  std::ranges::transform(highlight.ring, values.begin(),
                         [&](std::uint32_t pixel) { return radiance_at(b, pixel); });
  around.level = median();
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::size_t value = 3 * std::size_t(highlight.ring[i]) + c;
      values[i] = double(a.values()[value]) - double(b.values()[value]);
    }
    around.change[c] = median();
  }
  return around;
}

/// Sets energy and channel.
void add_energy_error(const Image& a, const Image& b, const std::array<double, 3>& around,
                      const LocalHighlight& highlight, LocalErrors& errors) {
  std::array<double, 3> differences{};
  for_pixels(highlight.core, b.width(), [&](std::size_t pixel, int, int) {
    for (std::size_t i = 0; i < 3; ++i)
      differences[i] +=
          double(a.values()[3 * pixel + i]) - double(b.values()[3 * pixel + i]) - around[i];
  });
  constexpr double kOfAll = 0.5;
  const auto largest =
      std::ranges::max_element(differences, {}, [](double d) { return std::abs(d); });
  errors.energy = *largest / highlight.energy;
  if (std::abs(differences[0] + differences[1] + differences[2]) < 3 * kOfAll * std::abs(*largest))
    errors.channel = std::size_t(largest - differences.begin());
}

bool holds(std::span<const PixelRun> runs, int x, int y) {
  return std::ranges::any_of(
      runs, [&](const PixelRun& run) { return run.y == y && run.x <= x && x < run.end; });
}

double beyond(double size, double slack) { return std::max(0.0, size - slack); }

}  // namespace

double LocalErrors::badness() const {
  return std::max(
      {energy_beyond / kEnergyLimit, width_beyond / kWidthLimit, shift_beyond / kShiftLimit});
}

LocalErrors judge_highlight(const Image& a, const Image& b, const LocalHighlight& highlight) {
  LocalErrors errors;
  if (highlight.only_in_a) {
    // As much as b lacks of it.
    add_energy_error(b, a, surroundings_of(b, a, highlight).change, highlight, errors);
    errors.energy = -errors.energy;
    errors.energy_beyond = beyond(std::abs(errors.energy), highlight.energy_slack);
    return errors;
  }
  const auto& [level, around] = surroundings_of(a, b, highlight);
  add_energy_error(a, b, around, highlight, errors);
  errors.energy_beyond = beyond(std::abs(errors.energy), highlight.energy_slack);
  // Each over the light around it: a part of the tail is in that, which dims with the highlight.
  Moments in_a, in_b, over_skirt;
  const double level_of_a = level + (around[0] + around[1] + around[2]) / 3;
  for_pixels(highlight.pixels, b.width(), [&](std::size_t pixel, int x, int y) {
    const double dx = x - highlight.centre_x, dy = y - highlight.centre_y;
    in_a.add(radiance_at(a, pixel) - level_of_a, dx, dy);
    over_skirt.add(radiance_at(b, pixel) - highlight.skirt, dx, dy);
    in_b.add(radiance_at(b, pixel) - level, dx, dy);
  });
  errors.gone = !(in_a.sum > kGone * in_b.sum);
  if (errors.gone) return errors;
  const double scale = in_b.sum / in_a.sum;
  // With a small widening, some light leaves the pixels over their edge, and the scaling undoes a part of the rest. The
  // share that is left follows from b.
  const double left = 2 - over_skirt.sum * in_b.spread / (in_b.sum * over_skirt.spread);
  const double of_change = highlight.spread * std::clamp(left, kLeastLeft, 1.0);
  if (of_change > 0) {
    const double wider = (scale * in_a.spread - in_b.spread) / of_change;
    errors.width = std::sqrt(std::max(0.0, 1 + wider)) - 1;
    // The slack is that of half the ratio, which the root exceeds where noise makes the highlight narrower.
    const double size = std::min(std::abs(errors.width), std::abs(wider) / 2);
    errors.width_beyond = beyond(size, highlight.width_slack * highlight.spread / of_change);
  }
  errors.shift_x = (scale * in_a.x - in_b.x) / highlight.light;
  errors.shift_y = (scale * in_a.y - in_b.y) / highlight.light;
  errors.shift_beyond = beyond(std::hypot(errors.shift_x, errors.shift_y), highlight.shift_slack);
  return errors;
}

void add_highlights_of_a(const Image& a, const Image& b, std::span<const std::uint8_t> where,
                         const HighlightNoise& noise, std::vector<LocalHighlight>& highlights) {
  const std::size_t of_b = highlights.size();
  for (LocalHighlight& one : find_highlights(a, where, noise)) {
    if (one.energy_slack > kMostSlackOfNew || !judge_highlight(b, a, one).gone) continue;
    const bool is_named =
        std::ranges::any_of(std::span(highlights).first(of_b), [&](const LocalHighlight& other) {
          return other.count < kBroader * one.count && holds(one.core, other.x, other.y) &&
                 judge_highlight(a, b, other).badness() > 1;
        });
    if (is_named) continue;
    one.only_in_a = true;
    highlights.push_back(std::move(one));
  }
}

std::vector<JudgedHighlight> judge_highlights(const Image& a, const Image& b,
                                              std::span<const LocalHighlight> highlights) {
  std::vector<JudgedHighlight> judged;
  for (const LocalHighlight& one : highlights) judged.push_back({&one, {}});
  return judge_again(a, b, judged);
}

std::vector<JudgedHighlight> judge_again(const Image& a, const Image& b,
                                         std::span<const JudgedHighlight> highlights) {
  std::vector<JudgedHighlight> judged(highlights.begin(), highlights.end());
  oneapi::tbb::parallel_for(std::size_t{0}, judged.size(), [&](std::size_t i) {
    judged[i].errors = judge_highlight(a, b, *judged[i].highlight);
  });
  std::ranges::stable_sort(judged, std::ranges::greater{},
                           [](const JudgedHighlight& one) { return one.errors.badness(); });
  return judged;
}

}  // namespace lobelia
