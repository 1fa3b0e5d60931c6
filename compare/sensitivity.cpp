#include "compare/sensitivity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/pictures/colour.hpp"
#include "base/pictures/half.hpp"
#include "base/pictures/image_values.hpp"
#include "base/system/error.hpp"
#include "base/words/text.hpp"
#include "compare/highlight_region.hpp"
#include "compare/highlights/judge.hpp"
#include "compare/highlights/words.hpp"
#include "compare/layers.hpp"
#include "profile/peak.hpp"

namespace lobelia {
namespace {

template <class Function>
Image each_value(const Image& image, Function function) {
  Image result = image;
  for (float& value : result.values()) value = float(function(double(value)));
  return result;
}

/// Filtered along rows (`dx` 1) or columns (`dy` 1) by taps around the middle one; the border repeats.
Image filtered(const Image& image, std::span<const double> taps, int dx, int dy) {
  Image result(image.width(), image.height());
  const int radius = int(taps.size()) / 2;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      std::array<double, 3> sum{};
      for (int k = -radius; k < int(taps.size()) - radius; ++k) {
        const auto pixel = image.pixel(std::clamp(x + k * dx, 0, image.width() - 1),
                                       std::clamp(y + k * dy, 0, image.height() - 1));
        for (std::size_t c = 0; c < 3; ++c)
          sum[c] += taps[std::size_t(k + radius)] * double(pixel[c]);
      }
      for (std::size_t c = 0; c < 3; ++c) result.pixel(x, y)[c] = float(sum[c]);
    }
  return result;
}

/// To the right, between its pixels by Catmull and Rom's cubic, without values below the least or above the peak.
Image shifted_by_half(const Image& image) {
  constexpr double kTaps[] = {-1.0 / 16, 9.0 / 16, 9.0 / 16, -1.0 / 16};
  const double least = std::ranges::min(image.values()), peak = peak_value(image);
  return each_value(filtered(image, kTaps, 1, 0),
                    [&](double v) { return std::clamp(v, least, peak); });
}

Image blurred(const Image& image) {
  std::array<double, 7> taps;
  double sum = 0;
  for (int k = -3; k <= 3; ++k) sum += taps[std::size_t(k + 3)] = std::exp(-0.5 * k * k);
  for (double& tap : taps) tap /= sum;
  return filtered(filtered(image, taps, 1, 0), taps, 0, 1);
}

/// The pixels of the highlight that hangs together with the brightest pixel.
PixelFlags brightest_highlight(const Image& image) {
  PixelFlags left = highlight_region(image, image, {}), found(left.size());
  const auto brightest = std::ranges::max_element(image.values()) - image.values().begin();
  std::vector<std::size_t> open{std::size_t(brightest) / 3};
  const auto width = std::size_t(image.width());
  while (!open.empty()) {
    const std::size_t pixel = open.back();
    open.pop_back();
    if (std::exchange(left[pixel], 0) == 0) continue;
    found[pixel] = 1;
    if (pixel % width > 0) open.push_back(pixel - 1);
    if (pixel % width + 1 < width) open.push_back(pixel + 1);
    if (pixel >= width) open.push_back(pixel - width);
    if (pixel + width < left.size()) open.push_back(pixel + width);
  }
  return found;
}

/// In place of its brightest highlight the picture has what is around it, or black.
Image without_brightest_highlight(const Image& image) {
  const PixelFlags highlight = brightest_highlight(image),
                   around = grown(highlight, image.width(), 1);
  std::array<double, 3> fill{};
  double count = 0;
  for (std::size_t pixel = 0; pixel < highlight.size(); ++pixel) {
    if (around[pixel] == 0 || highlight[pixel] != 0) continue;
    ++count;
    for (std::size_t c = 0; c < 3; ++c) fill[c] += double(image.values()[3 * pixel + c]);
  }
  Image result = image;
  for (std::size_t pixel = 0; pixel < highlight.size(); ++pixel)
    for (std::size_t c = 0; c < 3 && highlight[pixel] != 0; ++c)
      result.values()[3 * pixel + c] = count > 0 ? float(fill[c] / count) : 0.0f;
  return result;
}

/// Each highlight is changed by itself, as many as these.
constexpr std::size_t kMostChanged = 8;

/// The light of a highlight over its base, times `kept`, and moved by some columns. What moves beyond the border is lost.
Image with_highlight(const Image& image, const LocalHighlight& highlight, double kept,
                     int columns) {
  Image result = image;
  const auto share_over_base = [&](std::size_t pixel) {
    return 1 - highlight.base / radiance_at(image, pixel);
  };
  for_pixels(highlight.pixels, image.width(), [&](std::size_t pixel, int, int) {
    for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i)
      result.values()[i] -= float(share_over_base(pixel) * double(image.values()[i]));
  });
  for_pixels(highlight.pixels, image.width(), [&](std::size_t pixel, int x, int y) {
    if (x + columns < 0 || x + columns >= image.width()) return;
    for (std::size_t c = 0; c < 3; ++c)
      result.pixel(x + columns, y)[c] +=
          float(kept * share_over_base(pixel) * double(image.values()[3 * pixel + c]));
  });
  return result;
}

/// Whether `a` clearly has a highlight that `b` lacks.
bool has_highlight_alone(const Image& a, const Image& b, const ComparisonOptions& options) {
  std::vector<LocalHighlight> highlights = find_highlights(b, options.surfaces);
  add_highlights_of_a(a, b, options.surfaces, {}, highlights);
  return std::ranges::any_of(highlights, [&](const LocalHighlight& one) {
    return one.only_in_a && judge_highlight(a, b, one).badness() > 1;
  });
}

Image as_8_bits(const Image& image) {
  const DisplayImage display = to_display(image, 0);
  Image result(image.width(), image.height());
  for (std::size_t i = 0; i < display.rgb.size(); ++i)
    result.values()[i] = srgb_decoded(float(display.rgb[i]) / 255);
  return result;
}

/// Monte Carlo noise of 2 % of each value, as of a few thousand samples, which the comparison is told of.
constexpr double kNoise = 0.02;

Image with_noise(const Image& image, std::uint64_t stream) {
  Image result = image;
  for (std::size_t i = 0; i < result.values().size(); ++i)
    result.values()[i] += float(kNoise * double(result.values()[i]) * gaussian(stream, i));
  return result;
}

/// The result of comparing a changed copy with the original.
Change change_of(std::string name, Expected expected, const Comparison& comparison) {
  Change change{std::move(name), expected, comparison.verdict, {}};
  for (const LimitResult& limit : comparison.limits)
    if (!limit.pass && limit.standing != Standing::kOpen)
      change.found_by += (change.found_by.empty() ? "" : ", ") + limit.metric;
  return change;
}

}  // namespace

std::vector<Change> sensitivity(const Image& reference, const ComparisonOptions& options) {
  const double peak = peak_value(reference);
  if (!is_finite(reference) || !(peak > 0))
    throw Error(ExitCode::kInput,
                "a picture for --sensitivity needs finite values, and one above 0");
  std::vector<Change> changes;
  const auto add_pair = [&](std::string name, Expected expected, const Image& a, const Image& b,
                            const ComparisonOptions& how) {
    changes.push_back(change_of(std::move(name), expected, compare(a, b, how)));
  };
  const auto add = [&](std::string name, Expected expected, const Image& changed) {
    add_pair(std::move(name), expected, changed, reference, options);
  };
  add("black", Expected::kFound, Image(reference.width(), reference.height()));
  add("shifted by half a pixel", Expected::kFound, shifted_by_half(reference));
  for (const int percent : {1, 2, 5, 10})
    add(fmt::format("{} % dimmer", percent), percent < 2 ? Expected::kEither : Expected::kFound,
        each_value(reference, [&](double v) { return v * (1 - percent / 100.0); }));
  add("blurred, standard deviation 1 pixel", Expected::kEither, blurred(reference));
  // A highlight of a few pixels shows no width.
  constexpr int kFewPixels = 32;
  const auto pixels = std::ranges::count(highlight_region(reference, reference, {}), 1);
  add("exponent 5 % higher", pixels < kFewPixels ? Expected::kEither : Expected::kFound,
      each_value(reference, [&](double v) { return v > 0 ? peak * std::pow(v / peak, 1.05) : v; }));
  add("without its brightest highlight", Expected::kFound, without_brightest_highlight(reference));
  const std::vector<LocalHighlight> highlights = find_highlights(reference, options.surfaces);
  for (const LocalHighlight& one :
       std::span(highlights).first(std::min(highlights.size(), kMostChanged))) {
    const auto add_highlight = [&](std::string_view how, double kept, int columns) {
      const Image changed = with_highlight(reference, one, kept, columns);
      // A change that the picture's own roughness hides need not be found.
      const bool is_clear = judge_highlight(changed, reference, one).badness() > 1;
      add(fmt::format("{} {}", name_of_highlight(one.x, one.y), how),
          is_clear ? Expected::kFound : Expected::kEither, changed);
    };
    constexpr int kColumns = 4;
    const int columns = one.x + kColumns < reference.width() ? kColumns : -kColumns;
    add_highlight("gone", 0, 0);
    add_highlight("5 % dimmer", 0.95, 0);
    add_highlight("30 % dimmer", 0.7, 0);
    add_highlight(fmt::format("moved {} pixels", kColumns), 1, columns);
    const Image without = with_highlight(reference, one, 0, 0);
    add_pair(
        fmt::format("{} only in a", name_of_highlight(one.x, one.y)),
        has_highlight_alone(reference, without, options) ? Expected::kFound : Expected::kEither,
        reference, without, options);
  }

  add("rounded in the seventh digit", Expected::kNotFound,
      each_value(reference, [](double v) { return v * (1 + 1e-7); }));
  // A picture that a format cannot hold is not rounded by it but spoilt.
  constexpr double kMostRounding = 0.02;
  if (peak >= kLeastNormalHalf && peak <= kGreatestHalf)
    add("rounded to half floats", Expected::kNotFound, each_value(reference, rounded_to_half));
  PictureSource eight_bits;
  eight_bits.value_type = "uint8";
  eight_bits.transfer = "sRGB";
  ComparisonOptions rounded = options;
  rounded.rounding = rounding_of(eight_bits, peak);
  if (peak <= 1 && rounded.rounding < kMostRounding * peak)
    add_pair("rounded to 8 bits", Expected::kNotFound, as_8_bits(reference), reference, rounded);
  ComparisonOptions noisy = options;
  noisy.noise.emplace().bootstraps = kFewestBootstraps;
  noisy.noise->a = noisy.noise->b = noise_of_standard_errors(
      each_value(reference, [](double v) { return kNoise * std::abs(v); }), 1000, false);
  add_pair("noise that is known, 2 %", Expected::kNotFound, with_noise(reference, 1),
           with_noise(reference, 2), noisy);
  return changes;
}

bool are_as_expected(std::span<const Change> changes) {
  return std::ranges::all_of(changes, &Change::is_as_expected);
}

records::Sensitivity sensitivity_record(const std::string& a, std::span<const Change> changes,
                                        const ComparisonOptions& options) {
  records::Sensitivity record;
  record.a = a;
  record.as_expected = are_as_expected(changes);
  record.default_limits = options.default_limits;
  for (const auto& [metric, limit] : options.limits) record.limits.push_back({metric, limit});
  for (const Change& change : changes)
    record.changes.push_back({change.name,
                              std::string(records::kExpected[std::size_t(change.expected)]),
                              std::string(verdict_name(change.verdict)), change.is_as_expected(),
                              split(change.found_by, ", ")});
  return record;
}

}  // namespace lobelia
