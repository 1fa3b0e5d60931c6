// Scenes with area lights, lenses and several rays per pixel as averages of pictures by engines.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/pictures/image_values.hpp"
#include "base/system/error.hpp"
#include "reference_scenes/at_once.hpp"
#include "reference_scenes/engine.hpp"
#include "reference_scenes/engine_program.hpp"
#include "reference_scenes/preparation.hpp"
#include "reference_scenes/replicates.hpp"
#include "renderer/scene/scene_format.hpp"

namespace lobelia {
namespace {

/// Bytes of a scene's log. Its many parts repeat each other.
constexpr std::size_t kMostLog = 1 << 20;

/// The results of each part of each replicate.
using Parts = std::vector<std::vector<ReferenceResult>>;

/// The weighted mean of a replicate's pictures, with the visible lights.
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

ReferenceResult average(const Scene& scene, const std::vector<Replicate>& all, Parts& parts,
                        const ReferenceOptions& options) {
  ReferenceResult result;
  result.begun = std::chrono::steady_clock::time_point::max();
  EngineCost cost;
  std::size_t pictures = 0, passes = 0;
  for (auto& replicate : parts)
    for (ReferenceResult& part : replicate) {
      if (result.log.size() < kMostLog) result.log += part.log;
      result.begun = std::min(result.begun, part.begun);
      if (!part.error.empty()) {
        if (result.error.empty()) {
          result.error = part.error;
          result.failure = part.failure;
        }
        continue;
      }
      passes += part.record.passes;
      cost.add({part.record.seconds.total, part.record.cpu_seconds.value_or(0),
                part.record.peak_memory_bytes.value_or(0)});
      ++pictures;
    }
  result.record = parts.front().front().record;
  if (!result.error.empty()) return result;
  const SizedLights lights(scene);
  std::vector<double> sum, squares;
  for (std::size_t r = 0; r < parts.size(); ++r) {
    const auto values = estimate(lights, all[r], parts[r]);
    sum.resize(values.size());
    squares.resize(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      sum[i] += values[i];
      squares[i] += values[i] * values[i];
    }
    parts[r].clear();
  }
  const double n = double(parts.size());
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
  record.seconds.total = cost.seconds;
  if (record.cpu_seconds) record_cost(record, cost, record.threads.value_or(1));
  // They differ only in file names.
  if (record.engine_commands.size() > 1) record.engine_commands.resize(1);
  return result;
}

}  // namespace

double EngineFloor::of_peak_in(const Scene& scene) const {
  double exponent = 0, radii = 0;
  for (const Material& material : scene.materials)
    if (has_highlight(material)) exponent = std::max(exponent, material.highlight.exponent);
  for (const Sphere& sphere : scene.spheres)
    radii = std::max(radii, length(scene.camera.origin - sphere.center) / sphere.radius);
  const double turn = radii * of_place + radii * radii * of_quadratic;
  return of_peak + (2 * std::sqrt(exponent / std::numbers::e) + 1) * turn + exponent * of_cosine;
}

std::uint64_t memory_to_average(const Scene& scene, const ReferenceOptions& options) {
  if (!needs_replicates(scene)) return 0;
  constexpr std::uint64_t kOfPicture = 3 * sizeof(float), kOfSums = 3 * 3 * sizeof(double);
  return std::uint64_t(scene.film.width) * std::uint64_t(scene.film.height) *
         (std::uint64_t(options.points) * kOfPicture + kOfSums);
}

bool Engine::averages(const Scene& scene) const {
  return !info().whole_scenes && needs_replicates(scene);
}

std::string Engine::why_not(const Scene& scene, const ReferenceOptions& options,
                            const AxisValues& axes) const {
  if (std::string why = whole_picture_problem(scene.film); !why.empty()) return why;
  if (info().whole_scenes) return why_not_whole(scene, axes);
  if (options.own_transport) return why_not_transport(scene);
  if (std::string why = why_not_comparable(scene); !why.empty()) return why;
  if (!needs_replicates(scene)) return why_not_simple(scene, options);
  return why_not_simple(replicates(scene, 1, 1, options.seed)[0][0].scene, options);
}

Session::Session(Engine& engine, const ReferenceOptions& options)
    : engine_(engine), options_(options) {
  require_available(engine.info(), engine.status());
  if (options.points < kReplicates || options.points % kReplicates != 0)
    throw Error(ExitCode::kUsage, "{} points; allowed: multiples of {}", options.points,
                kReplicates);
  simple_ = engine.open_simple(options_);
}

ReferenceResult Session::render_part(const Scene& scene, const AxisValues& axes,
                                     std::size_t scenes) {
  ReferenceResult part = simple_->render_cell(scene, axes, scenes);
  if (part.error.empty() && !is_finite(part.image)) {
    part.error = fmt::format("{}'s picture has values that are not finite", engine_.info().title);
    part.failure = FailureClass::kNonFinite;
    part.image = {};
  }
  return part;
}

ReferenceResult Session::render(const Scene& scene, const AxisValues& axes) {
  if (std::string why = engine_.why_not(scene, options_, axes); !why.empty())
    return failed_result(engine_.info(), engine_.status(), scene, {FailureClass::kRefused, why});
  if (options_.own_transport || !engine_.averages(scene))
    return render_part(scene, axes, options_.scenes);
  const std::vector<Replicate> all =
      replicates(scene, kReplicates, options_.points / kReplicates, options_.seed);
  Parts parts;
  std::vector<std::pair<std::size_t, std::size_t>> places;  // in the order of replicates
  for (const Replicate& replicate : all) {
    for (std::size_t p = 0; p < replicate.size(); ++p) places.emplace_back(parts.size(), p);
    parts.emplace_back(replicate.size());
  }
  for_each_at_once(
      places.size(), simple_->at_once(places.size()),
      [&](std::size_t i) {
        const auto [r, p] = places[i];
        parts[r][p] = render_part(all[r][p].scene, axes, places.size());
      },
      [this] { stop(); });
  return average(scene, all, parts, options_);
}

}  // namespace lobelia
