// Scenes with lights of some size, lenses and several rays a pixel, as averages of what engines render.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/finite_image.hpp"
#include "reference_scenes/engine.hpp"
#include "reference_scenes/engine_program.hpp"
#include "reference_scenes/preparation.hpp"
#include "reference_scenes/replicates.hpp"

namespace lobelia {
namespace {

/// One scene that was asked for, and what the engine is asked for it.
struct Request {
  std::vector<Replicate> replicates;  ///< of a plain scene, one of one
  std::vector<std::vector<ReferenceResult>> parts;
  std::size_t unfinished = 0;
  bool average = false;
};

/// Of one scene, from many parts; the rest says the same again.
constexpr std::size_t kMostLog = 1 << 20;

struct Place {
  std::size_t request, replicate, part;
};

/// The weighted mean of a replicate's pictures, and the lights themselves.
std::vector<double> estimate(const SizedLights& lights, const Replicate& replicate,
                             const std::vector<ReferenceResult>& parts) {
  std::vector<double> sum(parts.front().image.values().size());
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const double weight = replicate[p].weight / double(parts.size());
    const Image seen = lights.seen_in(replicate[p].scene);
    for (std::size_t i = 0; i < sum.size(); ++i)
      sum[i] += weight * (double(parts[p].image.values()[i]) + double(seen.values()[i]));
  }
  return sum;
}

ReferenceResult average(const Scene& scene, Request& request, const ReferenceOptions& options) {
  ReferenceResult result;
  double seconds = 0, cpu_seconds = 0;
  std::uint64_t peak_memory_bytes = 0;
  std::size_t pictures = 0, passes = 0;
  for (auto& replicate : request.parts)
    for (ReferenceResult& part : replicate) {
      if (!part.error.empty()) {
        if (result.error.empty()) {
          result.error = part.error;
          result.failure = part.failure;
        }
        continue;
      }
      seconds += part.record.seconds.total;
      passes += part.record.passes;
      cpu_seconds += part.record.cpu_seconds.value_or(0);
      peak_memory_bytes = std::max(peak_memory_bytes, part.record.peak_memory_bytes.value_or(0));
      ++pictures;
    }
  result.record = request.parts.front().front().record;
  if (!result.error.empty()) return result;
  const SizedLights lights(scene);
  std::vector<double> sum, squares;
  for (std::size_t r = 0; r < request.parts.size(); ++r) {
    const auto values = estimate(lights, request.replicates[r], request.parts[r]);
    sum.resize(values.size());
    squares.resize(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      sum[i] += values[i];
      squares[i] += values[i] * values[i];
    }
    request.parts[r].clear();
  }
  const double n = double(request.parts.size());
  result.image = Image(scene.film.width, scene.film.height);
  result.standard_error = Image(scene.film.width, scene.film.height);
  for (std::size_t i = 0; i < sum.size(); ++i) {
    const double mean = sum[i] / n, variance = std::max(0.0, squares[i] / n - mean * mean);
    result.image.values()[i] = float(mean);
    result.standard_error.values()[i] = float(std::sqrt(variance / (n - 1)));
  }
  records::Reference& record = result.record;
  record.method = fmt::format(
      "{}; the mean of {} pictures in {} independent sets, {} points of each light with a size, of the "
      "lens and of the pixel in all; such lights themselves, where the camera sees them, by Lobelia",
      record.method, pictures, kReplicates, options.points);
  record.passes = passes;
  record.points = options.points;
  record.seed = options.seed;
  record.seconds = {};
  record.seconds.total = seconds;
  if (record.cpu_seconds)
    record_cost(record, cpu_seconds, peak_memory_bytes, record.threads.value_or(1));
  // All alike but for the names of files.
  if (record.engine_commands.size() > 1) record.engine_commands.resize(1);
  return result;
}

}  // namespace

std::uint64_t memory_to_average(const Scene& scene, const ReferenceOptions& options) {
  if (!needs_replicates(scene)) return 0;
  constexpr std::uint64_t kOfPicture = 3 * sizeof(float), kOfSums = 3 * 3 * sizeof(double);
  return std::uint64_t(scene.film.width) * std::uint64_t(scene.film.height) *
         (std::uint64_t(options.points) * kOfPicture + kOfSums);
}

std::string Engine::why_not(const Scene& scene, const ReferenceOptions& options) const {
  if (std::string why = why_not_comparable(scene); !why.empty()) return why;
  if (!needs_replicates(scene)) return why_not_simple(scene, options);
  return why_not_simple(replicates(scene, 1, 1, options.seed)[0][0].scene, options);
}

void Engine::render(std::span<const Scene> scenes, const ReferenceOptions& options,
                    const OnResult& on_result) {
  require_available(info(), status());
  if (options.points < kReplicates || options.points % kReplicates != 0)
    throw Error(ExitCode::kUsage,
                fmt::format("{} points; allowed: multiples of {}", options.points, kReplicates));
  std::vector<Request> requests(scenes.size());
  std::vector<Scene> simple;
  std::vector<Place> places;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    if (std::string why = why_not(scenes[i], options); !why.empty()) {
      on_result(i, failed_result(info(), status(), scenes[i], {FailureClass::kRefused, why}));
      continue;
    }
    Request& request = requests[i];
    request.average = needs_replicates(scenes[i]);
    if (request.average)
      request.replicates =
          replicates(scenes[i], kReplicates, options.points / kReplicates, options.seed);
    else
      request.replicates.push_back({{scenes[i], 1}});
    for (std::size_t r = 0; r < request.replicates.size(); ++r) {
      request.parts.emplace_back(request.replicates[r].size());
      for (std::size_t p = 0; p < request.replicates[r].size(); ++p) {
        simple.push_back(request.replicates[r][p].scene);
        places.push_back({i, r, p});
        ++request.unfinished;
      }
    }
  }
  // An engine numbers what it is asked for; whoever asked knows other numbers.
  const TemporaryDirectory logs;
  ReferenceOptions for_parts = options;
  if (!options.log_directory.empty()) for_parts.log_directory = logs.path();
  std::map<std::size_t, std::string> texts;
  std::mutex asking;
  std::vector<std::optional<bool>> answers(scenes.size());
  if (options.begin)
    for_parts.begin = [&](std::size_t index) {
      const std::scoped_lock lock(asking);
      const std::size_t i = places[index].request;
      if (!answers[i]) answers[i] = options.begin(i);
      return *answers[i];
    };
  render_simple(simple, for_parts, [&](std::size_t index, ReferenceResult part) {
    const auto [i, r, p] = places[index];
    Request& request = requests[i];
    if (!options.log_directory.empty()) {
      std::string& text = texts[i];
      if (text.size() < kMostLog) text += read_engine_log(for_parts, info(), index);
      if (request.unfinished == 1) {
        write_engine_log(options, info(), i, text);
        texts.erase(i);
      }
    }
    if (part.error.empty() && !is_finite(part.image)) {
      part.error = fmt::format("{}'s picture has values that are not finite", info().title);
      part.failure = FailureClass::kNonFinite;
      part.image = {};
    }
    request.parts[r][p] = std::move(part);
    if (--request.unfinished > 0) return;
    on_result(
        i, request.average ? average(scenes[i], request, options) : std::move(request.parts[0][0]));
    request = {};
  });
}

}  // namespace lobelia
