#include "cli/compare_pictures.hpp"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <mutex>
#include <utility>

#include "compare/highlight_region.hpp"
#include "compare/metrics/catalogue.hpp"
#include "compare/require_same_size.hpp"
#include "core/files.hpp"
#include "core/image_io.hpp"
#include "core/image_values.hpp"
#include "core/standard_streams.hpp"
#include "core/text.hpp"

namespace lobelia::cli {
namespace {

namespace fs = std::filesystem;

bool has_automatic_exposures(const ComparisonOptions& options) {
  return options.viewing.hdr_exposures && options.viewing.hdr_exposures->automatic;
}

/// `options.layer`; if all layers are asked for and a file has no picture, the first layer that both have.
std::string main_layer(const std::string& a, const std::string& b, const LayerOptions& options) {
  if (!options.all || !options.layer.empty()) return options.layer;
  return common_layers(a, b).both.front();
}

/// `asked` with the exposures that suit `reference`, or with the reason why there are none.
HdrExposures exposures_or_why_not(const Image& reference, HdrExposures asked) {
  try {
    return automatic_exposures(reference, asked);
  } catch (const Error& error) {
    asked.problem = error.what();
    return asked;
  }
}

/// The options with the exposures of this pair, for another one.
ComparisonOptions at_exposures_of(const Image& a, const Image& b, ComparisonOptions options) {
  options.viewing = with_exposures(options.viewing, a, b);
  options.viewing.automatic = false;
  return options;
}

/// With `equal_allowed`, values that are not finite in both references are no difference.
ReferenceFloor floor_of(const PairReport& pair, const std::string& layer, Image& b,
                        bool equal_allowed, const ComparisonOptions& options) {
  Image c = read_picture(pair.c, layer).image;
  if (!options.crop) require_same_size(c, b, pair.c, pair.b);
  take_part(c, b, options);
  if (!equal_allowed || is_finite(b)) return measure_reference_floor(c, b, options);
  Image cleared = b;
  clear_equal_nonfinite(c, cleared);
  return measure_reference_floor(c, cleared, options);
}

/// Calls difference(a, b, comparison) once the pair is compared.
template <class Difference>
PairReport compare_pair(PairReport pair, const CompareJob& job, const Pairing& pairing,
                        ComparisonOptions options, bool choose_exposures, Difference difference) {
  const auto started = std::chrono::steady_clock::now();
  PicturePair pictures = read_compared(pair, job, pairing, options);
  Image &a = pictures.a.image, &b = pictures.b.image;
  pair.sources = {pictures.a.source, pictures.b.source};
  if (choose_exposures)
    options.viewing.hdr_exposures = exposures_or_why_not(b, *options.viewing.hdr_exposures);
  std::optional<ReferenceFloor> floor;
  if (!pair.c.empty())
    floor = floor_of(pair, main_layer(pair.a, pair.b, job.layers), b,
                     allows_equal_nonfinite(options, pictures.b.source),
                     at_exposures_of(a, b, options));
  pair.comparison = compare_pictures(pictures, pair.a, pair.b, options);
  pair.comparison->reference_floor = std::move(floor);
  pair.layers = compare_others(pair.a, pair.b, pictures, job.layers, options);
  difference(a, b, *pair.comparison, pair.verdict());
  pair.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return pair;
}

/// Calls work(i) for i < count, in parallel. A thread that waits for a part of its own pair does not start another one,
/// so no more pairs are in memory than there are threads.
template <class Work>
void for_each_pair(std::size_t count, Work work) {
  oneapi::tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    oneapi::tbb::this_task_arena::isolate([&] { work(i); });
  });
}

/// One range for the set, so that a number means the same in every pair.
HdrExposures exposures_for_all(const std::vector<PairReport>& pairs, const CompareJob& job) {
  const HdrExposures& asked = *job.comparison.viewing.hdr_exposures;
  std::mutex mutex;
  std::optional<HdrExposures> all;
  std::string why = "no reference has finite values alone";
  std::size_t why_of = pairs.size();
  for_each_pair(pairs.size(), [&](std::size_t i) {
    try {
      Image reference =
          read_picture(pairs[i].b, main_layer(pairs[i].a, pairs[i].b, job.layers)).image;
      if (job.comparison.crop) reference = cut(std::move(reference), *job.comparison.crop);
      if (!is_finite(reference)) return;
      const HdrExposures one = automatic_exposures(reference, asked);
      const std::lock_guard lock(mutex);
      if (!all) all = one;
      all->start_stops = std::min(all->start_stops, one.start_stops);
      all->stop_stops = std::max(all->stop_stops, one.stop_stops);
    } catch (const Error& error) {
      if (error.code() != ExitCode::kInput) throw;
      const std::lock_guard lock(mutex);
      if (i > why_of) return;
      why = fmt::format("{}: {}", printable_path(pairs[i].b), error.what());
      why_of = i;
    }
  });
  if (!all) {
    all = asked;
    all->problem = why;
  }
  if (!asked.given_count)
    all->count = std::min(count_of_exposures(all->start_stops, all->stop_stops), kMaxHdrExposures);
  return *all;
}

/// The row's name, after the set's title if several sets are judged.
std::string name_of(const Pairing& pairing, std::size_t row, std::size_t set) {
  const std::string& name = pairing.rows[row].name;
  return pairing.sets.size() > 2 ? pairing.sets[set] + "/" + name : name;
}

std::string layer_reasons(const LayerComparison& layer, const std::string& a,
                          const std::string& b) {
  if (layer.identical) return "identical";
  if (!layer.comparison) return layer.problem;
  const Comparison& comparison = *layer.comparison;
  if (comparison.verdict == Verdict::kNonFinite) return why_not_pass(comparison, a, b);
  std::string text;
  for (const LimitResult& limit : comparison.limits)
    text += fmt::format("{}{} {:.4g}{}", text.empty() ? "" : ", ", limit.metric, limit.value,
                        limit.pass ? "" : fmt::format(" (limit {:g})", limit.limit));
  return text;
}

void print_layer_names(const char* where, const std::vector<std::string>& names) {
  for (const std::string& name : names)
    fmt::print("  only in {}: {}\n", where, name.empty() ? "the picture" : printable(name));
}

/// The verdict and the limits of each layer, the layers of one file alone, and what was not compared.
void print_layers(const OtherLayers& layers, const std::string& a, const std::string& b) {
  if (!layers.compared.empty() || layers.common) fmt::print("\n");
  for (const LayerComparison& layer : layers.compared)
    fmt::print("  {}: {}; {}\n", layer.title(), verdict_name(layer.verdict()),
               layer_reasons(layer, a, b));
  if (layers.common) {
    print_layer_names("a", layers.common->only_a);
    print_layer_names("b", layers.common->only_b);
  }
  if (!is_empty(layers.not_compared))
    fmt::print("  not compared: {}\n", to_text(layers.not_compared));
}

/// Names each file with an ICC profile that is not applied.
void print_profiles(const PicturePairSource& sources) {
  for (const auto& [name, source] : {std::pair('a', &sources.a), {'b', &sources.b}})
    if (!source->icc_profile.empty() && !source->icc_is_srgb)
      fmt::print("  {}: its ICC profile '{}' is not sRGB, and is not applied\n", name,
                 printable(source->icc_profile));
}

void print_names(const std::string& a, const std::string& b, const std::string& c) {
  fmt::print("a  {}\nb  {}  (the reference)\n", printable_path(a), printable_path(b));
  if (!c.empty()) fmt::print("c  {}  (the second reference)\n", printable_path(c));
}

/// "± 0.0012  "; blank for a figure without an error bar, "" where no noise is known.
std::string error_bar_text(const Comparison& comparison, std::string_view id) {
  if (!comparison.uncertainty) return "";
  const ErrorBar* bar = records::find(comparison.error_bars, id);
  return fmt::format("{:<12}", bar ? fmt::format("± {:.2g}", bar->standard_error) : "");
}

void print_exposures(const Viewing& viewing) {
  if (viewing.tail_stops)
    fmt::print(
        "  shown at {:.3g} stops for the peak and at {:.3g} for the tail; the worse counts\n\n",
        viewing.exposure_stops, *viewing.tail_stops);
}

void print_parts(const Comparison& comparison) {
  const auto print = [](std::string_view what, std::span<const std::string> of,
                        std::int64_t pixels) {
    std::string shapes;
    for (const std::string& shape : of)
      shapes += (shapes.empty() ? "" : " and ") + printable_path(shape);
    fmt::print("  {} {}: {} pixels\n", what, shapes, pixels);
  };
  if (const auto& crop = comparison.crop)
    fmt::print("  of both, {} x {} pixels from x {}, y {}\n", crop->width, crop->height, crop->x,
               crop->y);
  if (const auto& ignored = comparison.ignored)
    print("equal by --ignore", ignored->of, ignored->pixels);
  if (!comparison.mask_of.empty() && comparison.mask_pixels)
    print("the mask is", comparison.mask_of, *comparison.mask_pixels);
}

/// A column of the table of metrics: values by the id that a metric has in it.
struct Column {
  const char* title;
  const records::Named<double>* values;
  Region region;
};

void print_metric_lines(const Comparison& comparison) {
  const auto& floor = comparison.reference_floor;
  std::vector<Column> columns{{"A and B", &comparison.metrics, Region::kWhole}};
  if (floor) columns.push_back({"C and B", &floor->metrics, Region::kWhole});
  if (comparison.highlight_pixels.value_or(0) > 0)
    columns.push_back({"highlight", &comparison.metrics, Region::kHighlight});
  if (comparison.mask_pixels) {
    columns.push_back({"in the mask", &comparison.metrics, Region::kMask});
    columns.push_back({"outside", &comparison.metrics, Region::kOutside});
  }
  fmt::print("  {:<20}", "");
  for (const Column& column : columns) fmt::print("{:>13}", column.title);
  fmt::print("\n");
  for (const Metric* metric : metrics())
    for (const MetricOutput& output : metric->outputs) {
      if (metric->region != Region::kWhole) continue;
      const std::string id(output.id);
      std::string cells;
      bool any = false;
      for (const Column& column : columns) {
        const double* value =
            records::find(*column.values, id_in_region(*metric, output, column.region));
        any = any || (value && !std::isnan(*value));
        cells += fmt::format("{:>13}", value ? fmt::format("{:.6g}", *value) : "");
      }
      if (!any) continue;
      fmt::print("  {:<20}{}", id, cells);
      fmt::print("  {}{}\n", error_bar_text(comparison, id), output.meaning);
    }
  for (const NotMeasured& one : comparison.not_measured)
    if (find_metric(one.metric)->region == Region::kWhole)
      fmt::print("  {:<20}{:>13}  not measured: {}\n", one.metric, "-", one.because);
}

void print_limit_lines(const std::vector<LimitResult>& limits, std::string_view before) {
  for (const LimitResult& limit : limits)
    fmt::print("  {}{:<26}{:>14.6g}  {} {:g}\n", before, limit.metric, limit.value,
               std::isnan(limit.value)             ? "was NOT MEASURED; the limit is"
               : limit.pass                        ? "is within"
               : limit.standing == Standing::kOpen ? "MAY BE ON EITHER SIDE OF"
                                                   : "is OUTSIDE",
               limit.limit);
}

/// The short table leaves out regions, unless a figure has a default limit.
bool is_in_short_table(std::string_view id) {
  return find_metric(id)->region == Region::kWhole ||
         std::ranges::count(highlight_limits(), id, &MetricLimit::metric) > 0;
}

/// A line for each metric that some pairs lack, with the reason of the first of them.
void print_not_measured(const std::vector<PairReport>& pairs) {
  std::map<std::string_view, std::pair<std::size_t, std::string>> reasons;
  for (const PairReport& pair : pairs)
    if (pair.comparison)
      for (const NotMeasured& one : pair.comparison->not_measured)
        ++reasons.try_emplace(one.metric, 0, one.because).first->second.first;
  for (const auto& [id, why] : reasons)
    if (is_in_short_table(id))
      fmt::print("  {:<26}not measured in {} pairs: {}\n", id, why.first, why.second);
}

}  // namespace

std::vector<PairReport> pairs_of(const Pairing& pairing) {
  std::vector<PairReport> pairs;
  for (std::size_t row = 0; row < pairing.rows.size(); ++row)
    for (std::size_t set = 0; set < pairing.sets.size(); ++set) {
      const std::vector<std::string>& files = pairing.rows[row].files;
      if (set == kReferenceSet || files[set].empty() || files[kReferenceSet].empty()) continue;
      PairReport pair{name_of(pairing, row, set), files[set], files[kReferenceSet], "", {}, {}, 0};
      pair.row = row;
      pair.set = set;
      pairs.push_back(std::move(pair));
    }
  return pairs;
}

PicturePair read_compared(const PairReport& pair, const CompareJob& job, const Pairing& pairing,
                          ComparisonOptions& options) {
  PicturePair pictures = read_pair(pair.a, pair.b, main_layer(pair.a, pair.b, job.layers));
  job.noise.read(has_folders_by_name(job, pairing) ? pairing.rows[pair.row].name : "",
                 pictures.a.image, pictures.b.image, options);
  const Image &a = pictures.a.image, &b = pictures.b.image;
  if (!options.surfaces.empty() && options.surfaces.size() != a.pixel_count())
    throw Error(ExitCode::kInput,
                fmt::format("{} has {} x {} pixels, the film of {} {}", pair.a, a.width(),
                            a.height(), job.scene, options.surfaces.size()));
  job.regions.apply(b.width(), b.height(), options);
  take_part(pictures, pair.a, pair.b, options);
  return pictures;
}

SetReport compare_pairs(const CompareJob& job, const Pairing& pairing) {
  const bool one = is_one_pair(pairing);
  SetReport report;
  for (std::size_t set = 0; set < pairing.sets.size(); ++set) {
    const auto& given = job.pictures.given;
    const std::string& title = given.size() > 1 ? given[set] : pairing.sets[set];
    if (set == kReferenceSet)
      report.b = title;
    else
      report.a += (report.a.empty() ? "" : ", ") + title;
  }
  report.c = job.c;
  report.passed_over = pairing.passed_over;
  report.not_followed = pairing.not_followed;
  for (std::size_t row = 0; row < pairing.rows.size(); ++row)
    for (std::size_t set = 0; set < pairing.sets.size(); ++set) {
      const std::vector<std::string>& files = pairing.rows[row].files;
      if (set != kReferenceSet && files[set].empty() != files[kReferenceSet].empty())
        (files[set].empty() ? report.missing : report.extra).push_back(name_of(pairing, row, set));
    }
  report.pairs = pairs_of(pairing);
  for (PairReport& pair : report.pairs)
    if (!job.c.empty()) pair.c = one ? job.c : file_of(job.c, pairing.rows[pair.row].name).string();
  ComparisonOptions options = job.comparison;
  const bool automatic = has_automatic_exposures(options);
  if (automatic && !one) options.viewing.hdr_exposures = exposures_for_all(report.pairs, job);
  const DifferencePicture& wanted = job.difference;
  const auto write = [&](const PairReport& pair, const Image& a, const Image& b,
                         const Comparison& comparison, std::optional<double> of_set) {
    const fs::path file = one ? wanted.path : difference_file(job, pair.name);
    if (!one) make_directories(file.parent_path());
    wanted.write(file, a, b, comparison, of_set);
  };
  const bool at_once = one || wanted.has_own_scale();
  // One scale for the set. If that is the largest difference, all pairs come first.
  std::vector<double> largest(report.pairs.size(), -1.0);
  for_each_pair(report.pairs.size(), [&](std::size_t i) {
    PairReport& pair = report.pairs[i];
    try {
      pair = compare_pair(
          pair, job, pairing, options, automatic && one,
          [&](const Image& a, const Image& b, const Comparison& comparison, Verdict verdict) {
            if (one) wanted.write_histogram(a, b, comparison);
            if (!wanted.is_wanted(verdict)) return;
            if (at_once)
              write(pair, a, b, comparison, std::nullopt);
            else
              largest[i] = wanted.largest(a, b, comparison);
          });
    } catch (const Error& error) {
      if (one || error.code() != ExitCode::kInput) throw;
      pair.error = error.what();
    }
  });
  if (wanted.path.empty() || at_once || largest.empty()) return report;
  const double of_set = std::ranges::max(largest);
  for_each_pair(report.pairs.size(), [&](std::size_t i) {
    const PairReport& pair = report.pairs[i];
    if (!(largest[i] >= 0)) return;
    ComparisonOptions unused = options;
    PicturePair pictures = read_compared(pair, job, pairing, unused);
    if (allows_equal_nonfinite(options, pictures.b.source))
      clear_equal_nonfinite(pictures.a.image, pictures.b.image);
    write(pair, pictures.a.image, pictures.b.image, *pair.comparison, of_set);
  });
  return report;
}

void print_pair(const PairReport& pair) {
  const Comparison& comparison = *pair.comparison;
  print_names(pair.a, pair.b, pair.c);
  if (const auto& display = comparison.viewing.display)
    fmt::print("shown by view {} of display {} in {}\n", printable(display->choice().view),
               printable(display->choice().display), printable_path(display->choice().config));
  fmt::print("\n");
  if (comparison.verdict == Verdict::kNonFinite)
    fmt::print("  {}; nothing was measured\n", why_not_pass(comparison, pair.a, pair.b));
  if (comparison.nonfinite.equal_allowed.value_or(0) > 0)
    fmt::print("  in {} pixels both have the same NaN or infinity, which counts as no difference\n",
               *comparison.nonfinite.equal_allowed);
  print_parts(comparison);
  if (const std::string sentence = highlight_sentence(comparison); !sentence.empty())
    fmt::print("  {}\n\n", sentence);
  print_exposures(comparison.viewing);
  print_metric_lines(comparison);
  fmt::print("\n");
  if (comparison.verdict != Verdict::kNonFinite) {
    print_limit_lines(comparison.limits, "");
    print_limit_lines(comparison.warnings, "warning: ");
  }
  for (const LimitResult& limit : comparison.limits)
    if (limit.more_samples && std::isfinite(*limit.more_samples))
      fmt::print("  about {:.3g} times the samples would tell about {}\n", *limit.more_samples,
                 limit.metric);
  for (const std::string& sentence : comparison.disagreement)
    fmt::print("  metrics disagree: {}\n", sentence);
  for (const std::string& sentence : comparison.blind_limits)
    fmt::print("  warning: {}\n", sentence);
  if (pair.layers) print_layers(*pair.layers, pair.a, pair.b);
  if (pair.sources) print_profiles(*pair.sources);
  fmt::print("\nverdict: {}\n", verdict_name(pair.verdict()));
}

void print_set(const SetReport& report) {
  print_names(report.a, report.b, report.c);
  fmt::print("\n");
  const auto line = [](std::string_view what, const std::string& name, const std::string& why) {
    fmt::print("  {:<12}{}{}{}\n", what, printable_path(name), why.empty() ? "" : ": ",
               printable_path(why));
  };
  // Problems come first.
  for (const PairReport& pair : report.pairs)
    if (!pair.comparison) line("error", pair.name, pair.error);
  for (const std::string& name : report.missing) line("missing", name, "there is only a reference");
  for (const std::string& name : report.not_followed) line("link", name, std::string(kNotFollowed));
  for (const PairReport& pair : report.pairs)
    if (pair.comparison && !is_pass(pair.verdict()))
      line(verdict_name(pair.verdict()), pair.name, why_not_pass(pair));
  for (const PairReport& pair : report.pairs)
    if (pair.comparison)
      for (const LimitResult& limit : pair.comparison->warnings)
        if (!limit.pass)
          line("warning", pair.name,
               fmt::format("{} {}, limit {:g}", limit.metric, value_text(*pair.comparison, limit),
                           limit.limit));
  for (const std::string& name : report.extra) line("extra", name, "there is no reference");

  const std::vector<MetricSummary> summaries = summarise(report.pairs);
  if (!summaries.empty()) fmt::print("\n  {:<26}{:>14}{:>14}\n", "", "mean", "worst");
  for (const MetricSummary& metric : summaries)
    if (is_in_short_table(metric.id))
      fmt::print("  {:<26}{:>14.6g}{:>14.6g}  {}\n", metric.id, metric.mean, metric.worst,
                 printable_path(metric.worst_at->name));
  print_not_measured(report.pairs);
  const records::SetSummary counts = count(report);
  fmt::print(
      "\n{} pairs: {} pass, {} differ, {}{} not finite, {} not comparable; {} missing, {} extra\n",
      report.pairs.size(), counts.pass, counts.differs,
      counts.undecided > 0 ? fmt::format("{} undecided, ", counts.undecided) : "",
      counts.non_finite, counts.errors, counts.missing, counts.extra);
  if (const SetNotCompared left = not_compared(report); left.pairs > 0)
    fmt::print("not compared, in {} of the pairs: {}\n", left.pairs, to_text(left.all));
  if (report.passed_over > 0) fmt::print("{} files are no pictures\n", report.passed_over);
  if (counts.links_not_followed > 0)
    fmt::print("{} links to folders elsewhere were not followed\n", counts.links_not_followed);
}

}  // namespace lobelia::cli
