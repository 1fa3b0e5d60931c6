#include "program/command/gallery/publish.hpp"

#include <algorithm>

#include "base/system/standard_streams.hpp"
#include "base/words/text.hpp"
#include "compare/highlight_region.hpp"
#include "compare/maps/difference_map.hpp"
#include "compare/metrics/catalogue.hpp"
#include "reference_scenes/engines/analytic/formulas/evaluation.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia::cli {
namespace {

std::vector<gallery::MapKind> gallery_maps() {
  std::vector<gallery::MapKind> kinds;
  for (const DifferenceMap& map : difference_maps()) {
    if (!map.in_gallery) continue;
    kinds.push_back({std::string(map.id), std::string(map.unit), std::string(map.meaning),
                     [&map](const Image& a, const Image& b, const gallery::MapViewing& viewing) {
                       const PixelValues values = measure_difference_map(
                           map, a, b, {viewing.exposure_stops, viewing.pixels_per_degree});
                       return std::vector<float>(values.begin(), values.end());
                     },
                     map.scale == MapScale::kOne ? 1.0 : 10.0});
  }
  return kinds;
}

std::vector<gallery::MetricInfo> metric_infos() {
  std::vector<gallery::MetricInfo> infos;
  for (const Metric* metric : metrics())
    for (const MetricOutput& output : metric->outputs) {
      if (output.title.empty() || metric->on_request) continue;
      infos.push_back({std::string(output.id), std::string(output.title),
                       std::string(output.explanation), std::string(unit_name(output.unit)),
                       output.better == Better::kHigher});
      if (!metric->in_regions) continue;
      for (const auto& [region, where] : {std::pair(Region::kHighlight, "of the highlight"),
                                          {Region::kMask, "in the mask"},
                                          {Region::kOutside, "outside of the mask"}}) {
        gallery::MetricInfo info = infos.back();
        info.id = id_in_region(*metric, output, region);
        info.title = fmt::format("{}, {}", output.title, where);
        info.meaning.clear();
        infos.push_back(std::move(info));
      }
    }
  return infos;
}

PixelFlags surface_of(const std::filesystem::path& file, int width, int height) {
  Scene scene = read_scene(file);
  scene.film.width = width;
  scene.film.height = height;
  return truth::surface_mask(scene);
}

}  // namespace

gallery::GalleryOptions gallery_options() {
  gallery::GalleryOptions options;
  options.maps = gallery_maps();
  options.metrics = metric_infos();
  options.region = [](const Image& a, const Image& b) { return highlight_region(a, b, {}); };
  options.surface = surface_of;
  return options;
}

gallery::PublishedGallery publish(const std::filesystem::path& run, gallery::GalleryOptions options,
                                  WriteSite& write) {
  gallery::GalleryOptions known = gallery_options();
  options.maps = std::move(known.maps);
  options.metrics = std::move(known.metrics);
  options.region = std::move(known.region);
  options.surface = std::move(known.surface);
  gallery::PublishedGallery made = write(run, options);
  constexpr std::size_t kMostNamed = 20;
  const std::size_t count = made.doubts.size();
  for (std::size_t i = 0; i < std::min(count, kMostNamed); ++i)
    say("lobelia: gallery: {}\n", printable(made.doubts[i], 400));
  if (count > 0)
    say("lobelia: gallery: {} of {} cells {} not what the farm wrote{}\n", count, made.cells,
        count == 1 ? "is" : "are",
        count > kMostNamed ? fmt::format("; {} are named here", kMostNamed) : "");
  constexpr std::size_t kMostWorse = 3;
  std::string worse;
  for (std::size_t i = 0; i < std::min(made.worse.size(), kMostWorse); ++i)
    worse += (i > 0 ? "; " : "") + printable(made.worse[i], 200);
  if (!made.worse.empty())
    say("lobelia: gallery: {} of {} cells {} worse than in the baseline: {}{}\n", made.worse.size(),
        made.cells, made.worse.size() == 1 ? "is" : "are", worse,
        made.worse.size() > kMostWorse ? "; …" : "");
  return made;
}

ExitCode publish_if_wanted(const std::filesystem::path& run, const std::filesystem::path& site) {
  if (site.empty()) return ExitCode::kSuccess;
  gallery::GalleryOptions options;
  options.site = site;
  const gallery::PublishedGallery made = publish(run, options);
  say("lobelia: gallery: {}\n", printable_path(made.index.string()));
  return made.doubts.empty() ? ExitCode::kSuccess : ExitCode::kDiffers;
}

}  // namespace lobelia::cli
