#include "compare/faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/pictures/colour.hpp"
#include "base/pictures/image_values.hpp"
#include "base/system/scratch_memory.hpp"
#include "base/words/numbers.hpp"

namespace lobelia {
namespace {

using records::Fault;

/// The share of the values that may contradict a fault.
constexpr double kMostOff = 0.01;

/// The range of some values.
struct ValueSpan {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  std::size_t count = 0;

  void add(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
    ++count;
  }
};

/// Calls visit(value of faulty, value of other) for all values; stops with false as soon as it returns false.
template <class Visit>
bool all_values(const Image& faulty, const Image& other, const Visit& visit) {
  bool goes_on = true;
  in_parts(faulty.values().size(), 2 * sizeof(float), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && goes_on; ++i)
      goes_on = visit(double(faulty.values()[i]), double(other.values()[i]));
  });
  return goes_on;
}

std::optional<Fault> clipping_of(const Image& faulty, const Image& other) {
  const double level = peak_value(faulty);
  // A value beyond is no rounding of one at the level.
  constexpr double kBeyond = 1.01, kLeastSpread = 1.05, kRelative = 0.01, kAbsolute = 0.002;
  constexpr std::size_t kFewest = 5;
  if (!(level > 0)) return std::nullopt;
  ValueSpan beyond, below;
  std::size_t off = 0;
  all_values(faulty, other, [&](double value, double truth) {
    const double tolerance = kRelative * std::abs(truth) + kAbsolute * std::min(level, 1.0);
    if (kLeastSpread * value < level && value > 0) below.add(value);
    if (value == level && truth > kBeyond * level)
      beyond.add(truth);
    else
      off += std::abs(value - std::min(truth, level)) > tolerance;
    return true;
  });
  // A flat picture lacks the other's highlights; nothing says that it cut them off.
  if (below.count < kFewest || beyond.count < kFewest ||
      beyond.most < kLeastSpread * beyond.least || double(off) > kMostOff * double(beyond.count))
    return std::nullopt;
  Fault fault;
  fault.kind = "clipped";
  fault.value = level;
  fault.other = beyond.most;
  return fault;
}

std::optional<Fault> encoding_of(const Image& faulty, const Image& other) {
  // Where curve and light differ by more than the tolerance allows to mistake.
  constexpr double kDark = 0.02, kLight = 0.9, kTolerance = 0.003, kLeastSpread = 2;
  constexpr std::size_t kFewest = 32;
  ValueSpan telling;
  std::size_t off = 0, all = 0;
  const auto fits = [&](double value, double truth) {
    const double clamped = std::clamp(truth, 0.0, 1.0);
    const bool tells = truth >= kDark && truth <= kLight;
    const bool is_encoded =
        std::abs(value - srgb_encoded(clamped)) <= kTolerance ||
        std::abs(value - srgb_encoded(truth)) <= kTolerance * std::max(1.0, value);
    // Black says nothing.
    all += truth != 0 || value != 0;
    off += !is_encoded;
    if (tells && is_encoded) telling.add(truth);
    // Most pictures are not, and need no more than their first values.
    constexpr std::size_t kEnough = 4096;
    return all < kEnough || double(off) <= 0.5 * double(all);
  };
  if (!all_values(faulty, other, fits) || telling.count < kFewest ||
      telling.most < kLeastSpread * telling.least || double(off) > kMostOff * double(all))
    return std::nullopt;
  Fault fault;
  fault.kind = "encoded as sRGB";
  return fault;
}

double brightest(const Image& image, int x, int y) {
  return double(std::ranges::max(image.pixel(x, y)));
}

std::optional<Fault> bright_pixel_of(const Image& faulty, const Image& other) {
  constexpr double kOfOthers = 20, kOfNeighbours = 5;
  double largest = 0, second = 0;
  std::size_t where = 0;
  const std::span<const float> values = faulty.values(), truths = other.values();
  in_parts(faulty.pixel_count(), 6 * sizeof(float), [&](std::size_t begin, std::size_t end) {
    for (std::size_t pixel = begin; pixel < end; ++pixel) {
      double difference = 0;
      for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i)
        difference = std::max(difference, std::abs(double(values[i]) - double(truths[i])));
      if (difference > largest) {
        second = std::exchange(largest, difference);
        where = pixel;
      } else {
        second = std::max(second, difference);
      }
    }
  });
  if (!(largest > kOfOthers * second)) return std::nullopt;
  const int width = faulty.width(), x = int(where % std::size_t(width)),
            y = int(where / std::size_t(width));
  const double value = brightest(faulty, x, y);
  double around = brightest(other, x, y);
  int neighbours = 0;
  for (int j = std::max(y - 1, 0); j <= std::min(y + 1, faulty.height() - 1); ++j)
    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, width - 1); ++i)
      if (i != x || j != y) {
        around = std::max(around, brightest(faulty, i, j));
        ++neighbours;
      }
  if (neighbours == 0 || !(value > 0 && value >= kOfNeighbours * around)) return std::nullopt;
  Fault fault;
  fault.kind = "one bright pixel";
  fault.value = value;
  fault.other = brightest(other, x, y);
  fault.x = x;
  fault.y = y;
  const double peak = peak_value(other);
  fault.rest = peak > 0 ? second / peak : 0;
  return fault;
}

}  // namespace

std::vector<Fault> find_faults(const Image& a, const Image& b) {
  std::vector<Fault> faults;
  for (const auto find : {clipping_of, encoding_of, bright_pixel_of})
    for (const bool in_a : {true, false})
      if (auto fault = in_a ? find(a, b) : find(b, a)) {
        fault->picture = in_a ? "a" : "b";
        faults.push_back(*fault);
        break;
      }
  return faults;
}

std::string fault_text(const Fault& fault, std::string_view a, std::string_view b) {
  const auto& [faulty, other] = fault.picture == "a" ? std::pair(a, b) : std::pair(b, a);
  if (fault.kind == "clipped")
    return fmt::format("{} is clipped at {} where {} goes up to {}", faulty,
                       number_text(*fault.value), other, number_text(*fault.other));
  if (fault.kind == "one bright pixel")
    return fmt::format(
        "{} has one bright pixel at ({}, {}): {} where {} has {}; the rest differs by at most {} "
        "of the peak",
        faulty, *fault.x, *fault.y, number_text(*fault.value), other, number_text(*fault.other),
        percent_text(*fault.rest));
  return fmt::format("{} is {} encoded as sRGB", faulty, other);
}

}  // namespace lobelia
