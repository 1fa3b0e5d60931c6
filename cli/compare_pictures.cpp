#include "cli/compare_pictures.hpp"

#include <fnmatch.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <tuple>
#include <utility>

#include "compare/highlight_region.hpp"
#include "compare/metrics/catalogue.hpp"
#include "compare/require_same_size.hpp"
#include "core/files.hpp"
#include "core/for_each_whole.hpp"
#include "core/image_io.hpp"
#include "core/image_values.hpp"
#include "core/replacement.hpp"
#include "core/sha256.hpp"
#include "core/standard_streams.hpp"
#include "core/text.hpp"
#include "core/threads.hpp"

namespace lobelia::cli {
namespace {

namespace fs = std::filesystem;

bool has_automatic_exposures(const ComparisonOptions& options) {
  return options.viewing.hdr_exposures && options.viewing.hdr_exposures->automatic;
}

/// `options.layer`; if all layers are asked for and a file has no picture, the first layer that both have.
LayerNames main_layer(const std::string& a, const std::string& b, const LayerOptions& options) {
  if (!options.all) return options.layer;
  const std::string first = common_layers(a, b).both.front();
  return {first, first};
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
                        bool choose_exposures, Difference difference) {
  const auto started = std::chrono::steady_clock::now();
  const SteadyFile file_a(pair.a), file_b(pair.b);
  ComparisonOptions options = job.comparison;
  PicturePair pictures = read_compared(pair, job, pairing, options);
  Image &a = pictures.a.image, &b = pictures.b.image;
  pair.sources = {pictures.a.source, pictures.b.source};
  if (choose_exposures)
    options.viewing.hdr_exposures = exposures_or_why_not(b, *options.viewing.hdr_exposures);
  std::optional<ReferenceFloor> floor;
  if (!pair.c.empty())
    floor = floor_of(pair, main_layer(pair.a, pair.b, job.layers).b, b,
                     allows_equal_nonfinite(options, pictures.b.source),
                     at_exposures_of(a, b, options));
  pair.comparison = compare_pictures(pictures, pair.a, pair.b, options);
  pair.comparison->reference_floor = std::move(floor);
  pair.layers = compare_others(pair.a, pair.b, pictures, job.layers, options);
  if (job.hash_files) pair.hashes = {file_a.digest(), file_b.digest()};
  difference(a, b, *pair.comparison, pair.verdict());
  pair.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return pair;
}

/// Compares with each reference. The best one passes, or else is the least over its limits.
PairReport compare_with_each(const PairReport& pair, const CompareJob& job, const Pairing& pairing,
                             bool choose_exposures) {
  const auto fit = [](const PairReport& one) {
    return std::pair(!is_pass(one.verdict()), excess(one));
  };
  std::optional<PairReport> best;
  for (const std::string& reference : pair.references) {
    PairReport one = pair;
    one.b = reference;
    one = compare_pair(one, job, pairing, choose_exposures, [](auto&&...) {});
    if (!best || fit(one) < fit(*best)) best = std::move(one);
  }
  return *best;
}

bool fits(const std::string& match, const std::string& name) {
  return ::fnmatch(match.c_str(), name.c_str(), 0) == 0;
}

std::optional<records::Known> known_of(const CompareJob& job, const std::string& name) {
  for (const records::KnownDifference& known : job.known)
    if (fits(known.match, name))
      return records::Known{known.reason, known.expires, known.expires < job.today};
  return std::nullopt;
}

/// Calls work(i) for i < count, in parallel. A thread that waits for a part of its own pair does not start another one,
/// so no more pairs are in memory than there are threads. Those are one more than processors, unless fewer are asked for:
/// a thread waits while another process decodes its picture, and would leave a processor idle each time they take turns.
template <class Work>
void for_each_pair(std::size_t count, Work work) {
  const int threads = oneapi::tbb::this_task_arena::max_concurrency();
  const bool one_more = count > 1 && threads == usual_threads() && threads > 1;
  ThreadLimit(threads + one_more).run([&] {
    for_each_whole(count,
                   [&](std::size_t i) { oneapi::tbb::this_task_arena::isolate([&] { work(i); }); });
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
          read_picture(pairs[i].b, main_layer(pairs[i].a, pairs[i].b, job.layers).b).image;
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
  return pairing.sets.size() > 2 + pairing.also_accepted ? pairing.sets[set] + "/" + name : name;
}

}  // namespace

std::vector<MetricLimit> with_limits(std::vector<MetricLimit> limits,
                                     const std::vector<MetricLimit>& more) {
  std::erase_if(limits, [&](const MetricLimit& limit) {
    return std::ranges::count(more, limit.metric, &MetricLimit::metric) > 0;
  });
  limits.insert(limits.end(), more.begin(), more.end());
  return limits;
}

CompareJob job_of(const CompareJob& job, const std::string& name) {
  CompareJob own = job;
  ComparisonOptions& options = own.comparison;
  for (const PairRule& rule : job.rules) {
    if (!fits(rule.match, name)) continue;
    options.limits = with_limits(options.limits, rule.limits);
    options.warnings = with_limits(options.warnings, rule.warnings);
    if (rule.tolerance) options.tolerance = rule.tolerance;
    if (rule.default_limits) options.default_limits = *rule.default_limits;
    own.regions.change(rule.mask, rule.ignored, options);
  }
  return own;
}

std::vector<PairReport> pairs_of(const Pairing& pairing) {
  std::vector<PairReport> pairs;
  for (std::size_t row = 0; row < pairing.rows.size(); ++row) {
    const std::vector<std::string> references = pairing.references_of(pairing.rows[row]);
    for (std::size_t set = 0; set < pairing.sets.size(); ++set) {
      const std::vector<std::string>& files = pairing.rows[row].files;
      if (pairing.is_reference(set) || files[set].empty() || references.empty()) continue;
      PairReport pair{name_of(pairing, row, set), files[set], references.front(), "", {}, {}, 0};
      pair.row = row;
      pair.set = set;
      pair.references = references;
      pairs.push_back(std::move(pair));
    }
  }
  return pairs;
}

std::array<records::Named<std::string>, 2> reading_of(const PairReport& pair) {
  std::array facts{reading_facts(pair.sources->a), reading_facts(pair.sources->b)};
  if (const auto& noise = pair.comparison->uncertainty)
    for (std::size_t i = 0; i < facts.size(); ++i)
      if (const auto& one = i == 0 ? noise->a : noise->b; one && !one->layer.empty())
        facts[i].emplace_back("Noise", "layer " + printable(one->layer));
  return facts;
}

PicturePair read_compared(const PairReport& pair, const CompareJob& job, const Pairing& pairing,
                          ComparisonOptions& options) {
  PicturePair pictures = read_pair(pair.a, pair.b, main_layer(pair.a, pair.b, job.layers));
  job.noise.read(has_folders_by_name(job, pairing) ? pairing.rows[pair.row].name : "", pair,
                 pictures, options);
  const Image &a = pictures.a.image, &b = pictures.b.image;
  if (!options.surfaces.empty() && options.surfaces.size() != a.pixel_count())
    throw Error(ExitCode::kInput,
                fmt::format("{} has {} x {} pixels, the film of {} {}", pair.a, a.width(),
                            a.height(), job.scene, options.surfaces.size()));
  job.regions.apply(b.width(), b.height(), options);
  take_part(pictures, pair.a, pair.b, options);
  return pictures;
}

std::string plain_id(const std::string& name) {
  constexpr std::size_t kLongest = 80;
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.";
  std::string id = name.substr(0, kLongest);
  for (char& c : id)
    if (kPlain.find(c) == std::string_view::npos) c = '-';
  if (id == name && is_plain_name(id)) return id;
  constexpr std::size_t kDigits = 10;
  return "p" + id + "-" + hex(sha256(name)).substr(0, kDigits);
}

fs::path difference_file(const CompareJob& job, const std::string& name) {
  constexpr std::size_t kLongest = 255;
  const fs::path own = name + ".png";
  // A table may name a pair anything.
  const bool is_inside = own.is_relative() && own == own.lexically_normal() &&
                         *own.begin() != ".." && own.filename().string().size() <= kLongest;
  return job.difference.path / (is_inside ? own : fs::path(plain_id(name) + ".png"));
}

SetReport compare_pairs(const CompareJob& asked, const Pairing& pairing,
                        const std::function<void(std::size_t)>& done) {
  CompareJob job = asked;
  const bool one = is_one_pair(pairing);
  SetReport report;
  for (std::size_t set = 0; set < pairing.sets.size(); ++set) {
    const auto& [given, further] = std::tie(job.pictures.given, job.pictures.also_accepted);
    const std::string& title = given.size() < 2     ? pairing.sets[set]
                               : set < given.size() ? given[set]
                                                    : further[set - given.size()];
    std::string& side = pairing.is_reference(set) ? report.b : report.a;
    side += (side.empty() ? "" : ", ") + title;
  }
  report.c = job.c;
  report.passed_over = pairing.passed_over;
  report.not_followed = pairing.not_followed;
  report.misnamed = pairing.misnamed;
  for (std::size_t row = 0; row < pairing.rows.size(); ++row)
    for (std::size_t set = 0; set < pairing.sets.size(); ++set) {
      const PictureRow& pictures = pairing.rows[row];
      const bool has_reference = !pairing.references_of(pictures).empty();
      if (!pairing.is_reference(set) && pictures.files[set].empty() == has_reference)
        (has_reference ? report.missing : report.extra).push_back(name_of(pairing, row, set));
    }
  report.pairs = pairs_of(pairing);
  for (PairReport& pair : report.pairs)
    if (!job.c.empty()) pair.c = one ? job.c : file_of(job.c, pairing.rows[pair.row].name).string();
  const bool automatic = has_automatic_exposures(job.comparison);
  if (automatic && !one)
    job.comparison.viewing.hdr_exposures = exposures_for_all(report.pairs, job);
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
  std::atomic<std::size_t> count = 0;
  for_each_pair(report.pairs.size(), [&](std::size_t i) {
    PairReport& pair = report.pairs[i];
    try {
      const CompareJob own = job_of(job, pair.name);
      const bool several = pair.references.size() > 1;
      if (several) pair = compare_with_each(pair, own, pairing, automatic && one);
      if (!several || !wanted.path.empty() || !wanted.histogram.empty())
        pair = compare_pair(
            pair, own, pairing, automatic && one,
            [&](const Image& a, const Image& b, const Comparison& comparison, Verdict verdict) {
              if (one) wanted.write_histogram(a, b, comparison);
              if (!wanted.is_wanted(verdict)) return;
              if (at_once)
                write(pair, a, b, comparison, std::nullopt);
              else
                largest[i] = wanted.largest(a, b, comparison);
            });
      pair.known = known_of(job, pair.name);
    } catch (const Error& error) {
      if (error.code() != ExitCode::kInput) throw;
      pair.error = error.what();
    }
    done(++count);
  });
  if (wanted.path.empty() || at_once || largest.empty()) return report;
  const double of_set = std::ranges::max(largest);
  for_each_pair(report.pairs.size(), [&](std::size_t i) {
    const PairReport& pair = report.pairs[i];
    if (!(largest[i] >= 0)) return;
    const CompareJob own = job_of(job, pair.name);
    ComparisonOptions unused = own.comparison;
    PicturePair pictures = read_compared(pair, own, pairing, unused);
    if (allows_equal_nonfinite(own.comparison, pictures.b.source))
      clear_equal_nonfinite(pictures.a.image, pictures.b.image);
    write(pair, pictures.a.image, pictures.b.image, *pair.comparison, of_set);
  });
  return report;
}

}  // namespace lobelia::cli
