#include "farm/finish_cell.hpp"

#include "compare/compare.hpp"
#include "core/colour.hpp"
#include "core/error.hpp"
#include "core/image_io.hpp"
#include "farm/agreement.hpp"
#include "farm/profile_scene.hpp"
#include "reference_scenes/engine.hpp"
#include "renderer/pixel_ray.hpp"
#include "renderer/render_error.hpp"
#include "renderer/render_record.hpp"
#include "verify/truth/evaluation.hpp"

namespace lobelia {
namespace {

Json image_entry(const std::string& engine) {
  return {{"engine", engine},
          {"exr", engine + ".exr"},
          {"png", engine + ".png"},
          {"record", engine + ".json"}};
}

Image read_or_discard(const CellStore& store, const std::string& engine) {
  try {
    return read_image(store.file(engine + ".exr"));
  } catch (const Error&) {
    store.discard_image(engine);
    throw;
  }
}

/// Whether the errors of a picture that is an average lie beside it.
bool has_error(const CellStore& store, const std::string& engine) {
  std::error_code ignored;
  return std::filesystem::exists(store.file(error_file(engine)), ignored);
}

/// Ours are of samples that each pixel has for itself, an engine's of points that all pixels share.
NoiseOptions noise_of(const CellStore& store, const std::string& engine) {
  const auto noise = [&](const std::string& name, int freedom, bool shared) {
    return noise_of_standard_errors(read_image(store.file(error_file(name))), freedom, shared);
  };
  return {.a = noise(kOurs, kErrorFreedom, false), .b = noise(engine, kReplicates - 1, true)};
}

/// Writes the comparison with one reference; returns its entry in cell.json and its verdict. Where `noisy`, the
/// tolerance is what rounding may do, and the usual limits say how fine the answer has to be.
std::pair<Json, Verdict> compare_with(const CellStore& store, const std::string& engine,
                                      const Image& ours, const Image& reference, double exposure,
                                      const std::vector<std::uint8_t>& edges, bool noisy) {
  ComparisonOptions options;
  options.viewing.exposure_stops = exposure;
  options.tolerance = agreement(engine, edges);
  if (noisy) {
    options.limits.assign(default_limits().begin(), default_limits().end());
    options.noise = noise_of(store, engine);
  }
  const Comparison comparison = compare(ours, reference, options);

  const std::string name = std::string(kOurs) + "-" + engine;
  // White is what the tolerance allows at the brightest place, and a tenth of the peak where there is noise.
  const double relative = noisy ? 0.1 : options.tolerance->relative + options.tolerance->of_peak;
  const double white_at = relative * brightest(reference);
  write_png(store.file(name + ".png"), difference_picture(ours, reference, white_at));
  write_record(store.file(name + ".json"),
               comparison_record(comparison, std::string(kOurs) + ".exr", engine + ".exr"));
  return {{{"a", kOurs},
           {"b", engine},
           {"record", name + ".json"},
           {"png", name + ".png"},
           {"difference", {{"whiteAt", white_at}, {"relativeToPeak", relative}}}},
          comparison.verdict};
}

}  // namespace

std::string finish_cell(const CellStore& store, const std::vector<std::string>& references,
                        std::vector<CellProblem> not_comparable, std::vector<CellProblem>& problems,
                        const Json& inputs) {
  const Cell& cell = store.cell();
  std::vector<std::pair<std::string, Image>> pictures;
  pictures.emplace_back(kOurs, read_or_discard(store, kOurs));
  for (const auto& engine : references) {
    try {
      pictures.emplace_back(engine, read_or_discard(store, engine));
    } catch (const Error& error) {
      problems.push_back({engine, error.what()});
    }
  }
  const Image& ours = pictures.front().second;
  const double exposure = cell_exposure(ours);
  // A tolerance for each pixel is one of pictures without noise.
  const bool exact = truth::why_not_evaluated(store.scene()).empty();
  const auto is_judged = [&](const std::string& engine) {
    return engine != kOurs && (exact || (has_error(store, kOurs) && has_error(store, engine)));
  };
  bool judged = false;
  for (std::size_t i = 1; i < pictures.size(); ++i) {
    const std::string& engine = pictures[i].first;
    if (is_judged(engine))
      judged = true;
    else
      not_comparable.push_back(
          {engine,
           "its picture may have noise that is not known, and no tolerance of single pixels "
           "judges that"});
  }
  const auto edges =
      exact && pictures.size() > 1 ? truth::edge_ring(store.scene()) : std::vector<std::uint8_t>();

  Json record = make_record("cell");
  record["id"] = cell.id;
  record["axes"] = Json::object();
  for (const auto& [name, value] : cell.axes) record["axes"][name] = value;
  std::string status = !problems.empty() ? "failed" : judged ? "pass" : "unchecked";
  record["status"] = status;  // keeps its place near the top
  if (!store.scene().spheres.empty())
    record["highlight"] = highlight_record(
        store.scene().materials.at(std::size_t(store.scene().spheres.front().material)).highlight);
  record["exposureStops"] = exposure;
  record["images"] = Json::array();
  record["comparisons"] = Json::array();
  for (const auto& [engine, image] : pictures) {
    write_png(store.file(engine + ".png"), to_display(image, exposure));
    record["images"].push_back(image_entry(engine));
    if (!is_judged(engine)) continue;
    const auto [entry, verdict] = compare_with(store, engine, ours, image, exposure, edges, !exact);
    record["comparisons"].push_back(entry);
    if (is_pass(verdict) || status == "failed" || status == "differs") continue;
    status = verdict == Verdict::kUndecided ? "undecided" : "differs";
  }
  if (!store.scene().lights.empty() && !store.scene().spheres.empty() &&
      beyond_single_rays(store.scene()).empty()) {
    NamedImages named;
    // The profile draws the formula under that name already.
    for (const auto& [engine, image] : pictures)
      if (engine != kAnalyticName) named.emplace_back(engine, &image);
    write_record(store.file("profile.json"), profile_scene(store.scene(), 0, 0, named));
    record["profile"] = "profile.json";
  }
  record["notComparable"] = Json::array();
  for (const auto& one : not_comparable)
    record["notComparable"].push_back({{"engine", one.engine}, {"because", one.message}});
  record["problems"] = Json::array();
  for (const auto& problem : problems)
    record["problems"].push_back({{"engine", problem.engine}, {"message", problem.message}});
  record["status"] = status;
  record["inputs"] = inputs;
  write_record(store.file("cell.json"), record);
  return status;
}

}  // namespace lobelia
