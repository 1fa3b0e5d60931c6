// Area lights and inter-reflection: error over samples and time, with and without importance sampling, by us and by
// an engine.
#include "studies/cost/benchmarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/system/error.hpp"
#include "base/words/constants.hpp"
#include "base/words/error_time_chart.hpp"
#include "reference_scenes/engine.hpp"
#include "renderer/render_record.hpp"
#include "studies/cost/convergence.hpp"
#include "studies/cost/scenes.hpp"

namespace lobelia::cost {
namespace {

using Directions = Experiment::Directions;

/// Seeds of the converged pictures.
constexpr std::uint64_t kTruthSeeds[] = {1001, 1002};
/// Samples of a converged picture, in units of the most samples that are measured.
constexpr int kTruthFactor = 2;
/// The smallest squared error, relative to the picture, that a converged picture's own error does not hide.
constexpr double kLeastSquare = 1e-20;

struct Sampling {
  const char* name;
  const char* setting;
  Directions directions;
};
constexpr Sampling kSamplings[] = {
    {"ours", "light and surface, as planned", Directions::kPlanned},
    {"ours, by the surface", "surface", Directions::kSurface},
    {"ours, evenly", "none: evenly over the hemisphere", Directions::kEven},
};

/// The average of two pictures, with its expected error.
struct Converged {
  Image image;
  double error = 0;  ///< expected root mean square
  Converged() = default;
  Converged(const Image& a, const Image& b)
      : image(mean_of(a, b)), error(rms_of_difference(a, b) / 2) {}
};

/// The measurements at one number of samples.
struct Point {
  int samples = 1;
  std::vector<double> seconds, errors;  ///< by seed; errors are root mean squares
  records::CostFacts facts;
};

/// One kind of sampling by one engine.
struct Series {
  std::string name, engine, sampling;
  std::vector<Point> points;

  Series(std::string series, std::string by, std::string how, const std::vector<int>& counts)
      : name(std::move(series)), engine(std::move(by)), sampling(std::move(how)) {
    for (const int samples : counts) points.emplace_back().samples = samples;
  }
};

std::vector<int> sample_counts(const Options& options) {
  std::vector<int> counts;
  for (int n = 1; n <= options.rounds(16, 256, 1024); n *= 4) counts.push_back(n);
  return counts;
}

void measure_ours(const Scene& scene, int seed, const Converged& truth, Directions directions,
                  Series& series) {
  RenderOptions how;
  how.experiment.directions = directions;
  for (Point& point : series.points) {
    const Timed timed = render_timed(scene, point.samples, std::uint64_t(seed), how);
    point.seconds.push_back(timed.seconds);
    point.errors.push_back(rms_of_difference(timed.result.image, truth.image));
    point.facts.rays = rays_record(timed.result.work);
  }
}

/// The first engine of the catalogue with its own light transport. It renders one picture after the other, each on all
/// processors, in one process: a start takes seconds.
class TransportEngine {
 public:
  explicit TransportEngine(const Options& options) {
    const EngineInfo* const info = transport_engine();
    if (!info) {
      title = "an engine";
      why_not = "no engine traces light by itself";
      return;
    }
    name = info->name;
    title = info->transport;
    const auto program = options.programs.find(name);
    engine_ = make_engine(name, program == options.programs.end() ? "" : program->second);
    const EngineStatus& status = engine_->status();
    why_not = status.why;
    if (!status.available()) return;
    ReferenceOptions how;
    how.processes = 1;
    how.own_transport = true;
    how.no_progress_limit = std::chrono::minutes(5);
    session_.emplace(*engine_, how);
  }

  explicit operator bool() const { return session_.has_value(); }

  ReferenceResult render(Scene scene, int samples, std::uint64_t seed) {
    scene.sampler.sample_count = samples;
    scene.sampler.seed = seed;
    ReferenceResult result = session_->render(scene);
    if (!result.error.empty()) throw Error(ExitCode::kEngine, result.error);
    require_picture(result.image, title.c_str());
    return result;
  }

  std::string name;
  std::string title;    ///< "Cycles"
  std::string why_not;  ///< the reason if it is not available

 private:
  std::unique_ptr<Engine> engine_;
  std::optional<Session> session_;
};

void measure_engine(TransportEngine& by, const Scene& scene, int seed, const Converged& truth,
                    Series& series) {
  for (Point& point : series.points) {
    const ReferenceResult result = by.render(scene, point.samples, std::uint64_t(seed));
    point.seconds.push_back(result.record.seconds.total);
    point.errors.push_back(rms_of_difference(result.image, truth.image));
  }
}

Converged converged_picture(TransportEngine& by, const Scene& scene, int samples) {
  return {by.render(scene, samples, kTruthSeeds[0]).image,
          by.render(scene, samples, kTruthSeeds[1]).image};
}

/// Relative to the picture, without the converged picture's own error.
double error_of(const Point& point, const Converged& truth) {
  double squared = 0;
  for (const double error : point.errors) squared += error * error / double(point.errors.size());
  const double scale = std::pow(rms(truth.image), 2);
  return std::sqrt(std::max(kLeastSquare, (squared - truth.error * truth.error) / scale));
}

double spread_of(const Point& point, const Converged& truth) {
  const double n = double(point.errors.size());
  if (n < 2) return kNaN;
  double mean = 0, squared = 0;
  for (const double error : point.errors) mean += error / n;
  for (const double error : point.errors) squared += std::pow(error - mean, 2) / (n - 1);
  return std::sqrt(squared) / rms(truth.image);
}

std::string slope_text(const Slope& slope) {
  if (!std::isfinite(slope.value)) return "?";
  if (!std::isfinite(slope.standard_error)) return fmt::format("{:.2f}", slope.value);
  return fmt::format("{:.2f} +- {:.2f}", slope.value, slope.standard_error);
}

std::string time_text(const TimeTo& time) {
  if (!std::isfinite(time.seconds)) return "a time that cannot be told";
  const char* said = time.reach == TimeTo::Reach::kAtOnce   ? " (4 samples are better)"
                     : time.reach == TimeTo::Reach::kBeyond ? " (extrapolated)"
                                                            : "";
  return short_time_text(time.seconds) + said;
}

/// Adds the variants of a series, and remarks on its slopes and times.
void add_series(const Series& series, const Converged& truth, Table& table) {
  std::vector<double> samples, seconds, errors;
  for (const Point& point : series.points) {
    Variant variant;
    variant.name = fmt::format("{}, {}", series.name, point.samples);
    variant.settings = {{"engine", series.engine},
                        {"importance_sampling", series.sampling},
                        {"samples", std::to_string(point.samples)}};
    variant.seconds = records::rounds_record(summary(point.seconds));
    variant.errors = {{"rmse_rel", error_of(point, truth)}};
    variant.error_spreads.emplace() = {{"rmse_rel", spread_of(point, truth)}};
    variant.facts = point.facts;
    samples.push_back(point.samples);
    seconds.push_back(variant.seconds->median);
    errors.push_back(variant.errors[0].second);
    table.variants.push_back(std::move(variant));
  }
  // Slopes leave out a single sample, which goes through the pixel's centre and so misses edges, and times that are
  // mostly the start.
  const auto later = [](const std::vector<double>& values, std::size_t from) {
    return std::vector<double>(values.begin() + std::ptrdiff_t(from), values.end());
  };
  const std::size_t working = samples.size() > 3 ? 2 : 1;
  std::string slopes =
      fmt::format("{}: the error falls as the samples to the power {}", series.name,
                  slope_text(fit_slope(later(samples, 1), later(errors, 1))));
  if (seconds.back() > 2 * seconds[working])
    slopes += fmt::format(", as the time to the power {}",
                          slope_text(fit_slope(later(seconds, working), later(errors, working))));
  else
    slopes += "; its time is mostly the start";
  table.remarks.push_back(slopes);
  std::string times;
  for (const double wanted : {1e-2, 1e-3, 1e-4})
    times += fmt::format(
        "{} {:.0e} takes {}", times.empty() ? "" : ",", wanted,
        time_text(time_to(later(samples, 1), later(seconds, 1), later(errors, 1), wanted)));
  table.remarks.push_back(fmt::format("{}: an error of{}", series.name, times));
}

/// Two correct programs differ by noise, and where a plane ends in one of them; beyond this one of them is wrong.
constexpr double kMostApart = 0.03;

std::string agreement(const Converged& ours, const Converged& theirs, const std::string& title) {
  const double scale = rms(theirs.image);
  const double apart = rms_of_difference(ours.image, theirs.image) / scale;
  const double noise = std::hypot(ours.error, theirs.error) / scale;
  if (apart > kMostApart + 2 * noise)
    throw Error(ExitCode::kInternal,
                "light transport: our converged picture and that of {} are {:.2g} apart "
                "(relative RMS), their noise is {:.2g}",
                title, apart, noise);
  return fmt::format(
      "the converged pictures of ours and {} are {:.1e} apart (relative RMS), their noise is {:.1e}",
      title, apart, noise);
}

Table measure_scene(const std::string& id, const std::string& title, const Scene& scene,
                    TransportEngine* by, const Options& options) {
  const std::vector<int> counts = sample_counts(options);
  const int most = kTruthFactor * counts.back();
  Table table;
  table.id = "transport-" + id;
  table.level = "transport";
  table.title = fmt::format("{}, {} x {}", title, scene.film.width, scene.film.height);
  table.per = "picture";
  table.errors = {
      {"rmse_rel",
       "root mean square error, relative to that of the engine's own converged picture"}};

  options.progress(id + ": converged pictures");
  const Converged ours(render_timed(scene, most, kTruthSeeds[0]).result.image,
                       render_timed(scene, most, kTruthSeeds[1]).result.image);
  const Converged theirs = by ? converged_picture(*by, scene, most) : Converged();
  std::vector<Series> series;
  for (const Sampling& sampling : kSamplings)
    series.emplace_back(sampling.name, "lobelia", sampling.setting, counts);
  if (by)
    series.emplace_back(by->title, by->name,
                        fmt::format("light and surface, by {} itself", by->title), counts);

  // Interleaved, so that a change in the machine's speed affects all alike.
  const int rounds = options.rounds(2, 3, 7);
  for (int seed = 1; seed <= rounds; ++seed) {
    options.progress(fmt::format("{}: round {} of {}", id, seed, rounds));
    for (std::size_t s = 0; s < std::size(kSamplings); ++s)
      measure_ours(scene, seed, ours, kSamplings[s].directions, series[s]);
    if (by) measure_engine(*by, scene, seed, theirs, series.back());
  }
  for (const Series& one : series) add_series(one, one.engine == "lobelia" ? ours : theirs, table);
  table.remarks.push_back(fmt::format(
      "errors of the picture: of {} seeds each, against {} samples of two others, whose own error is "
      "taken out (ours {:.1e}{})",
      rounds, most, ours.error / rms(ours.image),
      by ? fmt::format(", {} {:.1e}", by->title, theirs.error / rms(theirs.image)) : ""));
  if (by) {
    table.remarks.push_back(agreement(ours, theirs, by->title));
    table.remarks.push_back(fmt::format(
        "times of {} are of a running program that is given the scene, with setting it up and the file; ours "
        "are of plan and picture",
        by->title));
  }
  return table;
}

}  // namespace

std::vector<Table> measure_transport(const Options& options) {
  const int side = options.rounds(48, 96, 192);
  TransportEngine engine(options);
  std::vector<Table> tables;
  const auto add = [&](const char* id, const char* title, const Scene& scene) {
    Table& table =
        tables.emplace_back(measure_scene(id, title, scene, engine ? &engine : nullptr, options));
    if (!engine)
      table.remarks.push_back(fmt::format("without {}: {}", engine.title, engine.why_not));
  };
  add("rectangle_light", "A sphere on a plane below a rectangle of light", below_rectangle(side));
  add("environment", "A sphere on a plane below a sky with a small sun", below_sky(side));
  add("inter_reflection", "Below the rectangle, with light that goes from surface to surface",
      with_inter_reflection(below_rectangle(side)));
  return tables;
}

}  // namespace lobelia::cost
