#include "compare/set/run.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <tuple>
#include <utility>

#include "base/pictures/image_io.hpp"
#include "base/pictures/image_values.hpp"
#include "base/system/for_each_whole.hpp"
#include "base/system/threads.hpp"
#include "base/words/text.hpp"
#include "compare/accept/replacement.hpp"
#include "compare/highlight_region.hpp"
#include "compare/set/unjudged_limits.hpp"
#include "profile/require_same_size.hpp"

namespace lobelia {
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

/// Judges pictures that are ready, by the options of the pair.
void judge_pair(PairReport& pair, PicturePair& pictures, const CompareJob& job,
                ComparisonOptions& options, bool choose_exposures) {
  const Image& a = pictures.a.image;
  Image& b = pictures.b.image;
  if (choose_exposures)
    options.viewing.hdr_exposures = exposures_or_why_not(b, *options.viewing.hdr_exposures);
  std::optional<ReferenceFloor> floor;
  if (!pair.c.empty())
    floor = floor_of(pair, main_layer(pair.a, pair.b, job.layers).b, b,
                     allows_equal_nonfinite(options, pictures.b.source),
                     at_exposures_of(a, b, options));
  pair.comparison = compare_pictures(pictures, pair.a, pair.b, options);
  pair.comparison->reference_floor = std::move(floor);
}

/// Everything besides the picture that two files hold.
void compare_rest(PairReport& pair, const PicturePair& pictures, const CompareJob& job,
                  const ComparisonOptions& options) {
  pair.sources = {pictures.a.source, pictures.b.source};
  pair.layers = compare_others(pair.a, pair.b, pictures, job.layers, options);
}

/// Makes pictures that were read ready to be judged: with the noise, and the parts that are compared.
void prepare(PicturePair& pictures, const PairReport& pair, const CompareJob& job,
             ComparisonOptions& options) {
  job.noise.read(pair, pictures, options);
  const Image &a = pictures.a.image, &b = pictures.b.image;
  if (!options.surfaces.empty() && options.surfaces.size() != a.pixel_count())
    throw Error(ExitCode::kInput, "{} has {} x {} pixels, the film of {} {}", pair.a, a.width(),
                a.height(), job.scene, options.surfaces.size());
  job.parts.apply(b.width(), b.height(), options);
  take_part(pictures, pair.a, pair.b, options);
}

/// Calls look(pair, a, b) once the pair is compared, if there is such a function.
PairReport compare_pair(PairReport pair, const CompareJob& job, bool choose_exposures,
                        const LookAtPair& look) {
  const auto started = std::chrono::steady_clock::now();
  const SteadyFile file_a(pair.a), file_b(pair.b);
  ComparisonOptions options = job.comparison;
  PicturePair pictures = read_compared(pair, job, options);
  judge_pair(pair, pictures, job, options, choose_exposures);
  compare_rest(pair, pictures, job, options);
  if (job.hash_files) pair.hashes = {file_a.digest(), file_b.digest()};
  if (look) look(pair, pictures.a.image, pictures.b.image);
  pair.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return pair;
}

/// Compares with each reference. The best one passes, or else is the least over its limits.
PairReport compare_with_each(const PairReport& pair, const CompareJob& job, bool choose_exposures) {
  const auto fit = [](const PairReport& one) {
    return std::pair(!is_pass(one.verdict()), excess(one));
  };
  std::optional<PairReport> best;
  for (const std::string& reference : pair.references) {
    PairReport one = pair;
    one.b = reference;
    one = compare_pair(one, job, choose_exposures, nullptr);
    if (!best || fit(one) < fit(*best)) best = std::move(one);
  }
  return *best;
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

void for_each_pair(std::size_t count, const std::function<void(std::size_t)>& work) {
  const int threads = oneapi::tbb::this_task_arena::max_concurrency();
  const bool one_more = count > 1 && threads == usual_threads() && threads > 1;
  ThreadLimit(threads + one_more).run([&] {
    for_each_whole(count,
                   [&](std::size_t i) { oneapi::tbb::this_task_arena::isolate([&] { work(i); }); });
  });
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
      if (pairing.is_by_name) pair.name_in_folders = pairing.rows[row].name;
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

PicturePair read_two(const CompareJob& job, const PairReport& pair) {
  return read_pair(pair.a, pair.b, main_layer(pair.a, pair.b, job.layers));
}

PicturePair read_compared(const PairReport& pair, const CompareJob& job,
                          ComparisonOptions& options) {
  PicturePair pictures = read_two(job, pair);
  prepare(pictures, pair, job, options);
  return pictures;
}

PairReport compare_two(const CompareJob& job, PairReport pair, PicturePair& pictures) {
  ComparisonOptions options = job.comparison;
  prepare(pictures, pair, job, options);
  judge_pair(pair, pictures, job, options, has_automatic_exposures(options));
  compare_rest(pair, pictures, job, options);
  require_judged_limits(job, {&pair, 1});
  return pair;
}

PairReport compare_in_memory(const CompareJob& job, PairReport pair, PicturePair& pictures,
                             std::optional<PicturePair> alpha) {
  ComparisonOptions options = job.comparison;
  prepare(pictures, pair, job, options);
  judge_pair(pair, pictures, job, options, has_automatic_exposures(options));
  if (alpha) {
    OtherLayers& others = pair.layers.emplace();
    if (job.layers.ignore_alpha || options.noise)
      others.not_compared.alpha = true;
    else
      others.compared.push_back(
          compare_alpha("A", *std::move(alpha), pair.a, pair.b, std::move(options)));
  }
  require_judged_limits(job, {&pair, 1});
  return pair;
}

void require_pairs(const SetReport& report) {
  if (report.pairs.empty())
    throw Error(ExitCode::kInput,
                "no pair to compare: {} references have no picture, {} pictures no "
                "reference, and {} files are no pictures or do not fit the pattern",
                report.missing.size(), report.extra.size(), report.passed_over);
}

SetReport compare_pairs(const CompareJob& asked, const Pairing& pairing,
                        const std::function<void(std::size_t)>& done, const LookAtPair& look) {
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
  report.missing_reference_fails = job.missing_reference_fails;
  for (std::size_t row = 0; row < pairing.rows.size(); ++row)
    for (std::size_t set = 0; set < pairing.sets.size(); ++set) {
      const PictureRow& pictures = pairing.rows[row];
      const bool has_reference = !pairing.references_of(pictures).empty();
      if (!pairing.is_reference(set) && pictures.files[set].empty() == has_reference)
        (has_reference ? report.missing : report.extra).push_back(name_of(pairing, row, set));
    }
  report.pairs = pairs_of(pairing);
  for (PairReport& pair : report.pairs)
    if (!job.c.empty()) pair.c = file_of(job.c, pair.name_in_folders).string();
  const bool automatic = has_automatic_exposures(job.comparison);
  if (automatic && !one)
    job.comparison.viewing.hdr_exposures = exposures_for_all(report.pairs, job);
  std::atomic<std::size_t> count = 0;
  for_each_pair(report.pairs.size(), [&](std::size_t i) {
    PairReport& pair = report.pairs[i];
    try {
      const CompareJob own = job_of(job, pair.name);
      const bool several = pair.references.size() > 1;
      if (several) pair = compare_with_each(pair, own, automatic && one);
      if (!several || look) pair = compare_pair(pair, own, automatic && one, look);
      pair.known = known_of(job, pair.name);
    } catch (const Error& error) {
      if (error.code() != ExitCode::kInput) throw;
      pair.error = error.what();
    }
    done(++count);
  });
  require_judged_limits(job, report.pairs);
  return report;
}

}  // namespace lobelia
