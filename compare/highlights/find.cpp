#include "compare/highlights/find.hpp"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_sort.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>

#include "base/pictures/image_values.hpp"
#include "base/system/scratch_memory.hpp"
#include "compare/highlight_region.hpp"
#include "compare/highlights/slack.hpp"
#include "profile/peak.hpp"

namespace lobelia {
namespace {

constexpr std::size_t kMostCells = std::size_t{1} << 20;
constexpr std::size_t kAreas = 21;  // of areas: 1, 2, 4, ... cells
/// The share of the fall so far that is hardly a fall.
constexpr double kPlateau = 0.1;
constexpr double kLeastHeight = 0.25, kSkirt = 0.05;
/// Less of the brightest light is rounding beside it.
constexpr double kDimmestBesideALight = 1e-7;
constexpr std::size_t kMostLookedAt = 1024;
/// Cells that are visited in all, for each cell of the picture.
constexpr std::size_t kMostVisits = 8;
constexpr std::size_t kMostBases = 3;  // of one maximum
constexpr std::uint32_t kNone = ~std::uint32_t{0};

/// The largest radiance of each square of pixels.
struct Cells {
  int side = 1;  ///< pixels
  int width = 0, height = 0;
  std::vector<float> values;

  std::size_t index(int x, int y) const { return std::size_t(y) * std::size_t(width) + x; }
};

Cells cells_of(const Image& image, std::span<const std::uint8_t> where) {
  Cells cells;
  const auto across = [&](int pixels) { return (pixels + cells.side - 1) / cells.side; };
  while (std::size_t(across(image.width())) * std::size_t(across(image.height())) > kMostCells)
    ++cells.side;
  cells.width = across(image.width());
  cells.height = across(image.height());
  cells.values.resize(std::size_t(cells.width) * std::size_t(cells.height));
  oneapi::tbb::parallel_for(0, cells.height, [&](int row) {
    for (int y = row * cells.side; y < std::min(image.height(), (row + 1) * cells.side); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        const std::size_t pixel = std::size_t(y) * std::size_t(image.width()) + std::size_t(x);
        if (!where.empty() && where[pixel] == 0) continue;
        float& cell = cells.values[cells.index(x / cells.side, row)];
        cell = std::max(cell, float(radiance_at(image, pixel)));
      }
      looked_at(3 * sizeof(float) * std::size_t(image.width()));
    }
  });
  return cells;
}

template <class Visit>
void for_cells_around(const Cells& cells, std::size_t cell, Visit visit) {
  const int x = int(cell % std::size_t(cells.width)), y = int(cell / std::size_t(cells.width));
  for (int j = std::max(0, y - 1); j <= std::min(cells.height - 1, y + 1); ++j)
    for (int i = std::max(0, x - 1); i <= std::min(cells.width - 1, x + 1); ++i)
      if (i != x || j != y) visit(cells.index(i, j));
}

/// A maximum, and how its surroundings fall.
struct Maximum {
  std::uint32_t cell = 0;
  std::uint32_t area = 0;
  float top = 0;
  float end = 0;  ///< the level at which it meets a higher maximum, or the lowest one
  std::uint32_t scales = 0;
  std::array<float, kAreas> level{};  ///< at which it has 1, 2, 4, ... cells
};

/// All maxima, the highest first. A union-find over the cells from the brightest down: where two maxima meet, the lower
/// one ends.
std::vector<Maximum> maxima_of(const Cells& cells, float least) {
  std::vector<std::uint64_t> order;
  for (std::size_t i = 0; i < cells.values.size(); ++i)
    if (cells.values[i] > least)
      order.push_back(std::uint64_t{std::bit_cast<std::uint32_t>(cells.values[i])} << 32 |
                      (~std::uint32_t{0} - std::uint32_t(i)));
  oneapi::tbb::parallel_sort(order.begin(), order.end(), std::greater<>());
  std::vector<std::uint32_t> of_cell(cells.values.size(), kNone);
  std::vector<Maximum> maxima;
  std::vector<std::uint32_t> joined;  // the maximum that took this one in, or itself
  const auto root = [&](std::uint32_t maximum) {
    while (joined[maximum] != maximum) maximum = joined[maximum] = joined[joined[maximum]];
    return maximum;
  };
  for (const std::uint64_t key : order) {
    const std::uint32_t cell = ~std::uint32_t{0} - std::uint32_t(key);
    const float value = cells.values[cell];
    std::uint32_t highest = kNone;
    std::array<std::uint32_t, 8> around;
    std::size_t count = 0;
    for_cells_around(cells, cell, [&](std::size_t neighbour) {
      if (of_cell[neighbour] == kNone) return;
      around[count] = root(of_cell[neighbour]);
      highest = std::min(highest, around[count++]);
    });
    if (highest == kNone) {
      highest = std::uint32_t(maxima.size());
      maxima.push_back({.cell = cell, .top = value});
      joined.push_back(highest);
    }
    of_cell[cell] = highest;
    Maximum& taking = maxima[highest];
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t other = root(around[i]);
      if (other == highest) continue;
      maxima[other].end = value;
      joined[other] = highest;
      taking.area += maxima[other].area;
    }
    ++taking.area;
    while (taking.scales < kAreas && taking.area >> taking.scales != 0)
      taking.level[taking.scales++] = value;
  }
  // A maximum that meets no higher one ends at 0, or at the picture's darkest value if it covers the picture.
  for (std::uint32_t i = 0; i < maxima.size(); ++i)
    if (joined[i] == i)
      maxima[i].end =
          maxima[i].area == cells.values.size() ? *std::ranges::min_element(cells.values) : 0;
  return maxima;
}

/// A level from which a maximum stands out.
struct Standout {
  std::uint32_t cell = 0;
  double top = 0, base = 0;
  double light = 0;  ///< about its height times the cells of its core
};

void add_standouts(const Maximum& maximum, float least, std::vector<Standout>& standouts) {
  const auto level = [&](std::size_t scale) {
    return double(scale < maximum.scales ? maximum.level[scale] : maximum.end);
  };
  double top = double(maximum.top);
  std::size_t scale = 1, found = 0, start = 0;
  for (; found < kMostBases && top > double(least); ++scale) {
    while (scale < maximum.scales &&
           !(level(scale) - level(scale + 2) < kPlateau * (top - level(scale))))
      ++scale;
    const bool ends = scale >= maximum.scales;
    const double base = ends ? double(maximum.end) : level(scale + 1);
    if (top - base >= kLeastHeight * top) {
      std::size_t core = 0;
      while (core + 1 < maximum.scales && level(core + 1) >= (top + base) / 2) ++core;
      // The tail of the highlight above falls at once; a broader highlight does not.
      if (found == 0 || core > start) {
        standouts.push_back({maximum.cell, top, base, std::ldexp(top - base, int(core))});
        ++found;
      }
      top = base;
      start = scale + 1;
    }
    if (ends) return;
  }
}

/// Floods regions one after the other without clearing the picture each time.
class Flood {
 public:
  explicit Flood(const Cells& cells) : cells_(cells), seen_(cells.values.size(), 0) {}

  /// The cells of at least `level` that connect to `start`. Valid until the next call.
  const std::vector<std::uint32_t>& above(std::uint32_t start, double level) {
    ++round_;
    region_.assign(1, start);
    seen_[start] = round_;
    for (std::size_t next = 0; next < region_.size(); ++next)
      for_cells_around(cells_, region_[next], [&](std::size_t cell) {
        if (seen_[cell] == round_ || !(double(cells_.values[cell]) >= level)) return;
        seen_[cell] = round_;
        region_.push_back(std::uint32_t(cell));
      });
    visits_ += region_.size();
    return region_;
  }
  bool has_worked_enough() const { return visits_ > kMostVisits * cells_.values.size(); }

 private:
  const Cells& cells_;
  std::vector<std::uint32_t> seen_, region_;
  std::uint32_t round_ = 0;
  std::size_t visits_ = 0;
};

/// The pixels of these cells of at least `level`, and of `where`.
std::vector<PixelRun> runs_of(const Image& image, std::span<const std::uint8_t> where,
                              const Cells& cells, std::span<const std::uint32_t> of, double level) {
  std::vector<PixelRun> runs;
  for (std::size_t i = 0; i < of.size();) {
    // Cells side by side have rows in common.
    std::size_t end = i + 1;
    const std::uint32_t row = of[i] / std::uint32_t(cells.width);
    while (end < of.size() && of[end] == of[end - 1] + 1 &&
           of[end] / std::uint32_t(cells.width) == row)
      ++end;
    const int from = int(of[i] % std::uint32_t(cells.width)) * cells.side;
    const int to = std::min(image.width(), from + int(end - i) * cells.side);
    for (int y = int(row) * cells.side; y < std::min(image.height(), (int(row) + 1) * cells.side);
         ++y) {
      bool inside = false;
      for (int x = from; x < to; ++x) {
        const std::size_t pixel = std::size_t(y) * std::size_t(image.width()) + std::size_t(x);
        const bool is = double(float(radiance_at(image, pixel))) >= level &&
                        (where.empty() || where[pixel] != 0);
        if (is && !inside) runs.push_back({y, x, x});
        if (is) runs.back().end = x + 1;
        inside = is;
      }
    }
    i = end;
  }
  return runs;
}

/// Sums of the reference that errors are divided by, and the centre.
void add_sums(const Image& image, LocalHighlight& highlight) {
  // Judged by its height alone, a shallow highlight would differ where its surroundings hardly do.
  constexpr double kLeastShare = 0.4;
  double light = 0, all = 0, x = 0, y = 0, carried = 0;
  highlight.count = 0;
  highlight.peak = 0;
  for_pixels(highlight.pixels, image.width(), [&](std::size_t pixel, int column, int row) {
    const double radiance = radiance_at(image, pixel), over = radiance - highlight.skirt;
    if (radiance > highlight.peak) {
      highlight.peak = radiance;
      highlight.x = column;
      highlight.y = row;
    }
    ++highlight.count;
    all += radiance;
    light += over;
    carried += std::max(0.0, radiance - std::max(highlight.top, highlight.skirt));
    x += over * column;
    y += over * row;
  });
  // One whose light is mostly that of a narrower highlight would be judged by that.
  if (!(carried <= light / 2) || !(light > 0)) return;
  highlight.centre_x = x / light;
  highlight.centre_y = y / light;
  highlight.light = std::max(light, kLeastShare * all);
  double spread = 0, all_spread = 0;
  for_pixels(highlight.pixels, image.width(), [&](std::size_t pixel, int column, int row) {
    const double away = squared_distance(highlight, column, row);
    const double radiance = radiance_at(image, pixel);
    spread += away * (radiance - highlight.skirt);
    all_spread += away * radiance;
  });
  highlight.spread = std::max(spread, kLeastShare * all_spread);
  double core = 0, over_base = 0;
  std::array<double, 3> channels{};
  for_pixels(highlight.core, image.width(), [&](std::size_t pixel, int, int) {
    const double radiance = radiance_at(image, pixel);
    core += radiance;
    over_base += radiance - highlight.base;
    for (std::size_t c = 0; c < 3; ++c) channels[c] += double(image.values()[3 * pixel + c]);
  });
  // An error counts in the channel where it is largest. The brightest channel of a coloured light exceeds the mean by the
  // same factor in the core and over the base.
  highlight.energy = std::max(over_base, kLeastShare * core) * (std::ranges::max(channels) / core);
}

/// Those around a highlight that have its base's light.
void add_ring(const Image& image, LocalHighlight& highlight) {
  constexpr double kNear = 0.25;
  for_pixels_around(image, highlight, [&](std::size_t pixel, int, int) {
    const double radiance = radiance_at(image, pixel);
    if (radiance < highlight.skirt &&
        std::abs(radiance - highlight.base) <= kNear * highlight.height())
      highlight.ring.push_back(std::uint32_t(pixel));
  });
}

}  // namespace

std::vector<LocalHighlight> find_highlights(const Image& reference,
                                            std::span<const std::uint8_t> where,
                                            const HighlightNoise& noise) {
  const Cells cells = cells_of(reference, where);
  const double peak = double(std::ranges::max(cells.values));
  const auto least =
      float(std::max(kDimmestShown * std::min(1.0, peak), kDimmestBesideALight * peak));
  if (!(least > 0)) return {};
  std::vector<Standout> standouts;
  for (const Maximum& maximum : maxima_of(cells, float(kSkirt / 2) * least))
    add_standouts(maximum, least, standouts);
  std::ranges::stable_sort(standouts, std::ranges::greater{}, &Standout::light);
  if (standouts.size() > kMostLookedAt) standouts.resize(kMostLookedAt);

  std::vector<LocalHighlight> highlights;
  Flood flood(cells);
  for (const Standout& standout : standouts) {
    if (highlights.size() == kMostHighlights || flood.has_worked_enough()) break;
    LocalHighlight highlight;
    highlight.top = standout.top;
    highlight.base = standout.base;
    const double height = standout.top - standout.base;
    highlight.skirt = standout.base + kSkirt * height;
    std::vector<std::uint32_t> region = flood.above(standout.cell, highlight.skirt);
    std::ranges::sort(region);
    highlight.pixels = runs_of(reference, where, cells, region, highlight.skirt);
    highlight.core = runs_of(reference, where, cells, region, standout.base + height / 2);
    add_sums(reference, highlight);
    if (highlight.count < kFewestPixelsOfOne || !(highlight.light > 0) || !(highlight.energy > 0))
      continue;
    add_ring(reference, highlight);
    if (add_slack(reference, noise, peak, highlight)) highlights.push_back(std::move(highlight));
  }
  return highlights;
}

}  // namespace lobelia
