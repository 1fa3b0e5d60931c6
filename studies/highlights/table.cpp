#include "studies/highlights/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compare/compare.hpp"
#include "studies/table.hpp"

namespace lobelia::highlights {
namespace {

constexpr int kWidth = 208, kHeight = 160;

/// A highlight on what is around it. Lengths in pixels.
struct MadeScene {
  const char* name;
  double light_x, light_y;  ///< the middle of the light, 3 x 3 pixels
  double x, y, peak, major, minor, tilt;
  bool ggx;
  double base, sphere;  ///< the surroundings, and the middle of a lit sphere around the highlight
};

constexpr MadeScene kScenes[] = {
    {"narrow, on black", 20, 20, 120.3, 90.7, 2, 2.5, 2.5, 0, false, 0, 0},
    {"broad, on black", 20, 20, 120.3, 90.7, 2, 28, 28, 0, false, 0, 0},
    {"long tails, on grey", 190, 20, 100.5, 80.2, 1, 9, 9, 0, true, 0.2, 0},
    {"elongated", 20, 140, 110.4, 70.6, 0.5, 24, 5, 0.6, false, 0.05, 0},
    {"on a lit sphere", 20, 20, 120.3, 90.7, 2.9, 3.2, 3.2, 0, false, 0.18, 0.5},
    {"beside the light", 112, 82, 126.3, 90.7, 2, 4, 4, 0, false, 0.1, 0},
    {"faint", 150, 30, 80.6, 100.4, 0.05, 6, 6, 0, true, 0.01, 0},
};

double lobe_at(const MadeScene& scene, double x, double y) {
  const double c = std::cos(scene.tilt), s = std::sin(scene.tilt), dx = x - scene.x,
               dy = y - scene.y;
  const double along = (c * dx + s * dy) / scene.major, across = (c * dy - s * dx) / scene.minor;
  const double q = along * along + across * across;
  return scene.peak * (scene.ggx ? std::pow(1 + (std::numbers::sqrt2 - 1) * q, -2) : std::exp2(-q));
}

/// The highlight times `kept` and moved to the right.
Image picture_of(const MadeScene& scene, double light, double kept, double moved) {
  constexpr double kSphere = 50, kHalfALight = 1.5;
  Image image(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double away = std::hypot(x - scene.x, y - scene.y) / kSphere;
      double radiance = scene.base + scene.sphere * std::sqrt(std::max(0.0, 1 - away * away)) +
                        kept * lobe_at(scene, x - moved, y);
      if (std::abs(x - scene.light_x) < kHalfALight && std::abs(y - scene.light_y) < kHalfALight)
        radiance = light * scene.peak;
      std::ranges::fill(image.pixel(x, y), float(radiance));
    }
  return image;
}

Image in_half_floats(Image image) {
  constexpr double kSteps = 2048;
  for (float& value : image.values()) {
    int exponent = 0;
    const double fraction = std::frexp(double(value), &exponent);
    value = float(std::ldexp(std::nearbyint(fraction * kSteps) / kSteps, exponent));
  }
  return image;
}

bool differ(const Image& a, const Image& b) {
  return !is_pass(compare(a, b, usual_options()).verdict);
}

/// How much of the highlight a and the reference have, and how far it moved in a.
struct Change {
  const char* name;
  double kept, moved, in_reference;
};
constexpr Change kChanges[] = {{"5 % dimmer", 0.95, 0, 1},
                               {"30 % dimmer", 0.7, 0, 1},
                               {"moved 4 px", 1, 4, 1},
                               {"gone", 0, 0, 1},
                               {"only in a", 1, 0, 0}};

}  // namespace

records::VerifyHighlights measure_table(const std::function<void(double)>& on_progress) {
  records::VerifyHighlights measured;
  const double all = double(std::size(kScenes) * std::size(kLights));
  double done = 0;
  for (const MadeScene& scene : kScenes) {
    const std::size_t first = measured.changes.size();
    for (const Change& change : kChanges)
      measured.changes.push_back({scene.name, change.name, true, {}});
    measured.changes.push_back({scene.name, "in half floats", false, {}});
    for (const double light : kLights) {
      const auto add = [&](std::size_t i, const Image& a, const Image& b) {
        records::ChangedHighlight& change = measured.changes[first + i];
        const bool differs = differ(a, b), is_right = differs == change.should_differ;
        change.lights.push_back({light, differs, is_right});
        measured.wrong += !is_right;
      };
      const Image reference = picture_of(scene, light, 1, 0);
      for (std::size_t i = 0; i < std::size(kChanges); ++i) {
        const Change& change = kChanges[i];
        add(i, picture_of(scene, light, change.kept, change.moved),
            picture_of(scene, light, change.in_reference, 0));
      }
      add(std::size(kChanges), in_half_floats(reference), reference);
      on_progress(++done / all);
    }
  }
  return measured;
}

std::string table_text(const records::VerifyHighlights& measured) {
  studies::Table table;
  table.columns = {{"highlight", -22, "{}", 2}, {"change", -18}};
  for (const double light : kLights) table.columns.push_back({fmt::format("{}", light), 9});
  for (const records::ChangedHighlight& change : measured.changes) {
    std::vector<studies::Cell> cells{change.highlight, change.change};
    for (const records::LightBeside& light : change.lights)
      cells.push_back(light.is_right  ? (light.differs ? "found" : "pass")
                      : light.differs ? "FALSE"
                                      : "MISSED");
    table.rows.push_back(std::move(cells));
  }
  return "The highlight beside a light of so many times its peak:\n\n" +
         studies::table_text(std::move(table)) +
         (measured.wrong == 0 ? "\nNothing is missed, and rounding is no difference.\n"
                              : fmt::format("\n{} cells are wrong.\n", measured.wrong));
}

}  // namespace lobelia::highlights
