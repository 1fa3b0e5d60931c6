// The averages of average_small_highlights(): each pixel is divided in four, and each part again, until a part's sum is
// that of its quarters. Around the middle of a highlight parts are divided until they are as narrow as it.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "renderer/small_highlights.hpp"
#include "renderer/waves/waves.hpp"

namespace lobelia {
namespace {

/// Gauss and Legendre's rule of 4 points in [0, 1].
constexpr std::array<double, 4> kNodes{0.06943184420297371, 0.33000947820757187, 0.6699905217924281,
                                       0.9305681557970262},
    kWeights{0.17392742256872692, 0.32607257743127307, 0.32607257743127307, 0.17392742256872692};
/// A part agrees with its quarters within this share of the brightest pixel.
constexpr double kAgrees = 1e-5;
/// Parts that hold no highlight's middle are not divided further: an edge goes through them.
constexpr int kMostLevels = 6, kMostLevelsNear = 48;
/// In widths of the highlight.
constexpr double kNear = 8;
/// Rings of pixels around a highlight that are averaged. An edge through a pixel beyond the first few stays as it is.
constexpr int kFewestRings = 2, kMostRings = 64;
/// A ring of pixels that changes by no more than this share of the brightest one is the last.
constexpr double kUnchanged = 3e-6;

struct Part {
  std::size_t pixel = 0;
  double x = 0, y = 0, side = 1;  ///< its upper left corner on the film
  int level = 0;
  Rgb sum;  ///< the integral over it
};

double brightness(Rgb c) { return std::max({std::abs(c.r), std::abs(c.g), std::abs(c.b)}); }

Rgb difference(Rgb a, Rgb b) { return {a.r - b.r, a.g - b.g, a.b - b.b}; }

class Averager {
 public:
  Averager(const Scene& scene, const Plan& plan, std::vector<SmallHighlight> highlights)
      : film_(scene.film), prepared_(scene, plan), highlights_(std::move(highlights)) {}

  std::vector<AveragedPixel> run(Work& work) {
    for (const SmallHighlight& highlight : highlights_) average_around(highlight);
    Work& done = workspace_.work;
    work.of<effects::Antialiasing>() +=
        done.camera_rays + done.shadow_rays + done.mirror_rays + done.scattered_rays;
    done.camera_rays = done.shadow_rays = done.mirror_rays = done.scattered_rays = 0;
    work += done;
    std::vector<AveragedPixel> all;
    for (const auto& [at, mean] : means_)
      all.push_back({int(at % std::size_t(film_.width)), int(at / std::size_t(film_.width)), mean});
    return all;
  }

 private:
  /// The rays through places of the film.
  std::vector<SampleResult> at(const std::vector<std::array<double, 2>>& places) {
    std::vector<SampleResult> all;
    all.reserve(places.size());
    std::vector<PixelSample> samples;
    std::vector<SampleResult> results(kChunk);
    for (std::size_t begin = 0; begin < places.size(); begin += kChunk) {
      samples.clear();
      for (std::size_t i = begin; i < std::min(places.size(), begin + kChunk); ++i) {
        const int x = std::clamp(int(std::floor(places[i][0])), 0, film_.width - 1),
                  y = std::clamp(int(std::floor(places[i][1])), 0, film_.height - 1);
        samples.push_back({x, y, 0, places[i][0] - (x + 0.5), places[i][1] - (y + 0.5)});
      }
      waves::render(prepared_, samples, std::span(results).first(samples.size()), workspace_);
      all.insert(all.end(), results.begin(), results.begin() + std::ptrdiff_t(samples.size()));
    }
    return all;
  }

  void integrate(std::vector<Part>& parts) {
    std::vector<std::array<double, 2>> places;
    for (const Part& part : parts)
      for (const double v : kNodes)
        for (const double u : kNodes)
          places.push_back({part.x + part.side * u, part.y + part.side * v});
    const std::vector<SampleResult> rays = at(places);
    std::size_t i = 0;
    for (Part& part : parts)
      for (const double wv : kWeights)
        for (const double wu : kWeights) {
          const SampleResult& ray = rays[i++];
          part.sum = part.sum + wu * wv * part.side * part.side * ray.radiance;
          if (ray.surface != surface_of_[part.pixel]) has_edge_[part.pixel] = true;
        }
  }

  /// The distance of a highlight's middle from a part, 0 inside, in the larger of x and y.
  static double distance(const SmallHighlight& highlight, const Part& part) {
    return std::max({part.x - highlight.x, highlight.x - part.x - part.side, part.y - highlight.y,
                     highlight.y - part.y - part.side, 0.0});
  }
  bool is_to_be_divided(const Part& part) const {
    return std::ranges::any_of(highlights_, [&](const SmallHighlight& highlight) {
      return part.side > highlight.width && distance(highlight, part) < part.side;
    });
  }
  int most_levels(const Part& part) const {
    return std::ranges::any_of(highlights_,
                               [&](const SmallHighlight& highlight) {
                                 return distance(highlight, part) < kNear * highlight.width;
                               })
               ? kMostLevelsNear
               : kMostLevels;
  }

  /// The means over some pixels, whose centres see `surface_of_`.
  std::vector<Rgb> means_of(const std::vector<std::size_t>& pixels) {
    std::vector<Rgb> means(pixels.size());
    has_edge_.assign(pixels.size(), false);
    std::vector<Part> parts;
    for (std::size_t i = 0; i < pixels.size(); ++i)
      parts.push_back({i,
                       double(pixels[i] % std::size_t(film_.width)),
                       double(pixels[i] / std::size_t(film_.width)),
                       1,
                       0,
                       {}});
    integrate(parts);
    while (!parts.empty()) {
      std::vector<Part> quarters;
      for (const Part& part : parts)
        for (const int i : {0, 1, 2, 3}) {
          const double side = part.side / 2;
          quarters.push_back({part.pixel,
                              part.x + (i % 2) * side,
                              part.y + (i / 2) * side,
                              side,
                              part.level + 1,
                              {}});
        }
      integrate(quarters);
      std::vector<Part> divided;
      for (std::size_t k = 0; k < parts.size(); ++k) {
        const std::span four = std::span(quarters).subspan(4 * k, 4);
        Rgb sum{};
        for (const Part& quarter : four) sum = sum + quarter.sum;
        brightest_ = std::max(brightest_, brightness(sum));
        if ((brightness(difference(sum, parts[k].sum)) <= kAgrees * brightest_ &&
             !is_to_be_divided(parts[k])) ||
            parts[k].level >= most_levels(parts[k]))
          means[parts[k].pixel] = means[parts[k].pixel] + sum;
        else
          divided.insert(divided.end(), four.begin(), four.end());
      }
      parts = std::move(divided);
    }
    return means;
  }

  void average_around(const SmallHighlight& highlight) {
    const int x = int(std::floor(highlight.x)), y = int(std::floor(highlight.y));
    brightest_ = 0;
    const int most = std::min(
        kMostRings, kFewestRings + int(std::ceil(kNear * std::min(highlight.length, 1e3))));
    for (int ring = 0; ring <= most; ++ring) {
      std::vector<std::size_t> pixels;
      std::vector<std::array<double, 2>> centres;
      for (int j = std::max(0, y - ring); j <= std::min(film_.height - 1, y + ring); ++j)
        for (int i = std::max(0, x - ring); i <= std::min(film_.width - 1, x + ring); ++i) {
          const std::size_t pixel = std::size_t(j) * std::size_t(film_.width) + std::size_t(i);
          if (std::max(std::abs(i - x), std::abs(j - y)) != ring || means_.contains(pixel))
            continue;
          pixels.push_back(pixel);
          centres.push_back({i + 0.5, j + 0.5});
        }
      const std::vector<SampleResult> by_centre = at(centres);
      surface_of_.clear();
      for (const SampleResult& ray : by_centre) surface_of_.push_back(ray.surface);
      const std::vector<Rgb> means = means_of(pixels);
      double changed = 0;
      for (std::size_t i = 0; i < pixels.size(); ++i) {
        if (has_edge_[i] && ring > kFewestRings) continue;
        changed = std::max(changed, brightness(difference(means[i], by_centre[i].radiance)));
        means_.emplace(pixels[i], means[i]);
      }
      if (ring >= kFewestRings && changed <= kUnchanged * brightest_) return;
    }
  }

  const Film& film_;
  waves::PreparedScene prepared_;
  std::vector<SmallHighlight> highlights_;
  waves::Workspace workspace_;
  std::map<std::size_t, Rgb> means_;  ///< by pixel, in reading order
  std::vector<int> surface_of_;       ///< of the pixels that are averaged, by their centres
  std::vector<bool> has_edge_;        ///< whether other rays meet another one
  double brightest_ = 0;              ///< of the parts of pixels so far
};

}  // namespace

std::vector<AveragedPixel> average_small_highlights(const Scene& scene, const Plan& plan,
                                                    Work& work) {
  std::vector<SmallHighlight> highlights = find_small_highlights(scene);
  if (highlights.empty()) return {};
  return Averager(scene, plan, std::move(highlights)).run(work);
}

}  // namespace lobelia
