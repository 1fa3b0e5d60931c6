#include "studies/verdicts/verdicts.hpp"

#include <algorithm>
#include <cmath>

#include "base/system/error.hpp"
#include "compare/uncertainty/noise_draws.hpp"
#include "renderer/render.hpp"
#include "studies/agreement/example_scenes.hpp"

namespace lobelia::verdicts {
namespace {

/// Uniform numbers in (0, 1), the same on every machine.
class Uniform {
 public:
  explicit Uniform(std::uint64_t seed) : state_(mix(seed)) {}
  double operator()() { return (double(mix(++state_) >> 11) + 0.5) * 0x1p-53; }
  double exponential() { return -std::log((*this)()); }

 private:
  std::uint64_t state_;
};

/// A ball with a highlight of peak 1 on a matt base, on black. u and v run from -1 to 1.
double light_at(double u, double v, double wider) {
  const double middle = u * u + v * v;
  if (middle > 0.7) return 0;
  const double du = u - 0.2, dv = v + 0.15;
  return 0.15 * (1 - middle) + std::exp(-30 / (wider * wider) * (du * du + dv * dv));
}

Image made(const Cell& cell, std::uint64_t seed, double wider) {
  constexpr double kOfSample = 0.5;  // standard deviation of a sample
  constexpr double kShareOfFireflies = 0.02, kFirefly = 5;
  Uniform uniform(seed);
  const double error = kOfSample / std::sqrt(cell.samples);
  Image image(cell.size, cell.size);
  for (int y = 0; y < cell.size; ++y)
    for (int x = 0; x < cell.size; ++x) {
      const double light =
          light_at((x + 0.5) / cell.size * 2 - 1, (y + 0.5) / cell.size * 2 - 1, wider);
      const std::uint64_t pixel = std::uint64_t(y) * std::uint64_t(cell.size) + std::uint64_t(x);
      double grey = 1, more = 0;
      if (cell.noise == Noise::kGrey) more = error * gaussian(seed, pixel);
      if (cell.noise == Noise::kGamma || cell.noise == Noise::kFireflies) {
        grey = 0;
        for (int k = 0; k < cell.samples; ++k) grey += uniform.exponential() / cell.samples;
      }
      if (cell.noise == Noise::kFireflies && uniform() < kShareOfFireflies)
        more = kFirefly * uniform.exponential();
      constexpr double kTint[] = {1, 0.8, 0.6};
      for (std::size_t c = 0; c < 3; ++c) {
        if (cell.noise == Noise::kColours) more = error * gaussian(seed, 3 * pixel + c);
        image.pixel(x, y)[c] = float(kTint[c] * light * grey + more);
      }
    }
  return image;
}

Scene scene_of(const Cell& cell, std::uint64_t seed, double wider) {
  // The width of cos^n is in proportion to 1 / sqrt(n).
  const HighlightChoice choice{"modified_phong", "cosine", "exact", 64 / (wider * wider)};
  const bool matt = cell.noise == Noise::kCycles;
  const Light ball = SphereLight{{2, 2.5, 2.5}, 0.6, {20, 16, 12}};
  const Light window = RectangleLight{{-2, 2, 2}, {0.5, 0, 0.5}, {0, -0.6, 0}, {9, 12, 15}};
  Scene scene = ground_scene(choice, {matt ? window : ball}, cell.size);
  if (matt)
    for (Material& material : scene.materials) material.specular_reflectance = {};
  scene.sampler = {cell.samples, seed};
  return scene;
}

}  // namespace

Cycles::Cycles(const std::map<std::string, std::filesystem::path>& programs) {
  const EngineInfo* const info = transport_engine();
  if (!info) {
    why_not_ = "no engine traces light by itself";
    return;
  }
  const auto given = programs.find(std::string(info->name));
  engine_ = make_engine(info->name, given == programs.end() ? "" : given->second);
  const EngineStatus& status = engine_->status();
  why_not_ = status.why;
  if (!status.available()) return;
  ReferenceOptions how;
  how.processes = 1;
  how.own_transport = true;
  session_ = std::make_unique<Session>(*engine_, how);
}

Cycles::~Cycles() = default;

Image Cycles::render(const Cell& cell, std::uint64_t seed) {
  ReferenceResult result = session_->render(scene_of(cell, seed, 1));
  if (!result.error.empty()) throw Error(ExitCode::kEngine, result.error);
  return std::move(result.image);
}

Image picture_of(const Cell& cell, std::uint64_t seed, Cycles* cycles, double wider) {
  if (cell.noise == Noise::kCycles) return cycles->render(cell, seed);
  if (cell.noise != Noise::kRenders) return made(cell, mix(seed), wider);
  RenderOptions options;
  options.threads = 1;  // other pairs keep the other processors busy
  return render(scene_of(cell, seed, wider), options).image;
}

}  // namespace lobelia::verdicts
